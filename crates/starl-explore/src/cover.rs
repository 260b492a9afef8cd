//! States whose behaviours are all among those of a known state are not explored.
//!
//! A state *covers* another one if robots and checkers are the same, if each datagram in transit there is also in transit
//! here and not older, and if at least as much is left of each bound. A datagram may always be late for ever. So whatever
//! can happen there can happen here, and checkers see the same. (Steps are monotone in this order: Finkel and Schnoebelen
//! 2001, "Well-structured transition systems everywhere!". Karp and Miller 1969 cover the markings of Petri nets so.) A
//! state is only left out for one that is not further from the start, so the first violation found still has the fewest
//! steps.

use crate::actors::HEAD;
use crate::code::Flying;
use crate::facts::Facts;
use crate::table::Rows;
use smallvec::SmallVec;

/// The states that have the same robots and checkers, without those that another one covers.
#[derive(Clone)]
pub(crate) struct Covers {
    /// Rows of the checkers' state and those of the robots.
    groups: Rows,
    members: Vec<Members>,
    /// Members in memory of their own.
    outside: usize,
}

/// Small groups need no memory of their own.
type Members = SmallVec<[Member; 2]>;

/// A state of a group.
#[derive(Clone, Copy)]
struct Member {
    number: u32,
    /// A bit for each datagram in transit; several share one.
    marks: u32,
}

impl Covers {
    pub fn new(width: usize) -> Covers {
        Covers {
            groups: Rows::new(width, 0),
            members: Vec::new(),
            outside: 0,
        }
    }

    /// Adds a state to a group, unless it has one that covers it. `row_of` gives the rows of states by their numbers.
    ///
    /// Gives the states of the group that it covers, which leave the group.
    ///
    /// # Errors
    /// The state that covers it.
    pub fn add<'a>(
        &mut self,
        group: &[u32],
        row: &[u32],
        number: u32,
        facts: &Facts,
        row_of: impl Fn(u32) -> &'a [u32],
    ) -> Result<Vec<u32>, u32> {
        let (group, is_new) = self.groups.insert(group, &[]);
        if is_new {
            if self.members.len() == self.members.capacity() {
                self.members.reserve_exact(more(self.members.len()));
            }
            self.members.push(Members::new());
        }
        let marks = facts.marks(&row[HEAD..]);
        let members = &mut self.members[group as usize];
        let covering = members
            .iter()
            .rev()
            .find(|member| marks & !member.marks == 0 && covers(row_of(member.number), row, facts));
        if let Some(member) = covering {
            return Err(member.number);
        }
        let mut covered = Vec::new();
        members.retain(|&mut member| {
            let is_covered =
                member.marks & !marks == 0 && covers(row, row_of(member.number), facts);
            if is_covered {
                covered.push(member.number);
            }
            !is_covered
        });
        if members.len() == members.capacity() {
            let before = outside(members);
            members.reserve_exact(more(members.len()));
            self.outside += outside(members) - before;
        }
        members.push(Member { number, marks });
        Ok(covered)
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        self.groups.bytes()
            + self.outside * size_of::<Member>()
            + self.members.capacity() * size_of::<Members>()
    }
}

/// How many members there is memory for outside of the list itself.
fn outside(members: &Members) -> usize {
    match members.spilled() {
        true => members.capacity(),
        false => 0,
    }
}

/// How many more elements a list of this length gets memory for. Doubling would leave a quarter of the memory empty.
fn more(len: usize) -> usize {
    len / 8 + 1
}

/// Whether one state of a group covers another.
fn covers(one: &[u32], other: &[u32], facts: &Facts) -> bool {
    let left = |row: &[u32]| facts.left(row[0]);
    let mut robots = one[HEAD..].iter().zip(&other[HEAD..]);
    (one[0] == other[0] || left(one).is_at_least(left(other)))
        && robots
            .all(|(one, other)| one == other || holds(facts.mailbox(*one), facts.mailbox(*other)))
}

/// Whether each datagram of the other mailbox is also in this one, and not older. Both are in the order of age.
fn holds(one: &[u32], other: &[u32]) -> bool {
    if one.len() < other.len() {
        return false;
    }
    let mut rest = one.iter();
    if other.iter().all(|word| rest.any(|mine| mine == word)) {
        return true;
    }
    let has_ages = |mailbox: &[u32]| {
        mailbox
            .last()
            .is_some_and(|&word| Flying(word).number() != word)
    };
    (has_ages(one) || has_ages(other)) && holds_younger(one, other)
}

/// The same where equal datagrams may differ in age.
fn holds_younger(one: &[u32], other: &[u32]) -> bool {
    // The youngest first. Whatever is young enough for it is so for all that follow, so it does not matter which it takes.
    let mut taken = SmallVec::<[bool; 32]>::from_elem(false, one.len());
    other.iter().all(|&word| {
        let wanted = Flying(word).number();
        let is_it = |place: &usize| {
            !taken[*place] && Flying(one[*place]).number() == wanted && one[*place] <= word
        };
        let place = (0..one.len()).find(is_it);
        if let Some(place) = place {
            taken[place] = true;
        }
        place.is_some()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mailbox(datagrams: &[(u32, u8)]) -> Vec<u32> {
        let aged = datagrams.iter();
        let mut mailbox: Vec<u32> = aged
            .map(|&(number, age)| Flying::aged(number, age).0)
            .collect();
        mailbox.sort_unstable();
        mailbox
    }

    #[test]
    fn a_mailbox_holds_another_if_each_datagram_of_it_is_there_and_not_older() {
        let all = mailbox(&[(1, 0), (1, 2), (7, 1)]);
        for (other, is_held) in [
            (&[][..], true),
            (&[(7, 1)], true),
            (&[(7, 3)], true),
            (&[(7, 0)], false),
            (&[(2, 1)], false),
            (&[(1, 0), (1, 3)], true),
            (&[(1, 1), (1, 2)], true),
            (&[(1, 1), (1, 1)], false),
            (&[(7, 1), (7, 1)], false),
        ] {
            assert_eq!(holds(&all, &mailbox(other)), is_held, "{other:?}");
        }
    }
}
