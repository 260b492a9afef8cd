//! Judges the properties of a program on the true state of the fleet.
//!
//! A [`Judge`] is shown the fleet whenever its state changes, and returns the violations. It does not depend on a
//! simulator: a [`Fleet`] is any source of the robots' variables and poses.
//!
//! Meaning, with the moments at which the judge is shown the fleet for time:
//! - `always p` holds if p is true at every moment;
//! - `eventually p within d` if p is true at some moment no later than d after the start;
//! - `eventually always p within d` if p is true at every moment later than d after the start;
//! - `always p leads_to q within d` if for each moment at which p is true there is one, the same or a
//!   later one but by no more than d, at which q is true.
//!
//! Faults are excused unless the property says otherwise. Deadlines count from the last fault. Robots that are down are
//! not judged; a robot whose target is blocked by a wreck does not have to reach it. Variables are not judged for a
//! time after a fault has overwritten some ([`RECOVERY`]). A property is not judged while its assumption does not hold.
//!
//! Without `within` there is no deadline, so that a condition that has not become true stays open. A property of each
//! robot, each pair of robots and so on is judged for each such tuple separately, tuples with a repeated robot
//! included, and is reported once for each tuple that violates it. A robot is judged from the moment its program has
//! started.

mod condition;
mod evaluation;
mod excuse;
mod fleet;
mod history;
mod host;
mod judge;
mod observables;
mod reads;
mod shared;
mod violation;

pub use condition::Condition;
pub use excuse::{Excuse, RECOVERY};
pub use fleet::Fleet;
pub use judge::{Judge, Standing};
pub(super) use observables::OBSERVABLES;
pub use violation::{Reason, Violation};
