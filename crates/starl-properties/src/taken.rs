//! The messages that robots have delivered, to detect a second delivery.
//!
//! Messages may be in any order. Their numbers are stored as intervals; a stream usually has one.

use super::report::MessageKey;
use starl_core::{Port, RobotId};
use std::collections::BTreeMap;
use std::ops::Range;

/// The number of lives of one stream that are kept. Earlier ones are not judged.
const MOST_RUNS: usize = 64;

/// The sent messages, and those that each robot has delivered in its present life.
#[derive(Clone, Debug, Default)]
pub(super) struct Taken {
    /// The last message of each stream.
    sent: BTreeMap<Stream, u32>,
    taken: BTreeMap<(RobotId, Stream), Vec<Range<u32>>>,
}

/// The messages that one life of a robot sends through one instance, to one robot if only to that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Stream {
    from: RobotId,
    port: Port,
    incarnation: u32,
    to: Option<RobotId>,
}

impl Stream {
    fn of(key: &MessageKey, to: Option<RobotId>) -> Stream {
        Stream {
            from: key.from,
            port: key.port,
            incarnation: key.incarnation,
            to,
        }
    }
}

impl Taken {
    /// A message is sent to all, or to one robot.
    pub fn sent(&mut self, key: &MessageKey, to: Option<RobotId>) {
        self.sent.insert(Stream::of(key, to), key.number);
    }

    /// A robot accepts a message that was sent to all, or to it alone. Returns the error, if any.
    pub fn take(
        &mut self,
        robot: RobotId,
        key: &MessageKey,
        to: Option<RobotId>,
    ) -> Option<&'static str> {
        let stream = Stream::of(key, to);
        if self.sent.get(&stream).is_none_or(|last| key.number > *last) {
            return Some("which was not sent");
        }
        let runs = self.taken.entry((robot, stream)).or_default();
        let is_new = insert(runs, key.number);
        if runs.len() > MOST_RUNS {
            runs.remove(0);
        }
        (!is_new).then_some("which it had taken before")
    }

    /// A robot has crashed: it has lost its state, and may deliver messages again.
    pub fn forget(&mut self, robot: RobotId) {
        self.taken.retain(|(receiver, _), _| *receiver != robot);
    }
}

/// Adds a number; whether it is new.
fn insert(runs: &mut Vec<Range<u32>>, number: u32) -> bool {
    let at = runs.partition_point(|run| run.end < number);
    let after = number.saturating_add(1);
    match runs.get_mut(at) {
        Some(run) if run.contains(&number) => return false,
        Some(run) if run.end == number => run.end = after,
        Some(run) if run.start == after => run.start = number,
        _ => runs.insert(at, number..after),
    }
    if let [run, next] = &runs[at..(at + 2).min(runs.len())]
        && run.end == next.start
    {
        runs[at].end = next.end;
        runs.remove(at + 1);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::Random;
    use std::collections::BTreeSet;

    #[test]
    fn runs_agree_with_a_plain_set() {
        let mut random = Random::keyed(1, &[]);
        for _ in 0..200 {
            let (mut runs, mut set) = (Vec::new(), BTreeSet::new());
            for _ in 0..60 {
                let number = random.below(40);
                assert_eq!(insert(&mut runs, number), set.insert(number), "{runs:?}");
                assert!(runs.is_sorted_by(|a, b| a.end < b.start), "{runs:?}");
            }
        }
    }
}
