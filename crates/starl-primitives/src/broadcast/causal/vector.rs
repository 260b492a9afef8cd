//! Up to where each sender's messages have been taken: a vector clock over robots' lives.
//!
//! Invariant: numbers only rise, but for one that no message can have brought about; and at most
//! [`LIVES`] lives of a robot are known: those that spoke last, and others that were heard of.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;
use starl_core::RobotId;

/// The lives of a robot that are remembered.
const LIVES: usize = 8;

/// A robot from one start to its next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Process {
    pub robot: RobotId,
    pub incarnation: u32,
}

/// That a message comes after those of a process up to this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct After {
    pub process: Process,
    pub number: u32,
}

/// What is known of a process.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    incarnation: u32,
    /// Messages up to this number were taken or passed over.
    pub taken: u32,
    /// Messages up to this number have arrived or never will.
    pub settled: u32,
    /// Whether any message of it was taken.
    pub is_joined: bool,
}

impl Known {
    fn nothing(incarnation: u32) -> Known {
        Known {
            incarnation,
            taken: 0,
            settled: 0,
            is_joined: false,
        }
    }
}

/// All processes that were heard of.
#[derive(Clone, Debug, Default)]
pub(super) struct Vector(BTreeMap<RobotId, SmallVec<[Known; 1]>>);

impl Vector {
    /// What is known of a process; nothing, if it was not heard of.
    pub fn get(&self, process: Process) -> Option<&Known> {
        let lives = self.0.get(&process.robot)?;
        let mut lives = lives.iter();
        lives.find(|known| known.incarnation == process.incarnation)
    }

    /// Whether so many lives of its robot are known that this one, which is not, must be over.
    pub fn is_forgotten(&self, process: Process) -> bool {
        let lives = self.0.get(&process.robot);
        lives.is_some_and(|lives| lives.len() == LIVES) && self.get(process).is_none()
    }

    /// Whether messages up to this number were taken or passed over.
    pub fn is_taken(&self, process: Process, number: u32) -> bool {
        let taken = self.get(process).map_or(0, |known| known.taken);
        taken >= number
    }

    /// What is known of a process, which speaks now.
    pub fn hear(&mut self, process: Process) -> &mut Known {
        let Process { robot, incarnation } = process;
        let lives = self.0.entry(robot).or_default();
        let mut places = lives.iter();
        let place = places.position(|known| known.incarnation == incarnation);
        let known = match place {
            Some(place) => lives.remove(place),
            None => Known::nothing(incarnation),
        };
        if lives.len() == LIVES {
            lives.remove(0);
        }
        lives.push(known);
        let last = lives.len() - 1;
        &mut lives[last]
    }

    /// What is known of a process that others speak of; none if it is forgotten.
    pub fn note(&mut self, process: Process) -> Option<&mut Known> {
        let Process { robot, incarnation } = process;
        let lives = self.0.entry(robot).or_default();
        let mut places = lives.iter();
        let place = places.position(|known| known.incarnation == incarnation);
        if place.is_none() && lives.len() < LIVES {
            lives.insert(0, Known::nothing(incarnation));
        }
        lives
            .get_mut(place.unwrap_or(0))
            .filter(|known| known.incarnation == incarnation)
    }

    /// What a message that is sent now comes after.
    pub fn now(&self) -> Vec<After> {
        let all = self.0.iter().flat_map(|(&robot, lives)| {
            lives.iter().map(move |known| After {
                process: Process {
                    robot,
                    incarnation: known.incarnation,
                },
                number: known.taken,
            })
        });
        all.filter(|after| after.number > 0).collect()
    }

    /// All that is known, for a fault to overwrite.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Known> {
        self.0.values_mut().flatten()
    }
}
