//! A run: the world, the robots, and the order in which a step happens.

use super::agenda::Agenda;
use super::inbox::Calendar;
use super::populate::{Programs, StartError};
use super::record::Tally;
use super::shard::{SIZE, Shard};
use super::shared::{Shared, Window};
use super::simulated_robot::SimulatedRobot;
use super::slots::Slots;
use super::things::Things;
use super::{populate, radio};
use crate::scenario::{Network, Scenario};
use starl_core::event::Name;
use starl_core::geometry::ObstacleIndex;
use starl_core::motion::Obstacles;
use starl_core::{
    Digest, Duration, Estimate, Point, Program, Record, RobotId, Time, WayPoint, math,
};
use starl_host::Node;
use starl_host::journal::{Batch, Journal};
use starl_motion::contact::{Contact, Contacts, Motions, Parts};
use starl_motion::{Neighbour, State};
use std::sync::Arc;

/// A running scenario. A clone continues exactly as the original would.
#[derive(Clone)]
pub struct Simulation {
    pub(super) now: Time,
    /// The scenario as it was at the start.
    pub(super) origin: Arc<Scenario>,
    pub(super) shared: Shared,
    pub(super) shards: Vec<Shard>,
    pub(super) calendar: Calendar,
    /// Where bodies would be after the step if nothing were in the way.
    pub(super) next: Vec<Point>,
    /// Where bodies are after the step; changes places with the shared ones at its end.
    pub(super) bodies: Vec<Neighbour>,
    /// The first contacts of robots in the step, for their settlement.
    found: Vec<Vec<(RobotId, Contact)>>,
    contacts: Contacts,
    pub(super) agenda: Agenda,
    /// Whether robots have joined or left since the spatial index was built.
    pub(super) have_changed: bool,
    /// When the last fault came.
    pub(super) disturbed: Time,
    /// When the last one came that overwrote the state of robots.
    pub(super) corrupted: Time,
    /// How many robots have a motor that is stuck, or sensors that are frozen.
    pub(super) impaired: usize,
    /// When the next obstacle vanishes.
    pub(super) next_expiry: Time,
    pub(super) world_digest: Digest,
    pub(super) world_records: Vec<Record>,
    records: Vec<Record>,
    journal: Batch,
    parallel: bool,
}

/// How far the robots are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Robots that are up.
    pub up: usize,
    /// Of these, robots whose programs have reached their goals.
    pub finished: usize,
    /// Of these, robots whose programs have failed.
    pub failed: usize,
}

impl Simulation {
    /// Sets up a run. `programs` makes a fresh program for a group of robots, or returns the problem with its name or
    /// parameters.
    pub fn new(scenario: Scenario, programs: &Programs<'_>) -> Result<Simulation, StartError> {
        let kinds = populate::kinds(&scenario, programs)?;
        let origin = Arc::new(scenario);
        let scenario = &origin;
        let fleet: Arc<[RobotId]> = (0..scenario.fleet.len() as u32).map(RobotId).collect();
        let mut shared = Shared {
            fleet,
            kinds,
            map: ObstacleIndex::new(&[]),
            standing: Vec::new(),
            known: Arc::new([]),
            hidden: Vec::new(),
            bodies: Vec::new(),
            perceived: Vec::new(),
            grid: Default::default(),
            inboxes: Default::default(),
            parts: Vec::new(),
            one_way: false,
            wind: Point::ZERO,
            network: scenario.network.clone(),
            obstacles: scenario.world.obstacles.clone(),
            way_points: scenario.world.way_points.clone(),
            things: Things::new(&scenario.world.things),
            gone: Vec::new(),
            scenario: origin.clone(),
        };
        let shards = populate::populate(&mut shared);
        let mut simulation = Simulation {
            now: Time::ZERO,
            next: vec![Point::ZERO; shared.bodies.len()],
            bodies: shared.bodies.clone(),
            found: Vec::new(),
            contacts: Contacts::default(),
            agenda: Agenda::new(&origin),
            have_changed: false,
            origin,
            shared,
            shards,
            calendar: Calendar::default(),
            disturbed: Time::ZERO,
            corrupted: Time::ZERO,
            impaired: 0,
            next_expiry: Time::NEVER,
            world_digest: Digest::default(),
            world_records: Vec::new(),
            records: Vec::new(),
            journal: Batch::default(),
            parallel: false,
        };
        simulation.raise_obstacles();
        Ok(simulation)
    }

