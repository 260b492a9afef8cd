//! Datagrams arrive according to the network of the scenario.
//!
//! They arrive only at their receivers, once unless a link duplicates, within radio range, and after a possible delay
//! of their link. A link with a constant delay keeps their order.

use super::broken;
use starl_core::event::{Event, Fault};
use starl_core::{Destination, Duration, Intervention, Point, Record, RobotId, Time};
use starl_properties::{Checker, Violation};
use starl_sim::Scenario;
use starl_sim::scenario::{DelayDistribution, Link, Network};
use std::collections::{BTreeMap, VecDeque};

const INTEGRITY: &str = "datagram_integrity";
const DELAY: &str = "datagram_delay";
const RANGE: &str = "datagram_range";
const ORDER: &str = "datagram_order";

/// No draw of a normal distribution is farther from its mean than this, in standard deviations, and none of an
/// exponential one is this many times its mean.
const FARTHEST: f64 = 40.0;

/// The most that a datagram has beside its payload, bytes.
const HEADER_BYTES: usize = 128;

/// Follows all datagrams.
#[derive(Clone, Debug)]
pub struct Traffic {
    /// The network, and since when it is so; the latest last.
    networks: Vec<(Time, Network)>,
    step: Duration,
    /// How far a robot can be from its last recorded pose in a second, metres.
    fastest: f64,
    pose_period: Duration,
    robots: Vec<Station>,
    latest: Time,
}

/// A robot as a sender and a receiver.
#[derive(Clone, Debug, Default)]
struct Station {
    /// Its datagrams that may still arrive.
    sent: VecDeque<Sent>,
    is_down: bool,
    place: Option<Point>,
    /// The last datagram from each sender, and when it was sent.
    heard: BTreeMap<RobotId, (Time, u32)>,
}

#[derive(Clone, Debug)]
struct Sent {
    sequence: u32,
    at: Time,
    to: Destination,
    bytes: usize,
    /// How often it reached each robot.
    reached: Vec<(RobotId, u32)>,
}

/// The least and the greatest delay of a link.
fn delays(link: &Link) -> (f64, f64) {
    let (mean, jitter) = (link.delay.seconds(), link.jitter.seconds());
    let (least, most) = match link.distribution {
        DelayDistribution::Constant => (mean, mean),
        DelayDistribution::Uniform => {
            let half = jitter * 3f64.sqrt();
            (mean - half, mean + half)
        }
        DelayDistribution::Normal => (mean - 9.0 * jitter, mean + 9.0 * jitter),
        DelayDistribution::Exponential => (mean - jitter, mean + FARTHEST * jitter),
    };
    let held = match link.reordering > 0.0 {
        true => link.reordering_delay.seconds(),
        false => 0.0,
    };
    (least.max(0.0), most.max(0.0) + held)
}

/// Whether what is sent first arrives first.
fn keeps_order(link: &Link) -> bool {
    let is_constant = link.distribution == DelayDistribution::Constant || link.jitter.is_zero();
    is_constant && link.reordering <= 0.0
}

/// How long a datagram may be in the sender's queue and on its radio, seconds.
fn queued(network: &Network, bytes: usize) -> f64 {
    network.bandwidth.map_or(0.0, |bandwidth| {
        network.queue.seconds() + ((bytes + HEADER_BYTES) * 8) as f64 / bandwidth
    })
}

impl Traffic {
    pub fn new(scenario: &Scenario) -> Traffic {
        let groups = &scenario.fleet.groups;
        let wind = scenario.wind.steady.length() + scenario.wind.gust.length();
        let speeds = groups.iter().map(|group| {
            let limits = group.model.limits();
            limits.speed + limits.vertical_speed + wind
        });
        Traffic {
            networks: vec![(Time::ZERO, scenario.network.clone())],
            step: scenario.physics.step,
            fastest: speeds.fold(0.0, f64::max),
            pose_period: scenario.trace.pose_period,
            robots: vec![Station::default(); scenario.fleet.len()],
            latest: Time::ZERO,
        }
    }

    fn station(&mut self, robot: RobotId) -> &mut Station {
        if robot.index() >= self.robots.len() {
            self.robots.resize(robot.index() + 1, Station::default());
        }
        &mut self.robots[robot.index()]
    }

    /// The networks that there were between two times.
    fn networks(&self, from: Time, to: Time) -> impl Iterator<Item = &Network> {
        let ends = self.networks.iter().skip(1).map(|(since, _)| *since);
        let ends = ends.chain([Time::NEVER]);
        let all = self.networks.iter().zip(ends);
        all.filter(move |((since, _), until)| *since <= to && *until >= from)
            .map(|((_, network), _)| network)
    }

    fn sent(&mut self, robot: RobotId, sent: Sent) {
        let now = sent.at;
        let longest = self.networks.iter().flat_map(|(_, network)| {
            let links = network.overrides.iter().map(|other| &other.link);
            let links = links.chain([&network.link]);
            let queue = queued(network, network.largest as usize);
            links.map(move |link| delays(link).1 + queue)
        });
        let longest = longest.fold(0.0, f64::max) * 2.0 + 10.0;
        let station = self.station(robot);
        while let Some(first) = station.sent.front()
            && now.since(first.at).seconds() > longest
        {
            station.sent.pop_front();
        }
        station.sent.push_back(sent);
    }

