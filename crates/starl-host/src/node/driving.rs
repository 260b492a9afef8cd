//! How the node moves its robot: plans, the pilot, and commands of the model.

use super::Node;
use crate::{Outlet, PlanJob, Snapshot};
use alloc::boxed::Box;
use alloc::format;
use core::mem;
use starl_core::event::Level;
use starl_core::{Command, Event, MotionRequest, Random, Time};
use starl_motion::Pilot;

impl Node {
    pub(super) fn request_motion(
        &mut self,
        at: Time,
        request: MotionRequest,
        snapshot: &Snapshot<'_>,
        outlet: &mut impl Outlet,
    ) {
        if let MotionRequest::Plan(request) = request {
            let job = self.next_job;
            self.next_job = job.wrapping_add(1);
            self.plans.push((job, request.ticket));
            let estimate = self.estimate;
            return outlet.plan(
                at,
                PlanJob {
                    job,
                    request,
                    estimate,
                },
            );
        }
        let Some(drive) = &snapshot.hardware.drive else {
            return outlet.request_motion(at, &request);
        };
        match &request {
            MotionRequest::Drive(command) if !drive.model.accepts(command) => {
                // Whatever the robot did before, its program wants something else now.
                self.pilot = None;
                self.command = Command::Stop;
                let text = format!("a {} does not take {command:?}", drive.model.name());
                let level = Level::Warning;
                let text = text.into();
                outlet.record(at, Event::Log { level, text });
            }
            MotionRequest::Drive(command) => {
                self.pilot = None;
                self.command = *command;
            }
            request => {
                let pilot = self.pilot.get_or_insert_with(|| {
                    Box::new(Pilot::new(&*drive.model, drive.avoidance.clone()))
                });
                pilot.request(request);
                self.steer(at, snapshot, outlet);
            }
        }
    }

    pub(super) fn is_overpowered(&self, snapshot: &Snapshot<'_>) -> bool {
        match (&self.pilot, &snapshot.hardware.drive) {
            (Some(pilot), Some(drive)) => pilot.is_overpowered(&*drive.model),
            _ => false,
        }
    }

    /// Lets the pilot choose the command that follows from the present estimate.
    pub(super) fn steer(&mut self, at: Time, snapshot: &Snapshot<'_>, outlet: &mut impl Outlet) {
        let (Some(pilot), Some(drive)) = (&mut self.pilot, &snapshot.hardware.drive) else {
            return;
        };
        let mut neighbours = mem::take(&mut outlet.workspace().neighbours);
        neighbours.clear();
        if let Some(reach) = pilot.wants_neighbours() {
            outlet.neighbours(reach, &mut neighbours);
        }
        let mut random = Random::keyed(drive.seed, &[u64::from(self.id.0), at.0]);
        self.command = pilot.command(
            &*drive.model,
            &self.estimate,
            &neighbours,
            snapshot.obstacles,
            &mut random,
        );
        outlet.workspace().neighbours = neighbours;
    }
}
