//! The slots of time in which datagrams arrive, finer than the physics step.
//!
//! Robots take their inputs slot by slot, so that an answer may travel within one physics step. Robots do not
//! affect each other within a slot: no datagram arrives in the one in which it was sent. Where no link is faster
//! than some number of slots, that many are taken at once (the lookahead of conservative simulation;
//! Chandy and Misra 1979), and slots in which nothing happens are left out.

use super::shared::Window;
use crate::scenario::{DelayDistribution, Link, Network};
use starl_core::{Duration, Time};

/// How time is cut into slots. Each physics step begins with a new one.
#[derive(Clone, Copy, Debug)]
pub struct Slots {
    step: Duration,
    length: Duration,
    per_step: u64,
}

impl Slots {
    /// Slots of a length of the network's resolution.
    pub fn new(step: Duration, resolution: Duration) -> Slots {
        let length = resolution.min(step).max(Duration(1));
        let per_step = step.0.div_ceil(length.0);
        Slots {
            step,
            length,
            per_step,
        }
    }

    /// The number of the slot in which a moment is.
    pub fn number(&self, at: Time) -> u64 {
        at.0 / self.step.0 * self.per_step + at.0 % self.step.0 / self.length.0
    }

    /// When a slot begins.
    pub fn start(&self, number: u64) -> Time {
        let (steps, slots) = (number / self.per_step, number % self.per_step);
        Time(steps * self.step.0 + slots * self.length.0)
    }

    /// The time from the slot in which a moment is over as many slots as the network's delays allow, at most to
    /// the end of the step; and the number of the slot after that.
    pub fn around(&self, at: Time, step: Window, network: &Network) -> (Window, u64) {
        let number = self.number(at);
        let together = (least_delay(network).0 / self.length.0).max(1);
        let end = number + together;
        let window = Window {
            from: self.start(number),
            to: self.start(end).min(step.to),
        };
        (window, self.number(window.to))
    }
}

/// No datagram arrives sooner after it was sent.
fn least_delay(network: &Network) -> Duration {
    let overrides = network.overrides.iter().map(|different| &different.link);
    let links = overrides.chain([&network.link]);
    links.map(least).min().unwrap_or_default()
}

fn least(link: &Link) -> Duration {
    let spread = match link.distribution {
        DelayDistribution::Constant => 0.0,
        _ if link.jitter.is_zero() => 0.0,
        DelayDistribution::Uniform => 3.0_f64.sqrt() * link.jitter.seconds(),
        DelayDistribution::Normal => f64::INFINITY,
        DelayDistribution::Exponential => link.jitter.seconds(),
    };
    // Less one nanosecond, since delays are rounded.
    let least = Duration::from_seconds_f64((link.delay.seconds() - spread).max(0.0));
    Duration(least.0.saturating_sub(1))
}
