//! A set of message numbers that fills up from below.

use alloc::vec::Vec;
use core::ops::Range;

/// A set of numbers: all below one, and runs of later ones.
///
/// Invariant: the runs are in order, do not touch each other, and do not touch what is before them.
#[derive(Clone, Debug)]
pub(super) struct Runs {
    next: u32,
    ahead: Vec<Range<u32>>,
}

impl Runs {
    /// All numbers before `next`.
    pub fn before(next: u32) -> Runs {
        Runs {
            next,
            ahead: Vec::new(),
        }
    }

    /// The first number that is missing.
    pub fn next(&self) -> u32 {
        self.next
    }

    /// The runs after the first that is missing.
    pub fn ahead(&self) -> &[Range<u32>] {
        &self.ahead
    }

    pub fn contains(&self, number: u32) -> bool {
        let at = self.ahead.partition_point(|run| run.end <= number);
        number < self.next || self.ahead.get(at).is_some_and(|run| run.start <= number)
    }

    /// Adds a number.
    pub fn insert(&mut self, number: u32) {
        if self.contains(number) {
            return;
        }
        let end = number.saturating_add(1);
        let at = self.ahead.partition_point(|run| run.end < number);
        match self.ahead.get_mut(at) {
            Some(run) if run.end == number => run.end = end,
            Some(run) if run.start == end => run.start = number,
            _ => self.ahead.insert(at, number..end),
        }
        if let [run, after] = &self.ahead[at..(at + 2).min(self.ahead.len())]
            && run.end == after.start
        {
            self.ahead[at].end = after.end;
            self.ahead.remove(at + 1);
        }
        self.fill_to(self.next);
    }

    /// Adds all numbers before one.
    pub fn fill_to(&mut self, next: u32) {
        self.next = self.next.max(next);
        let joined = self.ahead.partition_point(|run| run.start <= self.next);
        if let Some(last) = self.ahead[..joined].last() {
            self.next = self.next.max(last.end);
        }
        self.ahead.drain(..joined);
        if self.ahead.is_empty() {
            self.ahead = Vec::new();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::collections::BTreeSet;
    use starl_core::Random;

    #[test]
    fn runs_agree_with_a_plain_set() {
        let mut random = Random::keyed(1, &[]);
        for _ in 0..200 {
            let mut runs = Runs::before(1);
            let mut set = BTreeSet::from([0]);
            for _ in 0..60 {
                let number = random.below(40);
                match random.chance(0.1) {
                    true => {
                        runs.fill_to(number);
                        set.extend(0..number);
                    }
                    false => {
                        runs.insert(number);
                        set.insert(number);
                    }
                }
                assert!(
                    (0..50).all(|n| runs.contains(n) == set.contains(&n)),
                    "{runs:?}"
                );
                let mut end = runs.next();
                for run in runs.ahead() {
                    assert!(end < run.start && run.start < run.end, "{runs:?}");
                    end = run.end;
                }
            }
        }
    }
}
