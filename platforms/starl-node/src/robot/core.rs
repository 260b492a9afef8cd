//! The robot without clock, threads, sockets and files.

use super::equipment::Equipment;
use super::mailbox::Incoming;
use super::watch::Watched;
use crate::Reading;
use crate::discovery::Discovery;
use crate::link::quality::Quality;
use crate::link::{Channel, Member};
use crate::localise::Localiser;
use crate::motors::Report;
use crate::outlet::RuntimeOutlet;
use crate::recorder::Recorder;
use crate::safety::Hazard;
use crate::setup::Setup;
use crate::surroundings::Surroundings;
use crate::writer::Written;
use starl_core::sensor::Contact;
use starl_core::{Agent, Duration, Event, Obstacle, Point, RobotId, Sensors, Time};
use starl_host::{Clock, Datagram, Node, NodeInput, Snapshot, Workspace};
use std::mem;

/// How often a robot tells the others where it is.
pub(super) const BEACON_PERIOD: Duration = Duration::from_millis(100);

/// How often the robot's true pose is recorded.
const POSE_PERIOD: Duration = Duration::from_millis(100);

/// A pose this far from the recorded one is recorded at once, metres: the program acts on it now, and properties are
/// judged by the records.
const JUMP: f64 = 0.05;

/// The greatest number of timers that fire at once, so that packets do not wait long.
const MOST_TIMERS: usize = 16;

/// A robot that receives inputs, and acts through its [`Equipment`].
pub struct Core<R: Recorder, E: Equipment> {
    pub(super) setup: Setup,
    pub(super) fleet: Vec<RobotId>,
    pub(super) node: Node,
    pub(super) localiser: Localiser,
    pub(super) surroundings: Surroundings,
    discovery: Discovery,
    pub(super) equipment: E,
    pub(super) channel: Channel,
    pub(super) peers: Vec<Peer>,
    /// Datagrams that the robot has sent to itself.
    pub(super) to_self: Vec<Datagram>,
    pub(super) recorder: Watched<R>,
    workspace: Workspace,
    contact: Option<Contact>,
    pub(super) battery: Option<f64>,
    pub(super) hazard: Option<Hazard>,
    pub(super) begun: Time,
    pub(super) now: Time,
    next_location: Time,
    next_beacon: Time,
    next_pose: Time,
    /// The position that was recorded last.
    recorded: Point,
    /// When distant robots hear the next beacons, and which of them, in turns.
    pub(super) next_far: Time,
    pub(super) turn: u32,
    /// Where it stands or was last seen to move, and since when.
    pub(super) stand: (Point, Time),
    pub(super) link_heard: Time,
    pub(super) failure: Option<String>,
    /// The latest orders of operators, by operator and its number for the order; the last one first.
    pub(super) orders: Vec<(Member, u32)>,
    /// Until when the robot, stopped by an operator, still answers.
    pub(super) leaving: Option<Time>,
    is_over: bool,
}

/// The state known of another robot.
#[derive(Clone, Debug, Default)]
pub(super) struct Peer {
    pub quality: Quality,
    /// When it sent its latest beacon, by its clock, and when that arrived.
    pub latest: Option<(Time, Time)>,
    /// Where it was by that beacon.
    pub place: Option<Point>,
    /// The number of the latest beacon to it.
    pub beacons: u32,
}

impl<R: Recorder, E: Equipment> Core<R, E> {
    /// A robot that starts at `now`, without sessions in `channel`.
    pub fn new(now: Time, setup: Setup, channel: Channel, equipment: E, recorder: R) -> Core<R, E> {
        let fleet: Vec<RobotId> = (0..setup.bodies.len() as u32).map(RobotId).collect();
        let mut channel = channel;
        for peer in fleet.iter().filter(|peer| **peer != setup.id) {
            channel.want(peer.0);
        }
        let agent = Agent::new(setup.program.clone(), setup.random.clone());
        let agent = agent.with_saved(equipment.saved());
        let node = Node::new(setup.id, Clock::default(), agent, now)
            // Numbers continue from those of earlier lives.
            .with_sequence((now.0 / 1_000_000) as u32);
        let has_fixes = equipment.has_fixes();
        let surroundings = Surroundings::new(&setup);
        Core {
            peers: vec![Peer::default(); fleet.len()],
            fleet,
            node,
            localiser: Localiser::new(setup.accuracy, setup.start, has_fixes, now),
            discovery: Discovery::new(&setup, &surroundings),
            surroundings,
            equipment,
            channel,
            to_self: Vec::new(),
            recorder: Watched::new(recorder, now),
            workspace: Workspace::default(),
            contact: None,
            battery: None,
            hazard: None,
            begun: now,
            now,
            next_location: now,
            next_beacon: now,
            next_pose: now,
            recorded: Point::ZERO,
            next_far: now,
            turn: 0,
            stand: (Point::ZERO, now),
            link_heard: now,
            failure: None,
            orders: Vec::new(),
            leaving: None,
            is_over: false,
            setup,
        }
    }

