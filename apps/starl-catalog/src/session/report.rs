//! The report of a run at any time: its progress, its verdicts and counts, its fleet and its world.

use super::breakpoint::Stopped;
use super::inspect::{condition, language_program};
use serde::Serialize;
use starl_core::intervention::NetworkKnob;
use starl_core::{Obstacle, Point, RobotId, WayPoint};
use starl_properties::Verdict;
use starl_sim::engine::Drops;
use starl_sim::{Run, Simulation};

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// The present time, seconds.
    pub now: f64,
    /// Whether the run has ended. It can still be stepped further.
    pub over: bool,
    /// `reached`, `violated`, `timed_out` or `failed`; none before the end.
    pub outcome: Option<&'static str>,
    /// How many steps the call has made.
    pub steps: u64,
    /// The breakpoint that was met in the last of them.
    pub stopped: Option<Stopped>,
}

/// The report of a run so far.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The present time, seconds.
    pub now: f64,
    /// Whether the run has come to its end.
    pub over: bool,
    /// See [`Status::outcome`].
    pub outcome: Option<&'static str>,
    /// The hash of all events, hexadecimal.
    pub digest: String,
    /// How many robots are where.
    pub progress: Progress,
    /// The fate of datagrams.
    pub messages: Messages,
    /// The number of contacts of bodies.
    pub collisions: u64,
    /// The network as it is now: the positions of all knobs.
    pub network: Vec<NetworkKnob>,
    /// Each property that is watched.
    pub properties: Vec<Property>,
    /// Every violation so far.
    pub violations: Vec<Violation>,
    /// Every program so far that could not continue.
    pub failures: Vec<Failure>,
}

/// How many robots are where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Progress {
    /// All robots, those that have left too.
    pub robots: usize,
    /// Robots that are up.
    pub up: usize,
    /// Of these, robots whose programs have reached their goals.
    pub finished: usize,
    /// Of these, robots whose programs have failed.
    pub failed: usize,
}

/// The fate of datagrams: see [`starl_sim::engine::Tally`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Messages {
    /// Handed to the network.
    pub sent: u64,
    /// Arrived.
    pub delivered: u64,
    /// Lost at random.
    pub lost: u64,
    /// Dropped for another reason.
    pub dropped: u64,
    /// These by reason.
    pub drops: Drops,
    /// Sent again.
    pub retransmitted: u64,
}

/// A property.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Property {
    /// Its name.
    pub property: String,
    /// `holds`, `violated`, `open` (its deadline has not passed) or `unused` (there was no event yet to which it
    /// applies).
    pub verdict: &'static str,
    /// How often it was violated.
    pub violations: usize,
    /// How often something that speaks against it was excused, by reason.
    pub excused: Vec<Excused>,
}

/// The number of excused violations of a property, for one reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Excused {
    /// The reason.
    pub reason: &'static str,
    /// How often.
    pub count: u64,
}

/// A violation of a property.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Violation {
    /// The property.
    pub property: String,
    /// When, seconds.
    pub at: f64,
    /// The numbers of the robots concerned.
    pub robots: Vec<u32>,
    /// The observation.
    pub text: String,
}

/// A program that could not continue.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failure {
    /// Since when, seconds.
    pub at: f64,
    /// The number of its robot.
    pub robot: u32,
    /// Why.
    pub text: String,
}

/// A robot of the fleet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Member {
    /// Its number.
    pub id: u32,
    /// Its name.
    pub name: String,
    /// The name of its model.
    pub model: &'static str,
    /// The program that it runs.
    pub program: String,
    /// The radius of its body, metres.
    pub radius: f64,
    /// The height of its body, metres.
    pub height: f64,
    /// Whether it flies.
    pub flies: bool,
    /// See [`RobotReport::condition`](super::RobotReport::condition).
    pub condition: &'static str,
}

/// The world as it stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct World {
    /// The obstacles that stand, the walls around the world included.
    pub obstacles: Vec<Standing>,
    /// The waypoints.
    pub way_points: Vec<WayPoint>,
    /// The things.
    pub things: Vec<Thing>,
}

/// An obstacle that stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// Its index, as interventions have it.
    pub index: u32,
    /// Its shape and place, as interventions have them.
    pub obstacle: Obstacle,
    /// Robots do not know it until they meet it.
    pub hidden: bool,
}

/// A thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Thing {
    /// Its index.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// Where it is, metres.
    pub position: Point,
    /// The number of the robot that holds it.
    pub holder: Option<u32>,
}

