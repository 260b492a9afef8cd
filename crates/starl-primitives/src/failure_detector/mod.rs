//! Failure detection, shared by all primitives that wait for other robots.
//!
//! Every robot sends heartbeats; a robot whose silence is too unlikely, given the arrival of its earlier heartbeats, is
//! suspected (phi accrual failure detector: Hayashibara, Defago, Yared and Katayama 2004). Unlike there, mean and
//! variance fade rather than coming from a window, the margin grows with every suspicion that proves false, and silence
//! is checked once a period.
//!
//! Properties, in a network that from some time on delivers enough heartbeats within some unknown
//! bound (an eventually perfect detector: Chandra and Toueg 1996):
//! - completeness: every robot that stays down is eventually suspected permanently by all that are up, within
//!   [`FailureDetector::patience`] of its last heartbeat, which is never more than [`Options::longest_patience`], and a
//!   period more;
//! - accuracy: from some time on no robot suspects a robot that is up, connected and keeps running;
//! - a restart does not pass unnoticed, however short: the robot is suspected and trusted again.
//!
//! A suspicion may be wrong, and primitives that act on one must be safe even then.
//!
//! Messages: one datagram to all in each period, of some ten bytes, whatever the number of primitives.
//! After a corruption of the state a robot that is up is suspected in error at most once, and a robot that
//! is down is missed no longer than [`Options::longest_patience`] and a period.

mod arrivals;
mod options;

pub use options::Options;

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use arrivals::Arrivals;
use serde::{Deserialize, Serialize};
use starl_core::event::FailureDetectorEvent;
use starl_core::event::agreement::Suspicion;
use starl_core::random::hash_key;
use starl_core::{
    Destination, Duration, Input, Message, Port, Primitive, Random, Robot, RobotId, TimerKey,
    timers,
};

timers! {
    enum Alarm {
        /// A heartbeat is due.
        Beat,
    }
}

/// The content of a heartbeat.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Heartbeat {
    /// Drawn at the start.
    incarnation: u32,
    /// Counts heartbeats since then.
    number: u32,
}

/// Watches the other robots of the application. The program's other primitives receive its findings as
/// [`Input::Suspected`] and [`Input::Trusted`].
#[derive(Clone, Debug)]
pub struct FailureDetector {
    port: Port,
    options: Options,
    /// Standard deviations that stand for the threshold.
    deviations: f64,
    beat: Heartbeat,
    peers: BTreeMap<RobotId, Arrivals>,
}

impl FailureDetector {
    /// An instance; those of the same name on all robots hear each other. One is enough for a program.
    pub fn new(name: &str, options: Options) -> FailureDetector {
        FailureDetector {
            port: Port::named(name),
            deviations: options.deviations(),
            options,
            beat: Heartbeat {
                incarnation: 0,
                number: 0,
            },
            peers: BTreeMap::new(),
        }
    }

    /// Whether a robot is believed to have failed.
    pub fn suspects(&self, robot: RobotId) -> bool {
        self.peers
            .get(&robot)
            .is_some_and(|arrivals| arrivals.is_suspected)
    }

    /// All robots that are believed to have failed, in the order of their numbers.
    pub fn suspected(&self) -> impl Iterator<Item = RobotId> {
        let suspected = self.peers.iter().filter(|(_, peer)| peer.is_suspected);
        suspected.map(|(&robot, _)| robot)
    }

    /// The silence after which a robot is suspected at present; none for a robot that is not watched.
    pub fn patience(&self, robot: RobotId) -> Option<Duration> {
        let arrivals = self.peers.get(&robot)?;
        Some(arrivals.patience(&self.options, self.deviations))
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        for arrivals in self.peers.values_mut() {
            arrivals.corrupt(random);
        }
        self.beat.number = random.bits();
    }

    fn begin(&mut self, robot: &mut Robot<'_>) {
        // The clock is mixed in so that a robot whose random stream starts over draws another number.
        let bits = u64::from(robot.random().bits());
        self.beat.incarnation = hash_key(robot.now().0, &[bits]) as u32;
        self.meet(robot);
        // Robots that start together do not speak together.
        let period = self.options.period();
        let first = robot.random().uniform() * period.seconds();
        robot.set_timer(self.timer(), Duration::from_seconds_f64(first));
    }

    /// Announces that this robot is up, and checks for silent robots.
    fn tick(&mut self, robot: &mut Robot<'_>) {
        self.beat.number = self.beat.number.wrapping_add(1);
        robot.transmit(Destination::All, self.port, &self.beat);
        self.meet(robot);
        self.look(robot);
        let period = self.options.period().seconds();
        let pause = period * (0.9 + 0.2 * robot.random().uniform());
        robot.set_timer(self.timer(), Duration::from_seconds_f64(pause));
    }

    /// Watches those that have joined the fleet, and no longer those that have left it.
    fn meet(&mut self, robot: &mut Robot<'_>) {
        let fleet = robot.fleet();
        let (now, options) = (robot.now(), &self.options);
        self.peers
            .retain(|peer, _| fleet.binary_search(peer).is_ok());
        for peer in robot.peers() {
            let arrivals = self
                .peers
                .entry(peer)
                .or_insert_with(|| Arrivals::new(now, options));
            arrivals.settle(now, options);
        }
    }

    fn look(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let is_silent = |arrivals: &Arrivals| {
            now.since(arrivals.last) > arrivals.patience(&self.options, self.deviations)
        };
        let silent: Vec<RobotId> = self
            .peers
            .iter()
            .filter(|(_, arrivals)| !arrivals.is_suspected && is_silent(arrivals))
            .map(|(&peer, _)| peer)
            .collect();
        for peer in silent {
            self.suspect(robot, peer, Suspicion::Silence);
        }
    }

    fn hear(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let Some(beat) = message.read::<Heartbeat>() else {
            return;
        };
        let now = robot.now();
        let Some(arrivals) = self.peers.get_mut(&message.from) else {
            return;
        };
        if arrivals.is_late(&beat) {
            return;
        }
        let (is_known, was_suspected) = (arrivals.incarnation.is_some(), arrivals.is_suspected);
        let has_restarted = arrivals.note(&beat);
        if is_known && !has_restarted {
            if was_suspected {
                arrivals.forgive(&self.options);
                arrivals.last = now;
                self.trust(robot, message.from);
            } else {
                arrivals.hear(now);
            }
            return;
        }
        arrivals.last = now;
        if has_restarted && !was_suspected {
            self.suspect(robot, message.from, Suspicion::Restart);
        }
        if has_restarted || was_suspected {
            self.trust(robot, message.from);
        }
    }

    fn suspect(&mut self, robot: &mut Robot<'_>, peer: RobotId, reason: Suspicion) {
        if let Some(arrivals) = self.peers.get_mut(&peer) {
            arrivals.is_suspected = true;
        }
        robot.report(self.port, FailureDetectorEvent::Suspect { peer, reason });
        robot.suspect(peer);
    }

    fn trust(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        if let Some(arrivals) = self.peers.get_mut(&peer) {
            arrivals.is_suspected = false;
        }
        robot.report(self.port, FailureDetectorEvent::Trust { peer });
        robot.trust(peer);
    }

    fn timer(&self) -> TimerKey {
        TimerKey::new(self.port, Alarm::Beat)
    }
}

impl Primitive for FailureDetector {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => self.begin(robot),
            Input::Message(message) if message.port == self.port => self.hear(robot, message),
            Input::Timer(key) if *key == self.timer() => self.tick(robot),
            _ => {}
        }
    }
}
