//! The fleet of the test host, and its virtual time.

use super::outlet::FleetOutlet;
use super::unit::Unit;
use super::wire::{Mail, Wire};
use crate::{Node, NodeInput, PlanJob, Snapshot, Store, Workspace};
use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec;
use alloc::vec::Vec;
use starl_core::event::{Fault, Name};
use starl_core::motion::{Obstacles, Path};
use starl_core::{Agent, Duration, Event, Input, Point, Random, RobotId, Sensors, Time, WayPoint};

/// Robots in virtual time. A clone continues exactly as the original would.
#[derive(Clone)]
pub struct Fleet {
    /// The current time.
    pub now: Time,
    /// The network.
    pub wire: Wire,
    /// The robots, by number.
    pub robots: Vec<Unit>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The names of the things, by number.
    pub thing_names: Vec<Name>,
    /// The obstacles that all robots know.
    pub obstacles: Obstacles,
    /// All records: time, robot and event.
    pub records: Vec<(Time, RobotId, Event)>,
    /// How often robots hear where they are, from their start on; when they arrive, where none is given.
    pub positioning: Option<Duration>,
    /// How long it takes to find a path, which is the straight line. At 0 a robot has it before anything
    /// else happens.
    pub planning: Duration,
    /// How long a write to storage takes.
    pub write_time: Duration,
    /// Decides what the network does.
    pub random: Random,
    fleet: Vec<RobotId>,
    mail: Mail,
    plans: BTreeMap<(Time, usize, u32), Path>,
    workspace: Workspace,
}

/// The next event. Of events at the same moment, the lesser happens first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Due {
    Start(usize),
    Plan,
    Location(usize),
    Stored(usize),
    Datagram,
    Timeout(usize),
}

impl Fleet {
    /// A fleet without robots.
    pub fn new(seed: u64, wire: Wire) -> Fleet {
        Fleet {
            now: Time::ZERO,
            wire,
            robots: Vec::new(),
            way_points: Vec::new(),
            thing_names: Vec::new(),
            obstacles: [].into(),
            records: Vec::new(),
            positioning: None,
            planning: Duration::ZERO,
            write_time: Duration::ZERO,
            random: Random::keyed(seed, &[0]),
            fleet: Vec::new(),
            mail: Mail::default(),
            plans: BTreeMap::new(),
            workspace: Workspace::default(),
        }
    }

    /// Adds a robot to the fleet; its number is its index. It starts when time advances, or by [`Fleet::start`].
    pub fn add(&mut self, unit: Unit) -> usize {
        let robot = self.robots.len();
        assert_eq!(unit.node.id().index(), robot, "robots join in order");
        self.fleet.push(unit.node.id());
        self.robots.push(unit);
        robot
    }

    /// Starts a robot now.
    pub fn start(&mut self, robot: usize) {
        self.robots[robot].next_location = self.now;
        self.locate(robot);
        self.handle(robot, NodeInput::Start);
    }

    /// A robot crashes and stops where it is.
    pub fn crash(&mut self, robot: usize) {
        self.record(robot, Event::Fault(Fault::Crash));
        let here = self.position(robot);
        self.robots[robot].node.crash();
        if let Some(store) = &mut self.robots[robot].store {
            store.crash(false);
        }
        self.robots[robot].travel.place(self.now, here);
    }

    /// A robot starts again now, with fresh software and with what its storage holds.
    pub fn restart(&mut self, robot: usize, agent: Agent) {
        self.record(robot, Event::Fault(Fault::Restart));
        let saved = self.robots[robot].store.as_ref().map(Store::saved);
        let agent = agent.with_saved(saved);
        self.robots[robot].node.restart(self.now, agent);
        self.start(robot);
    }

    /// Overwrites the state of a robot's program.
    pub fn corrupt(&mut self, robot: usize, random: &mut Random) {
        self.record(robot, Event::Fault(Fault::CorruptState));
        self.call(robot, |node, now, _, outlet| {
            node.corrupt(now, random, outlet)
        });
    }

    /// Moves a robot to a position, and sends it the estimate.
    pub fn place(&mut self, robot: usize, position: Point) {
        self.robots[robot].travel.place(self.now, position);
        self.locate(robot);
        self.handle(robot, NodeInput::Located);
    }

    /// Where a robot is.
    pub fn position(&self, robot: usize) -> Point {
        self.robots[robot].travel.position(self.now)
    }

    /// Hands an input to a robot now.
    pub fn input(&mut self, robot: usize, input: &Input) {
        self.handle(robot, NodeInput::Input(input.clone()));
    }

    /// Lets something happen to a robot now.
    pub fn handle(&mut self, robot: usize, happening: NodeInput) {
        if self.positioning.is_none() && self.robots[robot].travel.is_under_way() {
            self.locate(robot);
        }
        let mut happenings = VecDeque::from([happening]);
        while let Some(happening) = happenings.pop_front() {
            let jobs = self.call(robot, |node, now, snapshot, outlet| {
                node.handle(now, happening, snapshot, outlet);
            });
            for PlanJob { job, request, .. } in jobs {
                let path = vec![request.target];
                if self.planning.is_zero() {
                    let path = Some(path);
                    happenings.push_back(NodeInput::Planned { job, path });
                } else {
                    let key = (self.now + self.planning, robot, job);
                    self.plans.insert(key, path);
                }
            }
        }
    }

