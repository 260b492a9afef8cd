//! The state of one robot at the present moment, as plain data.

use super::SensorReport;
use serde::Serialize;
use starl_core::{Command, Estimate, Port, Pose, RobotId, TimerKey, Twist};
use starl_lang::robot::{PrimitiveState, RobotProgram};
use starl_sim::{Run, Simulation};

/// One robot at one moment. Times are in seconds, lengths in metres, angles in radians.
#[derive(Clone, Debug, Serialize)]
pub struct RobotReport {
    /// Its number.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// The name of its model.
    pub model: &'static str,
    /// The program that it runs, as the scenario names it.
    pub program: String,
    /// `running`, `finished`, `failed` (its program cannot continue), `down` (it has crashed) or `left`.
    pub condition: &'static str,
    /// Whether its software has started in its present life.
    pub started: bool,
    /// Why its program cannot continue.
    pub failure: Option<String>,
    /// Its motors act as if told to stop.
    pub motors_stuck: bool,
    /// Its sensors and positioning repeat their last readings.
    pub sensors_frozen: bool,
    /// The readings of its sensors.
    pub sensors: SensorReport,
    /// Its true pose.
    pub pose: Pose,
    /// Its true velocity.
    pub twist: Twist,
    /// Its own belief of its pose and velocity; `at` is in nanoseconds of its own clock.
    pub estimate: Estimate,
    /// The command to its model.
    pub command: Command,
    /// The name of the thing in its gripper.
    pub holding: Option<String>,
    /// The distance that it has travelled.
    pub distance: f64,
    /// How many waypoints its ReachAvoid has reached.
    pub way_points_reached: u32,
    /// Its clock.
    pub clock: ClockReport,
    /// When its program is activated next, in simulated time; none if it does not run.
    pub next_activation: Option<f64>,
    /// The armed timers, the next one first.
    pub timers: Vec<TimerReport>,
    /// The datagrams on their way to it, the next one first.
    pub mailbox: Vec<MailReport>,
    /// The variables of a program in the StarL language, in the order of the text.
    pub variables: Vec<VariableReport>,
    /// The actions of a program in the StarL language, in the order of the text.
    pub actions: Vec<ActionReport>,
    /// The primitives of a program in the StarL language, in the order of the text.
    pub primitives: Vec<PrimitiveReport>,
    /// The state of a program in Rust, as its `Debug` shows it; none if it does not, or for a program in the StarL
    /// language.
    pub state: Option<String>,
}

/// A robot's own clock.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ClockReport {
    /// The time that it shows.
    pub now: f64,
    /// How far it was ahead at the start of the run.
    pub offset: f64,
    /// Seconds that it counts in a simulated second.
    pub rate: f64,
}

/// An armed timer.
#[derive(Clone, Debug, Serialize)]
pub struct TimerReport {
    /// The primitive that armed it, by its name in the program, or `program`; none if that is not known.
    pub owner: Option<String>,
    /// Its owner's endpoint, and the two numbers by which the owner knows it.
    #[serde(flatten)]
    pub key: TimerKey,
    /// When it is due, by the robot's own clock.
    pub due: f64,
    /// When it is due, in simulated time.
    pub due_simulated: f64,
}

/// A datagram on its way.
#[derive(Clone, Debug, Serialize)]
pub struct MailReport {
    /// The number of its sender.
    pub from: u32,
    /// The sender's number for it.
    pub sequence: u32,
    /// The primitive that it is for, by its name in the program, or `program`; none if that is not known.
    pub to: Option<String>,
    /// The endpoint that it is for.
    pub port: u32,
    /// When it arrives, in simulated time.
    pub at: f64,
    /// The length of its payload.
    pub bytes: usize,
}

/// A variable or parameter.
#[derive(Clone, Debug, Serialize)]
pub struct VariableReport {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: String,
    /// Its value, as a program would write it.
    pub value: String,
    /// Whether it is a parameter.
    pub parameter: bool,
}

/// An action.
#[derive(Clone, Debug, Serialize)]
pub struct ActionReport {
    /// Its name.
    pub name: String,
    /// Whether its guard holds.
    pub enabled: bool,
    /// The error that evaluating its guard ends with.
    pub error: Option<String>,
}

/// A primitive.
#[derive(Clone, Debug, Serialize)]
pub struct PrimitiveReport {
    /// Its name in the program.
    pub name: String,
    /// Its kind, for instance `Mutex`.
    pub kind: String,
    /// Where it listens.
    pub port: Option<u32>,
    /// Its state, as text for people; none before it is bound.
    pub state: Option<String>,
}

