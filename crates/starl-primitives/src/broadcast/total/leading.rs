//! The leader adds messages to the log, sends it to all, and determines which entries are decided.
//!
//! Invariant: an entry of the leader's term that a quorum of the voters has is decided, and with it all
//! before (Ongaro and Ousterhout 2014, section 5.4). The list of voters changes by one life at a time,
//! and only when the last change is decided, so that any quorum before intersects any quorum after it.

use super::followers::Leading;
use super::life::Life;
use super::packet::What;
use super::{CHUNK, Member, Role, Total};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::{Destination, Payload, Robot};

/// A leader that has not heard of a quorum for this many ticks leads no more.
const LONGEST_SILENCE: u32 = 8;

impl Total {
    /// This robot has been elected.
    pub(super) fn lead(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let mut roll = member.roll.clone();
        for index in member.applied + 1..=member.log.last() {
            if let Some(entry) = member.log.get(index) {
                roll.advance(&entry.what);
            }
        }
        member.leader = Some(life);
        member.silence = 0;
        member.is_active = true;
        let last = member.log.last();
        member.role = Role::Leading(Leading {
            age: 0,
            start: last + 1,
            sent: last,
            told: member.commit,
            past: [(member.log.base(), 0); 4],
            round: 0,
            calls: 0,
            followers: BTreeMap::new(),
            links: BTreeMap::new(),
            roll,
        });
        member.put(What::Start);
        let term = member.term;
        robot.report(self.port, BroadcastEvent::Lead { term });
        self.replicate(robot, true);
        self.propose_anew(robot);
    }

    /// A life has messages for the log, the oldest of which that still waits has this number.
    pub(super) fn put_messages(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        oldest: u32,
        messages: Vec<(u32, Payload)>,
    ) {
        let Some(member) = &mut self.member else {
            return;
        };
        for (number, content) in messages {
            let has_room = member.has_room();
            let Role::Leading(leading) = &member.role else {
                return;
            };
            let Some(last) = leading.roll.last(from) else {
                return; // it does not vote yet, or no longer
            };
            // Where an earlier message is missing or there is no room, it has to be proposed again.
            if number == oldest.max(last.saturating_add(1)) && has_room {
                let from = from.robot;
                member.put(What::Message {
                    from,
                    number,
                    content,
                });
            }
        }
        self.replicate(robot, false);
    }

    /// Sends new entries of the log to all, unless the last ones sent are not decided: then they are sent later
    /// together with the following entries, as soon as these fill a datagram. A beat is sent in any case.
    pub(super) fn replicate(&mut self, robot: &mut Robot<'_>, is_beat: bool) {
        self.decide(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        member.admit();
        let floor = member.floor();
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        let (sent, last) = (leading.sent, member.log.last());
        let may_send =
            is_beat || sent <= member.commit || member.log.size_between(sent, last) >= CHUNK;
        let has_news = leading.sent < member.log.last() && may_send;
        if !has_news && !is_beat && leading.told >= member.commit {
            return;
        }
        leading.round += 1;
        let previous = leading.sent;
        leading.told = member.commit;
        if has_news {
            leading.sent = member.log.last();
        }
        let last = leading.sent;
        let mut next = previous.max(member.log.base());
        loop {
            let Some(member) = &self.member else { return };
            let (body, end) = member.append_after(next, last, floor, is_beat);
            self.say(robot, Destination::All, body);
            if end == next || end >= last {
                break;
            }
            next = end;
        }
        let Some(member) = &mut self.member else {
            return;
        };
        member.log.drop_through(floor);
    }

    /// Sees what is decided.
    fn decide(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        if let Some(member) = &mut self.member
            && let Some(decided) = member.decided(life)
        {
            member.commit = decided;
            self.apply(robot);
        }
    }

    /// A leader's tick.
    pub(super) fn beat(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        leading.age = leading.age.saturating_add(1);
        for follower in leading.followers.values_mut() {
            follower.silence = follower.silence.saturating_add(1);
        }
        let near = leading.followers.values().filter(|f| f.silence <= 2);
        let mut near: BTreeSet<Life> = near.map(|f| f.life).collect();
        near.insert(life);
        if member.is_quorum(&near) {
            member.silence = 0;
        } else if member.silence >= LONGEST_SILENCE {
            member.role = Role::Following;
            member.leader = None;
            return;
        }
        self.replicate(robot, true);
        self.review_links(robot);
        if let Some(member) = &mut self.member
            && let Role::Leading(leading) = &mut member.role
        {
            leading.past.rotate_left(1);
            leading.past[3] = (member.commit, leading.round);
        }
    }
}

impl Member {
    /// The last entry that is decided by what the followers of this leader have; none if nothing more is decided.
    fn decided(&self, me: Life) -> Option<u64> {
        let Role::Leading(leading) = &self.role else {
            return None;
        };
        let matched = |voter: &Life| match leading.followers.get(&voter.robot) {
            _ if *voter == me => self.log.last(),
            Some(follower) if follower.life == *voter => follower.matched,
            _ => 0,
        };
        let mut matches: Vec<u64> = self.log.voters().iter().map(matched).collect();
        matches.sort_unstable_by(|a, b| b.cmp(a));
        let decided = matches.get(self.needed() - 1).copied().unwrap_or(0);
        (decided > self.commit && self.log.term(decided) == Some(self.term)).then_some(decided)
    }
}

#[cfg(test)]
mod tests {
    use super::super::packet::{Entry, Generation};
    use super::super::roll::Roll;
    use super::*;
    use crate::broadcast::total::followers::Follower;
    use starl_core::RobotId;

