//! How much memory a fleet takes that runs Race, and how long an activation of its programs takes, in
//! StarL and in Rust.
//!
//! `cargo bench -p starl-lang --bench robot`

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../tests/it/robot_support/mod.rs"]
mod robot_support;

use robot_support::compile;
use starl_core::motion::{self, Body, Obstacles};
use starl_core::{
    Agent, Duration, Event, Input, Point, Pose, Program, Random, RobotId, Sensors, Time, WayPoint,
};
use starl_host::{
    Clock, Datagram, Hardware, Node, NodeInput, Outlet, PlanJob, Snapshot, Workspace,
};
use starl_lang::machine::State;
use starl_lang::robot::RobotProgram;
use starl_lang::robot::properties::{self, Judge};
use starl_motion::Neighbour;
use std::time::Instant;

const ROBOTS: u32 = 100_000;

/// Bytes that the process holds in memory.
fn resident() -> usize {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = text
        .split(' ')
        .nth(1)
        .and_then(|pages| pages.parse::<usize>().ok());
    pages.unwrap_or(0) * 4096
}

struct Fleet {
    ids: Vec<RobotId>,
    way_points: Vec<WayPoint>,
    obstacles: Obstacles,
    nodes: Vec<Node>,
    sink: Sink,
}

/// Receives the outputs of nodes; only plans are read.
#[derive(Default)]
struct Sink {
    workspace: Workspace,
    plan: Option<PlanJob>,
}

impl Outlet for Sink {
    fn workspace(&mut self) -> &mut Workspace {
        &mut self.workspace
    }

    fn record(&mut self, _: Time, _: Event) {}

    fn transmit(&mut self, _: Time, _: Datagram) {}

    fn plan(&mut self, _: Time, job: PlanJob) {
        self.plan = Some(job);
    }

    fn neighbours(&mut self, _: f64, _: &mut Vec<Neighbour>) {}
}

impl Fleet {
    fn new(make: &dyn Fn() -> Box<dyn Program>) -> Fleet {
        let node = |id| {
            let agent = Agent::new(make(), Random::keyed(1, &[u64::from(id)]));
            Node::new(RobotId(id), Clock::default(), agent, Time::ZERO)
        };
        let way_point = |index: u32| WayPoint {
            name: format!("w{index}"),
            position: Point::planar(f64::from(index), 1.0),
            group: 0,
        };
        Fleet {
            ids: (0..ROBOTS).map(RobotId).collect(),
            way_points: (0..10).map(way_point).collect(),
            obstacles: [].into(),
            nodes: (0..ROBOTS).map(node).collect(),
            sink: Sink::default(),
        }
    }

    /// Lets this happen to all robots, and hands them the answers of the planner; gives nanoseconds for each.
    fn handle(&mut self, happening: &NodeInput) -> f64 {
        let hardware = Hardware {
            body: Body {
                radius: 0.1,
                height: 0.1,
                workspace: motion::Workspace::Ground,
            },
            control_period: Duration::ZERO,
            drive: None,
        };
        let snapshot = Snapshot {
            hardware: &hardware,
            sensors: Sensors::default(),
            fleet: &self.ids,
            way_points: &self.way_points,
            obstacles: &self.obstacles,
        };
        let began = Instant::now();
        for node in &mut self.nodes {
            node.handle(Time::ZERO, happening.clone(), &snapshot, &mut self.sink);
            if let Some(PlanJob { job, request, .. }) = self.sink.plan.take() {
                let path = Some(vec![request.target]);
                let answer = NodeInput::Planned { job, path };
                node.handle(Time::ZERO, answer, &snapshot, &mut self.sink);
            }
        }
        began.elapsed().as_nanos() as f64 / f64::from(ROBOTS)
    }
}

const ACTIVATE: NodeInput = NodeInput::Input(Input::Activate);

fn measure(name: &str, make: &dyn Fn() -> Box<dyn Program>) {
    let before = resident();
    let mut fleet = Fleet::new(make);
    let began = fleet.handle(&NodeInput::Start) + fleet.handle(&ACTIVATE);
    let bytes = (resident() - before) / ROBOTS as usize;
    let mut times: Vec<f64> = (0..31).map(|_| fleet.handle(&ACTIVATE)).collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{name}: {bytes} bytes a robot under way; {began:.0} ns to begin, then best {:.0} and median {:.0} ns \
         an activation",
        times[0], times[15]
    );
}

/// The fleet as a judge of its properties sees it.
struct Seen<'a> {
    fleet: &'a Fleet,
    /// Whether the fleet has versions, so that the judge can skip unchanged robots.
    tells_versions: bool,
}

impl Seen<'_> {
    fn program(&self, robot: RobotId) -> Option<&RobotProgram> {
        let node = self.fleet.nodes.get(robot.index())?;
        node.program().inspect()?.downcast_ref()
    }
}

impl properties::Fleet for Seen<'_> {
    fn robots(&self) -> &[RobotId] {
        &self.fleet.ids
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.program(robot).map(RobotProgram::state)
    }

    fn version(&self, robot: RobotId) -> Option<u64> {
        let program = self.program(robot).filter(|_| self.tells_versions);
        program.map(RobotProgram::version)
    }

    fn pose(&self, _: RobotId) -> Option<Pose> {
        Some(Pose::default())
    }

    fn velocity(&self, _: RobotId) -> Option<Point> {
        Some(Point::ZERO)
    }

    fn has_finished(&self, _: RobotId) -> bool {
        false
    }

    fn is_up(&self, _: RobotId) -> bool {
        true
    }

    fn way_points(&self) -> Option<&[WayPoint]> {
        Some(&self.fleet.way_points)
    }
}

/// How long it takes to judge Race's properties, all robots and those that have changed.
fn measure_judge(program: &RobotProgram) {
    let mut fleet = Fleet::new(&|| Box::new(program.clone()));
    fleet.handle(&NodeInput::Start);
    fleet.handle(&ACTIVATE);
    for tells_versions in [false, true] {
        let seen = Seen {
            fleet: &fleet,
            tells_versions,
        };
        let mut judge = Judge::new(program.code());
        let mut times: Vec<f64> = (0..31)
            .map(|_| {
                let began = Instant::now();
                assert_eq!(judge.observe(Time::ZERO, &seen), []);
                began.elapsed().as_nanos() as f64 / f64::from(ROBOTS)
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let of = if tells_versions {
            "where nothing has changed"
        } else {
            "of all"
        };
        println!(
            "Properties {of}: best {:.0} and median {:.0} ns a robot",
            times[0], times[15]
        );
    }
}

/// Memory that was given back would be used again, so each fleet has a process to itself.
fn main() {
    let source = include_str!("../../../examples/race/race.starl");
    let program = robot_support::program(&compile(source));
    match std::env::args().nth(1).as_deref() {
        Some("starl") => measure("Race in StarL", &|| Box::new(program.clone())),
        Some("judge") => measure_judge(&program),
        Some("rust") => measure("Race in Rust", &|| Box::new(starl_race::Race::default())),
        _ => {
            println!(
                "sizes of the programs themselves: {} and {} bytes",
                size_of::<RobotProgram>(),
                size_of::<starl_race::Race>()
            );
            for fleet in ["starl", "rust", "judge"] {
                let this = std::env::current_exe().expect("this program has a path");
                let run = std::process::Command::new(this).arg(fleet).status();
                assert!(run.is_ok_and(|status| status.success()), "{fleet} failed");
            }
        }
    }
}
