//! For tests of what runs on nodes, and of hosts: a small host in memory, and the suite that every host passes.
//!
//! [`Fleet`] runs robots in virtual time over a [`Wire`] that loses, delays, duplicates and cuts. It is
//! deterministic: everything follows from its seed.
//!
//! ```
//! use starl_core::{Agent, Duration, Primitives, Program, Random, Robot, RobotId};
//! use starl_host::testing::{Fleet, Unit, Wire};
//!
//! #[derive(Clone, Primitives)]
//! struct Greeter;
//!
//! impl Program for Greeter {
//!     fn activate(&mut self, robot: &mut Robot<'_>) {
//!         robot.emit("hello", []);
//!         robot.finish();
//!     }
//! }
//!
//! let mut fleet = Fleet::new(1, Wire::perfect());
//! let agent = Agent::new(Box::new(Greeter), Random::keyed(1, &[]));
//! let robot = fleet.add(Unit::new(RobotId(0), agent).with_period(Duration::from_millis(100)));
//! fleet.run_for(Duration::from_seconds(1));
//! assert_eq!(fleet.events("hello").len(), 11);
//! assert!(fleet.robots[robot].node.condition().finished);
//! ```

pub mod conformance;
mod fleet;
mod outlet;
mod reading;
mod unit;
mod wire;

pub use fleet::Fleet;
pub use reading::{Fields, Sent};
pub use unit::Unit;
pub use wire::Wire;
