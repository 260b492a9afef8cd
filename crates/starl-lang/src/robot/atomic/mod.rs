//! Actions with `atomic`: how a robot comes to have linearizable variables for itself.
//!
//! When the guard of such an action holds by what the robot knows, the robot asks for the lock of the
//! action's variables, reads their latest values from a majority, has them stored anew so that nothing that a
//! robot wrote when it crashed can take effect any more, and runs the action if its guard still holds by those.
//! What it wrote is stored by a majority before the lock is given back, so that whoever gets the lock next
//! reads it.
//!
//! Invariants: a robot waits for one action at a time, and holds the lock of no others, so robots do not wait
//! for each other in circles. Variables that some action uses together are one group: one lock, and one
//! register that holds the values of all of them, so that of what an action writes others see all or
//! nothing, even if the robot crashes meanwhile.

mod groups;
mod turn;

pub use groups::join_groups;
pub use turn::Turn;

use super::code::Code;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use starl_core::{Input, Payload, Port, Primitive, Random, Robot, message};
use starl_primitives::mutex::{self, Resources};
use starl_primitives::register::{self, OperationError, OperationId, Status};
use starl_primitives::{Mutex, Register};

/// The locks and the values, and how far this robot is with an action.
#[derive(Clone, Debug)]
pub struct Atomic {
    mutex: Mutex,
    register: Register,
    stage: Stage,
    /// The action that had its turn last.
    last: Option<u32>,
    /// The values at hand while an action runs.
    open: Option<Open>,
}

/// How far a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// It wants nothing.
    Idle,
    /// It waits for the lock of this action.
    Locking(u32),
    /// It has the lock and waits for the values.
    Reading(u32, OperationId),
    /// It has the values, and they are being stored anew.
    Fencing(u32, OperationId),
    /// The action runs.
    Running(u32),
    /// It has run, and what it wrote is being stored.
    Writing(u32, OperationId),
}

/// The variables of a group while an action runs.
#[derive(Clone, Debug)]
struct Open {
    group: Box<str>,
    values: Values,
    has_changed: bool,
}

/// Values of variables that were written, by name.
type Values = BTreeMap<String, Payload>;

impl Atomic {
    /// For the program of this name.
    pub fn new(program: &str) -> Atomic {
        let (locks, values) = (mutex::Options::default(), register::Options::default());
        Atomic {
            mutex: Mutex::new(&format!("{program}/atomic"), None, locks),
            register: Register::new(&format!("{program}/linearizable"), None, values),
            stage: Stage::Idle,
            last: None,
            open: None,
        }
    }

    /// A variable's value: while an action runs the latest, else what is known here.
    pub fn value(&self, group: &str, variable: &str) -> Option<Payload> {
        match &self.open {
            Some(open) if *open.group == *group => open.values.get(variable).cloned(),
            _ => values(self.register.known(group)).remove(variable),
        }
    }

    /// Writes a variable of the action that runs; whether there is one that may.
    pub fn set(&mut self, group: &str, variable: &str, value: Payload) -> bool {
        let Some(open) = self.open.as_mut().filter(|open| *open.group == *group) else {
            return false;
        };
        open.values.insert(variable.into(), value);
        open.has_changed = true;
        true
    }

    /// Whether what the robot waits for cannot come, as far as it knows.
    pub fn is_blocked(&self) -> bool {
        self.mutex.failed() || self.register.failed()
    }

    /// Begins a pass over all actions.
    pub fn turn(&mut self, robot: &mut Robot<'_>, code: &Code) -> Turn {
        self.set_right(robot, code);
        Turn {
            is_idle: self.stage == Stage::Idle,
            last: self.last,
            waiting: match self.stage {
                Stage::Locking(action) | Stage::Reading(action, _) | Stage::Fencing(action, _) => {
                    Some(action)
                }
                _ => None,
            },
            next: None,
        }
    }

    /// Ends a pass: begins an action, or gives up the one whose guard holds no longer.
    pub fn take_turn(&mut self, robot: &mut Robot<'_>, code: &Code, turn: Turn) {
        match self.stage {
            Stage::Idle => {
                if let Some(action) = turn.next {
                    self.stage = Stage::Locking(action);
                    self.lock(robot, code, action);
                }
            }
            Stage::Locking(action) | Stage::Reading(action, _) | Stage::Fencing(action, _)
                if turn.waiting != Some(action) =>
            {
                self.last = Some(action);
                self.release(robot, code);
            }
            _ => {}
        }
    }

    /// Whether the robot need not wait any longer.
    fn is_ready(&self, code: &Code) -> bool {
        match self.stage {
            Stage::Locking(action) => self.mutex.holds(&lock(code, action)),
            Stage::Reading(_, operation)
            | Stage::Fencing(_, operation)
            | Stage::Writing(_, operation) => {
                matches!(self.register.status(operation), Status::Done(_))
            }
            Stage::Idle | Stage::Running(_) => false,
        }
    }

