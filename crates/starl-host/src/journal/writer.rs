//! Takes down what nodes show.

use super::batch::{Batch, Noted};
use super::change::{Change, Surroundings, same_body, same_fleet, same_places};
use super::knowledge::Knowledge;
use super::lists::{List, Lists};
use super::{Entry, Observed, encode};
use alloc::borrow::Cow;
use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_core::{RobotId, Time, View};

/// The journal of robots with successive numbers while it is being written. A clone continues exactly as the original
/// would.
///
/// It keeps the last readings of each robot's sensors, and one copy of each list that robots know.
#[derive(Clone, Debug)]
pub struct Journal {
    first: RobotId,
    writers: Vec<Writer>,
    lists: Lists,
    entries: Vec<Noted>,
}

/// The state that the writer of one robot's journal keeps.
#[derive(Clone, Debug, Default)]
struct Writer {
    known: Knowledge,
    /// The hash of the obstacles in `known`, once there was an entry.
    obstacles: Option<u64>,
}

impl Journal {
    /// The journal of `count` robots, the first of which has the number `first`.
    pub fn new(first: RobotId, count: usize) -> Journal {
        Journal {
            first,
            writers: alloc::vec![Writer::default(); count],
            lists: Lists::default(),
            entries: Vec::new(),
        }
    }

    /// Adds the robot with the next number, which has joined the fleet.
    pub fn join(&mut self) {
        self.writers.push(Writer::default());
    }

    /// Records a call of a robot's software at `at`, by the host's clock.
    ///
    /// # Panics
    /// If the robot is not one of this journal's.
    pub fn observe(&mut self, robot: RobotId, at: Time, observed: Observed<'_>) {
        let writer = &mut self.writers[(robot.0 - self.first.0) as usize];
        let entry = match observed {
            Observed::Started { random, saved } => Entry::Started {
                random: Cow::Borrowed(random),
                saved: saved.map(Cow::Borrowed),
            },
            Observed::Corrupted { random } => Entry::Corrupted {
                random: Cow::Borrowed(random),
            },
            Observed::Input {
                input,
                view,
                effects,
            } => {
                let mut change = Change::between(&writer.known, at, view);
                change.surroundings = writer.surroundings(view, &mut self.lists);
                change.note(&mut writer.known, at, view);
                Entry::Input {
                    input: Cow::Borrowed(input),
                    change,
                    effects: Cow::Borrowed(effects),
                }
            }
        };
        let entry = encode(&entry);
        self.entries.push(Noted { at, robot, entry });
    }

    /// Moves the records since the last call to the end of `batch`.
    pub fn append_to(&mut self, batch: &mut Batch) {
        batch.lists.append(&mut self.lists.fresh);
        batch.entries.append(&mut self.entries);
    }
}

impl Writer {
    /// The changes of the parts that rarely change. Lists are applied at once.
    fn surroundings(&mut self, view: &View<'_>, lists: &mut Lists) -> Option<Surroundings> {
        let known = &mut self.known;
        let mut changed = Surroundings {
            body: (!same_body(&known.body, &view.body)).then_some(view.body),
            ..Surroundings::default()
        };
        if !same_fleet(&known.fleet, view.fleet) {
            changed.fleet = Some(lists.share(List::Fleet(view.fleet.into()), known));
        }
        if !same_places(&known.way_points, view.way_points) {
            let list = List::WayPoints(view.way_points.into());
            changed.way_points = Some(lists.share(list, known));
        }
        if self.obstacles.is_none() || !Arc::ptr_eq(&known.obstacles, view.obstacles) {
            let hash = lists.share(List::Obstacles(view.obstacles.clone()), known);
            // Keeping the same list makes the next comparison free.
            known.obstacles = view.obstacles.clone();
            let is_new = self.obstacles.replace(hash) != Some(hash);
            changed.obstacles = is_new.then_some(hash);
        }
        let any = changed.body.is_some()
            || changed.fleet.is_some()
            || changed.way_points.is_some()
            || changed.obstacles.is_some();
        any.then_some(changed)
    }
}
