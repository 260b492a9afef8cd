//! How much may go wrong in the behaviours that are explored, and what time is in them.

use crate::code::Kind;
use serde::{Deserialize, Serialize};
use starl_core::Duration;

/// The bounds of an exploration. It visits all behaviours within them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bounds {
    /// Datagrams that get lost, at most; default 0. To safety a datagram that gets lost is one that
    /// never arrives, which is covered without losses; robots that wait for ever show only with them.
    pub losses: u8,
    /// The greatest number of extra copies of datagrams that arrive; default 0.
    pub duplicates: u8,
    /// Whether each sent datagram may arrive any number of times, or never: at any later time, or within the delay
    /// bound of [`Clocks::Ticking`]. Losses and duplicates are then not counted. Only robots that wait for ever for a
    /// lost datagram are not found. Default false.
    #[serde(default)]
    pub any_copies: bool,
    /// Crashes, at most, of all robots together; each robot that is down may start again at any time, or
    /// never. Default 0.
    pub crashes: u8,
    /// False or true suspicions by failure detectors, and ends of suspicions, at most; default 0.
    pub suspicions: u8,
    /// Timers that fire, at most, of all robots together, or [`Bounds::ANY_NUMBER`]; default 1. With
    /// [`Clocks::Ticking`] timers are bounded by the time instead.
    pub timers: u8,
    /// The model of clocks.
    pub clocks: Clocks,
    /// States further than this many steps from the start are not explored; default none. A search that reaches this
    /// bound is not complete.
    pub depth: Option<u32>,
    /// The search stops when there are this many states, and is not complete then; default 10
    /// million.
    pub most_states: u32,
}

/// Models of time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Clocks {
    /// All clocks show zero, always, and a timer may fire at any time once it is armed.
    #[default]
    Still,
    /// Clocks advance in ticks. A timer fires at the first tick at which it is due, before the clock continues.
    Ticking {
        /// How long a tick is.
        tick: Duration,
        /// How many there are.
        ticks: u16,
        /// By how many ticks a robot's clock may be ahead of another's; at 0 all advance together.
        skew: u16,
        /// A datagram that has not arrived when it has been under way for more ticks than this is lost;
        /// 15 at most, default never. It counts the ticks that all clocks make together, so there is no such
        /// bound with a skew.
        delay: Option<u8>,
    },
}

impl Bounds {
    /// The value for timers without a bound: they fire any number of times.
    pub const ANY_NUMBER: u8 = u8::MAX;

    /// Whether a search visits states in the order of their distance from the start. With any copies it does so only
    /// where the distance is bounded.
    pub fn is_shortest_first(&self) -> bool {
        !self.any_copies || self.depth.is_some()
    }
}

impl Default for Bounds {
    fn default() -> Bounds {
        Bounds {
            losses: 0,
            duplicates: 0,
            any_copies: false,
            crashes: 0,
            suspicions: 0,
            timers: 1,
            clocks: Clocks::Still,
            depth: None,
            most_states: 10_000_000,
        }
    }
}

/// The remaining bounds on a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Left {
    pub losses: u8,
    pub duplicates: u8,
    pub crashes: u8,
    pub suspicions: u8,
    pub timers: u8,
}

impl Left {
    /// How many words it takes.
    pub const WORDS: usize = 2;

    pub fn of(bounds: &Bounds) -> Left {
        Left {
            losses: bounds.losses,
            duplicates: bounds.duplicates,
            crashes: bounds.crashes,
            suspicions: bounds.suspicions,
            timers: match bounds.clocks {
                Clocks::Still => bounds.timers,
                Clocks::Ticking { .. } => u8::MAX,
            },
        }
    }

    /// The bounds that remain after a step of this kind; none if the step would exceed them.
    pub fn after(self, kind: Kind, bounds: &Bounds) -> Option<Left> {
        let mut left = self;
        let budget = match kind {
            Kind::Lose => &mut left.losses,
            Kind::Duplicate if !bounds.any_copies => &mut left.duplicates,
            Kind::Crash => &mut left.crashes,
            Kind::Suspect | Kind::Trust => &mut left.suspicions,
            Kind::Timer
                if bounds.clocks == Clocks::Still && bounds.timers != Bounds::ANY_NUMBER =>
            {
                &mut left.timers
            }
            _ => return Some(self),
        };
        *budget = budget.checked_sub(1)?;
        Some(left)
    }

    /// Whether at least as much remains of each bound.
    pub fn is_at_least(self, other: Left) -> bool {
        self.losses >= other.losses
            && self.duplicates >= other.duplicates
            && self.crashes >= other.crashes
            && self.suspicions >= other.suspicions
            && self.timers >= other.timers
    }

    pub fn words(self) -> [u32; Left::WORDS] {
        let Left {
            losses,
            duplicates,
            crashes,
            suspicions,
            timers,
        } = self;
        let first = u32::from_le_bytes([losses, duplicates, crashes, suspicions]);
        [first, u32::from(timers)]
    }

    pub fn read(words: &[u32]) -> Left {
        let word = |index: usize| words.get(index).copied().unwrap_or_default();
        let [losses, duplicates, crashes, suspicions] = word(0).to_le_bytes();
        Left {
            losses,
            duplicates,
            crashes,
            suspicions,
            timers: word(1) as u8,
        }
    }
}
