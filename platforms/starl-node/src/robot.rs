//! One robot in real time: the loop around its node.
//!
//! The loop waits for whatever comes first: a packet, a report of the device, a path, a write that is done, or the time
//! that the node asked for. All of it happens on one thread, in the order in which it comes, so that what the robot's
//! software sees can be recorded and repeated.

use crate::link::channel::{self, Opened};
use crate::link::frame::{Beacon, Frame, Status};
use crate::link::quality::Quality;
use crate::link::{Arrival, Channel, Member, OPERATORS, Transport};
use crate::localise::{Accuracy, Localiser};
use crate::motors::{Motors, PositionSource, Report};
use crate::outlet::{Desk, Perceived};
use crate::planner::Planner;
use crate::safety::{Hazard, Safety};
use crate::writer::{StorageWriter, Written};
use crate::{Device, Reading, Storage, WallClock};
use starl_core::event::DropReason;
use starl_core::motion::{Body, Obstacles, Path};
use starl_core::sensor::Contact;
use starl_core::{
    Agent, Destination, Duration, Event, Message, Pose, Program, Random, RobotId, Sensors, Time,
    WayPoint,
};
use starl_host::{Clock, Datagram, Happening, Hardware, Node, Observed, Snapshot, Workspace};
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};

/// How often a robot tells the others where it is.
const BEACON_PERIOD: Duration = Duration::from_millis(100);

/// How often the robot's true pose is recorded.
const POSE_PERIOD: Duration = Duration::from_millis(100);

/// A robot that was stopped answers for so long, since its confirmation may be lost.
const FAREWELL: Duration = Duration::from_millis(1000);

/// The longest that the loop waits.
const LONGEST_WAIT: Duration = Duration::from_millis(20);

/// What a robot is, and what it knows from the start.
pub struct Setup {
    /// Its number.
    pub id: RobotId,
    /// The bodies of all robots, by number.
    pub bodies: Vec<Body>,
    /// The software that it runs.
    pub program: Box<dyn Program>,
    /// The stream that its software draws from.
    pub random: Random,
    /// What it is made of.
    pub hardware: Hardware,
    /// Whether it has a bumper that its program may feel.
    pub has_bumper: bool,
    /// The application's way-points.
    pub way_points: Vec<WayPoint>,
    /// The obstacles that it knows.
    pub obstacles: Obstacles,
    /// How often its software is told where it is.
    pub positioning_period: Duration,
    /// How exact its odometry and its positions are.
    pub accuracy: Accuracy,
    /// Where it stands at the start, if that is known.
    pub start: Option<Pose>,
    /// When its motors are stopped.
    pub safety: Safety,
    /// The time.
    pub clock: WallClock,
}

/// What the robot is connected to.
pub struct Connections {
    /// Its motors and sensors.
    pub device: Box<dyn Device>,
    /// Who tells it where it is; none if it has odometry alone.
    pub positions: Option<Box<dyn PositionSource>>,
    /// What it keeps over a restart; none if it keeps nothing.
    pub storage: Option<Storage>,
    /// The network.
    pub transport: Box<dyn Transport>,
    /// The protection of what goes over it.
    pub channel: Channel,
}

/// What comes in from other threads.
#[derive(Debug)]
pub enum Incoming {
    /// A packet.
    Packet(Arrival),
    /// From the device's thread.
    Device(Report),
    /// A path was found, or none.
    Planned(u32, Option<Path>),
    /// From the storage's thread.
    Written(Written),
    /// The robot is to stop and to end.
    Halt,
}

/// Where other threads put what comes in.
pub type Post = Sender<Incoming>;

/// A new mailbox: one end for [`Robot::start`], one for other threads.
pub fn mailbox() -> (Post, Receiver<Incoming>) {
    mpsc::channel()
}

/// Takes down what happens.
pub trait Recorder {
    /// Something happened on this robot.
    fn record(&mut self, at: Time, event: Event);