    /// Whether events are kept for [`Simulation::records`]; off at first.
    pub fn set_recording(&mut self, recording: bool) {
        for shard in &mut self.shards {
            shard.log.recording = recording;
        }
    }

    /// Whether [`Simulation::journal`] is kept; off at first. To be called before the first step, since a
    /// journal from later on cannot be replayed.
    pub fn set_journal(&mut self, keep: bool) {
        for shard in &mut self.shards {
            let journal = || Box::new(Journal::new(RobotId(shard.first), shard.members.len()));
            shard.journal = keep.then(journal);
        }
    }

    /// Whether shards step in parallel, on the thread pool in which [`Simulation::step`] is called.
    /// The results are the same either way. Without the feature `parallel` this does nothing.
    pub fn set_parallel(&mut self, parallel: bool) {
        self.parallel = parallel;
    }

    /// The scenario of the simulation.
    pub fn scenario(&self) -> &Scenario {
        &self.shared.scenario
    }

    /// The network as it is now, after everything that has changed it.
    pub fn network(&self) -> &Network {
        &self.shared.network
    }

    /// The present time.
    pub fn now(&self) -> Time {
        self.now
    }

    /// The time since the start or since the last fault began or ended; zero while the network is
    /// partitioned, a motor is stuck or sensors are frozen.
    pub fn undisturbed(&self) -> Duration {
        if self.impaired > 0 || !self.shared.parts.is_empty() {
            return Duration::ZERO;
        }
        self.now.since(self.disturbed)
    }

    /// How long it is since the start and since a fault last overwrote the state of robots at random.
    pub fn uncorrupted(&self) -> Duration {
        self.now.since(self.corrupted)
    }

    /// Advances by one physics step.
    pub fn step(&mut self) {
        self.records.clear();
        let step = self.shared.scenario.physics.step;
        // The last step ends with the scenario.
        let end = Time::ZERO + self.shared.scenario.duration;
        let to = self.now + step;
        let window = Window {
            from: self.now,
            to: if self.now < end { to.min(end) } else { to },
        };
        if window.from >= self.next_expiry {
            self.raise_obstacles();
        }
        if self.have_moved() {
            self.index_robots();
        }
        self.act(window);
        self.grip();
        self.advance(window);
        self.now = window.to;
        self.collect();
    }

    /// Whether some body is not where the spatial index has it: where it was a step ago.
    fn have_moved(&self) -> bool {
        let mut places = self.shared.bodies.iter().zip(&self.bodies);
        self.now == Time::ZERO
            || self.have_changed
            || places.any(|(now, before)| now.position != before.position)
    }

    fn index_robots(&mut self) {
        self.have_changed = false;
        let Shared {
            grid, bodies, gone, ..
        } = &mut self.shared;
        grid.rebuild(bodies, gone);
    }

    /// Lets robots take their inputs, slot by slot, and carries out interventions at their times.
    fn act(&mut self, window: Window) {
        self.shared.inboxes.begin_step();
        let Scenario { physics, .. } = &*self.shared.scenario;
        let slots = Slots::new(physics.step, self.shared.network.resolution);
        run(self.parallel, self.shards.iter_mut(), |shard| {
            shard.begin_step(window);
        });
        let mut now = window.from;
        loop {
            let own = self.shards.iter().map(Shard::next_due).min();
            let arrival = self.calendar.next().map(|slot| slots.start(slot));
            let next = own.into_iter().chain(arrival).min().unwrap_or(Time::NEVER);
            let next = next.max(now);
            let intervention = self.agenda.next_time();
            if next.min(intervention) >= window.to {
                break;
            }
            if intervention <= next {
                let at = intervention.max(now);
                self.intervene(at);
                if self.have_changed {
                    self.index_robots();
                }
                let shards = self.shards.iter_mut();
                shards.for_each(|shard| shard.schedule(window, at));
                continue;
            }
            let (mut slot, end) = slots.around(next, window, &self.shared.network);
            let sent_arrives = slot.to;
            slot = Window {
                from: slot.from.max(now),
                to: slot.to.min(intervention),
            };
            now = slot.to;
            let robots = self.shared.bodies.len();
            let inboxes = &mut self.shared.inboxes;
            self.calendar.turn(robots, (end, slot.to), inboxes);
            self.act_in_slot(window, slot);
            for shard in &mut self.shards {
                let Shard { outbox, posted, .. } = shard;
                radio::post(&mut self.calendar, outbox, posted, sent_arrives, slots);
                posted.clear();
            }
        }
    }

