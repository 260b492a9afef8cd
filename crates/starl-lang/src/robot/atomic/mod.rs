//! Actions with `atomic`: how a robot reads and writes linearizable variables as one step.
//!
//! When the guard of such an action holds for the values that the robot knows, the robot requests the lock of the
//! action's variables. Then it claims them: it reads their latest values from a majority, which promises not to store
//! anything under a lower number. Then the robot computes the action's writes and asks a majority to store them. The
//! action takes place, with these writes, only after they are stored. If another robot has claimed the variables
//! meanwhile, nothing is stored and the action is retried.
//!
//! Safety rests on the claims alone (`starl_primitives::register`, the module `claiming`): the lock only reduces
//! contention, and has leases so that its holder may fail. So neither clocks nor leases nor false suspicions can lose
//! an action's writes.
//!
//! Invariants: a robot waits for one action at a time, and holds the lock of no others, so robots do not wait for each
//! other in circles. Variables that some action uses together are one group: one lock, and one register that holds the
//! values of all of them, so that others see all writes of an action or none, even if the robot crashes meanwhile.
//! While an action's writes are being stored, nothing that the action depends on changes ([`Conflicts`]).

mod footprint;
mod groups;
mod script;
mod turn;

pub use footprint::{Conflicts, reads};
pub use groups::{Groups, KIND, join_groups};
pub use script::Script;
pub use turn::Turn;

use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use starl_core::{Input, Payload, Port, Primitive, Random, Robot, message};
use starl_primitives::mutex::{self, Algorithm, Resources};
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
    /// How the action goes whose writes are being stored.
    script: Script,
    /// The values at hand while it is found out what an action writes.
    open: Option<Open>,
}

/// How far a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// It wants nothing.
    Idle,
    /// It waits for the lock of this action.
    Locking(u32),
    /// It has, or had, the lock and waits for the values.
    Claiming(u32, OperationId),
    /// Its writes are known, and are being stored.
    Storing(u32, OperationId),
}

/// The next step of an action.
#[derive(Debug)]
pub enum Step {
    /// Compute its writes from the values ([`Atomic::open`]), and store them ([`Atomic::store`]).
    Try(u32, Values),
    /// It takes place, by this script. [`Atomic::release`] ends it.
    Perform(u32, Script),
}

/// The variables of a group while it is found out what an action writes.
#[derive(Clone, Debug)]
struct Open {
    group: Box<str>,
    values: Values,
}

/// Values of variables that were written, by name.
pub type Values = BTreeMap<String, Payload>;

impl Atomic {
    /// For the program of this name.
    pub fn new(program: &str) -> Atomic {
        let locks = mutex::Options {
            algorithm: Algorithm::Lease,
            ..mutex::Options::default()
        };
        let values = register::Options::default();
        Atomic {
            mutex: Mutex::new(&format!("{program}/atomic"), None, locks),
            register: Register::new(&format!("{program}/linearizable"), None, values),
            stage: Stage::Idle,
            last: None,
            script: Script::None,
            open: None,
        }
    }

    /// A variable's value: the latest while an action is tried, else the known one.
    pub fn value(&self, group: &str, variable: &str) -> Option<Payload> {
        match &self.open {
            Some(open) if *open.group == *group => open.values.get(variable).cloned(),
            _ => values(self.register.known(group)).remove(variable),
        }
    }

    /// Writes a variable of the action that is tried; whether there is one that may.
    pub fn set(&mut self, group: &str, variable: &str, value: Payload) -> bool {
        let Some(open) = self.open.as_mut().filter(|open| *open.group == *group) else {
            return false;
        };
        open.values.insert(variable.into(), value);
        true
    }

    /// Puts values at hand: for a copy on which an action is tried.
    pub fn open(&mut self, group: &str, values: Values) {
        self.open = Some(Open {
            group: group.into(),
            values,
        });
    }

    /// The values after an action was tried.
    pub fn take_values(&mut self) -> Values {
        self.open.take().map(|open| open.values).unwrap_or_default()
    }

    /// Whether the robot knows that it waits for something impossible at present.
    pub fn is_blocked(&self) -> bool {
        self.mutex.failed() || self.register.failed()
    }

    /// The action whose writes are being stored: its dependencies must not change.
    pub fn stores(&self) -> Option<u32> {
        match self.stage {
            Stage::Storing(action, _) => Some(action),
            _ => None,
        }
    }

    /// Begins a pass over all actions.
    pub fn turn(&mut self, robot: &mut Robot<'_>, groups: &Groups) -> Turn {
        self.set_right(robot, groups);
        Turn {
            is_idle: self.stage == Stage::Idle,
            last: self.last,
            waiting: match self.stage {
                Stage::Locking(action) | Stage::Claiming(action, _) => Some(action),
                Stage::Idle | Stage::Storing(..) => None,
            },
            next: None,
        }
    }

    /// Ends a pass: begins an action, or gives up one whose guard no longer holds.
    pub fn take_turn(&mut self, robot: &mut Robot<'_>, groups: &Groups, turn: Turn) {
        match self.stage {
            Stage::Idle => {
                if let Some(action) = turn.next {
                    self.stage = Stage::Locking(action);
                    self.lock(robot, groups, action);
                }
            }
            Stage::Locking(action) | Stage::Claiming(action, _) if turn.waiting != Some(action) => {
                self.last = Some(action);
                self.release(robot, groups);
            }
            _ => {}
        }
    }

