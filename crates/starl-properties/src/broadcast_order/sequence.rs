//! Total order: no two robots deliver two messages in different orders; and between two messages that a robot delivers
//! directly after each other, without reporting a gap, no robot delivers another one.

use super::{Finding, TOTAL};
use crate::report::MessageKey;
use starl_core::RobotId;
use std::collections::{BTreeMap, VecDeque};

/// The number of latest messages of each robot that are compared with those of others.
const WINDOW: usize = 2048;

/// The runs of robots that have ended that are compared with others, the latest.
const ENDED: usize = 32;

/// The deliveries of a robot since its start.
#[derive(Clone, Debug, Default)]
struct Run {
    robot: Option<RobotId>,
    /// Which message has which place.
    places: BTreeMap<MessageKey, u64>,
    window: VecDeque<MessageKey>,
    count: u64,
    /// The last one, unless there is a gap after it.
    last: Option<MessageKey>,
    /// By the other run: the last place here of a message that both delivered.
    common: BTreeMap<u64, u64>,
}

/// The deliveries of all robots.
#[derive(Clone, Debug, Default)]
pub(super) struct Sequences {
    /// By a number that each run gets.
    runs: BTreeMap<u64, Run>,
    present: BTreeMap<RobotId, u64>,
    ended: VecDeque<u64>,
    next_run: u64,
    /// Which message comes next after one, by the robot that was first handed both.
    next: BTreeMap<MessageKey, (MessageKey, RobotId)>,
    remembered: VecDeque<MessageKey>,
}

impl Sequences {
    /// The robot has stopped.
    pub fn end(&mut self, robot: RobotId) {
        if let Some(run) = self.present.remove(&robot) {
            self.ended.push_back(run);
        }
        while self.ended.len() > ENDED
            && let Some(run) = self.ended.pop_front()
        {
            self.runs.remove(&run);
            self.runs.values_mut().for_each(|other| {
                other.common.remove(&run);
            });
        }
    }

    /// The robot may miss messages here.
    pub fn gap(&mut self, robot: RobotId) {
        if let Some(run) = self
            .present
            .get(&robot)
            .and_then(|run| self.runs.get_mut(run))
        {
            run.last = None;
        }
    }

    pub fn handed(&mut self, robot: RobotId, key: MessageKey, finding: &mut Finding<'_>) {
        let number = *self.present.entry(robot).or_insert_with(|| {
            self.next_run += 1;
            self.next_run
        });
        let mut run = self.runs.remove(&number).unwrap_or_default();
        run.robot = Some(robot);
        run.count += 1;
        let place = run.count;
        for (&other_number, other) in &mut self.runs {
            let Some(&there) = other.places.get(&key) else {
                continue;
            };
            // The place there, and here, of the last message that both delivered.
            let last_there = other.common.get(&number).copied();
            if last_there.is_some_and(|last| last >= there) {
                let other = other.robot.unwrap_or(robot);
                let text = format!(
                    "delivered message {} of robot {} after one that robot {other} delivered later",
                    key.number, key.from
                );
                finding.add(TOTAL, other, text);
            }
            let last = other.common.entry(number).or_insert(there);
            *last = (*last).max(there);
            run.common.insert(other_number, place);
        }
        if let Some(last) = run.last.replace(key) {
            self.follows(last, key, robot, finding);
        }
        run.places.insert(key, place);
        run.window.push_back(key);
        if run.window.len() > WINDOW
            && let Some(oldest) = run.window.pop_front()
        {
            run.places.remove(&oldest);
        }
        self.runs.insert(number, run);
    }

    /// A robot delivered one message right after another.
    fn follows(
        &mut self,
        last: MessageKey,
        key: MessageKey,
        robot: RobotId,
        finding: &mut Finding<'_>,
    ) {
        match self.next.get(&last) {
            Some((next, other)) if *next != key => {
                let text = format!(
                    "delivered message {} of robot {} where robot {other} delivered message {} of \
                     robot {}",
                    key.number, key.from, next.number, next.from
                );
                finding.add(TOTAL, *other, text);
            }
            Some(_) => {}
            None => {
                self.next.insert(last, (key, robot));
                self.remembered.push_back(last);
                if self.remembered.len() > WINDOW
                    && let Some(oldest) = self.remembered.pop_front()
                {
                    self.next.remove(&oldest);
                }
            }
        }
    }
}
