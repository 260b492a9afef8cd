//! The program of one robot: its variables and its primitives, run by the machine.

use super::atomic::{Conflicts, Script, Turn, reads};
use super::code::Code;
use super::context::Context;
use super::corruption;
use super::failure::Failure;
use super::host::RobotHost;
use super::messages::Arrival;
use super::pace::Pace;
use super::parameter::{self, ParameterError};
use super::primitives::{Attended, Report, Slot};
use super::reports::{handle_reports, hold_back};
use super::rest::Disturbing;
use super::services::Services;
use super::stable::Kept;
use super::words::shortened;
use super::workbench::Workbench;
use crate::machine::{Limits, Machine, RuntimeError, State, Value};
use alloc::boxed::Box;
use alloc::collections::VecDeque;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::any::Any;
use core::{fmt, mem};
use starl_core::Value as Detail;
use starl_core::random::hash_key;
use starl_core::{
    Message, Order, Point, Port, Primitive, Primitives, Program, Random, Robot, Time,
};
use starl_primitives::SharedMemory;

/// A StarL program on one robot.
///
/// Events of primitives are handled first; a message or an order runs its handlers on arrival, and actions wait for the
/// next activation. A run-time error stops the robot and ends its program with the place in the source.
#[derive(Clone)]
pub struct RobotProgram {
    pub(super) code: Code,
    pub(super) state: State,
    pub(super) bound: Box<[Slot]>,
    pub(super) services: Services,
    /// Events of primitives that wait for their handlers: the instance's number and what happened.
    pub(super) reports: Vec<(u32, Report)>,
    /// Messages and orders that wait for an action with `atomic`.
    pub(super) waiting: VecDeque<Waiting>,
    /// See [`RobotProgram::version`].
    version: u64,
    /// The stable variables in storage.
    kept: Option<Box<Kept>>,
    pub(super) phase: Phase,
    /// Whether it rests: see [`rest`](super::rest).
    rests: bool,
    /// When each action may fire.
    paces: Box<[Pace]>,
    /// See [`RobotProgram::failed_check`].
    failed_check: Option<(u32, Box<str>)>,
    /// See [`RobotProgram::target`].
    target: Option<Point>,
}

/// The activation that waits for an action with `atomic`.
#[derive(Clone, Debug)]
pub(super) enum Waiting {
    Message(Message),
    Order(Order),
}

/// How far the program is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// It has not started.
    New,
    /// It runs.
    Running,
    /// It has said that it cannot continue, or something went wrong.
    Failed,
}

impl RobotProgram {
    /// A program that has not started, with these values of its parameters and the defaults of
    /// others.
    pub fn new(code: &Code, parameters: &[(&str, Value)]) -> Result<RobotProgram, ParameterError> {
        let actions = &code.program().bytecode().actions;
        Ok(RobotProgram {
            state: parameter::state(code, parameters)?,
            bound: code.instances().iter().map(|_| None).collect(),
            code: code.clone(),
            services: Services::default(),
            reports: Vec::new(),
            waiting: VecDeque::new(),
            version: 0,
            kept: None,
            phase: Phase::New,
            rests: false,
            paces: actions.iter().map(|_| Pace::default()).collect(),
            failed_check: None,
            target: None,
        })
    }

    /// Where the first check is written that was false, so that the program started again, and the values of the
    /// variables that it reads, e.g. `race.starl:12:7 (count = -4)`.
    pub fn failed_check(&self) -> Option<String> {
        let (check, values) = self.failed_check.as_ref()?;
        let place = self.code.place_of_check(*check)?;
        Some(match &**values {
            "" => place,
            values => format!("{place} ({values})"),
        })
    }

    /// Where its motion leads, or led last: a robot that cannot get to its target may have given up.
    pub fn target(&self) -> Option<Point> {
        self.target
    }

    /// Its variables.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// A number that is another one whenever its variables may have changed, those of an earlier run
    /// of the robot included.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Its copies of the program's shared variables; none before it starts, or if there are none.
    pub fn memory(&self) -> Option<&SharedMemory> {
        self.services.memory.as_deref()
    }

    /// The code that it runs.
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// Whether it has started, so that its variables have their first values.
    pub fn has_started(&self) -> bool {
        self.phase != Phase::New
    }

