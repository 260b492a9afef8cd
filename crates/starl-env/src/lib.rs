//! Environments for learning: many small worlds of robots that step together.
//!
//! Robots move by the models of `starl-motion`, stop where bodies touch, and measure distances as in the simulator,
//! with the same code. There are no programs, no radio protocol and no noise: an external policy controls each robot.
//!
//! Invariant: an environment depends on its seed and its actions alone, not on the number of environments or threads.

mod batch;
mod judge;
mod post;
mod scatter;
mod settings;
mod world;

pub use batch::{Batch, Outputs, Verdicts};
pub use judge::{Column, Constant, Judge, JudgeError, Kind, Wording, WordingError};

pub use scatter::{NoRoom, Region};
pub use settings::{Actions, Lidar, Radio, Settings, SettingsError};
pub use world::NotFinite;