    /// Advances time by this span, including the events at its end.
    pub fn run_for(&mut self, span: Duration) {
        let end = self.now + span;
        self.advance(end + Duration(1));
        self.now = end;
    }

    /// Advances time to `end`, excluding the events at `end`.
    pub fn run_before(&mut self, end: Time) {
        self.advance(end);
        self.now = self.now.max(end);
    }

    /// When something happens next; [`Time::NEVER`] if nothing does.
    pub fn next_moment(&self) -> Time {
        self.next().0
    }

    /// Suspends the host for a while: inputs due then are late.
    pub fn stall(&mut self, span: Duration) {
        self.now += span;
    }

    fn advance(&mut self, end: Time) {
        loop {
            let (at, due) = self.next();
            if at >= end {
                return;
            }
            self.now = self.now.max(at);
            self.happen(due);
        }
    }

    /// The next event, and its time.
    fn next(&self) -> (Time, Due) {
        let plan = self.plans.first_key_value();
        let plan = plan.map_or(Time::NEVER, |((at, ..), _)| *at);
        let mut next = (plan, Due::Plan).min((self.mail.next(), Due::Datagram));
        for (robot, unit) in self.robots.iter().enumerate() {
            let condition = unit.node.condition();
            let call = unit.node.next_timeout();
            let call = match condition.started {
                true => (call, Due::Timeout(robot)),
                false => (call, Due::Start(robot)),
            };
            let location = match self.positioning {
                Some(_) if condition.started => unit.next_location,
                Some(_) => Time::NEVER,
                None => unit.travel.arrival(),
            };
            let stored = unit.store.as_ref().map_or(Time::NEVER, Store::due);
            next = next
                .min(call)
                .min((stored, Due::Stored(robot)))
                .min((location, Due::Location(robot)));
        }
        next
    }

    fn happen(&mut self, due: Due) {
        match due {
            Due::Start(robot) => self.start(robot),
            Due::Plan => {
                if let Some(((_, robot, job), path)) = self.plans.pop_first() {
                    let path = Some(path);
                    self.handle(robot, NodeInput::Planned { job, path });
                }
            }
            Due::Location(robot) => {
                let unit = &mut self.robots[robot];
                match self.positioning {
                    Some(period) => unit.next_location += period,
                    None => unit.travel.arrive(self.now),
                }
                self.locate(robot);
                self.handle(robot, NodeInput::Located);
            }
            Due::Stored(robot) => {
                let store = self.robots[robot].store.as_mut();
                if let Some(job) = store.and_then(Store::finish) {
                    self.handle(robot, NodeInput::Stored { job });
                }
            }
            Due::Datagram => {
                if let Some((to, datagram)) = self.mail.take() {
                    let (sequence, message) = (datagram.sequence, datagram.message);
                    self.handle(to.index(), NodeInput::Datagram { sequence, message });
                }
            }
            Due::Timeout(robot) => self.handle(robot, NodeInput::Timeout),
        }
    }

    fn record(&mut self, robot: usize, event: Event) {
        self.records.push((self.now, self.fleet[robot], event));
    }

    /// The positioning system tells a robot that is up where it is.
    fn locate(&mut self, robot: usize) {
        let unit = &self.robots[robot];
        if !unit.node.condition().down {
            let estimate = unit.estimate(self.now);
            self.call(robot, |node, now, _, outlet| {
                node.locate(now, estimate, outlet)
            });
        }
    }

    /// Calls the node of a robot; gives the paths that it wants.
    fn call(
        &mut self,
        robot: usize,
        call: impl FnOnce(&mut Node, Time, &Snapshot<'_>, &mut FleetOutlet<'_>),
    ) -> Vec<PlanJob> {
        let unit = &mut self.robots[robot];
        let snapshot = Snapshot {
            hardware: &unit.hardware,
            sensors: Sensors {
                bumper: unit.bumper,
                proximity: &unit.rays,
                detections: &unit.detections,
                holding: unit.holding,
                thing_names: &self.thing_names,
            },
            fleet: &self.fleet,
            way_points: &self.way_points,
            obstacles: &self.obstacles,
        };
        let mut outlet = FleetOutlet {
            robot: self.fleet[robot],
            fleet: &self.fleet,
            wire: &self.wire,
            mail: &mut self.mail,
            random: &mut self.random,
            travel: &mut unit.travel,
            holding: &mut unit.holding,
            store: &mut unit.store,
            write_time: self.write_time,
            plans: Vec::new(),
            records: &mut self.records,
            workspace: &mut self.workspace,
        };
        call(&mut unit.node, self.now, &snapshot, &mut outlet);
        outlet.plans
    }
}