    /// Moves the bodies. A step in which paths bend is taken in parts.
    fn advance(&mut self, step: Window) {
        let mut parts = Parts::of(step.to.since(step.from));
        loop {
            let part = Window {
                from: step.from + parts.from,
                to: step.from + parts.to,
            };
            self.shared.wind = wind(&self.shared.scenario, part.from);
            let bend = self.predict(part);
            if self.shared.scenario.physics.collisions && !parts.suits(bend) {
                continue;
            }
            self.collide();
            self.settle(step, part);
            if !parts.proceed() {
                return;
            }
            if self.have_moved() {
                self.index_robots();
            }
        }
    }

    /// Predicts the motion of all robots in a part of the step. Returns the greatest bend of a path, metres.
    fn predict(&mut self, part: Window) -> f64 {
        let shared = &self.shared;
        let work = self.shards.iter_mut().zip(self.next.chunks_mut(SIZE));
        run(self.parallel, work, |(shard, next)| {
            shard.predict(shared, part, next);
        });
        self.shards
            .iter()
            .map(|shard| shard.bend)
            .fold(0.0, f64::max)
    }

    /// Lets the robots to which something happens in a slot take their inputs, and routes what they send.
    fn act_in_slot(&mut self, step: Window, slot: Window) {
        for delivery in self.shared.inboxes.arrivals() {
            let to = RobotId(delivery.to);
            self.shards[to.index() / SIZE].arrives(to, delivery.at);
        }
        let shared = &self.shared;
        let is_busy = |shard: &&mut Shard| shard.next_due() < slot.to;
        let busy = self.shards.iter_mut().filter(is_busy);
        run(self.parallel, busy, |shard| {
            shard.act(shared, step, slot);
            shard.route(shared, slot);
        });
    }

    fn collide(&mut self) {
        let shared = &self.shared;
        if !shared.scenario.physics.collisions {
            return;
        }
        let motions = Motions::new(shared.scene(), &shared.standing, &self.next);
        // Cell by cell, since robots with neighbouring numbers may be far apart.
        let cells = shared.grid.entries().chunks(SIZE);
        self.found.resize_with(cells.len(), Vec::new);
        run(
            self.parallel,
            cells.zip(&mut self.found),
            |(robots, found)| {
                motions.first_contacts(robots, found);
            },
        );
        let found = self.found.iter_mut().flat_map(|found| found.drain(..));
        self.contacts.settle(&motions, found);
    }

    fn settle(&mut self, step: Window, part: Window) {
        let mut perceived = std::mem::take(&mut self.shared.perceived);
        let (shared, contacts) = (&self.shared, &self.contacts);
        let shown = perceived
            .chunks_mut(SIZE)
            .map(Some)
            .chain(std::iter::repeat_with(|| None));
        let work = self
            .shards
            .iter_mut()
            .zip(self.bodies.chunks_mut(SIZE))
            .zip(shown)
            .map(|((shard, bodies), perceived)| (shard, bodies, perceived));
        run(self.parallel, work, |(shard, bodies, perceived)| {
            shard.settle(
                shared,
                (step, part),
                contacts,
                bodies,
                perceived.unwrap_or_default(),
            );
        });
        std::mem::swap(&mut self.shared.bodies, &mut self.bodies);
        self.shared.perceived = perceived;
    }

    /// Puts the step's records in the order of their times; those of one time by robot, the world's
    /// first.
    fn collect(&mut self) {
        self.records.append(&mut self.world_records);
        for shard in &mut self.shards {
            self.records.append(&mut shard.log.records);
        }
        self.records.sort_by_key(|record| (record.at, record.robot));
        self.journal.clear();
        for journal in self.shards.iter_mut().filter_map(|s| s.journal.as_mut()) {
            journal.append_to(&mut self.journal);
        }
        self.journal.sort();
    }

    /// The records of the last step, ordered by time and robot. Unless recording, only those of the
    /// world as a whole.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// The inputs of the robots' software in the last step, ordered by time and robot, then in the order
    /// of the calls; empty unless [`Simulation::set_journal`] was called. They are not part of the
    /// digest.
    pub fn journal(&self) -> &Batch {
        &self.journal
    }

    /// The hash of all events so far.
    pub fn digest(&self) -> Digest {
        let mut digest = self.world_digest;
        for member in self.members() {
            digest.word(member.account.digest.value());
        }
        digest
    }