    /// Whether the robot has ended.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// The time of the next call of [`Core::step`] if there is no input before.
    pub fn next_due(&self) -> Time {
        if let Some(end) = self.leaving {
            return end;
        }
        if !self.to_self.is_empty() {
            return self.now;
        }
        let node = match self.is_located() {
            true => self.node.next_timeout(),
            false => Time::NEVER,
        };
        node.min(self.next_location).min(self.next_beacon)
    }

    /// Handles the inputs until `now` and everything that is due, in the order that [`Node::handle`] requires.
    /// `incoming` is empty afterwards.
    pub fn step(&mut self, now: Time, incoming: &mut Vec<Incoming>) {
        // Time never goes back, so that records are in order.
        self.now = self.now.max(now);
        if let Some(stays) = self.surroundings.expire(self.now) {
            self.discovery.forget(&self.surroundings, &stays);
        }
        self.take_all(incoming, |incoming| matches!(incoming, Incoming::Device(_)));
        if self.is_located() && !self.node.condition().started && self.leaving.is_none() {
            self.locate();
            self.handle(NodeInput::Start);
        }
        self.take_all(incoming, |incoming| {
            matches!(incoming, Incoming::Planned(..))
        });
        if self.next_location <= self.now && self.leaving.is_none() {
            self.next_location = self.now + self.setup.positioning_period;
            self.locate();
        }
        self.take_all(incoming, |incoming| {
            matches!(incoming, Incoming::Written(_))
        });
        for Datagram {
            sequence, message, ..
        } in mem::take(&mut self.to_self)
        {
            self.handle(NodeInput::Datagram { sequence, message });
        }
        self.take_all(incoming, |_| true);
        match self.leaving {
            Some(end) => {
                self.equipment.stop();
                self.is_over |= self.now >= end;
            }
            None => self.do_what_is_due(),
        }
    }

    /// Stops the motors permanently; gives the recorder back.
    pub fn end(mut self, now: Time) -> R {
        self.equipment.end();
        self.now = self.now.max(now);
        self.tell_operators_the_rest();
        self.recorder.advance(self.now);
        self.recorder.recorder
    }

    /// Whether the robot has ever known where it is: its software starts then.
    fn is_located(&self) -> bool {
        self.node.condition().started || self.localiser.estimate().is_some()
    }

    fn take_all(&mut self, incoming: &mut Vec<Incoming>, is_due: fn(&Incoming) -> bool) {
        for incoming in incoming.extract_if(.., |incoming| is_due(incoming)) {
            self.take(incoming);
        }
    }

    fn take(&mut self, incoming: Incoming) {
        match incoming {
            Incoming::Packet(arrival) => self.receive(&arrival),
            Incoming::Halt => self.is_over = true,
            // The software of a robot that was stopped takes part in nothing any more.
            _ if self.leaving.is_some() => {}
            Incoming::Device(report) => self.learn(report),
            Incoming::Planned(job, path) => self.handle(NodeInput::Planned { job, path }),
            Incoming::Written(Written::Done(job)) => self.handle(NodeInput::Stored { job }),
            Incoming::Written(Written::Failed(why)) => {
                let text = format!("storage cannot be written, and is tried again: {why}");
                self.recorder.notice(self.now, &text);
            }
        }
    }

    fn do_what_is_due(&mut self) {
        for _ in 0..MOST_TIMERS {
            if !self.is_located() || self.node.next_timeout() > self.now {
                break;
            }
            self.handle(NodeInput::Timeout);
        }
        if self.next_beacon <= self.now {
            let late = self.now.since(self.next_beacon);
            self.next_beacon = self.now + BEACON_PERIOD;
            self.send_beacons(late);
            self.recorder.advance(self.now);
        }
        self.tell_operators();
        self.steer();
    }

