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
use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{
    Agent, Effect, Estimate, Input, MotionRequest, Point, Pose, Program, Random, RobotId, Sensors,
    Time, View, WayPoint,
};
use starl_lang::machine::State;
use starl_lang::robot::RobotProgram;
use starl_lang::robot::properties::{self, Judge};
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
    agents: Vec<Agent>,
    effects: Effects,
}

impl Fleet {
    fn new(make: &dyn Fn() -> Box<dyn Program>) -> Fleet {
        let agent = |id| Agent::new(make(), Random::keyed(1, &[id]));
        let way_point = |index: u32| WayPoint {
            name: format!("w{index}"),
            position: Point::planar(f64::from(index), 1.0),
            group: 0,
        };
        Fleet {
            ids: (0..ROBOTS).map(RobotId).collect(),
            way_points: (0..10).map(way_point).collect(),
            obstacles: [].into(),
            agents: (0..u64::from(ROBOTS)).map(agent).collect(),
            effects: Effects::default(),
        }
    }

    /// Hands all robots an input, and the answers of the planner; gives nanoseconds for each.
    fn feed(&mut self, input: &Input) -> f64 {
        let began = Instant::now();
        for (agent, &id) in self.agents.iter_mut().zip(&self.ids) {
            let view = View {
                id,
                now: Time::ZERO,
                estimate: Estimate::default(),
                body: Body {
                    radius: 0.1,
                    height: 0.1,
                    workspace: Workspace::Ground,
                },
                sensors: Sensors::default(),
                fleet: &self.ids,
                way_points: &self.way_points,
                obstacles: &self.obstacles,
            };
            agent.handle(input, &view, &mut self.effects);
            let plan = self.effects.list.drain(..).find_map(|effect| match effect {
                Effect::Move(MotionRequest::Plan(request)) => Some(request),
                _ => None,
            });
            if let Some(request) = plan {
                let answer = Input::Planned {
                    ticket: request.ticket,
                    path: Some(vec![request.target]),
                };
                agent.handle(&answer, &view, &mut self.effects);
                self.effects.list.clear();
            }
        }
        began.elapsed().as_nanos() as f64 / f64::from(ROBOTS)
    }
}

fn measure(name: &str, make: &dyn Fn() -> Box<dyn Program>) {
    let before = resident();
    let mut fleet = Fleet::new(make);
    let began = fleet.feed(&Input::Start) + fleet.feed(&Input::Activate);
    let bytes = (resident() - before) / ROBOTS as usize;
    let mut times: Vec<f64> = (0..31).map(|_| fleet.feed(&Input::Activate)).collect();
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
    /// Whether the judge is told of whom nothing has changed.
    tells_versions: bool,
}

impl Seen<'_> {
    fn program(&self, robot: RobotId) -> Option<&RobotProgram> {
        let agent = self.fleet.agents.get(robot.index())?;
        agent.program().inspect()?.downcast_ref()
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
}

/// How long it takes to judge Race's properties, all robots and those that have changed.
fn measure_judge(program: &RobotProgram) {
    let mut fleet = Fleet::new(&|| Box::new(program.clone()));
    fleet.feed(&Input::Start);
    fleet.feed(&Input::Activate);
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
