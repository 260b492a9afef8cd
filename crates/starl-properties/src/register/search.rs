//! Decides online whether a history of one register is linearizable.
//!
//! The search is that of Wing and Gong (1993, "Testing and Verifying Concurrent Objects"): it looks for an order of the
//! operations that agrees with their times and in which each read returns the last write. It advances in time, decides
//! only at the end of an operation which operations have taken effect (just-in-time linearization), and keeps the
//! possibilities as a set of configurations (Lowe 2017, "Testing for Linearizability").
//!
//! Ours differs because this is a register: reads change nothing, so they are not ordered. Each configuration contains,
//! for every current read, the values since its begin. A write takes effect only when it ends or a read shows it: now,
//! or just before the last write that took effect, which has overwritten it at once. So the number of configurations
//! does not grow with the number of orders of concurrent writes.
//!
//! An update replaces one value by another, and can take effect only while the register has the first. Then the order
//! matters, so once a register was updated all orders of the current operations are tried. These are few, because an
//! update must find its value.

use std::collections::{BTreeMap, BTreeSet};

/// At most this many configurations are kept.
const MOST_CONFIGURATIONS: usize = 4096;

/// The content of a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Content {
    /// Nothing was written.
    Nothing,
    /// A value, as a hash.
    Value(i64),
}

/// Names an operation.
pub(super) type Id = u64;

/// The verdict on a history so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// It is linearizable.
    Possible,
    /// It is not.
    Impossible,
    /// Too many operations were concurrent to decide in a reasonable time.
    Unknown,
}

/// One way in which things may stand.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Configuration {
    content: Content,
    /// The writes under way that have taken effect.
    effective: BTreeSet<Id>,
    /// For each read under way what it may give.
    possible: BTreeMap<Id, BTreeSet<Content>>,
    /// When a write last took effect; 0 where that does not matter any more.
    changed: Moment,
}

/// Counts what has happened.
type Moment = u64;

/// A write under way.
#[derive(Clone, Copy, Debug)]
struct Write {
    value: i64,
    begun: Moment,
    /// Whether its end is not to come.
    is_abandoned: bool,
}

/// A history of one register.
#[derive(Clone, Debug)]
pub(super) struct Search {
    configurations: BTreeSet<Configuration>,
    now: Moment,
    writes: BTreeMap<Id, Write>,
    /// Which of these are updates, and of what; those that will not end stay here as long as there.
    updated: BTreeMap<Id, Content>,
    /// Whether there has ever been an update.
    has_updates: bool,
    /// The reads under way, and when they began.
    reads: BTreeMap<Id, Moment>,
    verdict: Verdict,
}

impl Configuration {
    fn become_(&mut self, value: i64, now: Moment) {
        self.content = Content::Value(value);
        self.changed = now;
        for possible in self.possible.values_mut() {
            possible.insert(self.content);
        }
    }
}

impl Default for Search {
    /// A register before its first write.
    fn default() -> Search {
        Search::holding(Content::Nothing)
    }
}

impl Search {
    /// A register that holds this.
    pub fn holding(content: Content) -> Search {
        let first = Configuration {
            content,
            effective: BTreeSet::new(),
            possible: BTreeMap::new(),
            changed: 0,
        };
        Search {
            configurations: BTreeSet::from([first]),
            now: 0,
            writes: BTreeMap::new(),
            updated: BTreeMap::new(),
            has_updates: false,
            reads: BTreeMap::new(),
            verdict: Verdict::Possible,
        }
    }

