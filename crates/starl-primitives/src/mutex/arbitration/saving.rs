//! An arbiter's stored state over a restart, on robots with storage: its grants, the ended requests, and its
//! numbers.
//!
//! An arbiter that finds its grants on storage continues at once, and so does one that finds nothing on storage that
//! was never erased. All others ask for their earlier grants: see [`super::recovery`]. A lease that was granted before
//! the restart counts from the restart, which can only make it longer.
//!
//! Waiting requests are not stored: they are repeated.

use super::super::common::{Common, RequestId};
use super::super::lease::Numbers;
use super::Arbitration;
use super::packet::Wish;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Digest, Robot, RobotId, message};

/// Under which it is saved.
const GRANTS: &str = "grants";

/// The stored state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Kept {
    /// A hash of the participants.
    pub list: u32,
    /// The grants: robot, request and number.
    pub grants: Vec<(RobotId, Wish, u64)>,
    /// The last request of each robot that is over.
    pub finished: Vec<(RobotId, RequestId)>,
    pub numbers: Numbers,
}

impl Arbitration {
    /// Restores the stored state when the robot starts; returns whether it is complete.
    pub(super) fn restore(&mut self, common: &Common, robot: &mut Robot<'_>) -> bool {
        let Some(saved) = robot.saved() else {
            return false;
        };
        match saved.get::<Kept>(common.port, GRANTS) {
            Some(kept) if kept.list == self.list => {
                let terms = self.terms(common, robot);
                self.arbiter.restore(kept, terms);
            }
            // Other participants may have been granted something else.
            Some(_) => return false,
            None if saved.is_whole() => {}
            None => return false,
        }
        self.begin_to_grant(common, robot, false);
        true
    }

    /// Saves changes.
    pub fn save(&mut self, common: &Common, robot: &mut Robot<'_>) {
        if !self.recovery.is_ready || self.everyone.binary_search(&robot.id()).is_err() {
            return;
        }
        let kept = message::encode(&self.arbiter.kept(self.list));
        let mut digest = Digest::default();
        digest.bytes(&kept);
        let value = digest.value();
        if self.saved != Some(value) {
            self.saved = Some(value);
            robot.save_bytes(common.port, GRANTS, kept);
        }
    }
}
