//! The runtime's side of a robot's node while it handles something: what it asks for is kept, and done afterwards.

use crate::robot::{Peer, Recorder};
use starl_core::motion::Body;
use starl_core::{Duration, Event, Point, Time};
use starl_host::{Datagram, Observed, Outlet, PlanJob, StoreJob, Workspace};
use starl_motion::Neighbour;

/// A robot that says nothing for longer stands where it was heard last.
const FRESH: Duration = Duration::from_millis(500);

/// Another robot, as it told where it is.
#[derive(Clone, Copy, Debug)]
pub struct Perceived {
    /// When it was heard.
    pub at: Time,
    /// Where it was then.
    pub position: Point,
    /// How it moved then.
    pub velocity: Point,
    /// The space that it takes.
    pub body: Body,
}

pub(crate) struct Desk<'a> {
    pub workspace: &'a mut Workspace,
    pub recorder: &'a mut dyn Recorder,
    pub peers: &'a [Peer],
    pub here: Point,
    pub now: Time,
    /// To be sent.
    pub datagrams: Vec<Datagram>,
    /// Paths to be found.
    pub plans: Vec<(PlanJob, Vec<Neighbour>)>,
    /// To be stored.
    pub writes: Vec<StoreJob>,
    /// Why the program cannot go on.
    pub failure: Option<String>,
}

impl Desk<'_> {
    /// Where the other robots are by now.
    fn near(&self, reach: f64) -> impl Iterator<Item = Neighbour> {
        let perceived = self.peers.iter().filter_map(|peer| peer.perceived.as_ref());
        let neighbours = perceived.map(|perceived| {
            let age = self.now.since(perceived.at);
            let (position, velocity) = match age <= FRESH {
                true => {
                    let way = perceived.velocity * age.seconds();
                    (perceived.position + way, perceived.velocity)
                }
                false => (perceived.position, Point::ZERO),
            };
            Neighbour {
                position,
                velocity,
                radius: perceived.body.radius,
                height: perceived.body.height,
            }
        });
        neighbours.filter(move |neighbour| neighbour.position.planar_distance(self.here) <= reach)
    }
}

impl Outlet for Desk<'_> {
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
