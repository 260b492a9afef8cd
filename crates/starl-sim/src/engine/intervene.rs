//! Carries out what steers a run: faults, changes of the world and of the network, operators.

use super::agenda::Due;
use super::shard::SIZE;
use super::simulated_robot::SimulatedRobot;
use super::{Simulation, Stream, fault, populate, stream};
use crate::scenario::{Group, Network, Occasion, Scenario, ScenarioEvent};
use starl_core::event::{Fault, Level};
use starl_core::intervention::NetworkKnob;
use starl_core::{
    Agent, Event, FaultKind, Intervention, Order, Point, Pose, Record, RobotId, Time, WayPoint,
};
use starl_host::journal::Journal;
use std::sync::Arc;
use thiserror::Error;

/// Why an intervention is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InterventionError {
    /// No scenario file could hold it.
    #[error(
        "a number in it is not finite or out of its range, a name is blank, or it names no robot, or one twice"
    )]
    Invalid,
    /// It names a robot that the fleet does not have.
    #[error("there is no robot {robot}; the fleet has {count}")]
    NoRobot {
        /// The robot.
        robot: RobotId,
        /// The number of robots.
        count: usize,
    },
    /// It changes an obstacle that is not there any more, or never was.
    #[error("no obstacle {0} stands")]
    NoObstacle(u32),
    /// It removes something that is not there.
    #[error("there is no {kind} {name}")]
    Nothing {
        /// `waypoint` or `thing`.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// The network would contradict itself; the message says how.
    #[error("{0}")]
    Network(String),
    /// Another robot has the name of the one that joins.
    #[error("there is already a robot called {0}")]
    NameTaken(String),
    /// Something stands where a robot joins.
    #[error("the place where the robot joins is occupied")]
    Occupied,
}

/// A push is tried in so many parts until nothing is in the way.
const PARTS: u32 = 16;

impl Simulation {
    /// Schedules an intervention at a time, or now if that has passed. It is recorded, is part of the digest, and takes
    /// effect before the robots act in that step. A clone of the simulation with the same interventions continues
    /// identically.
    ///
    /// # Errors
    /// The error of the intervention: invalid numbers, unknown robots, and, if it is to happen now, unknown
    /// names and indices.
    pub fn apply(&mut self, at: Time, what: Intervention) -> Result<(), InterventionError> {
        let what = what.tidy();
        if !what.is_valid() {
            return Err(InterventionError::Invalid);
        }
        self.find_robots(&what)?;
        let at = at.max(self.now);
        if at == self.now {
            self.find_object(&what)?;
        }
        self.agenda.apply(at, what);
        Ok(())
    }

    /// Has happen again what steered another run of the same scenario, by its records in their order, apart from
    /// what the scenario brings by itself. To be called before the first step.
    pub fn repeat(&mut self, recorded: impl IntoIterator<Item = (Time, Intervention)>) {
        let own: Vec<(Time, Intervention)> = self.agenda.told().collect();
        let mut own = own.into_iter().peekable();
        for (at, what) in recorded {
            if own.next_if(|own| *own == (at, what.clone())).is_none() {
                self.agenda.apply(at, what);
            }
        }
    }

    /// The interventions applied to this run with their times, including future ones, in the order in which they were
    /// applied.
    pub fn applied(&self) -> &[(Time, Intervention)] {
        self.agenda.applied()
    }

    /// The scenario with all interventions of this run as scheduled events: it repeats this run from the start.
    pub fn as_scenario(&self) -> Scenario {
        let mut scenario = Scenario::clone(&self.origin);
        let applied = self.agenda.applied().iter().cloned();
        scenario
            .events
            .extend(applied.map(|(at, what)| ScenarioEvent {
                occasion: Occasion::At(at),
                what,
            }));
        scenario
    }

    /// Executes the interventions that are due.
    pub(super) fn intervene(&mut self, at: Time) {
        while let Some(Due { what, told, .. }) = self.agenda.next(at) {
            if told {
                self.note(at, Event::Intervention(Box::new(what.clone())));
            }
            let found = self.find_robots(&what);
            if let Err(error) = found.and_then(|()| self.find_object(&what)) {
                let (level, text) = (Level::Warning, error.to_string().into());
                self.note(at, Event::Log { level, text });
                continue;
            }
            self.carry_out(at, what);
        }
    }