    /// Runs a part of the program, after the handlers of pending events.
    pub(super) fn run(&mut self, robot: &mut Robot<'_>, mut part: Part<'_>) {
        if self.phase == Phase::Failed {
            return;
        }
        let code = &self.code;
        let (paces, now) = (&mut self.paces, robot.now());
        let held = code.held(&self.services);
        let mut reports = mem::take(&mut self.reports);
        self.reports = hold_back(code.instances(), &mut reports, held);
        let mut bench = robot.take_scratch::<Workbench>();
        let Workbench { workspace, memo } = &mut *bench;
        let context = Context::new(code, robot, memo, &mut self.services);
        let mut host = RobotHost::new(context, &mut self.bound, part.take_script());
        let is_activation = matches!(part, Part::Actions(_));
        let is_checked = held.is_none() && !matches!(part, Part::Start | Part::Perform(..));

        let is_told = !reports.is_empty() || !is_activation;
        let (program, limits) = (code.program(), Limits::default());
        let mut machine = Machine::new(program, &mut self.state, workspace, &mut host, limits);
        let checked = match is_checked {
            true => check(code, &mut machine),
            false => Ok(None),
        };
        let failed_check = checked.as_ref().ok().cloned().flatten();
        let result = checked
            .and_then(|_| handle_reports(code.instances(), &reports, &mut machine))
            .and_then(|()| part.run(code, held, (paces, now), &mut machine));
        let (failure, has_fired) = (host.failure, host.has_fired);
        if let Some((check, values)) = failed_check {
            self.failed_check.get_or_insert((check, values));
            paces.fill(Pace::default());
            let place = code.place_of_check(check).unwrap_or_default();
            let fields = [("check".into(), Detail::Text(place.into()))];
            robot.emit_fields("reset", fields.into_iter().collect());
        }
        if has_fired || is_told {
            let slots = self.bound.iter().flatten();
            let mut targets = slots.filter_map(|slot| slot.bound.target());
            self.target = targets.next().or(self.target);
            self.version += 1;
        }
        self.rests = is_activation && !has_fired && code.is_steady();
        bench.workspace.trim();
        robot.return_scratch(bench);
        if let Err(error) = result {
            let reason = failure.unwrap_or_else(|| self.code.describe(&error));
            self.fail(robot, reason);
        }
    }

    /// Ends the program.
    pub(super) fn fail(&mut self, robot: &mut Robot<'_>, reason: Failure) {
        robot.halt();
        robot.fail(reason.to_string());
        self.phase = Phase::Failed;
        // Others need not wait for it.
        if let Some(atomic) = &mut self.services.atomic {
            atomic.release(robot, self.code.groups());
        }
    }
}

/// Starts the program again if a check is false; returns the first one that is, and the values that it reads.
fn check(code: &Code, machine: &mut Machine<'_>) -> Result<Option<(u32, Box<str>)>, RuntimeError> {
    let mut first = None;
    for number in 0..code.checks() {
        machine.check(number, |state| {
            first.get_or_insert_with(|| (number, values_read(code, number, state)));
        })?;
    }
    Ok(first)
}

/// The variables that a check reads, with their values: `count = -4, most = 5`.
fn values_read(code: &Code, check: u32, state: &State) -> Box<str> {
    /// Longer texts are cut off.
    const LONGEST: usize = 80;
    let program = code.program();
    let bytecode = program.bytecode();
    let Some(action) = bytecode.actions.get(check as usize) else {
        return Box::default();
    };
    let values = program.values_where(state, reads(bytecode, action.guard));
    let values = values.map(|(name, value)| shortened(format!("{name} = {value}"), LONGEST));
    values.collect::<Vec<_>>().join(", ").into()
}

/// A part of a program that runs in one go.
pub(super) enum Part<'a> {
    /// The first values of variables, bindings of primitives, and `init`.
    Start,
    /// All actions, one after the other; the next of the actions that wait for variables is determined.
    Actions(&'a mut Turn),
    /// An action with `atomic` whose writes are stored.
    Perform(u32, Script),
    /// All handlers of a message; none if it is not a message of the program.
    Message(&'a Message),
    /// All handlers of an order.
    Order(Arrival<'a>),
    /// Only the handlers of pending events.
    Nothing,
}

impl Part<'_> {
    /// Takes the effects that calls to the host have requested.
    fn take_script(&mut self) -> Script {
        match self {
            Part::Perform(_, script) => mem::take(script),
            _ => Script::None,
        }
    }

    fn run(
        self,
        code: &Code,
        held: Option<&Conflicts>,
        (paces, now): (&mut [Pace], Time),
        machine: &mut Machine<'_>,
    ) -> Result<(), RuntimeError> {
        let program = code.program();
        match self {
            Part::Start => machine.start(),
            Part::Actions(turn) => {
                let actions = (0..).zip(&program.bytecode().actions).zip(paces);
                let mut actions = actions.skip(code.checks() as usize);
                actions.try_for_each(|((number, action), pace)| {
                    if code.groups().of_action(number).is_some() {
                        if turn.asks(number) {
                            turn.note(number, pace.is_due(action, number, now, machine)?);
                        }
                    } else if held.is_some_and(|held| held.keeps_action(number)) {
                        // It waits.
                    } else if !action.is_timed() {
                        machine.action(number)?;
                    } else if pace.is_due(action, number, now, machine)?
                        && machine.action(number)?
                    {
                        pace.fire(action, now, machine)?;
                    }
                    Ok(())
                })
            }
            Part::Nothing => Ok(()),
            Part::Perform(number, _) => {
                machine.action(number)?;
                let actions = &program.bytecode().actions;
                let action = actions.get(number as usize);
                match (action, paces.get_mut(number as usize)) {
                    (Some(action), Some(pace)) if action.is_timed() => {
                        pace.fire(action, now, machine)
                    }
                    _ => Ok(()),
                }
            }
            Part::Message(message) => {
                let Some(arrival) = code.inbox().decode(program, &message.payload) else {
                    return Ok(());
                };
                let from = [u64::from(message.from.0)];
                let scalars = from.into_iter().chain(arrival.scalars).collect();
                Arrival { scalars, ..arrival }.handle(machine)
            }
            Part::Order(arrival) => arrival.handle(machine),
        }
    }
}

impl Arrival<'_> {
    /// Runs its handlers.
    fn handle(&self, machine: &mut Machine<'_>) -> Result<(), RuntimeError> {
        let mut handlers = self.handlers.iter();
        handlers.try_for_each(|&handler| machine.handler(handler, &self.scalars, &self.objects))
    }
}