    /// Counts of events so far.
    pub fn tally(&self) -> Tally {
        let mut tally = Tally::default();
        self.shards
            .iter()
            .for_each(|shard| tally.add(&shard.log.tally));
        tally
    }

    /// How far the robots are.
    pub fn progress(&self) -> Progress {
        let mut progress = Progress::default();
        for member in self.members() {
            let condition = member.node.condition();
            if !condition.down {
                progress.up += 1;
                progress.finished += usize::from(condition.has_finished());
                progress.failed += usize::from(condition.failed);
            }
        }
        progress
    }

    /// A robot's true state.
    pub fn state(&self, robot: RobotId) -> &State {
        &self.shards[robot.index() / SIZE].states[robot.index() % SIZE]
    }

    /// A robot's estimate of its state.
    pub fn estimate(&self, robot: RobotId) -> &Estimate {
        self.member(robot).node.estimate()
    }

    /// The existing obstacles that all robots know.
    pub fn known_obstacles(&self) -> Obstacles {
        self.shared.known.clone()
    }

    /// The things in the world by index: name, place, and the robot that holds it. One that has vanished has
    /// no name.
    pub fn things(&self) -> impl Iterator<Item = (&Name, Point, Option<RobotId>)> {
        let things = &self.shared.things;
        (0..).zip(&things.names).map(|(thing, name)| {
            let holder = things.holder(thing);
            let place = match holder {
                Some(robot) => self.state(robot).pose.position,
                None => things.position(thing).unwrap_or_default(),
            };
            (name, place, holder)
        })
    }

    /// The application's waypoints.
    pub fn places(&self) -> &[WayPoint] {
        &self.shared.way_points
    }

    /// The robot's node: its software, timers, clock and condition.
    pub fn node(&self, robot: RobotId) -> &Node {
        &self.member(robot).node
    }

    /// Whether a robot has left the fleet.
    pub fn has_left(&self, robot: RobotId) -> bool {
        self.member(robot).is_gone
    }

    /// A robot's program.
    pub fn program(&self, robot: RobotId) -> &dyn Program {
        self.member(robot).node.program()
    }

    /// The group of a robot, by its place in the fleet.
    pub fn group(&self, robot: RobotId) -> usize {
        self.member(robot).group as usize
    }

    /// Whether a robot has not crashed, or has restarted since.
    pub fn is_up(&self, robot: RobotId) -> bool {
        !self.member(robot).node.condition().down
    }

    /// Whether a robot is up and its program has reached its goal.
    pub fn has_finished(&self, robot: RobotId) -> bool {
        self.member(robot).node.condition().has_finished()
    }

    /// The distance that a robot has travelled, metres.
    pub fn distance(&self, robot: RobotId) -> f64 {
        self.member(robot).distance
    }

    /// How many waypoints a robot's ReachAvoid has reached.
    pub fn way_points(&self, robot: RobotId) -> u32 {
        self.member(robot).account.way_points
    }

    /// How many commands a robot's ReachAvoid has given up.
    pub fn gave_up(&self, robot: RobotId) -> u32 {
        self.member(robot).account.gave_up
    }

    /// How many datagrams a robot has sent.
    pub fn sent(&self, robot: RobotId) -> u32 {
        self.member(robot).account.sent
    }

    /// All robots.
    pub fn robots(&self) -> &[RobotId] {
        &self.shared.fleet
    }

    pub(super) fn member(&self, robot: RobotId) -> &SimulatedRobot {
        &self.shards[robot.index() / SIZE].members[robot.index() % SIZE]
    }

    fn members(&self) -> impl Iterator<Item = &SimulatedRobot> {
        self.shards.iter().flat_map(|shard| &shard.members)
    }
}

/// The air's velocity.
fn wind(scenario: &Scenario, at: Time) -> Point {
    let wind = &scenario.wind;
    if wind.gust == Point::ZERO {
        return wind.steady;
    }
    let turns = at.seconds() / wind.gust_period.seconds();
    wind.steady + wind.gust * math::sin(math::TAU * turns)
}

/// Does independent pieces of work, on several threads if wanted.
fn run<T: Send>(parallel: bool, work: impl Iterator<Item = T>, job: impl Fn(T) + Sync + Send) {
    #[cfg(feature = "parallel")]
    if parallel {
        use rayon::prelude::*;
        let work: Vec<T> = work.collect();
        return work.into_par_iter().for_each(job);
    }
    let _ = parallel;
    work.for_each(job);
}
