//! The last delivered message of each robot: a vector clock over robots' lives.
//!
//! The protocol below hears a robot's lives in order, so only the present one needs an entry: messages of earlier lives
//! will not be delivered any more. Invariant: no message of a life that is over is waited for, and no life is regarded
//! as over before this is known.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;
use starl_core::RobotId;

/// For this number of past lives of a robot the count of taken messages is stored. Forgotten counts are
/// queried again.
const PAST: usize = 16;

/// A robot from one start to its next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Process {
    pub robot: RobotId,
    pub incarnation: u32,
}

/// A dependency on the messages of a process up to this number; with 0, on all earlier lives of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct After {
    pub process: Process,
    pub number: u32,
}

/// The life of a robot that is heard.
#[derive(Clone, Copy, Debug)]
pub(super) struct Life {
    pub incarnation: u32,
    /// Messages up to this number were taken or passed over.
    pub taken: u32,
    /// Messages up to this number have arrived or never will.
    pub settled: u32,
    /// Whether any message of it was taken.
    pub is_joined: bool,
}

/// A life of which others speak, and that was not waited for any longer. It may be later than the present one.
#[derive(Clone, Copy, Debug)]
struct Unheard {
    incarnation: u32,
    /// Messages up to this number were passed over.
    passed: u32,
    /// Counts what had arrived when it was heard of.
    since: u64,
}

/// The lives of one robot.
#[derive(Clone, Debug, Default)]
struct Known {
    present: Option<Life>,
    /// Lives that are over, and how much was taken of each.
    past: SmallVec<[(u32, u32); 1]>,
    unheard: Vec<Unheard>,
}

impl Known {
    /// A life is over, and so much of it was taken or passed over.
    fn end(&mut self, incarnation: u32, taken: u32) {
        self.unheard
            .retain(|unheard| unheard.incarnation != incarnation);
        if let Some(past) = self.past.iter_mut().find(|past| past.0 == incarnation) {
            past.1 = past.1.max(taken);
            return;
        }
        if self.past.len() == PAST {
            self.past.remove(0);
        }
        self.past.push((incarnation, taken));
    }
}

/// How far a life has been heard.
#[derive(Clone, Copy, Debug)]
pub(super) enum Standing {
    /// It is heard.
    Present(Life),
    /// It is over: messages up to this number were taken or passed over.
    Over(u32),
    /// It is unknown whether the life is over or has not begun; messages up to this number were passed over.
    Unknown(Option<u32>),
}

/// The place of a life in the order of its robot's lives: only a life of a smaller rank may be earlier. Lives are heard
/// in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    Past(usize),
    /// It was never heard, and is earlier than the present life.
    Unheard,
    Present,
}

/// All robots that were heard of.
#[derive(Clone, Debug, Default)]
pub(super) struct Vector(BTreeMap<RobotId, Known>);

impl Vector {
    pub fn standing(&self, process: Process) -> Standing {
        let Some(known) = self.0.get(&process.robot) else {
            return Standing::Unknown(None);
        };
        let is_it = |incarnation: u32| incarnation == process.incarnation;
        if let Some(life) = known.present.filter(|life| is_it(life.incarnation)) {
            return Standing::Present(life);
        }
        if let Some((_, taken)) = known.past.iter().find(|past| is_it(past.0)) {
            return Standing::Over(*taken);
        }
        let mut unheard = known.unheard.iter();
        let unheard = unheard.find(|unheard| is_it(unheard.incarnation));
        Standing::Unknown(unheard.map(|unheard| unheard.passed))
    }

    /// The place of a life in the order of its robot's lives, if anything is known of it.
    pub fn rank(&self, process: Process) -> Option<Rank> {
        let known = self.0.get(&process.robot)?;
        let is_it = |incarnation: u32| incarnation == process.incarnation;
        if known.present.is_some_and(|life| is_it(life.incarnation)) {
            return Some(Rank::Present);
        }
        let place = known.past.iter().position(|past| is_it(past.0))?;
        Some(Rank::Past(place))
    }

    /// The life of a robot that is heard.
    pub fn present(&mut self, robot: RobotId) -> Option<&mut Life> {
        self.0.get_mut(&robot)?.present.as_mut()
    }