impl Status {
    /// How far a run is.
    pub(super) fn of(run: &Run, steps: u64) -> Status {
        let over = run.is_over();
        Status {
            now: run.simulation().now().seconds(),
            over,
            outcome: over.then(|| run.outcome().word()),
            steps,
            stopped: None,
        }
    }
}

impl Progress {
    /// How many robots of a simulation are where now.
    pub fn of(simulation: &Simulation) -> Progress {
        let progress = simulation.progress();
        Progress {
            robots: simulation.robots().len(),
            up: progress.up,
            finished: progress.finished,
            failed: progress.failed,
        }
    }
}

impl Messages {
    /// The fate of the datagrams of a simulation so far.
    pub fn of(simulation: &Simulation) -> Messages {
        let tally = simulation.tally();
        Messages {
            sent: tally.sent,
            delivered: tally.delivered,
            lost: tally.lost,
            dropped: tally.drops.total(),
            drops: tally.drops,
            retransmitted: tally.retransmitted,
        }
    }
}

impl Report {
    /// The report of a run so far. Takes time in proportion to the fleet.
    pub fn of(run: &Run) -> Report {
        let simulation = run.simulation();
        let Status {
            now, over, outcome, ..
        } = Status::of(run, 0);
        Report {
            now,
            over,
            outcome,
            digest: simulation.digest().to_string(),
            progress: Progress::of(simulation),
            messages: Messages::of(simulation),
            collisions: simulation.tally().collisions,
            network: simulation.network().knobs(),
            properties: run.verdicts().into_iter().map(Property::of).collect(),
            violations: Violation::all(run),
            failures: Failure::all(run),
        }
    }
}

impl Violation {
    /// Every violation so far.
    pub fn all(run: &Run) -> Vec<Violation> {
        let violations = run.violations().iter();
        let told = violations.map(|violation| Violation {
            property: violation.property.to_string(),
            at: violation.at.seconds(),
            robots: violation.robots.iter().map(|robot| robot.0).collect(),
            text: violation.text.clone(),
        });
        told.collect()
    }
}

impl Failure {
    /// Every program so far that could not continue.
    pub fn all(run: &Run) -> Vec<Failure> {
        let failures = run.failures().iter();
        let told = failures.map(|failure| Failure {
            at: failure.at.seconds(),
            robot: failure.robot.0,
            text: failure.text.to_string(),
        });
        told.collect()
    }
}

impl Property {
    fn of(verdict: Verdict) -> Property {
        Property {
            verdict: match (verdict.violations, verdict.open, verdict.used) {
                (0, _, false) => "unused",
                (0, false, _) => "holds",
                (0, true, _) => "open",
                _ => "violated",
            },
            property: verdict.property.to_string(),
            violations: verdict.violations,
            excused: (verdict.excused.iter())
                .map(|(excuse, count)| Excused {
                    reason: excuse.text(),
                    count: *count,
                })
                .collect(),
        }
    }
}

/// All robots in the order of their numbers, those that have joined and left too.
pub fn fleet(run: &Run) -> Vec<Member> {
    let fleet = &run.simulation().scenario().fleet;
    let groups = fleet.groups.iter();
    let groups = groups.flat_map(|group| group.starts.iter().map(move |_| group));
    let members = (0..).map(RobotId).zip(groups).map(|(robot, group)| {
        let body = group.model.body();
        Member {
            id: robot.0,
            name: fleet.name(robot),
            model: group.model.name(),
            program: group.program.clone(),
            radius: body.radius,
            height: body.height,
            flies: body.flies(),
            condition: condition(run, robot),
        }
    });
    members.collect()
}

/// The stage of each robot's program, in the order of their numbers: for a program in the StarL language the value of
/// its first enum variable, or its role. None without such a variable, for programs in Rust, and before the program has
/// started.
pub fn states(run: &Run) -> Vec<Option<&str>> {
    let simulation = run.simulation();
    let stage = |&robot: &RobotId| language_program(simulation, robot)?.stage();
    simulation.robots().iter().map(stage).collect()
}

impl World {
    /// The world as it stands in a run.
    pub fn of(run: &Run) -> World {
        let simulation = run.simulation();
        let things = simulation.things().enumerate();
        let things = things.filter(|(_, (name, ..))| !name.is_empty());
        World {
            obstacles: (simulation.standing_obstacles())
                .map(|standing| Standing {
                    index: standing.index,
                    obstacle: standing.obstacle.clone(),
                    hidden: standing.is_hidden,
                })
                .collect(),
            way_points: simulation.places().to_vec(),
            things: things
                .map(|(index, (name, position, holder))| Thing {
                    index,
                    name: name.to_string(),
                    position,
                    holder: holder.map(|robot| robot.0),
                })
                .collect(),
        }
    }
}
