//! States whose behaviours are all among those of a known state are not explored.
//!
//! A state *covers* another one if robots and checkers are the same, if each datagram in transit there is also in transit
//! here and not older, and if at least as much is left of each bound. A datagram may always be late for ever. So whatever
//! can happen there can happen here, and checkers see the same. (Steps are monotone in this order: Finkel and Schnoebelen
//! 2001, "Well-structured transition systems everywhere!". Karp and Miller 1969 cover the markings of Petri nets so.) A
//! state is only left out for one that is not further from the start, so the first violation found still has the fewest
//! steps.

use crate::actors::Actors;
use crate::bounds::Left;
use crate::code::Flying;
use crate::search::HEAD;
use crate::table::Rows;

/// The states that have the same robots and checkers, without those that another one covers.
#[derive(Clone)]
pub(crate) struct Covers {
    /// Rows of the checkers' state and those of the robots.
    groups: Rows,
    members: Vec<Vec<Member>>,
    key: Vec<u32>,
}

/// A state of a group.
#[derive(Clone, Copy)]
struct Member {
    number: u32,
    /// A bit for each datagram in transit; several share one.
    marks: u32,
}

/// A state as it is compared: its row, and what is left of the bounds.
#[derive(Clone, Copy)]
pub(crate) struct Candidate<'a> {
    row: &'a [u32],
    left: Left,
}

impl<'a> Candidate<'a> {
    /// The state with this row; `heads` are those of the search.
    pub fn of(row: &'a [u32], heads: &Rows) -> Candidate<'a> {
        let left = Left::read(&heads.row(row[0])[1..]);
        Candidate { row, left }
    }
}

impl Covers {
    pub fn new(robots: usize) -> Covers {
        Covers {
            groups: Rows::new(1 + robots, 0),
            members: Vec::new(),
            key: Vec::new(),
        }
    }

    /// The group of a state.
    pub fn group(&mut self, watch: u32, row: &[u32], actors: &Actors) -> u32 {
        self.key.clear();
        self.key.push(watch);
        let locals = row[HEAD..].iter().map(|&actor| actors.local(actor));
        self.key.extend(locals);
        let (group, is_new) = self.groups.insert(&self.key, &[]);
        if is_new {
            self.members.push(Vec::new());
        }
        group
    }

    /// A state of the group that covers this one. `state` gives the states by their numbers.
    pub fn find<'a>(
        &self,
        group: u32,
        new: Candidate<'_>,
        actors: &Actors,
        state: impl Fn(u32) -> Candidate<'a>,
    ) -> Option<u32> {
        let marks = actors.marks(&new.row[HEAD..]);
        let members = self.members[group as usize].iter();
        let mut covering = members
            .rev()
            .filter(|member| marks & !member.marks == 0)
            .filter(|member| covers(state(member.number), new, actors));
        covering.next().map(|member| member.number)
    }

    /// Adds a state to a group. Gives the states that it covers, which leave the group.
    pub fn add<'a>(
        &mut self,
        group: u32,
        number: u32,
        new: Candidate<'_>,
        actors: &Actors,
        state: impl Fn(u32) -> Candidate<'a>,
    ) -> Vec<u32> {
        let marks = actors.marks(&new.row[HEAD..]);
        let mut covered = Vec::new();
        let members = &mut self.members[group as usize];
        members.retain(|member| {
            let is_covered =
                member.marks & !marks == 0 && covers(new, state(member.number), actors);
            if is_covered {
                covered.push(member.number);
            }
            !is_covered
        });
        if members.len() == members.capacity() {
            // Doubling would leave a quarter of the room empty.
            members.reserve_exact(members.len() / 4 + 1);
        }
        members.push(Member { number, marks });
        covered
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        let members = self.members.iter().map(Vec::capacity).sum::<usize>() * size_of::<Member>();
        self.groups.bytes() + members + self.members.capacity() * size_of::<Vec<Member>>()
    }
}

/// Whether one state of a group covers another.
fn covers(one: Candidate<'_>, other: Candidate<'_>, actors: &Actors) -> bool {
    let mut robots = one.row[HEAD..].iter().zip(&other.row[HEAD..]);
    one.left.is_at_least(other.left)
        && robots
            .all(|(one, other)| one == other || holds(actors.mailbox(*one), actors.mailbox(*other)))
}

/// Whether each datagram of the other mailbox is also in this one, and not older. Both are in the order of age.
fn holds(one: &[u32], other: &[u32]) -> bool {
    if one.len() < other.len() {
        return false;
    }
    // The youngest first. Whatever is young enough for it is so for all that follow, so it does not matter which it takes.
    let mut taken = smallvec::SmallVec::<[bool; 32]>::from_elem(false, one.len());
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
