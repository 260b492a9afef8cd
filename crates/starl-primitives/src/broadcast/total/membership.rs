//! The voters: how new lives are added and replace earlier ones.
//!
//! Invariant: any quorum before a change meets any quorum after it, and a change follows only when the last one is
//! decided (Ongaro and Ousterhout 2014, section 6, which changes one voter at a time for that). Because at least a
//! majority of the founding fleet decides, several voters may be removed or added at once.

use super::life::Life;
use super::packet::What;
use super::{Member, Role};

impl Member {
    /// Removes voters of which a later life is present, or else adds the new lives as voters.
    pub fn admit(&mut self) {
        let Role::Leading(leading) = &self.role else {
            return;
        };
        if self.log.voters_since() > self.commit || leading.start > self.commit {
            return;
        }
        let voters = self.log.voters();
        let is_replaced = |voter: &Life| {
            let follower = leading.followers.get(&voter.robot);
            follower.is_some_and(|follower| follower.life != *voter)
        };
        let mut changed = voters.to_vec();
        for replaced in voters.iter().filter(|voter| is_replaced(voter)) {
            let mut fewer = changed.clone();
            fewer.retain(|voter| voter != replaced);
            if self.may_follow(voters.len(), fewer.len()) {
                changed = fewer;
            }
        }
        if changed.len() == voters.len() {
            let votes = |life: &Life| voters.iter().any(|voter| voter.robot == life.robot);
            let is_ready = |matched: u64| matched >= leading.past[3].0;
            let here = leading.followers.values().filter(|f| f.silence <= 2);
            for new in here.filter(|f| is_ready(f.matched) && !votes(&f.life)) {
                let mut more = changed.clone();
                more.push(new.life);
                if self.may_follow(voters.len(), more.len()) {
                    changed = more;
                }
            }
            changed.sort_unstable();
        }
        if changed.len() != voters.len() {
            self.put(What::Voters(changed));
        }
    }

    /// Whether any quorum of so many voters meets any of the present ones, where one list holds the other.
    fn may_follow(&self, present: usize, next: usize) -> bool {
        let (before, after) = (self.needed_of(present), self.needed_of(next));
        after <= next && before + after > present.max(next)
    }

    /// How many of the voters decide.
    pub fn needed(&self) -> usize {
        self.needed_of(self.log.voters().len())
    }

    /// The number of voters, of this number, that decide.
    pub fn needed_of(&self, voters: usize) -> usize {
        (voters / 2 + 1).max(self.quorum as usize)
    }
}
