//! One robot in real time.
//!
//! [`Core`] is the robot without clock and threads: it receives inputs, and returns the time of its next call.
//! [`Robot`] is the loop around it, with the machine's clock and the threads of the device, the planner and the
//! storage. All inputs of the robot's software arrive on one thread, so that they can be recorded and repeated.

mod core;
mod equipment;
mod mailbox;
mod network;
mod watch;

pub use self::core::Core;
pub use crate::recorder::Recorder;
pub use crate::setup::{MapObstacle, Setup, Thing};
pub use equipment::Equipment;
pub use mailbox::{Incoming, Post, mailbox};
pub use network::longest_silence;

use crate::link::{Channel, Transport};
use crate::motors::{Motors, PositionSource};
use crate::planner::Planner;
use crate::writer::StorageWriter;
use crate::{Device, Storage, WallClock};
use equipment::Attached;
use starl_core::Duration;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};

/// The longest that the loop waits.
const LONGEST_WAIT: Duration = Duration::from_millis(20);

/// The loop takes at most so many things at once, so that timers are not kept waiting.
const MOST_AT_ONCE: usize = 64;

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
