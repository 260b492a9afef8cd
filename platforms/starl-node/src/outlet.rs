//! The runtime's side of a robot's node while it handles an input: its requests are collected, and executed afterwards.

use crate::recorder::Recorder;
use crate::surroundings::Surroundings;
use starl_core::{Event, Point, Time};
use starl_host::{Datagram, Observed, Outlet, PlanJob, StoreJob, Workspace};
use starl_motion::Neighbour;

pub(crate) struct RuntimeOutlet<'a> {
    pub workspace: &'a mut Workspace,
    pub recorder: &'a mut dyn Recorder,
    pub surroundings: &'a Surroundings,
    pub here: Point,
    pub now: Time,
    /// To be sent.
    pub datagrams: Vec<Datagram>,
    /// Paths to be found.
    pub plans: Vec<(PlanJob, Vec<Neighbour>)>,
    /// To be stored.
    pub writes: Vec<StoreJob>,
    /// Why the program cannot continue.
    pub failure: Option<String>,
}

impl RuntimeOutlet<'_> {
    /// Where the other robots are by now.
    fn near(&self, reach: f64) -> impl Iterator<Item = Neighbour> {
        let others = self.surroundings.others(self.now);
        others.filter(move |other| other.position.planar_distance(self.here) <= reach)
    }
}

impl Outlet for RuntimeOutlet<'_> {
    fn workspace(&mut self) -> &mut Workspace {
        self.workspace
    }

    fn record(&mut self, at: Time, event: Event) {
        if let Event::Failed(why) = &event {
            self.failure = Some(why.to_string());
        }
        self.recorder.record(at, event);
    }

    fn transmit(&mut self, _: Time, datagram: Datagram) {
        self.datagrams.push(datagram);
    }

    fn plan(&mut self, _: Time, job: PlanJob) {
        let neighbours = self.near(job.sight()).collect();
        self.plans.push((job, neighbours));
    }

    fn neighbours(&mut self, reach: f64, near: &mut Vec<Neighbour>) {
        near.extend(self.near(reach));
    }

    fn store(&mut self, _: Time, job: StoreJob) {
        self.writes.push(job);
    }

    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        self.recorder.observe(at, observed);
    }
}