    /// Something was done to its software.
    fn observe(&mut self, at: Time, observed: Observed<'_>);

    /// All up to now was told.
    fn advance(&mut self, now: Time);

    /// All that was told must outlast the process from now on: something is about to leave the robot that shows it.
    fn commit(&mut self) {}

    /// The person in front of the robot should know this.
    fn notice(&mut self, at: Time, text: &str);

    /// What the program is doing, in a word, if that can be said.
    fn state(&self, program: &dyn Program) -> Option<String> {
        let _ = program;
        None
    }
}

/// A running robot.
pub struct Robot<R: Recorder> {
    setup: Setup,
    fleet: Vec<RobotId>,
    node: Node,
    localiser: Localiser,
    motors: Motors,
    planner: Planner,
    writer: Option<StorageWriter>,
    transport: Box<dyn Transport>,
    channel: Channel,
    peers: Vec<Peer>,
    inbox: Receiver<Incoming>,
    /// Datagrams that the robot has sent to itself.
    to_self: Vec<Datagram>,
    recorder: R,
    workspace: Workspace,
    contact: Option<Contact>,
    battery: Option<f64>,
    hazard: Option<Hazard>,
    begun: Time,
    now: Time,
    next_location: Time,
    next_beacon: Time,
    next_pose: Time,
    beacons: u32,
    link_heard: Time,
    failure: Option<String>,
    /// Until when the robot, stopped by an operator, still answers.
    leaving: Option<Time>,
    is_over: bool,
}

/// What is known of another robot.
#[derive(Clone, Debug, Default)]
struct Peer {
    quality: Quality,
    /// When it sent its latest beacon, by its clock, and when that arrived.
    latest: Option<(Time, Time)>,
    perceived: Option<Perceived>,
}

impl<R: Recorder> Robot<R> {
    /// A robot that is about to start.
    ///
    /// # Errors
    /// If the system gives no threads.
    pub fn start(
        setup: Setup,
        connections: Connections,
        (post, inbox): (Post, Receiver<Incoming>),
        recorder: R,
    ) -> io::Result<Robot<R>> {
        let Connections {
            device,
            positions,
            storage,
            transport,
            mut channel,
        } = connections;
        let now = setup.clock.now();
        let fleet: Vec<RobotId> = (0..setup.bodies.len() as u32).map(RobotId).collect();
        for peer in fleet.iter().filter(|peer| **peer != setup.id) {
            channel.want(peer.0);
        }
        let saved = storage
            .as_ref()
            .map(|storage| Arc::new(storage.saved().clone()));
        let agent = Agent::new(setup.program.clone(), setup.random.clone()).with_saved(saved);
        let node = Node::new(setup.id, Clock::default(), agent, now)
            // Numbers go on from those of earlier lives.
            .with_sequence((now.0 / 1_000_000) as u32);
        let localiser = Localiser::new(setup.accuracy, setup.start, positions.is_some(), now);
        let (reports, plans, writes) = (post.clone(), post.clone(), post);
        let motors = Motors::start(device, positions, move |report| {
            let _ = reports.send(Incoming::Device(report));
        })?;
        let planner = Planner::start(setup.hardware.clone(), move |job, path| {
            let _ = plans.send(Incoming::Planned(job, path));
        })?;
        let writer = storage.map(|storage| {
            StorageWriter::start(storage, move |written| {
                writes.send(Incoming::Written(written)).is_ok()
            })
        });
        Ok(Robot {
            peers: vec![Peer::default(); fleet.len()],
            fleet,
            node,
            localiser,
            motors,
            planner,
            writer: writer.transpose()?,
            transport,
            channel,
            inbox,
            to_self: Vec::new(),
            recorder,
            workspace: Workspace::default(),
            contact: None,
            battery: None,
            hazard: None,
            begun: now,
            now,
            next_location: now,
            next_beacon: now,
            next_pose: now,
            beacons: 0,
            link_heard: now,
            failure: None,
            leaving: None,
            is_over: false,
            setup,
        })
    }

