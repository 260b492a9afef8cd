//! A program that executes a script, and reports all its inputs.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use starl_core::motion::{PlanRequest, Planner};
use starl_core::timer::Token;
use starl_core::{
    Destination, Duration, Input, Point, Port, Primitive, Primitives, Program, Random, Robot,
    RobotId, TimerKey,
};

/// The program. It emits an event `told` for each input: `what` it was, the time `now` by the robot's clock, and
/// which input it was in this `count`. A robot that finds a saved number when it starts emits `found` with it.
#[derive(Clone, Debug, Default, Primitives)]
pub struct Probe(Ear);

/// Under which a number is saved.
const KEY: &str = "number";

/// A primitive that answers, because programs do not see all inputs.
#[derive(Clone, Debug, Default)]
struct Ear {
    rules: Vec<(Cue, Vec<Act>)>,
    count: u32,
}

/// The cues for a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cue {
    /// It starts.
    Start,
    /// It is activated.
    Activate,
    /// It hears where it is.
    Located,
    /// A timer fires.
    Timer(u32),
    /// A datagram arrives with this number.
    Message(u32),
    /// A path was found for this request.
    Path(u32),
    /// No path was found for this request.
    NoPath(u32),
    /// Something else.
    Other,
}

/// The responses of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// Arm a timer.
    Arm(u32, Duration),
    /// Cancel a timer.
    Cancel(u32),
    /// Send a number to a robot.
    Send(RobotId, u32),
    /// Ask for a path, by this ticket.
    Plan(u32),
    /// Save a number, replacing the previous one.
    Save(u32),
    /// Say that the goal is reached.
    Finish,
    /// Say that it cannot continue.
    Fail,
}

impl Probe {
    /// A robot that only reports.
    pub fn new() -> Probe {
        Probe::default()
    }

    /// The same robot, which also does this at each such cue.
    pub fn on(mut self, cue: Cue, acts: impl Into<Vec<Act>>) -> Probe {
        self.0.rules.push((cue, acts.into()));
        self
    }

    /// The same robot, which also performs these acts at this time after its start. Each such moment has its timer; the
    /// first is 1000.
    pub fn after(self, span: Duration, acts: impl Into<Vec<Act>>) -> Probe {
        let timer = 1000 + self.0.rules.len() as u32;
        self.on(Cue::Start, [Act::Arm(timer, span)])
            .on(Cue::Timer(timer), acts)
    }

    /// This robot, as a program.
    pub fn boxed(self) -> Box<dyn Program> {
        Box::new(self)
    }
}

impl Program for Probe {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn corrupt(&mut self, random: &mut Random) {
        self.0.count = 1_000_000 + random.below(1000);
    }

    fn write_state(&self, text: &mut dyn fmt::Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}

impl Primitive for Ear {
    fn port(&self) -> Port {
        Port::named("probe")
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        self.count += 1;
        let cue = match input {
            Input::Start => Cue::Start,
            Input::Activate => Cue::Activate,
            Input::Estimate => Cue::Located,
            Input::Timer(key) => Cue::Timer(key.token.parts().1),
            Input::Message(message) => message.read().map_or(Cue::Other, Cue::Message),
            Input::Planned {
                ticket,
                path: Some(_),
            } => Cue::Path(*ticket),
            Input::Planned { ticket, path: None } => Cue::NoPath(*ticket),
            _ => Cue::Other,
        };
        let what: String = format!("{cue:?}");
        let now = robot.now();
        robot.emit(
            "told",
            [
                ("what", starl_core::Value::Text(what.into())),
                ("now", now.into()),
                ("count", self.count.into()),
            ],
        );
        let port = self.port();
        if let (Input::Start, Some(saved)) = (input, robot.saved())
            && let Some(number) = saved.get::<u32>(port, KEY)
        {
            robot.emit("found", [("number", number.into())]);
        }
        for (_, acts) in self.rules.iter().filter(|(on, _)| *on == cue) {
            acts.iter().for_each(|act| self.act(robot, *act));
        }
    }
}

impl Ear {
    fn act(&self, robot: &mut Robot<'_>, act: Act) {
        let key = |number| TimerKey {
            port: self.port(),
            token: Token::new(0, number),
        };
        match act {
            Act::Arm(timer, after) => robot.set_timer(key(timer), after),
            Act::Cancel(timer) => robot.cancel_timer(key(timer)),
            Act::Send(to, number) => {
                robot.transmit(Destination::Robot(to), self.port(), &number);
            }
            Act::Plan(ticket) => robot.plan(PlanRequest {
                ticket,
                target: robot.position() + Point::planar(1.0, 0.0),
                vicinity: 0.1,
                unsafe_set: [].into(),
                around_robots: false,
                planner: Planner::Auto,
                most_nodes: 1000,
                seed: 1,
            }),
            Act::Save(number) => robot.save(self.port(), KEY, &number),
            Act::Finish => robot.finish(),
            Act::Fail => robot.fail("told to"),
        }
    }
}
