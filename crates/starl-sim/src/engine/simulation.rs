//! A run: the world, the robots, and the order in which a step happens.

use super::fault;
use super::inbox::Calendar;
use super::mind::{Account, Mind, Senses};
use super::record::Tally;
use super::shard::{SIZE, Shard};
use super::shared::{Kind, Shared, Window};
use super::{Stream, collide, radio, stream};
use crate::scenario::{Fault, FaultKind, Group, Scenario};
use starl_core::event::Hit;
use starl_core::geometry::ObstacleIndex;
use starl_core::motion::Obstacles;
use starl_core::{
    Agent, Command, Digest, Duration, Estimate, Event, Point, Program, Record, RobotId, Time, math,
    random,
};
use starl_host::hardware::Drive;
use starl_host::journal::{Batch, Journal};
use starl_host::{Clock, Hardware, Node};
use starl_motion::{Neighbour, State};
use std::sync::Arc;

/// A scenario under way. A clone goes on exactly as the original would.
#[derive(Clone)]
pub struct Simulation {
    now: Time,
    shared: Shared,
    shards: Vec<Shard>,
    calendar: Calendar,
    /// Where bodies would be after the step if nothing were in the way.
    next: Vec<Point>,
    /// Where bodies are after the step; changes places with the shared ones at its end.
    bodies: Vec<Neighbour>,
    hits: Vec<Option<Hit>>,
    faults: Vec<Fault>,
    faults_done: usize,
    /// When the last fault came.
    disturbed: Time,
    /// When the last one came that overwrote the state of robots.
    corrupted: Time,
    /// How many robots have a motor that is stuck, or sensors that are frozen.
    impaired: usize,
    /// When the next obstacle vanishes.
    next_expiry: Time,
    world_digest: Digest,
    world_records: Vec<Record>,
    records: Vec<Record>,
    journal: Batch,
    parallel: bool,
}

/// Makes the program of a group's robots, or says why it cannot.
pub type Programs<'a> = dyn Fn(&Group) -> Result<Box<dyn Program>, String> + 'a;

/// Why a run cannot start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartError {
    /// The group of robots concerned, by its place in the fleet.
    pub group: usize,
    /// What is wrong with its program.
    pub message: String,
}

/// How far the robots are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Robots that are up.
    pub up: usize,
    /// Of these, robots whose programs have reached their goals.
    pub finished: usize,
    /// Of these, robots whose programs cannot go on.
    pub failed: usize,
}

