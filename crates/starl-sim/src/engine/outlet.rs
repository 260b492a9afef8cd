//! The simulator's side of a robot's node: the network's entrance, the planner, and the record.

use super::record::Log;
use super::shared::{Kind, Shared};
use super::simulated_robot::{Account, Outgoing};
use super::things::Grip;
use starl_core::event::{DropReason, PrimitiveEvent, ReachAvoidEvent};
use starl_core::{Duration, Event, RobotId, Time};
use starl_host::journal::Journal;
use starl_host::{Datagram, Observed, Outlet, PlanJob, StoreJob, Workspace};
use starl_motion::{Neighbour, State};

/// Bytes that travel with a payload: addresses, port, sequence number and checksum, as in UDP over
/// IP version 4 over Wi-Fi, rounded.
const HEADER_BYTES: usize = 64;

/// The environment of one robot's node in its turn.
pub struct SimulatorOutlet<'a> {
    pub robot: RobotId,
    pub shared: &'a Shared,
    pub kind: &'a Kind,
    pub state: &'a State,
    pub account: &'a mut Account,
    pub outbox: &'a mut Vec<Outgoing>,
    pub grips: &'a mut Vec<Grip>,
    pub log: &'a mut Log,
    pub journal: &'a mut Option<Box<Journal>>,
    pub workspace: &'a mut Workspace,
}

impl Outlet for SimulatorOutlet<'_> {
    fn workspace(&mut self) -> &mut Workspace {
        self.workspace
    }

    #[inline(always)]
    fn record(&mut self, at: Time, event: Event) {
        if let Event::Primitive {
            event: PrimitiveEvent::ReachAvoid(event),
            ..
        } = &event
        {
            match event {
                ReachAvoidEvent::Done { .. } => self.account.way_points += 1,
                ReachAvoidEvent::GiveUp { .. } => self.account.gave_up += 1,
                _ => {}
            }
        }
        self.log
            .record(&mut self.account.digest, self.robot, at, event);
    }

    fn transmit(&mut self, at: Time, datagram: Datagram) {
        self.account.sent += 1;
        match self.leaves(at, datagram.message.payload.len()) {
            Ok(at) => self.outbox.push(Outgoing { at, datagram }),
            Err(reason) => self.record(
                at,
                Event::Dropped {
                    from: self.robot,
                    to: None,
                    sequence: datagram.sequence,
                    reason,
                },
            ),
        }
    }

    fn store(&mut self, at: Time, job: StoreJob) {
        if let Some(store) = &mut self.account.store {
            store.begin(at, job, self.shared.scenario.storage.write_time);
        }
    }

    fn take(&mut self, at: Time, thing: u32) {
        let (robot, thing) = (self.robot, Some(thing));
        self.grips.push(Grip { at, robot, thing });
    }

    fn put_down(&mut self, at: Time) {
        let (robot, thing) = (self.robot, None);
        self.grips.push(Grip { at, robot, thing });
    }

    fn plan(&mut self, _: Time, job: PlanJob) {
        let mut near = std::mem::take(&mut self.workspace.neighbours);
        near.clear();
        self.neighbours(job.sight(), &mut near);
        let path = job.run(&self.kind.hardware, &near);
        self.workspace.neighbours = near;
        self.account.plans.push((job.job, path));
    }

    fn neighbours(&mut self, reach: f64, near: &mut Vec<Neighbour>) {
        if reach <= 0.0 {
            return;
        }
        let shared = self.shared;
        let shown = if shared.perceived.is_empty() {
            &shared.bodies
        } else {
            &shared.perceived
        };
        shared
            .grid
            .for_each_within(self.state.pose.position, reach, |entry| {
                if entry.robot != self.robot.0 {
                    near.push(shown[entry.robot as usize]);
                }
            });
    }

    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        if let Some(journal) = self.journal {
            journal.observe(self.robot, at, observed);
        }
    }
}

impl SimulatorOutlet<'_> {
    /// When a datagram with this payload leaves the radio, or why it never does.
    fn leaves(&mut self, at: Time, bytes: usize) -> Result<Time, DropReason> {
        let network = &self.shared.network;
        if bytes > network.largest as usize {
            return Err(DropReason::Size);
        }
        let Some(bandwidth) = network.bandwidth else {
            return Ok(at);
        };
        let begins = self.account.radio_free.max(at);
        if begins.since(at) > network.queue {
            return Err(DropReason::Bandwidth);
        }
        let bits = ((bytes + HEADER_BYTES) * 8) as f64;
        self.account.radio_free = begins + Duration::from_seconds_f64(bits / bandwidth);
        Ok(self.account.radio_free)
    }
}