    /// Whether the robots that an intervention names are there.
    fn find_robots(&self, what: &Intervention) -> Result<(), InterventionError> {
        let count = self.shared.bodies.len();
        let mut robots = what.robots().into_iter();
        match robots.find(|robot| robot.index() >= count) {
            Some(robot) => Err(InterventionError::NoRobot { robot, count }),
            None => Ok(()),
        }
    }

    /// Whether the object that an intervention changes is there.
    fn find_object(&mut self, what: &Intervention) -> Result<(), InterventionError> {
        let name = match what {
            Intervention::MoveObstacle { index, .. } | Intervention::RemoveObstacle { index } => {
                let found = self.obstacle(*index).map(|_| ());
                return found.ok_or(InterventionError::NoObstacle(*index));
            }
            Intervention::Network(knobs) => {
                let mut network = Network::clone(&self.shared.network);
                knobs.iter().for_each(|&knob| network.turn(knob));
                let sets_jitter = |knob: &NetworkKnob| matches!(knob, NetworkKnob::Jitter(_));
                let contradiction = network.link.contradiction(knobs.iter().any(sets_jitter));
                return contradiction.map_or(Ok(()), |found| {
                    Err(InterventionError::Network(found.message))
                });
            }
            Intervention::RemoveWayPoint { name } => {
                let mut known = self.shared.way_points.iter();
                known
                    .all(|point| point.name != *name)
                    .then_some(("waypoint", name))
            }
            Intervention::RemoveThing { name } => {
                let mut known = self.shared.things.names.iter();
                known.all(|known| known != name).then_some(("thing", name))
            }
            Intervention::Join { pose, like, name } => {
                let fleet = &self.shared.scenario.fleet;
                let mut robots = (0..self.shared.bodies.len() as u32).map(RobotId);
                if robots.any(|robot| !self.has_left(robot) && fleet.name(robot) == *name) {
                    return Err(InterventionError::NameTaken(name.clone()));
                }
                let body = self.shared.bodies[like.index()];
                return match self.is_free(None, pose.position, body.radius, body.height) {
                    true => Ok(()),
                    false => Err(InterventionError::Occupied),
                };
            }
            _ => None,
        };
        match name {
            Some((kind, name)) => {
                let name = name.clone();
                Err(InterventionError::Nothing { kind, name })
            }
            None => Ok(()),
        }
    }

    fn carry_out(&mut self, at: Time, what: Intervention) {
        match what {
            Intervention::Fault(kind) => return self.bring_fault(at, &kind),
            Intervention::Push { robot, by } => self.push(at, robot, by),
            Intervention::Network(knobs) => {
                knobs
                    .iter()
                    .for_each(|&knob| self.shared.network.turn(knob));
            }
            Intervention::AddObstacle { obstacle, hidden } => {
                self.add_obstacle(obstacle, hidden);
                self.raise_obstacles();
            }
            Intervention::MoveObstacle { index, obstacle } => {
                if let Some(entry) = self.obstacle(index) {
                    entry.obstacle = obstacle;
                }
                self.raise_obstacles();
            }
            Intervention::RemoveObstacle { index } => {
                let now = self.now;
                if let Some(entry) = self.obstacle(index) {
                    entry.expires = now;
                }
                self.raise_obstacles();
            }
            Intervention::SetWayPoint(way_point) => return self.set_way_point(at, way_point),
            Intervention::RemoveWayPoint { name } => {
                self.shared.way_points.retain(|point| point.name != name);
                return self.tell_way_points(at);
            }
            Intervention::SetThing { name, position } => {
                let holder = self.shared.things.set(&name, position);
                return self.empty_hands(holder);
            }
            Intervention::RemoveThing { name } => {
                let holder = self.shared.things.remove(&name).unwrap_or_default();
                return self.empty_hands(holder);
            }
            Intervention::Tell { robots, order } => return self.tell(at, &robots, &order),
            Intervention::Join { like, name, pose } => self.join(at, like, name, pose),
            Intervention::Leave(robots) => self.leave(at, &robots),
        }
        self.disturbed = at;
    }

