//! The protocol as a program of robots: robot 0 is the transaction manager. Activations and timers are the choices.

use starl_core::{
    Destination, Duration, Message, Port, Primitives, Program, Robot, RobotId, Time, TimerKey,
    timers,
};
use starl_explore::{Bounds, End, Invariant, Model, Report, Scene, Search, Setup};
use starl_properties::Violation;
use std::any::Any;
use std::fmt::Write;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Working,
    Prepared,
    Committed,
    Aborted,
}

timers! {
    enum Choice {
        Abort,
    }
}

const ABORT: fn() -> TimerKey = || TimerKey::new(Port::PROGRAM, Choice::Abort);

#[derive(Clone, Debug, Primitives)]
struct Participant {
    stage: Stage,
    /// By resource manager; on the transaction manager.
    prepared: Vec<bool>,
}

impl Participant {
    fn decide(&mut self, robot: &mut Robot<'_>, commits: bool) {
        self.stage = match commits {
            true => Stage::Committed,
            false => Stage::Aborted,
        };
        robot.cancel_timer(ABORT());
        if robot.id() == RobotId(0) {
            robot.transmit(Destination::All, Port::PROGRAM, &commits);
        }
    }
}

impl Program for Participant {
    fn start(&mut self, robot: &mut Robot<'_>) {
        robot.set_timer(ABORT(), Duration::from_seconds(1));
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        match (robot.id(), self.stage) {
            (RobotId(0), Stage::Working) if self.prepared.iter().all(|is| *is) => {
                self.decide(robot, true);
            }
            (RobotId(1..), Stage::Working) => {
                self.stage = Stage::Prepared;
                robot.cancel_timer(ABORT());
                robot.transmit(Destination::Robot(RobotId(0)), Port::PROGRAM, &true);
            }
            _ => {}
        }
    }

    fn timer(&mut self, robot: &mut Robot<'_>, _: TimerKey) {
        self.decide(robot, false);
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        match (robot.id(), message.read::<bool>()) {
            (RobotId(0), Some(_)) => {
                if self.stage == Stage::Working {
                    self.prepared[message.from.index() - 1] = true;
                }
            }
            (_, Some(commits)) => self.decide(robot, commits),
            (_, None) => {}
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(&self.stage)
    }
}

/// No resource manager commits where another one aborts.
#[derive(Clone)]
struct Consistent;

impl Invariant for Consistent {
    fn judge(&self, scene: &Scene<'_>, violations: &mut Vec<Violation>) {
        let managers = &scene.robots()[1..];
        let is_at = |stage: Stage| {
            let stages = managers
                .iter()
                .filter_map(|&robot| scene.program(robot)?.downcast_ref());
            stages.into_iter().any(|at: &Stage| *at == stage)
        };
        if is_at(Stage::Committed) && is_at(Stage::Aborted) {
            violations.push(Violation {
                property: "consistent".into(),
                at: Time::ZERO,
                robots: Vec::new(),
                text: "one has committed and another aborted".into(),
            });
        }
    }
}

/// Searches all states with this number of resource managers.
pub fn search(managers: usize, threads: usize) -> Report {
    let program = Participant {
        stage: Stage::Working,
        prepared: vec![false; managers],
    };
    let programs = (0..=managers).map(|_| Box::new(program.clone()) as Box<dyn Program>);
    let setup = Setup {
        model: Model::new(programs.collect()),
        bounds: Bounds {
            any_copies: true,
            timers: Bounds::ANY_NUMBER,
            ..Bounds::default()
        },
        checkers: Vec::new(),
        invariants: vec![Box::new(Consistent)],
    };
    let mut search = Search::new(setup).expect("few robots");
    search.set_parallel(threads > 1);
    assert_eq!(search.run(), &End::Complete);
    search.report()
}
