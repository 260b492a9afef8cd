//! Puts robots into a simulation: those of the scenario at the start, and those that join later.

use super::shard::{SIZE, Shard};
use super::shared::{Kind, Shared};
use super::simulated_robot::{Account, Senses, SimulatedRobot};
use super::{Stream, stream};
use crate::scenario::{Group, Scenario};
use starl_core::{Agent, Command, Duration, Point, Pose, Program, RobotId, Time, random};
use starl_host::hardware::Drive;
use starl_host::{Clock, Hardware, Node, Store};
use starl_motion::Neighbour;

/// Makes the program of a group's robots, or says why it cannot.
pub type Programs<'a> = dyn Fn(&Group) -> Result<Box<dyn Program>, Complaint> + 'a;

/// An error in a program's name or parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    /// The field below the group or the scenario: `program` or `parameters.vicinity`.
    pub field: String,
    /// The error.
    pub message: String,
    /// The suggested fix.
    pub help: String,
}

/// Why a run cannot start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartError {
    /// The group of robots concerned, by its place in the fleet.
    pub group: usize,
    /// The error of its program.
    pub complaint: Complaint,
}

/// The common properties of the robots of each group.
pub fn kinds(scenario: &Scenario, programs: &Programs<'_>) -> Result<Vec<Kind>, StartError> {
    let kind = |(index, group): (usize, &Group)| {
        let program = programs(group).map_err(|complaint| StartError {
            group: index,
            complaint,
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

/// Puts the robots of the scenario in their places.
pub fn populate(shared: &mut Shared) -> Vec<Shard> {
    let scenario = shared.scenario.clone();
    let mut shards: Vec<Shard> = Vec::new();
    for (group, members) in scenario.fleet.groups.iter().enumerate() {
        for start in &members.starts {
            add(shared, &mut shards, group, *start, Time::ZERO);
        }
    }
    for list in [&mut shared.bodies, &mut shared.perceived] {
        list.shrink_to_fit();
    }
    for shard in &mut shards {
        shard.members.shrink_to_fit();
        shard.states.shrink_to_fit();
        shard.predicted.shrink_to_fit();
    }
    shards
}

/// Puts one more robot of a group behind all there are; it starts at `at`.
pub fn add(shared: &mut Shared, shards: &mut Vec<Shard>, group: usize, start: Pose, at: Time) {
    let index = shared.bodies.len();
    let kind = &shared.kinds[group];
    let state = kind.model.at_rest(start);
    let body = Neighbour {
        position: state.pose.position,
        velocity: Point::ZERO,
        radius: kind.hardware.body.radius,
        height: kind.hardware.body.height,
    };
    shared.bodies.push(body);
    if shared.scenario.motion.avoidance.is_some() {
        shared.perceived.push(body);
    }
    if index.is_multiple_of(SIZE) {
        shards.push(Shard::starting_at(index as u32));
    }
    if let Some(shard) = shards.last_mut() {
        let robot = RobotId(index as u32);
        shard
            .members
            .push(member(&shared.scenario, robot, group, kind, at));
        shard.states.push(state);
        shard.predicted.push(state);
    }
}

fn member(scenario: &Scenario, id: RobotId, group: usize, kind: &Kind, at: Time) -> SimulatedRobot {
    let key = [u64::from(id.0)];
    let random = stream(scenario.seed, Stream::Program, &key);
    let bounds = &scenario.fleet.groups[group].clock;
    let mut draw = stream(scenario.seed, Stream::Clock, &key);
    let offset = Duration::from_seconds_f64(draw.between(0.0, bounds.offset.seconds()));
    let clock = Clock {
        offset: i64::try_from(offset.0).unwrap_or(i64::MAX),
        rate: 1.0 + draw.between(-bounds.drift_ppm, bounds.drift_ppm) * 1e-6,
    };
    let store = scenario.storage.kept.then(Box::<Store>::default);
    let agent = Agent::new(kind.program.clone(), random);
    let agent = agent.with_saved(store.as_ref().map(|store| store.saved()));
    SimulatedRobot {
        node: Node::new(id, clock, agent, at),
        senses: Senses::default(),
        account: Account {
            store,
            ..Account::default()
        },
        group: group as u32,
        next_estimate: at + scenario.positioning.period,
        next_pose_record: at + scenario.trace.pose_period,
        motor_stuck: false,
        is_gone: false,
        distance: 0.0,
    }
}
