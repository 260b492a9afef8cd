//! The client: follows one tracker by its name, on a thread of its own, since connecting may block.

use crate::wire::{self, Decoder, KIND_NAME, Message, Place, SENDER_NAME};
use starl_core::{Point, Pose};
use std::collections::BTreeMap;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use thiserror::Error;

/// The server and the body to follow.
#[derive(Clone, Debug)]
pub struct VrpnOptions {
    /// The server.
    pub server: SocketAddr,
    /// The name of the tracker.
    pub tracker: String,
    /// The names of other trackers whose poses are wanted too. The server need not know them.
    pub others: Vec<String>,
}

/// Why there are no positions.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum VrpnError {
    /// The server cannot be reached, or the connection has ended.
    #[error("the VRPN server at {0}: {1}")]
    Connection(SocketAddr, String),
    /// The server is silent about the tracker.
    #[error("the VRPN server does not see `{tracker}`; it knows {}", known.join(", "))]
    Silent {
        /// The tracker's name.
        tracker: String,
        /// The names that the server has told.
        known: Vec<String>,
    },
}

/// A tracker is out of sight after this long without a report.
const SILENCE: Duration = Duration::from_millis(1000);
/// How long to wait for a connection, and before the next try.
const PATIENCE: Duration = Duration::from_millis(500);
/// How long a read waits before it looks whether to end.
const WAIT: Duration = Duration::from_millis(20);

/// A tracker that is followed.
#[derive(Debug)]
pub struct Vrpn {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared {
    options: VrpnOptions,
    stop: AtomicBool,
    seen: Mutex<Seen>,
}

#[derive(Debug)]
struct Seen {
    pose: Option<(Instant, Pose)>,
    /// The latest pose of each of the other trackers, in the order of the options.
    others: Vec<Option<(Instant, Pose)>>,
    last: Instant,
    trouble: Option<String>,
    known: Vec<String>,
}

impl Vrpn {
    /// Begins to connect to the server. One that does not answer shows in [`Vrpn::poll`].
    pub fn connect(options: VrpnOptions) -> Vrpn {
        let shared = Arc::new(Shared {
            stop: AtomicBool::new(false),
            seen: Mutex::new(Seen {
                pose: None,
                others: vec![None; options.others.len()],
                last: Instant::now(),
                trouble: None,
                known: Vec::new(),
            }),
            options,
        });
        let thread = thread::spawn({
            let shared = shared.clone();
            move || shared.run()
        });
        Vrpn {
            shared,
            thread: Some(thread),
        }
    }

    /// The latest pose that has arrived since the last call, and when it arrived; `None` if there is no new one. Does
    /// not block.
    ///
    /// # Errors
    /// If the server cannot be reached or has not reported the tracker for a second. Call again: it may come back.
    pub fn poll(&mut self) -> Result<Option<(Instant, Pose)>, VrpnError> {
        let mut seen = self.shared.seen();
        if let Some(pose) = seen.pose.take() {
            return Ok(Some(pose));
        }
        if seen.last.elapsed() < SILENCE {
            return Ok(None);
        }
        let VrpnOptions {
            server, tracker, ..
        } = self.shared.options.clone();
        Err(match seen.trouble.clone() {
            Some(trouble) => VrpnError::Connection(server, trouble),
            None => VrpnError::Silent {
                tracker,
                known: seen.known.clone(),
            },
        })
    }

    /// The latest poses of the other trackers that have arrived since the last call: the place of each in
    /// [`VrpnOptions::others`], and when it arrived.
    pub fn others(&mut self) -> Vec<(usize, Instant, Pose)> {
        let mut seen = self.shared.seen();
        let others = seen.others.iter_mut().enumerate();
        others
            .filter_map(|(index, seen)| seen.take().map(|(at, pose)| (index, at, pose)))
            .collect()
    }
}

impl Drop for Vrpn {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn seen(&self) -> MutexGuard<'_, Seen> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn run(&self) {
        while !self.stopped() {
            let trouble = self.follow().err();
            let trouble = trouble.map_or("the server has ended".into(), |error| error.to_string());
            self.seen().trouble = Some(trouble);
            let limit = Instant::now() + PATIENCE;
            while !self.stopped() && Instant::now() < limit {
                thread::sleep(WAIT);
            }
        }
    }

    /// One connection, until it ends.
    fn follow(&self) -> Result<(), Box<dyn std::error::Error>> {
        let mut stream = TcpStream::connect_timeout(&self.options.server, PATIENCE)?;
        stream.set_read_timeout(Some(WAIT))?;
        stream.set_nodelay(true)?;
        stream.write_all(&wire::greeting())?;
        self.seen().known.clear();
        let mut decoder = Decoder::default();
        let mut names = Names::default();
        let mut buffer = [0; 4096];
        while !self.stopped() {
            match stream.read(&mut buffer) {
                Ok(0) => return Ok(()),
                Ok(length) => decoder.push(&buffer[..length]),
                Err(error) => match error.kind() {
                    ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => {}
                    _ => return Err(error.into()),
                },
            }
            while let Some(message) = decoder.pop()? {
                // Now it is sure that a server is there.
                self.seen().trouble = None;
                self.take(&mut names, &message);
            }
        }
        Ok(())
    }

    fn take(&self, names: &mut Names, message: &Message) {
        match message.kind {
            SENDER_NAME => {
                if let Some(name) = message.name() {
                    self.seen().known.push(name.clone());
                    names.senders.insert(message.sender, name);
                }
            }
            KIND_NAME => {
                if let Some(name) = message.name() {
                    names.kinds.insert(message.sender, name);
                }
            }
            kind => {
                let named = |name: Option<&String>, wanted: &str| name.is_some_and(|n| n == wanted);
                if named(names.kinds.get(&kind), wire::PLACE)
                    && let Some(sender) = names.senders.get(&message.sender)
                    && let Some(pose) = Place::decode(&message.body).and_then(|place| pose(&place))
                {
                    let now = Instant::now();
                    let mut seen = self.seen();
                    let others = self.options.others.iter();
                    for (_, other) in others
                        .zip(&mut seen.others)
                        .filter(|(name, _)| *name == sender)
                    {
                        *other = Some((now, pose));
                    }
                    if *sender == self.options.tracker {
                        seen.last = now;
                        seen.pose = Some((now, pose));
                    }
                }
            }
        }
    }
}

/// The names behind the server's numbers.
#[derive(Debug, Default)]
struct Names {
    senders: BTreeMap<i32, String>,
    kinds: BTreeMap<i32, String>,
}

/// The pose; `None` if the rotation is none.
fn pose(place: &Place) -> Option<Pose> {
    let [x, y, z] = place.position;
    Pose::of_quaternion(Point::new(x, y, z), place.rotation)
}