    /// A life of a robot.
    fn life(robot: u32, start: u64) -> Life {
        Life::of_test(RobotId(robot), start)
    }

    /// A leader in term 2 of these many voters, with an entry of term 1 that is not decided.
    fn leader(voters: u32) -> Member {
        let voters: Vec<(Life, u32)> = (0..voters).map(|robot| (life(robot, 1), 0)).collect();
        let generation = Generation {
            counter: 1,
            founder: life(0, 1),
        };
        let quorum = voters.len() as u32 / 2 + 1;
        let roll = Roll::new(voters);
        let mut member = Member::at(generation, quorum, (0, 1), roll.clone());
        let what = What::Start;
        member.log.push(Entry { term: 1, what });
        member.term = 2;
        member.leader = Some(life(0, 1));
        member.role = Role::Leading(Leading {
            age: 0,
            start: 2,
            sent: 1,
            told: 0,
            past: [(0, 0); 4],
            round: 0,
            calls: 0,
            followers: BTreeMap::new(),
            links: BTreeMap::new(),
            roll,
        });
        member
    }

    /// A follower has the log up to here.
    fn has(member: &mut Member, life: Life, matched: u64) {
        let Role::Leading(leading) = &mut member.role else {
            panic!("it leads");
        };
        let mut follower = Follower::new(life);
        follower.matched = matched;
        leading.followers.insert(life.robot, follower);
    }

    #[test]
    fn an_entry_of_an_earlier_term_is_decided_only_with_one_of_the_leaders_term() {
        let mut member = leader(3);
        has(&mut member, life(1, 1), 1);
        has(&mut member, life(2, 1), 1);
        assert_eq!(member.decided(life(0, 1)), None);
        member.put(What::Start);
        assert_eq!(member.decided(life(0, 1)), None, "no other robot has it");
        has(&mut member, life(1, 1), 2);
        assert_eq!(member.decided(life(0, 1)), Some(2));
    }

    #[test]
    fn the_log_of_a_new_life_does_not_count_for_the_life_that_votes() {
        let mut member = leader(3);
        member.put(What::Start);
        has(&mut member, life(1, 2), 2);
        assert_eq!(member.decided(life(0, 1)), None);
        has(&mut member, life(1, 1), 2);
        assert_eq!(member.decided(life(0, 1)), Some(2));
    }

    #[test]
    fn voters_change_only_after_an_entry_of_the_leaders_term_is_decided() {
        let mut member = leader(5);
        member.put(What::Start);
        has(&mut member, life(1, 2), 2);
        member.commit = 1;
        member.admit();
        assert_eq!(member.log.last(), 2, "its own entry is not decided");
        member.commit = 2;
        member.admit();
        assert_eq!(member.log.last(), 3);
        assert_eq!(member.log.voters().len(), 4);
    }

    #[test]
    fn voters_change_only_after_the_last_change_is_decided() {
        let mut member = leader(5);
        member.put(What::Start);
        has(&mut member, life(1, 2), 2);
        member.commit = 2;
        member.admit();
        member.admit();
        assert_eq!(member.log.last(), 3, "the last change is not decided");
        member.commit = 3;
        member.admit();
        assert_eq!(member.log.voters().len(), 5, "the new life votes");
    }
}
