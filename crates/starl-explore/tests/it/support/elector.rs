//! Robots that are candidates in an election.

use starl_core::{Primitives, Program, Robot};
use starl_primitives::LeaderElection;
use starl_primitives::election::Options;
use std::fmt::Write;

/// Stands from its first activation on.
#[derive(Clone, Debug, Primitives)]
pub struct Elector {
    election: LeaderElection,
    stands: bool,
}

impl Elector {
    /// Robots that elect one of all.
    pub fn new(options: Options) -> Elector {
        Elector {
            election: LeaderElection::new("election", None, options),
            stands: false,
        }
    }
}

impl Program for Elector {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if !self.stands {
            self.stands = true;
            self.election.elect(robot);
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}