    /// Gives the node the latest position, if there is one that is not stale.
    fn locate(&mut self) {
        let Some((estimate, measured)) = self.localiser.estimate() else {
            return;
        };
        let is_started = self.node.condition().started;
        // A stale position is not told again: its age shows in the estimate that the software has.
        if is_started && self.now.since(measured) > self.setup.safety.localisation {
            return;
        }
        self.call(|node, now, _, outlet| node.locate(now, estimate, outlet));
        let position = estimate.pose.position;
        if self.next_pose <= self.now || position.distance(self.recorded) > JUMP {
            self.next_pose = self.now + POSE_PERIOD;
            self.recorded = position;
            self.recorder.record(self.now, Event::Moved(estimate.pose));
        }
        let found = self.discovery.look(&self.surroundings, position);
        self.discover(found);
        if is_started {
            self.handle(NodeInput::Located);
        }
    }

    /// Lets the motors do what the node wants, unless something forbids that.
    fn steer(&mut self) {
        let position = self.localiser.estimate().map(|(_, measured)| measured);
        let hazard = self.setup.safety.check(
            self.now,
            position,
            self.link_heard,
            self.failure.as_deref(),
            self.fleet.len() > 1,
        );
        if hazard != self.hazard {
            let text = match &hazard {
                Some(hazard) => format!("motors stopped: {hazard}"),
                None => "motors released".to_string(),
            };
            self.recorder.notice(self.now, &text);
            self.hazard.clone_from(&hazard);
        }
        if self.hazard.is_none() && self.node.condition().started {
            self.equipment
                .drive(self.node.command(), self.node.estimate());
        } else {
            self.equipment.stop();
        }
    }

    fn learn(&mut self, report: Report) {
        match report {
            Report::Measured(at, reading) => {
                self.feel(&reading);
                self.localiser.measure(at, &reading);
            }
            Report::Seen(at, pose) => self.localiser.fix(at, pose),
            Report::SawOther(robot, at, pose) => self.surroundings.see(robot, at, pose),
            Report::Trouble(Some(what)) => self
                .recorder
                .notice(self.now, &format!("the device does not work: {what}")),
            Report::Trouble(None) => self.recorder.notice(self.now, "the device works again"),
        }
    }

    fn feel(&mut self, reading: &Reading) {
        if let Some(contact) = reading.bumper.filter(|_| self.setup.sensors.bumper) {
            self.contact = contact;
            if let (Some(contact), Some((estimate, _))) = (contact, self.localiser.estimate()) {
                let (around, pose) = (&self.surroundings, &estimate.pose);
                let found = self.discovery.touch(around, self.now, pose, contact);
                self.discover(found);
            }
        }
        self.battery = reading.battery.or(self.battery);
    }

    fn discover(&mut self, found: Vec<Obstacle>) {
        for obstacle in found {
            self.recorder.record(self.now, Event::Discovered(obstacle));
        }
    }

    pub(super) fn handle(&mut self, happening: NodeInput) {
        self.call(|node, now, snapshot, outlet| node.handle(now, happening, snapshot, outlet));
    }

    /// Calls the node, and carries out what it asks for.
    fn call(&mut self, call: impl FnOnce(&mut Node, Time, &Snapshot<'_>, &mut RuntimeOutlet<'_>)) {
        let here = self.node.estimate().pose;
        self.surroundings.sense(self.now, &here);
        let readings = self.surroundings.readings();
        let snapshot = Snapshot {
            hardware: &self.setup.hardware,
            sensors: Sensors {
                bumper: self.contact,
                proximity: &readings.proximity,
                detections: &readings.detections,
                holding: None,
                thing_names: &self.surroundings.thing_names,
            },
            fleet: &self.fleet,
            way_points: &self.setup.way_points,
            obstacles: self.discovery.known(),
        };
        let mut outlet = RuntimeOutlet {
            workspace: &mut self.workspace,
            recorder: &mut self.recorder,
            surroundings: &self.surroundings,
            here: here.position,
            now: self.now,
            datagrams: Vec::new(),
            plans: Vec::new(),
            writes: Vec::new(),
            failure: None,
        };
        call(&mut self.node, self.now, &snapshot, &mut outlet);
        let RuntimeOutlet {
            datagrams,
            plans,
            writes,
            failure,
            ..
        } = outlet;
        self.failure = failure.or(self.failure.take());
        // A robot that is killed must not have sent what its trace does not show.
        if !datagrams.is_empty() {
            self.recorder.commit();
        }
        for datagram in datagrams {
            self.transmit(datagram);
        }
        for (job, neighbours) in plans {
            self.equipment.find(job, neighbours);
        }
        for job in writes {
            self.equipment.write(job);
        }
    }
}