impl Simulation {
    /// Sets up a run. `programs` makes a fresh program for a group of robots, or says what is wrong
    /// with its name or parameters.
    pub fn new(scenario: Scenario, programs: &Programs<'_>) -> Result<Simulation, StartError> {
        let kinds = kinds(&scenario, programs)?;
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
            wind: Point::ZERO,
            scenario: Arc::new(scenario),
        };
        let shards = populate(&mut shared);
        let mut simulation = Simulation {
            now: Time::ZERO,
            next: vec![Point::ZERO; shared.bodies.len()],
            bodies: shared.bodies.clone(),
            hits: Vec::new(),
            faults: fault::timeline(&shared.scenario),
            shared,
            shards,
            calendar: Calendar::default(),
            faults_done: 0,
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
            let journal = || Box::new(Journal::new(RobotId(shard.first), shard.minds.len()));
            shard.journal = keep.then(journal);
        }
    }

    /// Whether shards step in parallel, on the thread pool in which [`Simulation::step`] is called.
    /// The results are the same either way. Without the feature `parallel` this does nothing.
    pub fn set_parallel(&mut self, parallel: bool) {
        self.parallel = parallel;
    }

    /// What is simulated.
    pub fn scenario(&self) -> &Scenario {
        &self.shared.scenario
    }

    /// The present time, a multiple of the physics step.
    pub fn now(&self) -> Time {
        self.now
    }

    /// How long it is since the start and since the last fault began or was mended; zero while the network is
    /// parted, a motor is stuck or sensors are frozen.
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
        let window = Window {
            from: self.now,
            to: self.now + step,
        };
        self.bring_faults(window);
        if window.from >= self.next_expiry {
            self.raise_obstacles();
        }
        self.shared.wind = wind(&self.shared.scenario, window.from);
        if self.have_moved() {
            self.shared.grid.rebuild(&self.shared.bodies);
        }
        self.calendar
            .turn(self.shared.bodies.len(), &mut self.shared.inboxes);
        self.act(window);
        self.collide();
        self.settle(window);
        self.route(window, step);
        self.now = window.to;
        self.collect();
    }

    /// Whether some body is not where the spatial index has it: where it was a step ago.
    fn have_moved(&self) -> bool {
        let mut places = self.shared.bodies.iter().zip(&self.bodies);
        self.now == Time::ZERO || places.any(|(now, before)| now.position != before.position)
    }

    fn act(&mut self, window: Window) {
        let shared = &self.shared;
        let work = self.shards.iter_mut().zip(self.next.chunks_mut(SIZE));
        run(self.parallel, work, |(shard, next)| {
            shard.act(shared, window, next)
        });
    }

    fn collide(&mut self) {
        let shared = &self.shared;
        if !shared.scenario.physics.collisions {
            return;
        }
        let reach = shared
            .bodies
            .iter()
            .zip(&self.next)
            .map(|(body, next)| body.position.distance(*next))
            .fold(0.0, f64::max);
        self.hits.resize(self.next.len(), None);
        let next = &self.next;
        let work = self.shards.iter_mut().zip(self.hits.chunks_mut(SIZE));
        run(self.parallel, work, |(shard, hits)| {
            shard.look_ahead(shared, next, reach, hits);
        });
        collide::settle(shared, &mut self.next, reach, &mut self.hits);
    }

    fn settle(&mut self, window: Window) {
        let mut perceived = std::mem::take(&mut self.shared.perceived);
        let (shared, hits) = (&self.shared, &self.hits);
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
            shard.settle(shared, window, hits, bodies, perceived.unwrap_or_default());
        });
        std::mem::swap(&mut self.shared.bodies, &mut self.bodies);
        self.shared.perceived = perceived;
    }

    fn route(&mut self, window: Window, step: Duration) {
        let shared = &self.shared;
        run(self.parallel, self.shards.iter_mut(), |shard| {
            shard.route(shared, window)
        });
        for shard in &self.shards {
            radio::post(
                &mut self.calendar,
                &shard.outbox,
                &shard.posted,
                window.to,
                step,
            );
        }
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

    fn bring_faults(&mut self, window: Window) {
        while let Some(fault) = self
            .faults
            .get(self.faults_done)
            .filter(|f| f.at < window.to)
        {
            let (at, kind) = (fault.at.max(window.from), fault.kind.clone());
            self.faults_done += 1;
            self.bring_fault(at, &kind);
        }
    }

    fn bring_fault(&mut self, at: Time, kind: &FaultKind) {
        self.disturbed = at;
        if matches!(kind, FaultKind::CorruptState(_)) {
            self.corrupted = at;
        }
        let robots = match kind {
            FaultKind::Partition(groups) => {
                self.shared.parts = fault::parts(groups, self.shared.bodies.len());
                return self.note(at, Event::Fault(fault::name(kind).into()));
            }
            FaultKind::Heal => {
                self.shared.parts.clear();
                return self.note(at, Event::Fault(fault::name(kind).into()));
            }
            FaultKind::Crash(robots)
            | FaultKind::Restart(robots)
            | FaultKind::StuckMotor(robots)
            | FaultKind::FrozenSensor(robots)
            | FaultKind::Repair(robots)
            | FaultKind::CorruptState(robots) => robots,
        };
        for &robot in robots {
            let seed = self.shared.scenario.seed;
            let shard = &mut self.shards[robot.index() / SIZE];
            let mind = &mut shard.minds[robot.index() % SIZE];
            let event = Event::Fault(fault::name(kind).into());
            shard.log.record(&mut mind.account.digest, robot, at, event);
            self.impaired -= usize::from(mind.is_impaired());
            match kind {
                FaultKind::Crash(_) => mind.crash(),
                FaultKind::Restart(_) if mind.node.condition().down => {
                    let program = self.shared.kinds[mind.group as usize].program.clone();
                    let key = [u64::from(robot.0), at.0];
                    let agent = Agent::new(program, stream(seed, Stream::Program, &key));
                    mind.node.restart(at, agent);
                    mind.next_estimate = at;
                }
                FaultKind::StuckMotor(_) => mind.motor_stuck = true,
                FaultKind::FrozenSensor(_) => mind.senses.are_frozen = true,
                FaultKind::Repair(_) => {
                    mind.motor_stuck = false;
                    mind.repair_senses();
                }
                FaultKind::CorruptState(_) => {
                    let key = [u64::from(robot.0), at.0];
                    let mut random = stream(seed, Stream::Corruption, &key);
                    // It happens before all that the robot does in this step.
                    shard.corrupt(&self.shared, robot, self.now, &mut random);
                }
                _ => {}
            }
            let mind = &shard.minds[robot.index() % SIZE];
            self.impaired += usize::from(mind.is_impaired());
        }
    }

    fn note(&mut self, at: Time, event: Event) {
        self.world_digest.event(at, &event);
        self.world_records.push(Record {
            at,
            robot: None,
            event,
        });
    }

    /// Makes the map of the obstacles that stand now, and of what is known of them.
    fn raise_obstacles(&mut self) {
        let now = self.now;
        let world = &self.shared.scenario.world;
        let mut standing = Vec::new();
        let mut obstacles = Vec::new();
        let mut known = Vec::new();
        let mut hidden = Vec::new();
        self.next_expiry = Time::NEVER;
        for (index, entry) in world.obstacles.iter().enumerate() {
            if entry.expires <= now {
                continue;
            }
            self.next_expiry = self.next_expiry.min(entry.expires);
            if entry.hidden {
                hidden.push(obstacles.len() as u32);
            } else {
                known.push(entry.obstacle.clone());
            }
            standing.push(index as u32);
            obstacles.push(entry.obstacle.clone());
        }
        if let Some(bounds) = &world.bounds {
            for (side, wall) in bounds.walls().into_iter().enumerate() {
                known.push(wall.clone());
                standing.push((world.obstacles.len() + side) as u32);
                obstacles.push(wall);
            }
        }
        self.shared.map = ObstacleIndex::new(&obstacles);
        self.shared.standing = standing;
        self.shared.hidden = hidden;
        self.shared.known = known.into();
        self.forget_vanished();
    }

    /// Brings what single robots know up to date with the obstacles that stand.
    fn forget_vanished(&mut self) {
        let shared = &self.shared;
        for mind in self.shards.iter_mut().flat_map(|shard| &mut shard.minds) {
            if let Some(knowledge) = &mut mind.senses.knowledge {
                let met = |index: &u32| shared.standing.binary_search(index).ok();
                knowledge.met.retain(|index| met(index).is_some());
                let extra = knowledge.met.iter().filter_map(met);
                let extra = extra.map(|index| shared.map.obstacles()[index].clone());
                knowledge.obstacles = shared.known.iter().cloned().chain(extra).collect();
            }
        }
    }

    /// What happened in the last step, ordered by time and robot; empty unless recording, but for
    /// what concerns the world as a whole.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// What was done to the robots' software in the last step, ordered by time and robot, then as it was
    /// done; empty unless [`Simulation::set_journal`] was called. It is no part of the digest.
    pub fn journal(&self) -> &Batch {
        &self.journal
    }

    /// The hash of all that has happened so far.
    pub fn digest(&self) -> Digest {
        let mut digest = self.world_digest;
        for mind in self.minds() {
            digest.word(mind.account.digest.value());
        }
        digest
    }

    /// The hash of all that has happened to one robot, to find out where two runs part.
    pub fn robot_digest(&self, robot: RobotId) -> Digest {
        self.mind(robot).account.digest
    }

    /// Counts of what has happened so far.
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
        for mind in self.minds() {
            let condition = mind.node.condition();
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

    /// What a robot believes of its state.
    pub fn estimate(&self, robot: RobotId) -> &Estimate {
        self.mind(robot).node.estimate()
    }

    /// The obstacles that stand and that all robots know of.
    pub fn known_obstacles(&self) -> Obstacles {
        self.shared.known.clone()
    }

    /// What a robot runs.
    pub fn program(&self, robot: RobotId) -> &dyn Program {
        self.mind(robot).node.program()
    }

    /// The group of a robot, by its place in the fleet.
    pub fn group(&self, robot: RobotId) -> usize {
        self.mind(robot).group as usize
    }

    /// Whether a robot has not crashed, or has restarted since.
    pub fn is_up(&self, robot: RobotId) -> bool {
        !self.mind(robot).node.condition().down
    }

    /// Whether a robot is up and its program has reached its goal.
    pub fn has_finished(&self, robot: RobotId) -> bool {
        self.mind(robot).node.condition().has_finished()
    }

    /// How far a robot has come along its path, metres.
    pub fn distance(&self, robot: RobotId) -> f64 {
        self.mind(robot).distance
    }

    /// How many way-points a robot's ReachAvoid has reached.
    pub fn way_points(&self, robot: RobotId) -> u32 {
        self.mind(robot).account.way_points
    }

    /// All robots.
    pub fn robots(&self) -> &[RobotId] {
        &self.shared.fleet
    }

    fn mind(&self, robot: RobotId) -> &Mind {
        &self.shards[robot.index() / SIZE].minds[robot.index() % SIZE]
    }

    fn minds(&self) -> impl Iterator<Item = &Mind> {
        self.shards.iter().flat_map(|shard| &shard.minds)
    }
}

fn kinds(scenario: &Scenario, programs: &Programs<'_>) -> Result<Vec<Kind>, StartError> {
    let kind = |(index, group): (usize, &Group)| {
        let program = programs(group).map_err(|message| StartError {
            group: index,
            message,
        })?;
        let model = group.model.clone();
        let lands = model.accepts(&Command::Land);
        Ok(Kind {
            program,
            hardware: Hardware {
                body: model.body(),
                control_period: group.control_period,
                drive: Some(Drive {
                    model: model.clone(),
                    avoidance: scenario.motion.avoidance.clone(),
                    position_error: scenario.positioning.position_noise,
                    seed: random::hash_key(scenario.seed, &[Stream::Pilot as u64]),
                }),
            },
            at_a_loss: if lands { Command::Land } else { Command::Stop },
            model,
            sensors: group.sensors,
        })
    };
    scenario.fleet.groups.iter().enumerate().map(kind).collect()
}

/// Puts the robots in their places.
fn populate(shared: &mut Shared) -> Vec<Shard> {
    let scenario = shared.scenario.clone();
    let mut shards: Vec<Shard> = Vec::new();
    let starts = scenario
        .fleet
        .groups
        .iter()
        .enumerate()
        .flat_map(|(group, members)| members.starts.iter().map(move |start| (group, start)));
    for (index, (group, start)) in starts.enumerate() {
        let kind = &shared.kinds[group];
        let state = kind.model.at_rest(*start);
        let body = Neighbour {
            position: state.pose.position,
            velocity: Point::ZERO,
            radius: kind.hardware.body.radius,
            height: kind.hardware.body.height,
        };
        shared.bodies.push(body);
        if scenario.motion.avoidance.is_some() {
            shared.perceived.push(body);
        }
        if index % SIZE == 0 {
            shards.push(Shard::starting_at(index as u32));
        }
        if let Some(shard) = shards.last_mut() {
            let robot = RobotId(index as u32);
            shard.minds.push(mind(&scenario, robot, group, kind));
            shard.states.push(state);
            shard.predicted.push(state);
        }
    }
    for list in [&mut shared.bodies, &mut shared.perceived] {
        list.shrink_to_fit();
    }
    for shard in &mut shards {
        shard.minds.shrink_to_fit();
        shard.states.shrink_to_fit();
        shard.predicted.shrink_to_fit();
    }
    shards
}

fn mind(scenario: &Scenario, id: RobotId, group: usize, kind: &Kind) -> Mind {
    let key = [u64::from(id.0)];
    let random = stream(scenario.seed, Stream::Program, &key);
    let bounds = &scenario.fleet.groups[group].clock;
    let mut draw = stream(scenario.seed, Stream::Clock, &key);
    let clock = Clock {
        offset: Duration::from_seconds_f64(draw.between(0.0, bounds.offset.seconds())),
        rate: 1.0 + draw.between(-bounds.drift_ppm, bounds.drift_ppm) * 1e-6,
    };
    Mind {
        node: Node::new(
            id,
            clock,
            Agent::new(kind.program.clone(), random),
            Time::ZERO,
        ),
        senses: Senses::default(),
        account: Account::default(),
        group: group as u32,
        next_estimate: Time::ZERO + scenario.positioning.period,
        next_pose_record: Time::ZERO + scenario.trace.pose_period,
        motor_stuck: false,
        distance: 0.0,
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
