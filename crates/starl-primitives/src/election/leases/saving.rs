//! A voter's stored state, on robots with storage: the promised epoch, and the latest known one.
//!
//! A robot that finds its promise on storage votes and is a candidate at once, and so is one that finds nothing on
//! storage that was never erased. All others wait and ask: see `recovery.rs`. The end of the promise is not stored,
//! because a restart may set a clock back: it binds for a whole lease from the restart.

use super::recovery::Stage;
use super::{Leases, Promise};
use crate::election::epoch::Epoch;
use crate::election::rules::Scene;
use starl_core::event::ElectionEvent;
use starl_core::{Port, Robot};

/// Under which the epochs are saved.
const EPOCHS: &str = "epochs";

impl Leases {
    pub(super) fn take_up(&mut self, scene: &mut Scene<'_, '_>) {
        let Some(saved) = scene.robot.saved().filter(|_| scene.takes_part) else {
            return;
        };
        let now = scene.now();
        match saved.get::<(Epoch, Epoch)>(scene.port, EPOCHS) {
            Some((promised, known)) => {
                self.known = known;
                self.promise = Promise {
                    epoch: promised,
                    until: now + scene.options.lease,
                    number: 0,
                };
            }
            None if saved.is_whole() => {}
            None => return,
        }
        self.stage = Stage::Remembering(None);
        self.up_since = now;
        let vote = ElectionEvent::Vote { anew: false };
        scene.robot.report(scene.port, vote);
        self.postpone(scene);
    }

    pub(super) fn save_epochs(&mut self, robot: &mut Robot<'_>, port: Port) {
        let epochs = (self.promise.epoch, self.known);
        if self.remembers() && self.saved != epochs {
            self.saved = epochs;
            robot.save(port, EPOCHS, &epochs);
        }
    }
}
