//! One robot in real time.
//!
//! [`Core`] is the robot without clock and threads: it receives inputs, and returns the time of its next call.
//! [`Robot`] is the loop around it, with the machine's clock and the threads of the device, the planner and the
//! storage. All inputs of the robot's software arrive on one thread, so that they can be recorded and repeated.

mod core;
mod equipment;
mod network;
mod watch;

pub use self::core::Core;
pub use equipment::Equipment;
pub use network::longest_silence;

use crate::link::{Arrival, Channel, Transport};
use crate::localise::Accuracy;
use crate::motors::{Motors, PositionSource, Report};
use crate::planner::Planner;
use crate::safety::Safety;
use crate::writer::{StorageWriter, Written};
use crate::{Device, Storage, WallClock};
use equipment::Attached;
use starl_core::event::Name;
use starl_core::motion::{Body, Path};
use starl_core::{
    Duration, Event, Obstacle, Point, Pose, Program, Random, RobotId, Time, WayPoint,
};
use starl_host::{Hardware, Observed};
use starl_motion::sensing::SensorSuite;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};

/// The longest that the loop waits.
const LONGEST_WAIT: Duration = Duration::from_millis(20);

/// The loop takes at most so many things at once, so that timers are not kept waiting.
const MOST_AT_ONCE: usize = 64;

/// An obstacle of the scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct MapObstacle {
    /// Its shape and place.
    pub obstacle: Obstacle,
    /// Robots have to discover it.
    pub hidden: bool,
    /// It disappears at this time.
    pub expires: Time,
}

/// A thing that detectors see, where it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its name.
    pub name: Name,
    /// Where it is, metres.
    pub position: Point,
}

/// The configuration of a robot.
pub struct Setup {
    /// Its number.
    pub id: RobotId,
    /// The bodies of all robots, by number.
    pub bodies: Vec<Body>,
    /// The software that it runs.
    pub program: Box<dyn Program>,
    /// The stream that its software draws from.
    pub random: Random,
    /// Its hardware.
    pub hardware: Hardware,
    /// The sensors that its program may read. A bumper is the device's; the others are measured among the places of the
    /// other robots and the known obstacles.
    pub sensors: SensorSuite,
    /// The things that a detector sees.
    pub things: Vec<Thing>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The obstacles of the scenario.
    pub obstacles: Vec<MapObstacle>,
    /// The period of its position estimates.
    pub positioning_period: Duration,
    /// How exact its odometry and its positions are.
    pub accuracy: Accuracy,
    /// Its position at the start, if known.
    pub start: Option<Pose>,
    /// When its motors are stopped.
    pub safety: Safety,
}

/// The connections of a robot.
pub struct Connections {
    /// Its motors and sensors.
    pub device: Box<dyn Device>,
    /// The source of its position; none if it has odometry alone.
    pub positions: Option<Box<dyn PositionSource>>,
    /// Its storage, which survives restarts; none if it has none.
    pub storage: Option<Storage>,
    /// The network.
    pub transport: Box<dyn Transport>,
    /// The encryption of its packets.
    pub channel: Channel,
}

/// An input from another thread.
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
    /// The robot must stop and end.
    Halt,
}

/// The sender of inputs for other threads.
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

    /// All events until now have been recorded.
    fn advance(&mut self, now: Time);

    /// Everything that was recorded must survive the process from now on: something is about to leave the robot that
    /// shows it.
    fn commit(&mut self) {}

    /// The person in front of the robot should know this.
    fn notice(&mut self, at: Time, text: &str);

    /// The state of the program in a word, if it has one.
    fn state(&self, program: &dyn Program) -> Option<String> {
        let _ = program;
        None
    }
}

/// A running robot.
pub struct Robot<R: Recorder> {
    core: Core<R, Attached>,
    clock: WallClock,
    inbox: Receiver<Incoming>,
}

impl<R: Recorder> Robot<R> {
    /// A robot that is about to start, with the time of `clock`.
    ///
    /// # Errors
    /// If the system gives no threads.
    pub fn start(
        setup: Setup,
        connections: Connections,
        clock: WallClock,
        (post, inbox): (Post, Receiver<Incoming>),
        recorder: R,
    ) -> io::Result<Robot<R>> {
        let Connections {
            device,
            positions,
            storage,
            transport,
            channel,
        } = connections;
        let saved = storage
            .as_ref()
            .map(|storage| Arc::new(storage.saved().clone()));
        let has_fixes = positions.is_some();
        let (reports, plans, writes) = (post.clone(), post.clone(), post);
        let motors = Motors::start(device, positions, clock, move |report| {
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
        let attached = Attached {
            motors,
            planner,
            writer: writer.transpose()?,
            transport,
            saved,
            has_fixes,
        };
        Ok(Robot {
            core: Core::new(clock.now(), setup, channel, attached, recorder),
            clock,
            inbox,
        })
    }

    /// Runs until someone stops the robot; gives the recorder back.
    pub fn run(mut self) -> R {
        let mut incoming = Vec::new();
        while !self.core.is_over() {
            self.core.step(self.clock.now(), &mut incoming);
            let wait = self.clock.until(self.core.next_due());
            match self.inbox.recv_timeout(wait.min(LONGEST_WAIT.into())) {
                Ok(first) => {
                    incoming.push(first);
                    incoming.extend(self.inbox.try_iter().take(MOST_AT_ONCE));
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => incoming.push(Incoming::Halt),
            }
        }
        self.core.end(self.clock.now())
    }
}