    /// Whether the robot need not wait any longer.
    fn is_ready(&self, groups: &Groups) -> bool {
        match self.stage {
            Stage::Idle => false,
            Stage::Locking(action) => self.mutex.holds(&lock(groups, action)),
            Stage::Claiming(_, operation) | Stage::Storing(_, operation) => {
                let status = self.register.status(operation);
                !matches!(status, Status::Pending | Status::NoQuorum)
            }
        }
    }

    /// Continues as far as possible without waiting, or without the program.
    pub fn go_on(&mut self, robot: &mut Robot<'_>, groups: &Groups) -> Option<Step> {
        while self.is_ready(groups) {
            match self.stage {
                Stage::Idle => return None,
                Stage::Locking(action) => {
                    let claim = self.register.claim(robot, groups.of_action(action)?).ok()?;
                    self.stage = Stage::Claiming(action, claim);
                }
                Stage::Claiming(action, claim) => {
                    let Status::Done(value) = self.register.status(claim) else {
                        self.release(robot, groups);
                        continue;
                    };
                    self.register.withdraw(robot, claim);
                    return Some(Step::Try(action, values(value.as_deref())));
                }
                Stage::Storing(action, write) => {
                    let status = self.register.status(write);
                    self.register.withdraw(robot, write);
                    match status {
                        Status::Done(_) => {
                            let script = core::mem::take(&mut self.script);
                            return Some(Step::Perform(action, script));
                        }
                        Status::Lost => self.stage = Stage::Locking(action),
                        // Only a corruption leads here.
                        _ => self.release(robot, groups),
                    }
                }
            }
        }
        None
    }

    /// Starts storing the writes of a tried action, if its guard held.
    ///
    /// # Errors
    /// The value is too long.
    pub fn store(
        &mut self,
        robot: &mut Robot<'_>,
        groups: &Groups,
        tried: Option<(Values, Script)>,
    ) -> Result<(), OperationError> {
        let Stage::Claiming(action, _) = self.stage else {
            return Ok(());
        };
        self.last = Some(action);
        let (Some((values, script)), Some(group)) = (tried, groups.of_action(action)) else {
            self.release(robot, groups);
            return Ok(());
        };
        let value = message::encode(&values);
        match self.register.write_claimed(robot, group, value) {
            Ok(write) => {
                self.stage = Stage::Storing(action, write);
                self.script = script;
            }
            Err(error @ (OperationError::NameTooLong | OperationError::ValueTooLong)) => {
                return Err(error);
            }
            // Only a corruption can have taken away the claim.
            Err(_) => self.release(robot, groups),
        }
        Ok(())
    }

    /// Gives up the action that the robot waits for, and releases its lock.
    pub fn release(&mut self, robot: &mut Robot<'_>, groups: &Groups) {
        if let Stage::Claiming(_, operation) | Stage::Storing(_, operation) = self.stage {
            self.register.withdraw(robot, operation);
        }
        self.script = Script::None;
        self.stage = Stage::Idle;
        if self.mutex.crit() || self.mutex.is_waiting() {
            self.mutex.release(robot, &all_locks(groups));
        }
    }

    fn lock(&mut self, robot: &mut Robot<'_>, groups: &Groups, action: u32) {
        if self.mutex.acquire(robot, lock(groups, action)).is_err() {
            // Only a corruption can have left it with others.
            self.mutex.release(robot, &all_locks(groups));
        }
    }

    /// Requests a lock again that has ended meanwhile, and repairs states that only a corruption leaves behind.
    fn set_right(&mut self, robot: &mut Robot<'_>, groups: &Groups) {
        match self.stage {
            Stage::Idle if self.mutex.crit() || self.mutex.is_waiting() => {
                self.release(robot, groups);
            }
            Stage::Idle => {}
            Stage::Locking(action) => self.lock(robot, groups, action),
            Stage::Claiming(_, operation) | Stage::Storing(_, operation) => {
                if self.register.status(operation) == Status::Unknown {
                    self.release(robot, groups);
                }
            }
        }
    }

    /// Shows both primitives to `visit`.
    pub fn primitives(&mut self, groups: &Groups, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        for is_mutex in [true, false] {
            visit(&mut Half {
                atomic: self,
                groups,
                is_mutex,
            });
        }
    }

    /// Whether one of its primitives listens at the port.
    pub fn listens_at(&self, port: Port) -> bool {
        self.mutex.port() == port || self.register.port() == port
    }

    /// Overwrites its state at random.
    pub fn corrupt(&mut self, groups: &Groups, random: &mut Random) {
        self.mutex.corrupt(random, &all_locks(groups));
        self.register.corrupt(random);
        let action = random.below(groups.actions());
        match random.below(4) {
            0 => self.stage = Stage::Idle,
            1 | 2 if groups.of_action(action).is_some() => self.stage = Stage::Locking(action),
            _ => {}
        }
    }
}

/// One of the two primitives. When it brings what the robot waits for, the robot delivers an empty message to itself,
/// so that the action continues at once.
struct Half<'a> {
    atomic: &'a mut Atomic,
    groups: &'a Groups,
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
        if self.atomic.is_ready(self.groups) {
            robot.deliver(robot.id(), self.port(), Payload::new());
        }
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        match self.is_mutex {
            true => self.atomic.mutex.save(robot),
            false => self.atomic.register.save(robot),
        }
    }
}

/// Reads a group's register. Bytes that are not a valid value count as never written.
fn values(bytes: Option<&[u8]>) -> Values {
    bytes.and_then(message::decode).unwrap_or_default()
}

fn lock(groups: &Groups, action: u32) -> Resources {
    groups
        .of_action(action)
        .into_iter()
        .map(Box::from)
        .collect()
}

fn all_locks(groups: &Groups) -> Resources {
    groups.all().map(Box::from).collect()
}
