//! The progress of a robot that has just started: its stage, and the robots that it has heard in
//! it.
//!
//! See the module `recovery` for when a stage is over, and why.

use crate::founders::Founders;
use alloc::collections::BTreeMap;
use alloc::string::String;
use starl_core::{Duration, RobotId, Time};

/// Whether a robot answers others.
#[derive(Clone, Debug)]
pub(super) enum Standing {
    /// Not yet.
    New(Entering),
    /// In the life with this number.
    Up(u64),
}

/// For so long a robot that is up and not heard any more may be up still.
const LASTING: Duration = Duration::from_seconds(10);

/// How far a robot is that has just started.
#[derive(Clone, Debug, Default)]
pub(super) struct Entering {
    /// How many stages it has begun.
    pub stages: u32,
    /// In the second stage the number of its new life.
    pub life: Option<u64>,
    /// The greatest number of its earlier lives that others knew.
    pub told: u64,
    /// When it began, by its own clock; none if it has not.
    pub begun: Option<Time>,
    /// The robots that had just started in the first stage, with their incarnations.
    pub new_before: BTreeMap<RobotId, u32>,
    /// The knowledge of others in this stage.
    pub heard: BTreeMap<RobotId, Heard>,
    pub repetitions: u32,
    /// When this robot heard one that is up.
    pub heard_up: Option<Time>,
    /// When one that has just started too said that it had.
    pub told_up: Option<Time>,
    /// As a robot that is up has told, if this robot is one of them.
    pub founders: Founders,
}

/// A new robot's knowledge of another one.
#[derive(Clone, Debug)]
pub(super) enum Heard {
    /// It has just started too, in this incarnation.
    New(u32),
    /// It is up.
    Up {
        life: u64,
        /// Its copies up to this register have come.
        after: Option<String>,
        /// Everything that is wanted of it in this stage has come.
        is_done: bool,
    },
}

impl Default for Standing {
    fn default() -> Standing {
        Standing::New(Entering::default())
    }
}

impl Standing {
    /// The life in which the robot answers; 0 if it does not.
    pub fn life(&self) -> u64 {
        match self {
            Standing::New(_) => 0,
            Standing::Up(life) => *life,
        }
    }
}

fn is_recent(heard: Option<Time>, now: Time) -> bool {
    heard.is_some_and(|heard| heard <= now && now.since(heard) < LASTING)
}

impl Entering {
    pub fn next_stage(&mut self, life: Option<u64>) {
        let heard = core::mem::take(&mut self.heard).into_iter();
        let new = heard.filter_map(|(peer, heard)| match heard {
            Heard::New(incarnation) => Some((peer, incarnation)),
            Heard::Up { .. } => None,
        });
        self.new_before = match life {
            Some(_) => new.collect(),
            None => BTreeMap::new(),
        };
        self.life = life;
        self.stages = self.stages.wrapping_add(1);
        self.repetitions = 0;
    }

    /// Whether a robot that has just started had done so in the first stage already.
    pub fn is_new(&self, peer: RobotId, incarnation: u32) -> bool {
        self.life.is_none() || self.new_before.get(&peer) == Some(&incarnation)
    }

    /// The robots that had just started when the fleet began, if it begins now or another robot has told so. Those heard
    /// in the first stage count, because they ask as the same ones later.
    pub fn founders(&mut self) -> Founders {
        let begins = |heard: &Heard| matches!(heard, Heard::New(_));
        if self.founders.is_empty() && self.heard.values().all(begins) {
            return Founders::new(core::mem::take(&mut self.new_before));
        }
        core::mem::take(&mut self.founders)
    }

    /// Whether this robot has heard one that is up, lately.
    pub fn hears_up(&self, now: Time) -> bool {
        is_recent(self.heard_up, now)
    }

    /// Whether the fleet may be new, as far as robots that are up have been heard. A robot does not pass on what others have
    /// heard, or it would never end.
    pub fn may_begin(&self, now: Time) -> bool {
        !is_recent(self.heard_up, now) && !is_recent(self.told_up, now)
    }

    /// Whether this stage has ended; `majority` of `others` participants and this one are a majority. `may_begin` if the
    /// fleet may be new.
    pub fn is_over(&self, others: usize, majority: usize, may_begin: bool) -> bool {
        let (mut up, mut new, mut unfinished) = (0, 0, 0);
        for (&peer, heard) in &self.heard {
            match heard {
                Heard::Up { is_done: true, .. } => up += 1,
                Heard::New(incarnation) if self.is_new(peer, *incarnation) => new += 1,
                _ => unfinished += 1,
            }
        }
        !self.founders.is_empty()
            || up >= majority
            || up + new == others
            || up + unfinished == 0 && new + 1 >= majority && may_begin
    }
}