    /// The verdict. Once it is "not linearizable" or "unknown", it stays so.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    pub fn write_begins(&mut self, id: Id, value: i64) {
        self.now += 1;
        let write = Write {
            value,
            begun: self.now,
            is_abandoned: false,
        };
        self.writes.insert(id, write);
    }

    /// An update begins, which replaces the value that was found.
    pub fn update_begins(&mut self, id: Id, found: Content, value: i64) {
        self.has_updates = true;
        self.updated.insert(id, found);
        self.write_begins(id, value);
    }

    /// An update has not taken effect and will not.
    pub fn update_is_lost(&mut self, id: Id) {
        self.writes.remove(&id);
        self.updated.remove(&id);
        let configurations = core::mem::take(&mut self.configurations);
        let is_without = |configuration: &Configuration| !configuration.effective.contains(&id);
        self.keep(configurations.into_iter().filter(is_without).collect());
    }

    pub fn read_begins(&mut self, id: Id) {
        self.now += 1;
        self.reads.insert(id, self.now);
        let configurations = core::mem::take(&mut self.configurations);
        let with_read = configurations.into_iter().map(|mut configuration| {
            let now = BTreeSet::from([configuration.content]);
            configuration.possible.insert(id, now);
            configuration
        });
        self.configurations = with_read.collect();
    }

    /// The operation will not end: its robot has crashed, or has withdrawn it. A write may still take
    /// effect.
    pub fn is_abandoned(&mut self, id: Id) {
        if let Some(write) = self.writes.get_mut(&id) {
            write.is_abandoned = true;
        }
        if self.reads.remove(&id).is_some() {
            let configurations = core::mem::take(&mut self.configurations);
            let without = configurations.into_iter().map(|mut configuration| {
                configuration.possible.remove(&id);
                configuration
            });
            self.configurations = without.collect();
        }
    }

    pub fn write_ends(&mut self, id: Id) {
        if self.has_updates {
            let next = self.after_any(|configuration| configuration.effective.remove(&id));
            self.writes.remove(&id);
            self.updated.remove(&id);
            return self.keep_if_known(next);
        }
        self.now += 1;
        let Some(write) = self.writes.remove(&id) else {
            return;
        };
        let mut next = BTreeSet::new();
        for mut configuration in core::mem::take(&mut self.configurations) {
            if configuration.effective.remove(&id) {
                next.insert(configuration);
            } else {
                self.take_effect(configuration, write, write.begun, &mut next);
            }
        }
        self.keep_if_few(next);
    }

    pub fn read_ends(&mut self, id: Id, result: Content) {
        let Some(begun) = self.reads.remove(&id) else {
            return;
        };
        self.now += 1;
        if self.has_updates {
            let next = self.after_any(|configuration| {
                let possible = configuration.possible.remove(&id);
                possible.is_some_and(|possible| possible.contains(&result))
            });
            return self.keep_if_known(next);
        }
        let mut next = BTreeSet::new();
        for mut configuration in core::mem::take(&mut self.configurations) {
            let possible = configuration.possible.remove(&id).unwrap_or_default();
            if possible.contains(&result) {
                next.insert(configuration);
                continue;
            }
            let can_take_effect = |(id, write): (&Id, &Write)| {
                let is_it = Content::Value(write.value) == result;
                (is_it && !configuration.effective.contains(id)).then_some((*id, *write))
            };
            let candidates = self.writes.iter().filter_map(can_take_effect);
            let candidates: Vec<(Id, Write)> = candidates.collect();
            for (id, write) in candidates {
                let mut effective = configuration.clone();
                effective.effective.insert(id);
                self.take_effect(effective, write, begun.max(write.begun), &mut next);
            }
        }
        self.keep_if_few(next);
    }

    /// The possible states after any pending operations have taken effect, in any order, so that it `fits`;
    /// none if there are too many.
    fn after_any(
        &mut self,
        fits: impl Fn(&mut Configuration) -> bool,
    ) -> Option<BTreeSet<Configuration>> {
        let mut found = core::mem::take(&mut self.configurations);
        let mut left: Vec<Configuration> = found.iter().cloned().collect();
        while let Some(configuration) = left.pop() {
            for (id, &Write { value, begun, .. }) in &self.writes {
                let finds = self.updated.get(id);
                let can = finds.is_none_or(|finds| *finds == configuration.content);
                if can && !configuration.effective.contains(id) {
                    let mut then = configuration.clone();
                    then.effective.insert(*id);
                    // A write from before the first update may have been overwritten before it.
                    if finds.is_none() && then.changed > begun {
                        let overwritten = self.with_overwritten(then.clone(), value);
                        if found.insert(overwritten.clone()) {
                            left.push(overwritten);
                        }
                    }
                    then.become_(value, 0);
                    if found.insert(then.clone()) {
                        left.push(then);
                    }
                }
            }
            if found.len() > MOST_CONFIGURATIONS {
                return None;
            }
        }
        let fitting = found.into_iter().filter_map(|mut configuration| {
            let does = fits(&mut configuration);
            does.then_some(configuration)
        });
        Some(fitting.collect())
    }

    fn keep_if_known(&mut self, next: Option<BTreeSet<Configuration>>) {
        match next {
            Some(next) => self.keep(next),
            None => self.give_up(),
        }
    }

    /// A write took effect just before the last one, and only reads that were under way then may have seen it.
    fn with_overwritten(&self, mut configuration: Configuration, value: i64) -> Configuration {
        for (read, possible) in &mut configuration.possible {
            if self
                .reads
                .get(read)
                .is_some_and(|&begun| begun < configuration.changed)
            {
                possible.insert(Content::Value(value));
            }
        }
        configuration
    }

    /// A write takes effect: now, or just before the last one, if that took effect after the moment `since`.
    fn take_effect(
        &self,
        mut configuration: Configuration,
        Write { value, .. }: Write,
        since: Moment,
        next: &mut BTreeSet<Configuration>,
    ) {
        if configuration.changed > since {
            next.insert(self.with_overwritten(configuration.clone(), value));
        }
        configuration.become_(value, self.now);
        next.insert(configuration);
    }

    fn keep_if_few(&mut self, mut next: BTreeSet<Configuration>) {
        // Of those that differ only in when a write last took effect, the last in order leaves the most possible.
        let mut following = next.iter().skip(1);
        let is_less = |one: &Configuration| {
            following.next().is_some_and(|other| {
                (&one.content, &one.effective, &one.possible)
                    == (&other.content, &other.effective, &other.possible)
            })
        };
        let less: Vec<bool> = next.iter().map(is_less).collect();
        let mut less = less.into_iter();
        next.retain(|_| !less.next().unwrap_or(false));
        match next.len() > MOST_CONFIGURATIONS {
            true => self.give_up(),
            false => self.keep(next),
        }
    }

    fn give_up(&mut self) {
        self.configurations.clear();
        self.verdict = Verdict::Unknown;
    }

    fn keep(&mut self, next: BTreeSet<Configuration>) {
        if next.is_empty() && self.verdict == Verdict::Possible {
            self.verdict = Verdict::Impossible;
        }
        // Of writes that will not end, those that have taken effect everywhere are done with.
        let is_effective = |id: &Id| next.iter().all(|c| c.effective.contains(id));
        let done = self
            .writes
            .iter()
            .filter(|(id, write)| write.is_abandoned && is_effective(id));
        let done: BTreeSet<Id> = done.map(|(&id, _)| id).collect();
        self.writes.retain(|id, _| !done.contains(id));
        self.updated.retain(|id, _| !done.contains(id));
        let writes = self.writes.values().map(|write| write.begun);
        let oldest = self.reads.values().copied().chain(writes).min();
        let lean = next.into_iter().map(|mut configuration| {
            configuration.effective.retain(|id| !done.contains(id));
            // It matters only to operations that began before.
            if oldest.is_none_or(|oldest| configuration.changed <= oldest) {
                configuration.changed = 0;
            }
            configuration
        });
        self.configurations = lean.collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::Random;

    /// An operation of a history: when it begins and ends, if it does, and the value.
    #[derive(Clone, Copy, Debug)]
    struct Operation {
        begin: u32,
        end: Option<u32>,
        /// When it is known that it will not end.
        abandoned: Option<u32>,
        is_write: bool,
        /// The value that an update finds.
        found: Option<i64>,
        value: i64,
    }

    fn judge(history: &[Operation]) -> Verdict {
        let mut search = Search::default();
        let all = || history.iter().enumerate();
        let begins = all().map(|(id, o)| (o.begin, id, true));
        let ends = all().filter_map(|(id, o)| Some((o.end.or(o.abandoned)?, id, false)));
        let mut events: Vec<(u32, usize, bool)> = begins.chain(ends).collect();
        events.sort_unstable();
        for (_, id, is_begin) in events {
            let operation = history[id];
            if !is_begin && operation.end.is_none() {
                search.is_abandoned(id as Id);
                continue;
            }
            let content = |value: i64| match value {
                0 => Content::Nothing,
                value => Content::Value(value),
            };
            let result = content(operation.value);
            let id = id as Id;
            match (operation.is_write, is_begin) {
                (true, true) if let Some(found) = operation.found => {
                    search.update_begins(id, content(found), operation.value);
                }
                (true, true) => search.write_begins(id, operation.value),
                (true, false) => search.write_ends(id),
                (false, true) => search.read_begins(id),
                (false, false) => search.read_ends(id, result),
            }
        }
        search.verdict()
    }

    /// Tries all orders.
    fn is_linearizable(history: &[Operation], done: u32, value: i64) -> bool {
        let left = |id: &usize| done >> id & 1 == 0;
        let mut rest = (0..history.len()).filter(left);
        if rest.all(|id| history[id].end.is_none()) {
            return true;
        }
        (0..history.len()).filter(left).any(|id| {
            let first = history[id];
            let mut others = (0..history.len()).filter(left);
            let is_next =
                others.all(|other| history[other].end.is_none_or(|end| end > first.begin));
            let fits = match first.is_write {
                true => first.found.is_none_or(|found| found == value),
                false => first.value == value || first.end.is_none(),
            };
            let then = if first.is_write { first.value } else { value };
            is_next && fits && is_linearizable(history, done | 1 << id, then)
        })
    }

    #[test]
    fn it_agrees_with_trying_all_orders() {
        let (mut good, mut bad) = (0, 0);
        for seed in 0..40_000 {
            let has_updates = seed % 2 == 1;
            let mut random = Random::keyed(seed, &[]);
            let count = 2 + random.below(5);
            // All times differ.
            let mut times: Vec<u32> = (0..2 * count).collect();
            for index in (1..times.len()).rev() {
                times.swap(index, random.below(index as u32 + 1) as usize);
            }
            let history: Vec<Operation> = times
                .chunks(2)
                .map(|pair| {
                    let is_write = random.chance(0.5);
                    let is_update = has_updates && is_write && random.chance(0.7);
                    let (begin, end) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
                    let ends = random.chance(0.75);
                    let is_abandoned = !ends && random.chance(0.7);
                    Operation {
                        found: is_update.then(|| i64::from(random.below(3))),
                        begin,
                        end: ends.then_some(end),
                        abandoned: is_abandoned.then_some(end),
                        is_write,
                        // Values occur more than once.
                        value: i64::from(random.below(3) + u32::from(is_write)),
                    }
                })
                .collect();
            let expected = match is_linearizable(&history, 0, 0) {
                true => Verdict::Possible,
                false => Verdict::Impossible,
            };
            assert_eq!(judge(&history), expected, "seed {seed}: {history:?}");
            *(if expected == Verdict::Possible {
                &mut good
            } else {
                &mut bad
            }) += 1;
        }
        assert!(good > 6000 && bad > 6000, "{good} good, {bad} bad");
    }

    #[test]
    fn a_read_may_show_the_write_of_a_crashed_robot_that_another_write_has_overwritten() {
        let mut search = Search::default();
        search.write_begins(0, 1);
        search.write_begins(1, 2);
        search.read_begins(2);
        search.is_abandoned(0);
        search.write_ends(1);
        search.read_ends(2, Content::Value(1));
        search.read_begins(3);
        search.read_ends(3, Content::Value(2));
        assert_eq!(search.verdict(), Verdict::Possible);
        search.read_begins(4);
        search.read_ends(4, Content::Value(1));
        assert_eq!(
            search.verdict(),
            Verdict::Impossible,
            "it cannot take effect twice"
        );
    }

    #[test]
    fn an_update_reported_as_lost_must_not_be_seen() {
        for is_read in [false, true] {
            let mut search = Search::default();
            search.update_begins(0, Content::Nothing, 1);
            if is_read {
                search.read_begins(1);
                search.read_ends(1, Content::Value(1));
            }
            search.update_is_lost(0);
            let expected = match is_read {
                true => Verdict::Impossible,
                false => Verdict::Possible,
            };
            assert_eq!(search.verdict(), expected);
        }
    }

    #[test]
    fn one_of_two_updates_of_the_same_is_lost() {
        let mut search = Search::default();
        search.update_begins(0, Content::Nothing, 1);
        search.update_begins(1, Content::Nothing, 2);
        search.write_ends(1);
        assert_eq!(search.verdict(), Verdict::Possible);
        search.write_ends(0);
        assert_eq!(search.verdict(), Verdict::Impossible);
    }

    #[test]
    fn it_says_so_when_it_would_take_too_long() {
        let mut search = Search::default();
        (0..40).for_each(|id| search.write_begins(id, id as i64));
        search.update_begins(40, Content::Nothing, 40);
        search.write_ends(7);
        assert_eq!(search.verdict(), Verdict::Unknown);
    }

    #[test]
    fn many_robots_that_write_and_read_at_once_are_judged() {
        for is_wrong in [false, true] {
            let mut search = Search::default();
            let mut random = Random::keyed(1, &[]);
            let (mut last, mut content) = (0, Content::Nothing);
            for _ in 0..200 {
                // All begin at once and end one by one. One in three reads, and the others write new values.
                let mut under_way: Vec<Id> = (last + 1..=last + 30).collect();
                last += 30;
                for &id in &under_way {
                    match id % 3 {
                        0 => search.read_begins(id),
                        _ => search.write_begins(id, id as i64),
                    }
                }
                while !under_way.is_empty() {
                    let next = random.below(under_way.len() as u32) as usize;
                    let id = under_way.swap_remove(next);
                    if id.is_multiple_of(3) {
                        search.read_ends(id, content);
                    } else {
                        content = Content::Value(id as i64);
                        search.write_ends(id);
                    }
                }
            }
            if is_wrong {
                search.read_begins(last + 1);
                search.read_ends(last + 1, Content::Value(1));
            }
            let expected = match is_wrong {
                true => Verdict::Impossible,
                false => Verdict::Possible,
            };
            assert_eq!(search.verdict(), expected);
        }
    }

    #[test]
    fn writes_that_never_end_cost_nothing() {
        let mut search = Search::default();
        for id in 0..1000 {
            search.write_begins(id, id as i64);
            search.is_abandoned(id);
        }
        search.read_begins(5000);
        search.read_ends(5000, Content::Value(600));
        search.read_begins(5001);
        search.read_ends(5001, Content::Value(3));
        search.write_begins(5002, -1);
        search.write_ends(5002);
        assert_eq!(search.verdict(), Verdict::Possible);
        search.read_begins(5003);
        search.read_ends(5003, Content::Value(600));
        assert_eq!(search.verdict(), Verdict::Impossible);
    }
}
