//! An arbiter that remembers nothing asks, and robots answer: see [`super::recovery`].

use super::super::common::{Alarm, Common};
use super::super::lease::number_at;
use super::packet::Packet;
use super::recovery::Outlook;
use super::{Arbitration, Post, lease};
use alloc::vec::Vec;
use starl_core::event::MutexEvent;
use starl_core::random::hash_key;
use starl_core::{Robot, RobotId};

impl Arbitration {
    /// Starts the necessary steps: see [`recovery`]. Called with every input.
    pub fn look(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let is_same = match &common.participants {
            None => self.everyone == robot.fleet(),
            Some(participants) => self.everyone.iter().eq(participants),
        };
        let is_first = self.everyone.is_empty();
        let is_change = !is_same && !is_first;
        if !is_same {
            self.everyone = common.everyone(robot);
            let ids: Vec<u64> = self.everyone.iter().map(|id| u64::from(id.0)).collect();
            self.list = hash_key(ids.len() as u64, &ids) as u32;
            self.arbiter.keep_only(&self.everyone);
        }
        if is_change {
            self.change_list(common, robot);
        }
        if self.everyone.binary_search(&robot.id()).is_err() {
            // A robot that does not participate is not an arbiter.
            self.recovery.is_ready = true;
        } else if is_first && self.restore(common, robot) {
            // It continues where it was.
        } else if !is_same || self.recovery.is_idle() {
            let nonce = robot.random().bits() ^ common.incarnation.of(robot);
            self.recovery.begin(nonce, robot.now(), is_change);
            self.recall(common, robot);
        }
        self.stabilise(common, robot);
    }

    /// Asks robots that have not answered yet for this robot's earlier grants to them.
    pub(super) fn recall(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let mut post = Post::default();
        self.review(common, robot, &mut post);
        self.arbiter.tell_again();
        self.ask_others(common, robot, &mut post);
        self.deliver(common, robot, post);
    }

    /// An answer has arrived.
    pub(super) fn hear_answer(
        &mut self,
        common: &mut Common,
        robot: &mut Robot<'_>,
        post: &mut Post,
    ) {
        if self.review(common, robot, post) {
            self.ask_others(common, robot, post);
        }
    }

    /// This robot is an arbiter from now on; `is_anew` if the last number is unknown.
    pub(super) fn begin_to_grant(&mut self, common: &Common, robot: &mut Robot<'_>, is_anew: bool) {
        self.recovery.end(is_anew);
        let participants = self.everyone.len() as u32;
        let ready = MutexEvent::Ready {
            participants,
            needed: match lease(common) {
                Some(_) => participants / 2 + 1,
                None => participants,
            },
            anew: is_anew,
        };
        robot.report(common.port, ready);
    }

    fn ask_others(&mut self, common: &mut Common, robot: &mut Robot<'_>, post: &mut Post) {
        let to_ask = self.recovery.to_ask(&common.others(robot));
        let until_more =
            lease(common).and_then(|lease| self.recovery.until_more(robot.now(), lease));
        let (list, incarnation) = (self.list, common.incarnation.of(robot));
        let Some(begun) = self.recovery.asking() else {
            return;
        };
        let nonce = begun.nonce;
        for peer in to_ask {
            let recall = Packet::Recall {
                nonce,
                list,
                incarnation,
            };
            post.send(peer, recall);
        }
        let timeout = common.options.timeout(begun.repetitions);
        let timeout = until_more.map_or(timeout, |more| timeout.min(more));
        begun.repetitions = begun.repetitions.saturating_add(1);
        robot.set_timer(common.timer(Alarm::Recall), timeout);
    }

    /// Looks whether enough has been heard to be an arbiter; whether others are to be asked at once.
    fn review(&mut self, common: &Common, robot: &mut Robot<'_>, post: &mut Post) -> bool {
        if self.recovery.is_ready {
            return false;
        }
        let others = common.others(robot);
        let (now, lease) = (robot.now(), lease(common));
        let mut outlook = self.recovery.outlook(now, &others, lease);
        let asks_anew = outlook == Outlook::Unready
            && lease.is_some_and(|lease| self.recovery.ends_stage(now, &others, lease));
        if asks_anew {
            outlook = self.recovery.outlook(now, &others, lease);
        }
        let is_anew = outlook == Outlook::ReadyWithoutNumbers;
        if is_anew {
            self.arbiter.numbers.raise_floor(number_at(robot.now()));
        }
        if outlook != Outlook::Unready {
            self.begin_to_grant(common, robot, is_anew);
            self.arbiter.settle(self.terms(common, robot), post);
        }
        asks_anew
    }

    /// An arbiter asks for its grants to this robot. A request that only waits is made again.
    pub(super) fn answer(
        &mut self,
        common: &mut Common,
        robot: &mut Robot<'_>,
        (from, life): (RobotId, u32),
        (nonce, list): (u32, u32),
        post: &mut Post,
    ) {
        if list != self.list {
            return;
        }
        let remembers = self.recovery.remembers;
        let known = self.arbiter.numbers.greatest();
        let request = self
            .request
            .as_mut()
            .filter(|request| request.has_asked(from));
        let holds = match request {
            Some(request) if request.is_entered => Some(request.wish(from, common)),
            Some(request) => {
                request.try_anew(from, common, post);
                None
            }
            None => None,
        };
        let answer = Packet::Recalled {
            nonce,
            list,
            holds,
            number: match remembers {
                true => known,
                // It may have forgotten numbers that continued from its time.
                false => known.max(number_at(robot.now())),
            },
            remembers,
            incarnation: common.incarnation.of(robot),
            founders: self.recovery.founders.with(from, life),
        };
        post.send(from, answer);
    }
}
