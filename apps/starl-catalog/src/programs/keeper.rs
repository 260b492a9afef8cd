//! A robot that reads and writes one register and reads and updates another, at random. Programs in the language use
//! registers in actions with `atomic` alone, which only update.

use starl_core::{Duration, Payload, Primitives, Program, Random, Robot, Time};
use starl_primitives::register::{OperationId, Options, Status as Progress};
use starl_primitives::{FailureDetector, Register, failure_detector};

/// The register that is written, and the one that is claimed and updated: claims of a register refuse its plain
/// writes.
const WRITTEN: &str = "written";
const UPDATED: &str = "updated";

/// The program of one robot.
#[derive(Clone, Debug, Primitives)]
pub struct Keeper {
    detector: FailureDetector,
    register: Register,
    /// How many operations it is still to begin.
    left: u32,
    /// The longest pause between two.
    pause: Duration,
    /// An operation that takes longer is withdrawn.
    patience: Duration,
    under_way: Option<Operation>,
    next: Time,
}

#[derive(Clone, Copy, Debug)]
struct Operation {
    id: OperationId,
    is_claim: bool,
    /// When it is withdrawn.
    end: Time,
}

impl Keeper {
    /// A robot that has not started.
    pub fn new(operations: u32, pause: Duration, patience: Duration) -> Keeper {
        Keeper {
            detector: FailureDetector::new("detector", failure_detector::Options::default()),
            register: Register::new("register", None, Options::default()),
            left: operations,
            pause,
            patience,
            under_way: None,
            next: Time::ZERO,
        }
    }

    /// Whether the last operation is over. A claimed register is written at once.
    fn is_idle(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(operation) = self.under_way else {
            return true;
        };
        match self.register.status(operation.id) {
            Progress::Pending | Progress::NoQuorum if robot.now() < operation.end => return false,
            Progress::Pending | Progress::NoQuorum => {
                self.register.withdraw(robot, operation.id);
                self.under_way = None;
            }
            Progress::Done(_) if operation.is_claim => {
                let value = value(robot);
                let written = self.register.write_claimed(robot, UPDATED, value);
                self.note(robot.now(), written.ok(), false);
            }
            _ => self.under_way = None,
        }
        self.under_way.is_none()
    }

    fn note(&mut self, now: Time, id: Option<OperationId>, is_claim: bool) {
        let end = now + self.patience;
        self.under_way = id.map(|id| Operation { id, is_claim, end });
    }
}

/// No two writes are of the same value.
fn value(robot: &mut Robot<'_>) -> Payload {
    let bits = u64::from(robot.random().bits()) << 32 | u64::from(robot.id().0);
    let bytes = (robot.now().0 ^ bits).to_le_bytes();
    Payload::from_slice(&bytes)
}

impl Program for Keeper {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        if !self.is_idle(robot) || now < self.next {
            return;
        }
        if self.left == 0 {
            return robot.finish();
        }
        self.left -= 1;
        let pause = self.pause.seconds() * robot.random().uniform();
        self.next = now + Duration::from_seconds_f64(pause);
        let (id, is_claim) = match robot.random().below(4) {
            0 => (self.register.read(robot, WRITTEN), false),
            1 => (self.register.read(robot, UPDATED), false),
            2 => {
                let value = value(robot);
                (self.register.write(robot, WRITTEN, value), false)
            }
            _ => (self.register.claim(robot, UPDATED), true),
        };
        self.note(now, id.ok(), is_claim);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.register.corrupt(random);
        self.next = Time::ZERO;
    }
}
