//! The robots that had just started when a fleet began, with their lives: a register or an arbiter that begins first
//! tells them. As long as they do not restart they have promised nothing, and need not learn anything.

use alloc::collections::BTreeMap;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// The founders; none where that is not known.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Founders(BTreeMap<RobotId, u32>);

impl Founders {
    /// These robots in these lives.
    pub fn new(robots: BTreeMap<RobotId, u32>) -> Founders {
        Founders(robots)
    }

    /// All founders, for a robot that is one of them in this life.
    pub fn with(&self, robot: RobotId, life: u32) -> Founders {
        match self.0.get(&robot) == Some(&life) {
            true => self.clone(),
            false => Founders::default(),
        }
    }

    /// Whether none are known.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
