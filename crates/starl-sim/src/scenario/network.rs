//! How messages travel.

use starl_core::intervention::{DelayDistribution, NetworkKnob};
use starl_core::{Duration, RobotId};

/// The simulated network. A datagram is sent once; every robot it could reach receives it, or not,
/// on its own account.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// The default for links.
    pub link: Link,
    /// Radio range between robots' centres, metres; none: everywhere; default none.
    pub range: Option<f64>,
    /// Obstacles and other robots' bodies block the radio; default false.
    pub line_of_sight: bool,
    /// The send rate of each robot, bits per second; datagrams queue; none: unlimited; default
    /// none.
    pub bandwidth: Option<f64>,
    /// How long a datagram may wait in the sender's queue before it is dropped; default 1 s.
    pub queue: Duration,
    /// Largest datagram, bytes; larger ones are dropped, and the trace says so; default 65507.
    pub largest: u32,
    /// Times of arrival are exact; but a datagram arrives at the soonest in the slot of this length after the one
    /// in which it was sent. Each physics step begins with a new slot; default 1 ms.
    pub resolution: Duration,
    /// Links that differ; the last that matches counts.
    pub overrides: Vec<LinkOverride>,
}

/// The properties of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Mean delay; default 15 ms.
    pub delay: Duration,
    /// Standard deviation of the delay; default 5 ms.
    pub jitter: Duration,
    /// How delays are distributed; default normal.
    pub distribution: DelayDistribution,
    /// Probability that a datagram is lost; default 0.
    pub loss: f64,
    /// Probability that it arrives twice, the second after a delay of its own; default 0.
    pub duplication: f64,
    /// Probability that it is held back, so that later ones overtake it; default 0.
    pub reordering: f64,
    /// How long it is held back then, on top of its delay; default 50 ms.
    pub reordering_delay: Duration,
}

/// A set of links that differ from the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkOverride {
    /// Senders; none: all.
    pub from: Option<Vec<RobotId>>,
    /// Receivers; none: all.
    pub to: Option<Vec<RobotId>>,
    /// The properties of these links.
    pub link: Link,
}

impl Default for Link {
    fn default() -> Link {
        Link {
            delay: Duration::from_millis(15),
            jitter: Duration::from_millis(5),
            distribution: DelayDistribution::default(),
            loss: 0.0,
            duplication: 0.0,
            reordering: 0.0,
            reordering_delay: Duration::from_millis(50),
        }
    }
}

impl Default for Network {
    fn default() -> Network {
        Network {
            link: Link::default(),
            range: None,
            line_of_sight: false,
            bandwidth: None,
            queue: Duration::from_seconds(1),
            largest: 65_507,
            resolution: Duration::from_millis(1),
            overrides: Vec::new(),
        }
    }
}

/// Parts of a link's delay that do not go together, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Contradiction {
    pub message: String,
    pub help: &'static str,
}

impl Link {
    /// Whether the distribution would reach below zero, or leave a jitter that is given without effect.
    pub(crate) fn contradiction(&self, sets_jitter: bool) -> Option<Contradiction> {
        let (delay, jitter) = (self.delay, self.jitter);
        let (message, help) = match self.distribution {
            DelayDistribution::Constant if sets_jitter && jitter > Duration::ZERO => (
                "a constant delay has no jitter".to_string(),
                "leave it out, or choose another distribution",
            ),
            DelayDistribution::Uniform if jitter.seconds() * 3.0_f64.sqrt() > delay.seconds() => (
                format!(
                    "a delay of {delay} cannot vary evenly with a jitter of {jitter}: it would be \
                     negative at times"
                ),
                "make the jitter at most 0.57 of the delay, or choose another distribution",
            ),
            DelayDistribution::Exponential if jitter > delay => (
                format!("an exponential delay of {delay} cannot have the greater jitter {jitter}"),
                "make the jitter at most the delay, or choose another distribution",
            ),
            _ => return None,
        };
        Some(Contradiction { message, help })
    }
}

impl Network {
    /// Turns one knob.
    pub fn turn(&mut self, knob: NetworkKnob) {
        let link = &mut self.link;
        match knob {
            NetworkKnob::Delay(delay) => link.delay = delay,
            NetworkKnob::Jitter(jitter) => link.jitter = jitter,
            NetworkKnob::Distribution(distribution) => link.distribution = distribution,
            NetworkKnob::Loss(loss) => link.loss = loss,
            NetworkKnob::Duplication(duplication) => link.duplication = duplication,
            NetworkKnob::Reordering(reordering) => link.reordering = reordering,
            NetworkKnob::ReorderingDelay(delay) => link.reordering_delay = delay,
            NetworkKnob::Range(range) => self.range = range,
            NetworkKnob::LineOfSight(is_needed) => self.line_of_sight = is_needed,
            NetworkKnob::Bandwidth(bandwidth) => self.bandwidth = bandwidth,
            NetworkKnob::Queue(queue) => self.queue = queue,
            NetworkKnob::Largest(largest) => self.largest = largest,
        }
    }

    /// Delays that are shorter than the resolution and therefore have no exact effect; none if datagrams arrive
    /// immediately.
    pub fn too_short_delays(&self) -> impl Iterator<Item = Duration> {
        let overrides = self.overrides.iter().map(|different| &different.link);
        let delays = overrides.chain([&self.link]).map(|link| link.delay);
        delays.filter(|delay| !delay.is_zero() && *delay < self.resolution)
    }

    /// The properties of the link between two robots.
    pub fn link(&self, from: RobotId, to: RobotId) -> &Link {
        let names = |set: &Option<Vec<RobotId>>, robot| {
            set.as_ref().is_none_or(|robots| robots.contains(&robot))
        };
        self.overrides
            .iter()
            .rev()
            .find(|link| names(&link.from, from) && names(&link.to, to))
            .map_or(&self.link, |link| &link.link)
    }
}