/// Not derived: which primitives a program holds its code says, and their events are passed to the program.
impl Primitives for RobotProgram {
    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        let forms = self.code.instances().iter();
        for ((number, form), slot) in forms.enumerate().zip(&mut self.bound) {
            let Some(slot) = slot else { continue };
            let Some(port) = slot.port else { continue };
            visit(&mut Attended {
                slot,
                port,
                form,
                number: number as u32,
                reports: &mut self.reports,
                rests: &mut self.rests,
            });
        }
        let rests = &mut self.rests;
        self.services
            .primitives(self.code.groups(), &mut |primitive| {
                visit(&mut Disturbing { primitive, rests });
            });
    }
}

impl Program for RobotProgram {
    fn start(&mut self, robot: &mut Robot<'_>) {
        self.phase = Phase::Running;
        // Far from the numbers of earlier runs.
        self.version = 1 + (hash_key(robot.now().0, &[self.version]) >> 1);
        self.bound.fill_with(|| None);
        self.reports.clear();
        self.waiting.clear();
        self.rests = false;
        self.target = None;
        self.paces.fill(Pace::default());
        self.services = self.code.services().started(self.code.groups(), robot);
        self.run(robot, Part::Start);
        // After a start that failed, variables may be without their values.
        if self.phase == Phase::Running && self.kept.is_none() {
            self.kept = Kept::at_start(self.code.stable(), robot).map(Box::new);
        }
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        // Without optimisation it is seen to that nothing was missed.
        let rests = self.rests && self.services.atomic.is_none();
        if rests && !cfg!(debug_assertions) {
            return;
        }
        let mut turn = Turn::default();
        if let Some(atomic) = &mut self.services.atomic {
            turn = atomic.turn(robot, self.code.groups());
        }
        self.run(robot, Part::Actions(&mut turn));
        debug_assert!(!rests || self.rests, "an action is enabled without cause");
        if let Some(atomic) = &mut self.services.atomic
            && self.phase == Phase::Running
        {
            atomic.take_turn(robot, self.code.groups(), turn);
        }
        self.go_on(robot);
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let atomic = self.services.atomic.as_ref();
        if atomic.is_some_and(|atomic| atomic.listens_at(message.port)) {
            return self.go_on(robot);
        }
        // Programs talk through primitives; nothing else is heard.
        if message.port == Port::PROGRAM {
            return;
        }
        if self.must_wait(message) {
            self.keep_waiting(Waiting::Message(message.clone()));
        } else {
            self.run(robot, Part::Message(message));
        }
    }

    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        // The waypoints may have changed, and guards may depend on them.
        self.rests = false;
        self.follow(robot, order);
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        if let Some(kept) = &mut self.kept {
            let values = (self.code.program(), &self.state);
            kept.save(self.code.stable(), values, self.version, robot);
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.version += 1;
        self.rests = false;
        corruption::corrupt(self.code.program(), &mut self.state, random);
        for slot in self.bound.iter_mut().flatten() {
            slot.is_stirred = true;
            slot.bound.corrupt(random);
        }
        for (pace, action) in self
            .paces
            .iter_mut()
            .zip(&self.code.program().bytecode().actions)
        {
            if action.is_timed() {
                pace.corrupt(random);
            }
        }
        self.services.corrupt(self.code.groups(), random);
    }

    fn write_state(&self, text: &mut dyn fmt::Write) -> bool {
        // The code never changes, the version and the target are for observers, and to rest saves time alone.
        let RobotProgram {
            code: _,
            state,
            bound,
            services,
            reports,
            waiting,
            version: _,
            kept,
            phase,
            rests: _,
            paces,
            failed_check: _,
            target: _,
        } = self;
        let kept = kept.iter().flat_map(|kept| kept.digests());
        write!(
            text,
            "{state:?}{bound:?}{services:?}{reports:?}{waiting:?}{phase:?}"
        )
        .and_then(|()| { kept }.try_for_each(|digest| write!(text, "{digest:?}")))
        .and_then(|()| match self.code.waits_for_time() {
            true => write!(text, "{paces:?}"),
            false => Ok(()),
        })
        .is_ok()
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}