    fn bring_fault(&mut self, at: Time, kind: &FaultKind) {
        self.disturbed = at;
        if matches!(kind, FaultKind::CorruptState(_)) {
            self.corrupted = at;
        }
        let Some(robots) = kind.robots() else {
            self.shared.parts.clear();
            if let FaultKind::Partition(groups) | FaultKind::OneWay(groups) = kind {
                self.shared.one_way = matches!(kind, FaultKind::OneWay(_));
                self.shared.parts = fault::parts(groups, self.shared.bodies.len());
            }
            return self.note(at, fault::event(kind));
        };
        for &robot in robots {
            let seed = self.shared.scenario.seed;
            let shard = &mut self.shards[robot.index() / SIZE];
            if shard.members[robot.index() % SIZE].is_gone {
                continue;
            }
            shard.record(robot, at, fault::event(kind));
            let member = &mut shard.members[robot.index() % SIZE];
            self.impaired -= usize::from(member.is_impaired());
            match kind {
                FaultKind::Crash(_) => {
                    let key = [u64::from(robot.0), at.0];
                    let loss = self.shared.scenario.storage.loss;
                    let is_lost = member.account.store.is_some()
                        && stream(seed, Stream::Storage, &key).chance(loss);
                    member.crash(is_lost);
                    if is_lost {
                        shard.record(robot, at, Event::Fault(Fault::StorageLost));
                    }
                }
                FaultKind::Restart(_) if member.node.condition().down => {
                    let program = self.shared.kinds[member.group as usize].program.clone();
                    let key = [u64::from(robot.0), at.0];
                    let agent = Agent::new(program, stream(seed, Stream::Program, &key));
                    let saved = member.account.store.as_ref().map(|store| store.saved());
                    member.node.restart(at, agent.with_saved(saved));
                    member.next_estimate = at;
                }
                FaultKind::StuckMotor(_) => member.motor_stuck = true,
                FaultKind::FrozenSensor(_) => member.senses.are_frozen = true,
                FaultKind::Repair(_) => {
                    member.motor_stuck = false;
                    member.repair_senses();
                }
                FaultKind::CorruptState(_) => {
                    let key = [u64::from(robot.0), at.0];
                    let mut random = stream(seed, Stream::Corruption, &key);
                    shard.corrupt(&self.shared, robot, at, &mut random);
                }
                _ => {}
            }
            let member = &shard.members[robot.index() % SIZE];
            self.impaired += usize::from(member.is_impaired());
        }
    }

    /// Moves a body as far as nothing is in the way.
    fn push(&mut self, at: Time, robot: RobotId, by: Point) {
        let body = self.shared.bodies[robot.index()];
        let is_free = |part: &u32| {
            let place = body.position + by * (f64::from(*part) / f64::from(PARTS));
            self.is_free(Some(robot), place, body.radius, body.height)
        };
        let free = (1..=PARTS).take_while(is_free).last().unwrap_or(0);
        let place = body.position + by * (f64::from(free) / f64::from(PARTS));
        let shard = &mut self.shards[robot.index() / SIZE];
        if shard.members[robot.index() % SIZE].is_gone {
            return;
        }
        let state = &mut shard.states[robot.index() % SIZE];
        state.pose.position = place;
        self.shared.bodies[robot.index()].position = place;
        let event = Event::Moved(state.pose);
        shard.record(robot, at, event);
    }

    /// Whether a body would touch nothing there, apart from `robot`'s own.
    fn is_free(&self, robot: Option<RobotId>, place: Point, radius: f64, height: f64) -> bool {
        let obstacles = self.shared.map.obstacles().iter();
        let mut bodies = (0..).map(RobotId).zip(&self.shared.bodies);
        bodies.all(|(other, body)| {
            Some(other) == robot
                || self.member(other).is_gone
                || place.z >= body.position.z + body.height
                || body.position.z >= place.z + height
                || place.planar_distance(body.position) >= radius + body.radius
        }) && obstacles
            .map(|obstacle| obstacle.body_gap(place, radius, height))
            .all(|gap| gap >= 0.0)
    }

    fn set_way_point(&mut self, at: Time, way_point: WayPoint) {
        let way_points = &mut self.shared.way_points;
        match way_points
            .iter_mut()
            .find(|known| known.name == way_point.name)
        {
            Some(known) => *known = way_point,
            None => way_points.push(way_point),
        }
        self.tell_way_points(at);
    }

    fn tell_way_points(&mut self, at: Time) {
        let order = Order {
            name: Order::WAY_POINTS.into(),
            fields: Default::default(),
        };
        self.tell(at, &[], &order);
    }