impl RobotReport {
    /// A robot of a run as it is now; none if there is no such robot. The time is proportional to all datagrams in
    /// transit, and every guard is evaluated once.
    pub fn of(run: &Run, robot: RobotId) -> Option<RobotReport> {
        let simulation = run.simulation();
        let fleet = &simulation.scenario().fleet;
        let (group, _) = fleet.group_of(robot)?;
        let node = simulation.node(robot);
        let (clock, state) = (node.clock(), simulation.state(robot));
        let program = language_program(simulation, robot);
        let primitives = program.map_or(Vec::new(), RobotProgram::primitives_state);
        let owner = |port| owner(&primitives, port);
        let mut failures = run.failures().iter().rev();
        let failure = failures.find(|failure| failure.robot == robot);
        let holding = simulation.holding(robot);
        let holding = holding.and_then(|thing| simulation.things().nth(thing as usize));
        let mut text = String::new();
        let is_shown = program.is_none() && simulation.program(robot).write_state(&mut text);
        let actions = match program {
            Some(program) if node.runs() => {
                simulation.rehearse(robot, |_, robot| program.actions(robot))
            }
            _ => Vec::new(),
        };
        Some(RobotReport {
            id: robot.0,
            name: fleet.name(robot),
            model: group.model.name(),
            program: group.program.clone(),
            condition: condition(run, robot),
            started: node.condition().started,
            failure: failure
                .filter(|_| node.condition().failed)
                .map(|failure| failure.text.to_string()),
            motors_stuck: simulation.has_stuck_motors(robot),
            sensors_frozen: simulation.has_frozen_sensors(robot),
            sensors: SensorReport::of(run, robot),
            pose: state.pose,
            twist: state.twist,
            estimate: *node.estimate(),
            command: node.command(),
            holding: holding.map(|(name, ..)| name.to_string()),
            distance: simulation.distance(robot),
            way_points_reached: simulation.way_points(robot),
            clock: ClockReport {
                now: clock.read(simulation.now()).seconds(),
                offset: clock.offset as f64 / 1e9,
                rate: clock.rate,
            },
            next_activation: node.runs().then(|| node.next_activation().seconds()),
            timers: node
                .timers()
                .iter()
                .map(|(at, key)| TimerReport {
                    owner: owner(key.port),
                    key,
                    due: clock.read(at).seconds(),
                    due_simulated: at.seconds(),
                })
                .collect(),
            mailbox: simulation
                .mail(robot)
                .into_iter()
                .map(|mail| MailReport {
                    from: mail.from.0,
                    sequence: mail.sequence,
                    to: owner(mail.port),
                    port: mail.port.0,
                    at: mail.at.seconds(),
                    bytes: mail.bytes,
                })
                .collect(),
            variables: program
                .map_or(Vec::new(), RobotProgram::variables)
                .into_iter()
                .map(|variable| VariableReport {
                    name: variable.name,
                    kind: variable.kind,
                    value: variable.value.to_string(),
                    parameter: variable.is_parameter,
                })
                .collect(),
            actions: actions
                .into_iter()
                .map(|action| ActionReport {
                    name: action.name,
                    enabled: action.enabled == Ok(true),
                    error: action.enabled.err().map(|error| error.to_string()),
                })
                .collect(),
            primitives: primitives
                .into_iter()
                .map(|primitive| PrimitiveReport {
                    name: primitive.name,
                    kind: primitive.kind,
                    port: primitive.port.map(|port| port.0),
                    state: primitive.state,
                })
                .collect(),
            state: is_shown.then_some(text),
        })
    }
}

/// The program of a robot, if it is one in the StarL language.
pub(super) fn language_program(simulation: &Simulation, robot: RobotId) -> Option<&RobotProgram> {
    simulation.program(robot).inspect()?.downcast_ref()
}

/// The word for how a robot is.
pub(super) fn condition(run: &Run, robot: RobotId) -> &'static str {
    let simulation = run.simulation();
    let condition = simulation.node(robot).condition();
    if simulation.has_left(robot) {
        "left"
    } else if condition.down {
        "down"
    } else if condition.failed {
        "failed"
    } else if condition.finished {
        "finished"
    } else {
        "running"
    }
}

/// Names the owner of an endpoint.
fn owner(primitives: &[PrimitiveState], port: Port) -> Option<String> {
    if port == Port::PROGRAM {
        return Some("program".to_string());
    }
    let owner = primitives.iter().find(|known| known.port == Some(port));
    owner.map(|owner| owner.name.clone())
}