    /// Whether anything of a robot was ever taken.
    pub fn is_joined(&self, robot: RobotId) -> bool {
        let known = self.0.get(&robot);
        known.is_some_and(|known| {
            !known.past.is_empty() || known.present.is_some_and(|life| life.is_joined)
        })
    }

    /// A life of a robot is heard from now on; gives the one that is over with that.
    pub fn hear(&mut self, process: Process) -> Option<Process> {
        let Process { robot, incarnation } = process;
        let known = self.0.entry(robot).or_default();
        if known
            .present
            .is_some_and(|life| life.incarnation == incarnation)
        {
            return None;
        }
        let mut unheard = known.unheard.iter();
        let place = unheard.position(|unheard| unheard.incarnation == incarnation);
        let passed = place.map_or(0, |place| known.unheard.remove(place).passed);
        let before = known.present.replace(Life {
            incarnation,
            taken: passed,
            settled: 0,
            is_joined: false,
        });
        let before = before?;
        known.end(before.incarnation, before.taken);
        Some(Process {
            robot,
            incarnation: before.incarnation,
        })
    }

    /// Messages of a life that is over are passed over.
    pub fn end(&mut self, process: Process, number: u32) {
        let known = self.0.entry(process.robot).or_default();
        known.end(process.incarnation, number);
    }

    /// Messages of a life that is not heard are passed over.
    pub fn pass_over(&mut self, process: Process, number: u32, since: u64) {
        let known = self.0.entry(process.robot).or_default();
        let mut all = known.unheard.iter_mut();
        match all.find(|unheard| unheard.incarnation == process.incarnation) {
            Some(unheard) => unheard.passed = unheard.passed.max(number),
            None => known.unheard.push(Unheard {
                incarnation: process.incarnation,
                passed: number,
                since,
            }),
        }
    }

    /// A life of which messages were passed over, and which may be later than every life that was heard.
    pub fn unheard(&self, robot: RobotId) -> Option<After> {
        let mut unheard = self.0.get(&robot)?.unheard.iter();
        let passed = unheard.find(|unheard| unheard.passed > 0)?;
        Some(After {
            process: Process {
                robot,
                incarnation: passed.incarnation,
            },
            number: passed.passed,
        })
    }

    /// Lives of a robot that were heard of by then are over, except the present one. Says whether messages of one were
    /// passed over.
    pub fn forget_unheard(&mut self, robot: RobotId, by: u64) -> bool {
        let Some(known) = self.0.get_mut(&robot) else {
            return false;
        };
        let over = known.unheard.extract_if(.., |unheard| unheard.since <= by);
        let over: Vec<Unheard> = over.collect();
        over.iter()
            .for_each(|unheard| known.end(unheard.incarnation, unheard.passed));
        over.iter().any(|unheard| unheard.passed > 0)
    }

    /// The dependencies of a message that is sent now: for each robot its present life, and its earlier lives too until
    /// a message of the present one was delivered.
    pub fn now(&self) -> Vec<After> {
        let mut all = Vec::new();
        for (&robot, known) in &self.0 {
            let present = known
                .present
                .iter()
                .map(|life| (life.incarnation, life.taken));
            let is_silent = known.present.is_none_or(|life| life.taken == 0);
            let past = known.past.iter().copied();
            let past = past.filter(|(_, taken)| is_silent && *taken > 0);
            let unheard = known.unheard.iter();
            let unheard = unheard.map(|unheard| (unheard.incarnation, unheard.passed));
            all.extend(
                present
                    .chain(past)
                    .chain(unheard)
                    .map(|(incarnation, number)| After {
                        process: Process { robot, incarnation },
                        number,
                    }),
            );
        }
        all
    }

    /// The lives that are heard, for a fault to overwrite.
    pub fn lives_mut(&mut self) -> impl Iterator<Item = &mut Life> {
        let all = self.0.values_mut();
        all.filter_map(|known| known.present.as_mut())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_ends_no_life_that_was_heard_of_after_the_question() {
        let robot = RobotId(1);
        let life = |incarnation| Process { robot, incarnation };
        let mut vector = Vector::default();
        vector.pass_over(life(5), 3, 10);
        vector.pass_over(life(6), 4, 20);
        vector.forget_unheard(robot, 15);
        assert!(matches!(vector.standing(life(5)), Standing::Over(3)));
        let later = vector.standing(life(6));
        assert!(matches!(later, Standing::Unknown(Some(4))), "{later:?}");
    }
}