    /// Runs until someone stops the robot; gives the recorder back.
    pub fn run(mut self) -> R {
        while !self.is_over {
            self.turn();
            let due = self.next_due();
            let wait = self.setup.clock.until(due).min(LONGEST_WAIT.into());
            match self.inbox.recv_timeout(wait) {
                Ok(incoming) => {
                    self.take(incoming);
                    // What is there already comes before the clock is asked again, but not for ever.
                    for _ in 0..64 {
                        let Ok(incoming) = self.inbox.try_recv() else {
                            break;
                        };
                        self.take(incoming);
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => self.is_over = true,
            }
        }
        self.motors.end();
        self.tick();
        self.recorder.advance(self.now);
        self.recorder
    }

    /// Time never goes back, so that records are in order.
    fn tick(&mut self) {
        self.now = self.now.max(self.setup.clock.now());
    }

    fn next_due(&self) -> Time {
        let node = match self.is_located() && self.leaving.is_none() {
            true => self.node.next_timeout(),
            false => Time::NEVER,
        };
        node.min(self.next_location).min(self.next_beacon)
    }

    /// Whether the robot has ever known where it is: its software starts then.
    fn is_located(&self) -> bool {
        self.node.condition().started || self.localiser.estimate().is_some()
    }

    /// Does all that is due.
    fn turn(&mut self) {
        self.tick();
        if let Some(end) = self.leaving {
            self.motors.stop();
            self.is_over = self.now >= end;
            return;
        }
        for datagram in std::mem::take(&mut self.to_self) {
            let (sequence, message) = (datagram.sequence, datagram.message);
            self.handle(Happening::Datagram { sequence, message });
        }
        if self.next_location <= self.now {
            self.next_location = self.now + self.setup.positioning_period;
            self.locate();
        }
        if self.is_located() && !self.node.condition().started {
            self.handle(Happening::Start);
        }
        for _ in 0..16 {
            if !self.is_located() || self.node.next_timeout() > self.now {
                break;
            }
            self.handle(Happening::Timeout);
        }
        if self.next_beacon <= self.now {
            self.next_beacon = self.now + BEACON_PERIOD;
            self.send_beacons();
            self.recorder.advance(self.now);
        }
        self.steer();
    }

    /// Tells the software where the robot is, if that is known afresh.
    fn locate(&mut self) {
        let Some((estimate, measured)) = self.localiser.estimate() else {
            return;
        };
        // A stale position is not told again: its age shows in the estimate that the software has.
        if self.now.since(measured) > self.setup.safety.localisation
            && self.node.condition().started
        {
            return;
        }
        self.call(|node, now, _, desk| node.locate(now, estimate, desk));
        if self.next_pose <= self.now {
            self.next_pose = self.now + POSE_PERIOD;
            self.recorder.record(self.now, Event::Moved(estimate.pose));
        }
        if self.node.condition().started {
            self.handle(Happening::Located);
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
            self.motors.drive(self.node.command(), self.node.estimate());
        } else {
            self.motors.stop();
        }
    }

    fn take(&mut self, incoming: Incoming) {
        // What came in since the last look at the clock did not come before it.
        self.tick();
        match incoming {
            Incoming::Packet(arrival) => self.receive(arrival),
            Incoming::Device(report) => self.learn(report),
            Incoming::Planned(job, path) => self.handle(Happening::Planned { job, path }),
            Incoming::Written(Written::Done(job)) => self.handle(Happening::Stored { job }),
            Incoming::Written(Written::Failed(why)) => {
                let text = format!("storage cannot be written, and is tried again: {why}");
                self.recorder.notice(self.now, &text);
            }
            Incoming::Halt => self.is_over = true,
        }
    }

    fn learn(&mut self, report: Report) {
        match report {
            Report::Measured(at, reading) => {
                self.feel(&reading);
                self.localiser.measure(self.setup.clock.at(at), &reading);
            }
            Report::Seen(at, pose) => self.localiser.fix(self.setup.clock.at(at), pose),
            Report::Trouble(Some(what)) => self
                .recorder
                .notice(self.now, &format!("the device does not work: {what}")),
            Report::Trouble(None) => self.recorder.notice(self.now, "the device works again"),
        }
    }

    fn feel(&mut self, reading: &Reading) {
        if let Some(contact) = reading.bumper.filter(|_| self.setup.has_bumper) {
            self.contact = contact;
        }
        self.battery = reading.battery.or(self.battery);
    }

    fn receive(&mut self, arrival: Arrival) {
        match self.channel.open(self.now, &arrival.packet) {
            Opened::Content { from, content } => {
                self.transport.learn(from, arrival.origin);
                if let Some(frame) = starl_core::message::decode::<Frame>(&content) {
                    self.hear(from, frame);
                }
            }
            Opened::Handshake { from, answer } => {
                self.transport.learn(from, arrival.origin);
                if let Some(answer) = answer {
                    let _ = self.transport.send(from, &answer);
                } else {
                    // The other end uses the session once it has heard something in it.
                    self.send_beacon(from);
                }
            }
            Opened::Refused(_) => {}
        }
    }

    fn hear(&mut self, from: Member, frame: Frame) {
        if from < OPERATORS && from as usize >= self.peers.len() || from == self.setup.id.0 {
            return;
        }
        if from < OPERATORS {
            self.link_heard = self.now;
        }
        match frame {
            Frame::Halt if from >= OPERATORS => {
                self.motors.stop();
                self.send(from, &Frame::Halted);
                if self.leaving.is_none() {
                    self.recorder.notice(self.now, "stopped by an operator");
                    self.leaving = Some(self.now + FAREWELL);
                }
            }
            _ if self.leaving.is_some() => {}
            Frame::Datagram {
                sequence,
                port,
                payload,
            } if from < OPERATORS => {
                let message = Message {
                    from: RobotId(from),
                    port,
                    payload,
                };
                self.handle(Happening::Datagram { sequence, message });
            }
            Frame::Beacon(beacon) if from < OPERATORS => self.notice_peer(from, &beacon),
            Frame::Ask if from >= OPERATORS => {
                let status = Frame::Status(Box::new(self.status()));
                self.send(from, &status);
            }
            Frame::Order(order) if from >= OPERATORS => {
                self.handle(Happening::Input(starl_core::Input::Order(order)));
            }
            _ => {}
        }
    }

    fn notice_peer(&mut self, from: Member, beacon: &Beacon) {
        let peer = &mut self.peers[from as usize];
        peer.quality.take(self.now, beacon);
        peer.latest = Some((beacon.sent, self.now));
        let body = self.setup.bodies[from as usize];
        if let Some(pose) = beacon.pose {
            peer.perceived = Some(Perceived {
                at: self.now,
                position: pose.position,
                velocity: beacon.velocity,
                body,
            });
        }
    }

    fn send_beacons(&mut self) {
        for (member, packet) in self.channel.due(self.now) {
            let _ = self.transport.send(member, &packet);
        }
        for index in 0..self.fleet.len() {
            if index != self.setup.id.index() {
                self.send_beacon(index as u32);
            }
        }
        self.beacons = self.beacons.wrapping_add(1);
    }

    fn send_beacon(&mut self, to: Member) {
        let estimate = self.localiser.estimate();
        let peer = self.peers.get(to as usize);
        let beacon = Beacon {
            number: self.beacons,
            sent: self.setup.clock.now(),
            pose: estimate.map(|(estimate, _)| estimate.pose),
            velocity: estimate.map_or(starl_core::Point::ZERO, |(e, _)| e.twist.linear),
            echo: peer.and_then(|peer| peer.latest),
        };
        self.send(to, &Frame::Beacon(beacon));
    }

    /// Whether a packet left.
    fn send(&mut self, to: Member, frame: &Frame) -> bool {
        let content = starl_core::message::encode(frame);
        let sealed = self.channel.seal(to, &content);
        sealed.is_some_and(|packet| self.transport.send(to, &packet).is_ok())
    }

    fn handle(&mut self, happening: Happening) {
        self.call(|node, now, snapshot, desk| node.handle(now, happening, snapshot, desk));
    }

    /// Calls the node, and carries out what it asks for.
    fn call(&mut self, call: impl FnOnce(&mut Node, Time, &Snapshot<'_>, &mut Desk<'_>)) {
        let snapshot = Snapshot {
            hardware: &self.setup.hardware,
            sensors: Sensors {
                bumper: self.contact,
                ..Sensors::default()
            },
            fleet: &self.fleet,
            way_points: &self.setup.way_points,
            obstacles: &self.setup.obstacles,
        };
        let perceived = || self.peers.iter().filter_map(|peer| peer.perceived.as_ref());
        let mut desk = Desk {
            workspace: &mut self.workspace,
            recorder: &mut self.recorder,
            perceived: perceived().copied().collect(),
            here: self.node.estimate().pose.position,
            now: self.now,
            datagrams: Vec::new(),
            plans: Vec::new(),
            writes: Vec::new(),
            failure: None,
        };
        call(&mut self.node, self.now, &snapshot, &mut desk);
        let Desk {
            datagrams,
            plans,
            writes,
            failure,
            ..
        } = desk;
        self.failure = failure.or(self.failure.take());
        // A robot that is killed must not have sent what its trace does not show.
        if !datagrams.is_empty() {
            self.recorder.commit();
        }
        for datagram in datagrams {
            self.transmit(datagram);
        }
        for (job, neighbours) in plans {
            self.planner.find(job, neighbours);
        }
        for job in writes {
            if let Some(writer) = &self.writer {
                writer.write(job);
            }
        }
    }

    fn transmit(&mut self, datagram: Datagram) {
        let me = self.setup.id;
        let to: Vec<RobotId> = match datagram.destination {
            Destination::All => self.fleet.iter().copied().filter(|to| *to != me).collect(),
            Destination::Robot(to) if to == me => {
                self.to_self.push(datagram);
                return;
            }
            Destination::Robot(to) => vec![to],
        };
        let Datagram {
            sequence, message, ..
        } = datagram;
        let frame = Frame::Datagram {
            sequence,
            port: message.port,
            payload: message.payload,
        };
        let content = starl_core::message::encode(&frame);
        for to in to {
            let reason = if content.len() > channel::LONGEST {
                DropReason::Size
            } else {
                let packet = self.channel.seal(to.0, &content);
                match packet.map(|packet| self.transport.send(to.0, &packet)) {
                    Some(Ok(())) => continue,
                    _ => DropReason::Loss,
                }
            };
            let event = Event::Dropped {
                from: me,
                to: Some(to),
                sequence,
                reason,
            };
            self.recorder.record(self.now, event);
        }
    }

    fn status(&self) -> Status {
        let estimate = self.localiser.estimate();
        let condition = self.node.condition();
        let links = self.peers.iter().enumerate();
        Status {
            now: self.now,
            up: self.now.since(self.begun),
            finished: condition.finished,
            failed: self.failure.clone(),
            pose: estimate.map(|(estimate, _)| estimate.pose),
            position_age: estimate.map_or(Duration(u64::MAX), |(_, at)| self.now.since(at)),
            stopped: self.hazard.as_ref().map(ToString::to_string),
            battery: self.battery,
            state: self.recorder.state(self.node.program()),
            links: links
                .filter(|(index, _)| *index != self.setup.id.index())
                .map(|(index, peer)| (index as u32, peer.quality))
                .collect(),
            refused: self.channel.refusals(),
        }
    }
}