    /// Robots hear an order in the course of the step; those that are down do not.
    fn tell(&mut self, at: Time, robots: &[RobotId], order: &Order) {
        let members = self.shards.iter_mut().flat_map(|shard| &mut shard.members);
        let is_meant = |member: &&mut SimulatedRobot| {
            let is_named = robots.is_empty() || robots.contains(&member.id());
            is_named && !member.node.condition().down
        };
        for member in members.filter(is_meant) {
            member.account.orders.push((at, order.clone()));
        }
    }

    fn empty_hands(&mut self, holder: Option<RobotId>) {
        if let Some(robot) = holder {
            self.member_mut(robot).senses.holding = None;
        }
    }

    /// One more robot of the kind of another.
    fn join(&mut self, at: Time, like: RobotId, name: String, pose: Pose) {
        let group = self.member(like).group as usize;
        let scenario = Arc::make_mut(&mut self.shared.scenario);
        let kind = self.shared.kinds[group].clone();
        let group = Group {
            name,
            numbered: false,
            starts: vec![pose],
            ..scenario.fleet.groups[group].clone()
        };
        scenario.fleet.groups.push(group);
        self.shared.kinds.push(kind);
        let group = self.shared.kinds.len() - 1;
        let first = self.shards.first();
        let recording = first.is_some_and(|shard| shard.log.recording);
        let has_journal = first.is_some_and(|shard| shard.journal.is_some());
        populate::add(&mut self.shared, &mut self.shards, group, pose, at);
        self.set_recording(recording);
        let robot = RobotId(self.shared.bodies.len() as u32 - 1);
        let shard = &mut self.shards[robot.index() / SIZE];
        match &mut shard.journal {
            Some(journal) => journal.join(),
            // The robot is the first of a new shard.
            journal => *journal = has_journal.then(|| Box::new(Journal::new(robot, 1))),
        }
        let fleet = self.shared.fleet.iter().copied();
        self.shared.fleet = fleet.chain([robot]).collect();
        if !self.shared.parts.is_empty() {
            self.shared.parts.push(0);
        }
        self.next.push(pose.position);
        self.bodies.push(self.shared.bodies[robot.index()]);
        self.have_changed = true;
        let event = Event::Moved(self.state(robot).pose);
        self.shards[robot.index() / SIZE].record(robot, at, event);
    }

    /// Robots leave permanently, recorded as crashes. Things that they hold stay where they were.
    fn leave(&mut self, at: Time, robots: &[RobotId]) {
        self.have_changed = true;
        self.shared.gone.resize(self.shared.bodies.len(), false);
        for &robot in robots {
            self.shared.gone[robot.index()] = true;
            self.bring_fault(at, &FaultKind::Crash(vec![robot]));
            let position = self.shared.bodies[robot.index()].position;
            let member = self.member_mut(robot);
            member.is_gone = true;
            let held = member.senses.holding.take();
            if let Some(thing) = held {
                self.shared.things.put_down(thing, position);
            }
        }
    }

    fn member_mut(&mut self, robot: RobotId) -> &mut SimulatedRobot {
        &mut self.shards[robot.index() / SIZE].members[robot.index() % SIZE]
    }

    /// Carries out what robots have asked of their grippers, in the order of time and robots.
    pub(super) fn grip(&mut self) {
        let mut grips = Vec::new();
        for shard in &mut self.shards {
            grips.append(&mut shard.grips);
        }
        grips.sort_by_key(|grip| (grip.at, grip.robot));
        for grip in grips {
            let body = self.shared.bodies[grip.robot.index()];
            let held = self.member(grip.robot).senses.holding;
            let things = &mut self.shared.things;
            let event = match (grip.thing, held) {
                (Some(thing), None)
                    if things.take(thing, grip.robot, body.position, body.radius) =>
                {
                    self.member_mut(grip.robot).senses.holding = Some(thing);
                    Event::Took(thing)
                }
                (None, Some(thing)) => {
                    things.put_down(thing, body.position);
                    self.member_mut(grip.robot).senses.holding = None;
                    Event::PutDown {
                        thing,
                        position: body.position,
                    }
                }
                _ => continue,
            };
            self.shards[grip.robot.index() / SIZE].record(grip.robot, grip.at, event);
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
}
