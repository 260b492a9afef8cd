//! When a robot's heartbeats came, and until when the next one is due.

use super::Heartbeat;
use super::options::Options;
use alloc::collections::VecDeque;
use starl_core::{Duration, Time, math};

/// The share of each new interval in mean and variance: about the last sixteen count.
const WEIGHT: f64 = 1.0 / 16.0;

/// The number of lives of a robot that are remembered: late copies of their heartbeats do not look like restarts.
const LIVES: usize = 64;

/// A heartbeat that is further behind is no late copy: a corruption has left the greater number.
const FURTHEST: u32 = 1000;

/// The knowledge of one robot. Intervals are in seconds; mean and variance fade exponentially (West
/// 1979), so that they follow a network that changes.
#[derive(Clone, Debug)]
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
    /// The lives that are over, each with the number of its latest heartbeat.
    earlier: VecDeque<(u32, u32)>,
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
            earlier: VecDeque::new(),
        }
    }

    /// Whether the heartbeat says nothing about the present: it is a late copy, or the robot has restarted since.
    pub fn is_late(&mut self, beat: &Heartbeat) -> bool {
        let is_copy = |latest: u32| {
            // Counted round the circle.
            let behind = latest.wrapping_sub(beat.number);
            behind < FURTHEST || behind as i32 >= 0 && !self.is_suspected
        };
        if self.incarnation == Some(beat.incarnation) {
            return is_copy(self.number);
        }
        let mut lives = self.earlier.iter();
        let Some(place) = lives.position(|(life, _)| *life == beat.incarnation) else {
            return false;
        };
        let is_late = is_copy(self.earlier[place].1) || !self.is_suspected;
        if !is_late {
            // It is not over: a corruption has made it look so.
            self.earlier.remove(place);
        }
        is_late
    }

    /// A heartbeat is the latest one. Returns whether it is the first of a new life, although another one was heard.
    pub fn note(&mut self, beat: &Heartbeat) -> bool {
        let before = self.incarnation.replace(beat.incarnation);
        let latest = core::mem::replace(&mut self.number, beat.number);
        let over = before.filter(|before| *before != beat.incarnation);
        if let Some(over) = over {
            if self.earlier.len() == LIVES {
                self.earlier.pop_front();
            }
            self.earlier.push_back((over, latest));
        }
        over.is_some()
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
