//! When a robot's heartbeats came, and until when the next one is due.

use super::options::Options;
use starl_core::{Duration, Time, math};

/// The share of each new interval in mean and variance: about the last sixteen count.
const WEIGHT: f64 = 1.0 / 16.0;

/// The knowledge of one robot. Intervals are in seconds; mean and variance fade exponentially (West
/// 1979), so that they follow a network that changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrivals {
    /// Drawn by the robot when it started; none before it was heard.
    pub incarnation: Option<u32>,
    /// The number of its latest heartbeat.
    pub number: u32,
    /// When that came, or when this robot began to listen.
    pub last: Time,
    mean: f64,
    variance: f64,
    /// Beyond what is usual.
    margin: Duration,
    pub is_suspected: bool,
}

impl Arrivals {
    /// A robot that was not heard yet.
    pub fn new(now: Time, options: &Options) -> Arrivals {
        let period = options.period().seconds();
        Arrivals {
            incarnation: None,
            number: 0,
            last: now,
            mean: period,
            variance: period * period / 16.0,
            margin: options.margin,
            is_suspected: false,
        }
    }

    /// A heartbeat came that is later than those before.
    pub fn hear(&mut self, now: Time) {
        let interval = now.since(self.last).seconds();
        let difference = interval - self.mean;
        let increment = WEIGHT * difference;
        self.mean += increment;
        self.variance = (1.0 - WEIGHT) * (self.variance + difference * increment);
        self.last = now;
    }

    /// The suspicion was false: the next one is delayed. So in a network with some bound, even an unknown one, false
    /// suspicions end (Chandra and Toueg 1996, section 5.1).
    pub fn forgive(&mut self, options: &Options) {
        let margin = self.margin + options.period();
        self.margin = margin.min(options.longest_patience);
    }

    /// The silence after which the robot is suspected.
    pub fn patience(&self, options: &Options, deviations: f64) -> Duration {
        if self.incarnation.is_none() {
            return options.first_timeout;
        }
        // Two heartbeats that share a fate may come as one interval of almost no length.
        let least = options.period().seconds() / 8.0;
        let deviation = math::sqrt(self.variance).max(least);
        let usual = Duration::from_seconds_f64(self.mean + deviations * deviation);
        (usual + self.margin).min(options.longest_patience)
    }

    /// Repairs states that a corruption or a clock set back may have left.
    pub fn settle(&mut self, now: Time, options: &Options) {
        self.last = self.last.min(now);
        let longest = options.longest_patience.seconds();
        let plausible = |value: f64| (0.0..=longest).contains(&value);
        if !plausible(self.mean) || !plausible(math::sqrt(self.variance)) {
            let fresh = Arrivals::new(now, options);
            (self.mean, self.variance) = (fresh.mean, fresh.variance);
        }
        self.margin = self.margin.min(options.longest_patience);
    }

    /// Overwrites everything at random.
    pub fn corrupt(&mut self, random: &mut starl_core::Random) {
        self.incarnation = random.chance(0.5).then(|| random.bits());
        self.number = random.bits();
        self.last = Time(u64::from(random.bits()) << random.below(32));
        self.mean = f64::from_bits(u64::from(random.bits()) << 32);
        self.variance = f64::from_bits(u64::from(random.bits()) << 32);
        self.margin = Duration(u64::from(random.bits()) << random.below(32));
        self.is_suspected = random.chance(0.5);
    }
}
