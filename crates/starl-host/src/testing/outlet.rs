//! The environment of a node of the test host while it handles an input.

use super::unit::Travel;
use super::wire::{Mail, Wire};
use crate::{Datagram, Outlet, PlanJob, Store, StoreJob, Workspace};
use alloc::vec::Vec;
use starl_core::{Duration, Event, MotionRequest, Random, RobotId, Time};
use starl_motion::Neighbour;

pub(super) struct FleetOutlet<'a> {
    pub robot: RobotId,
    pub fleet: &'a [RobotId],
    pub wire: &'a Wire,
    pub mail: &'a mut Mail,
    pub random: &'a mut Random,
    pub travel: &'a mut Travel,
    pub holding: &'a mut Option<u32>,
    pub store: &'a mut Option<Store>,
    /// How long a write takes.
    pub write_time: Duration,
    /// The paths that it wants.
    pub plans: Vec<PlanJob>,
    pub records: &'a mut Vec<(Time, RobotId, Event)>,
    pub workspace: &'a mut Workspace,
}

impl Outlet for FleetOutlet<'_> {
    fn workspace(&mut self) -> &mut Workspace {
        self.workspace
    }

    fn record(&mut self, at: Time, event: Event) {
        self.records.push((at, self.robot, event));
    }

    fn transmit(&mut self, at: Time, datagram: Datagram) {
        let lost = self
            .mail
            .post(at, &datagram, self.wire, self.fleet, self.random);
        for (to, reason) in lost {
            let event = Event::Dropped {
                from: self.robot,
                to: Some(to),
                sequence: datagram.sequence,
                reason,
            };
            self.record(at, event);
        }
    }

    fn store(&mut self, at: Time, job: StoreJob) {
        if let Some(store) = &mut self.store {
            store.begin(at, job, self.write_time);
        }
    }

    fn take(&mut self, _: Time, thing: u32) {
        *self.holding = self.holding.or(Some(thing));
    }

    fn put_down(&mut self, _: Time) {
        *self.holding = None;
    }

    fn plan(&mut self, _: Time, job: PlanJob) {
        self.plans.push(job);
    }

    fn neighbours(&mut self, _: f64, _: &mut Vec<Neighbour>) {}

    fn request_motion(&mut self, at: Time, request: &MotionRequest) {
        self.travel.request(at, request);
    }
}