    fn arrived(
        &mut self,
        at: Time,
        to: RobotId,
        (from, sequence): (RobotId, u32),
        violations: &mut Vec<Violation>,
    ) {
        let mut break_law = |law, text: String| {
            let text = format!("datagram {sequence} of robot {from} {text}");
            violations.push(broken(law, at, vec![from, to], text));
        };
        let (fastest, period, step) = (self.fastest, self.pose_period, self.step);
        if self.station(to).is_down {
            break_law(INTEGRITY, format!("reaches robot {to}, which is down"));
        }
        let sender = self.station(from);
        let place = sender
            .sent
            .iter()
            .rev()
            .position(|sent| sent.sequence == sequence);
        let Some(index) = place.map(|back| sender.sent.len() - 1 - back) else {
            let text = format!("reaches robot {to}, and was not sent, or too long ago");
            return break_law(INTEGRITY, text);
        };
        let sent = &mut sender.sent[index];
        let (sent_at, bytes) = (sent.at, sent.bytes);
        let is_for = match sent.to {
            Destination::All => to != from,
            Destination::Robot(robot) => robot == to,
        };
        let mut reached = sent.reached.iter_mut();
        let count = match reached.find(|(robot, _)| *robot == to) {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                sent.reached.push((to, 1));
                1
            }
        };
        if !is_for {
            break_law(INTEGRITY, format!("reaches robot {to}, and is not for it"));
        }
        let until = Time(sent_at.0 + step.0);
        let networks: Vec<&Network> = self.networks(sent_at, until).collect();
        let links = || networks.iter().map(|network| network.link(from, to));
        let copies = if links().any(|link| link.duplication > 0.0) {
            2
        } else {
            1
        };
        if count > copies {
            break_law(INTEGRITY, format!("reaches robot {to} {count} times"));
        }
        let delay = at.since(sent_at).seconds();
        let fits = networks.iter().any(|network| {
            let (least, most) = delays(network.link(from, to));
            let late = network.resolution.seconds() + queued(network, bytes);
            // Nanoseconds are rounded.
            least - 2e-9 <= delay && delay <= most + late + 2e-9
        });
        if !fits || at < sent_at {
            let text = format!("reaches robot {to} after {:.6} ms", delay * 1e3);
            break_law(DELAY, format!("{text}: its link has no such delay"));
        }
        let mut ranges = networks.iter().map(|network| network.range);
        let range = ranges.try_fold(0.0, |most: f64, range| Some(most.max(range?)));
        let place = |robot: RobotId| self.robots[robot.index()].place;
        if let (Some(range), Some(a), Some(b)) = (range, place(from), place(to)) {
            let moved = 2.0 * fastest * (period.seconds() + step.seconds() + delay);
            let apart = a.distance(b);
            if apart > range + moved {
                let text = format!("reaches robot {to}, which is {apart:.3} m away");
                break_law(RANGE, format!("{text}; the range is {range} m"));
            }
        }
        let keeps_order = networks.len() == 1 && links().all(keeps_order);
        let heard = self.station(to).heard.insert(from, (sent_at, sequence));
        if let Some((earlier, number)) = heard
            && keeps_order
            && (sent_at, sequence) < (earlier, number)
            && self.networks(sent_at, earlier).count() == 1
        {
            let text = format!("reaches robot {to} after datagram {number}, which was sent later");
            break_law(ORDER, text);
        }
    }

    fn steered(&mut self, at: Time, what: &Intervention) {
        if let Intervention::Network(knobs) = what
            && let Some((_, network)) = self.networks.last()
        {
            let mut network = network.clone();
            knobs.iter().for_each(|&knob| network.turn(knob));
            self.networks.push((at, network));
        }
    }
}

impl Checker for Traffic {
    fn properties(&self) -> &'static [&'static str] {
        &[INTEGRITY, DELAY, RANGE, ORDER]
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        let Record { at, robot, event } = record;
        // Datagrams dropped in a sender's queue are recorded ahead of their time.
        if !matches!(event, Event::Dropped { .. }) {
            if *at < self.latest {
                let text = format!("a record of {at} follows one of {}", self.latest);
                violations.push(broken(ORDER, *at, robot.iter().copied().collect(), text));
            }
            self.latest = self.latest.max(*at);
        }
        let Some(robot) = *robot else {
            if let Event::Intervention(what) = event {
                self.steered(*at, what);
            }
            return;
        };
        match event {
            Event::Sent {
                sequence,
                destination,
                payload,
                ..
            } => {
                let sent = Sent {
                    sequence: *sequence,
                    at: *at,
                    to: *destination,
                    bytes: payload.len(),
                    reached: Vec::new(),
                };
                self.sent(robot, sent);
            }
            Event::Delivered { from, sequence } => {
                self.arrived(*at, robot, (*from, *sequence), violations);
            }
            Event::Moved(pose) => self.station(robot).place = Some(pose.position),
            Event::Fault(Fault::Crash) => self.station(robot).is_down = true,
            Event::Fault(Fault::Restart) => self.station(robot).is_down = false,
            _ => {}
        }
    }
}