    /// Goes on as far as can be without waiting; gives the action that is to run, which
    /// [`Atomic::close`] ends.
    pub fn go_on(&mut self, robot: &mut Robot<'_>, code: &Code) -> Option<u32> {
        while self.is_ready(code) {
            match self.stage {
                Stage::Locking(action) => {
                    let read = self.register.read(robot, code.group(action)?).ok()?;
                    self.stage = Stage::Reading(action, read);
                }
                Stage::Reading(action, read) => {
                    let Status::Done(value) = self.register.status(read) else {
                        return None;
                    };
                    self.register.withdraw(robot, read);
                    let value = message::encode(&values(value.as_deref()));
                    let group = code.group(action)?;
                    let fence = self.register.write_locked(robot, group, value).ok()?;
                    self.stage = Stage::Fencing(action, fence);
                }
                Stage::Fencing(action, fence) => {
                    let Status::Done(value) = self.register.status(fence) else {
                        return None;
                    };
                    self.register.withdraw(robot, fence);
                    self.open = Some(Open {
                        group: code.group(action)?.into(),
                        values: values(value.as_deref()),
                        has_changed: false,
                    });
                    self.stage = Stage::Running(action);
                    return Some(action);
                }
                Stage::Writing(_, write) => {
                    self.register.withdraw(robot, write);
                    self.release(robot, code);
                }
                Stage::Idle | Stage::Running(_) => return None,
            }
        }
        None
    }

    /// The action has run, or its guard did not hold. What it wrote is to be stored before others go on.
    pub fn close(&mut self, robot: &mut Robot<'_>, code: &Code) -> Result<(), OperationError> {
        let Stage::Running(action) = self.stage else {
            return Ok(());
        };
        self.last = Some(action);
        match self.open.take().filter(|open| open.has_changed) {
            Some(open) => {
                let value = message::encode(&open.values);
                let write = self.register.write_locked(robot, &open.group, value)?;
                self.stage = Stage::Writing(action, write);
            }
            None => self.release(robot, code),
        }
        Ok(())
    }

    /// Gives up whatever the robot waits for, and gives back what it holds.
    pub fn release(&mut self, robot: &mut Robot<'_>, code: &Code) {
        if let Stage::Reading(_, operation)
        | Stage::Fencing(_, operation)
        | Stage::Writing(_, operation) = self.stage
        {
            self.register.withdraw(robot, operation);
        }
        self.open = None;
        self.stage = Stage::Idle;
        if self.mutex.crit() || self.mutex.is_waiting() {
            self.mutex.release(robot, &all_locks(code));
        }
    }

    fn lock(&mut self, robot: &mut Robot<'_>, code: &Code, action: u32) {
        if self.mutex.acquire(robot, lock(code, action)).is_err() {
            // Only a corruption can have left it with others.
            self.mutex.release(robot, &all_locks(code));
        }
    }

    /// Sets right what only a corruption leaves behind.
    fn set_right(&mut self, robot: &mut Robot<'_>, code: &Code) {
        match self.stage {
            Stage::Idle if self.mutex.crit() || self.mutex.is_waiting() => {
                self.release(robot, code);
            }
            Stage::Idle => {}
            Stage::Locking(action) => self.lock(robot, code, action),
            Stage::Reading(action, operation) | Stage::Fencing(action, operation) => {
                let has_lock = self.mutex.holds(&lock(code, action));
                if !has_lock || self.register.status(operation) == Status::Unknown {
                    self.release(robot, code);
                }
            }
            Stage::Writing(_, operation) => {
                if self.register.status(operation) == Status::Unknown {
                    self.release(robot, code);
                }
            }
            Stage::Running(_) => self.release(robot, code),
        }
    }

    /// Shows both primitives to `visit`.
    pub fn primitives(&mut self, code: &Code, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        for is_mutex in [true, false] {
            visit(&mut Half {
                atomic: self,
                code,
                is_mutex,
            });
        }
    }

    /// Whether one of its primitives listens at the port.
    pub fn listens_at(&self, port: Port) -> bool {
        self.mutex.port() == port || self.register.port() == port
    }

    /// Overwrites its state at random.
    pub fn corrupt(&mut self, code: &Code, random: &mut Random) {
        self.mutex.corrupt(random, &all_locks(code));
        self.register.corrupt(random);
        let actions = code.program().bytecode().actions.len() as u32;
        let action = random.below(actions);
        match random.below(4) {
            0 => self.stage = Stage::Idle,
            1 if code.group(action).is_some() => self.stage = Stage::Locking(action),
            2 if code.group(action).is_some() => self.stage = Stage::Running(action),
            _ => {}
        }
    }
}

/// One of the two primitives. When it brings what the robot waits for, the robot delivers an empty message to
/// itself, so that the action goes on at once.
struct Half<'a> {
    atomic: &'a mut Atomic,
    code: &'a Code,
    is_mutex: bool,
}

impl Primitive for Half<'_> {
    fn port(&self) -> Port {
        match self.is_mutex {
            true => self.atomic.mutex.port(),
            false => self.atomic.register.port(),
        }
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match self.is_mutex {
            true => self.atomic.mutex.handle(robot, input),
            false => self.atomic.register.handle(robot, input),
        }
        if self.atomic.is_ready(self.code) {
            robot.deliver(robot.id(), self.port(), Payload::new());
        }
    }
}

/// Reads a group's register. What is none of ours is as if nothing was ever written.
fn values(bytes: Option<&[u8]>) -> Values {
    bytes.and_then(message::decode).unwrap_or_default()
}

fn lock(code: &Code, action: u32) -> Resources {
    code.group(action).into_iter().map(Box::from).collect()
}

fn all_locks(code: &Code) -> Resources {
    code.groups().map(Box::from).collect()
}
