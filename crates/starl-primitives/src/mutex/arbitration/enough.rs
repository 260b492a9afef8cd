//! When a request has been granted by enough arbiters, and until when.

use super::super::common::Common;
use super::Post;
use super::packet::{Behind, Packet};
use super::request::{Asked, Enough, Request};
use alloc::vec::Vec;
use starl_core::{Duration, RobotId, Time};

impl Request {
    /// The number with which it may enter, and until when; none if it may not yet. Requests one number from all if
    /// enough have granted different ones.
    pub fn may_enter(
        &mut self,
        now: Time,
        enough: Enough,
        common: &Common,
        post: &mut Post,
    ) -> Option<(u64, Time)> {
        let (majority, belief) = match enough {
            Enough::All => {
                let mut asked = self.asked.values();
                return asked
                    .all(|asked| asked.granted.is_some())
                    .then_some((0, Time::NEVER));
            }
            Enough::Majority(majority, belief) => (majority, belief),
        };
        let valid = |granted: &(Time, u64)| granted.0 > now && granted.0 <= now + belief;
        let granted = self.asked.values().filter_map(|asked| asked.granted);
        let granted: Vec<(Time, u64)> = granted.filter(valid).collect();
        let number = granted.iter().map(|&(_, number)| number).max()?;
        let same = granted.iter().filter(|&&(_, other)| other == number);
        let mut ends: Vec<Time> = same.map(|&(until, _)| until).collect();
        ends.sort_unstable();
        if ends.len() >= majority {
            return Some((number, ends[ends.len() - majority]));
        }
        if granted.len() >= majority && number > self.number {
            self.number = number;
            let lower = self
                .asked
                .iter()
                .filter(|(_, asked)| asked.granted.is_some_and(|granted| granted.1 < number));
            for (&arbiter, _) in lower {
                post.send(arbiter, Packet::Request(self.wish(arbiter, common)));
            }
        }
        None
    }

    /// Until when a majority has granted what the robot holds.
    pub fn held_until(&self, now: Time, majority: usize, belief: Duration) -> Time {
        let granted = self.asked.values().filter_map(|asked| asked.granted);
        let ends = granted
            .map(|(until, _)| until)
            .filter(|&until| until <= now + belief);
        let mut ends: Vec<Time> = ends.collect();
        ends.sort_unstable();
        let index = ends.len().checked_sub(majority);
        index
            .and_then(|index| ends.get(index).copied())
            .unwrap_or(Time::ZERO)
    }

    /// Whether it waits for a robot that is believed to have failed.
    pub fn is_stuck(&self, enough: Enough, common: &Common) -> bool {
        let is_hopeless = |(arbiter, asked): &(&RobotId, &Asked)| {
            let is_suspected = |robot: &RobotId| common.suspects.contains(robot);
            asked.granted.is_none()
                && (is_suspected(arbiter)
                    || match &asked.behind {
                        Some(Behind::Robot(robot)) => is_suspected(robot),
                        Some(Behind::OtherList) => true,
                        None => false,
                    })
        };
        let hopeless = self.asked.iter().filter(is_hopeless).count();
        match enough {
            Enough::All => hopeless > 0,
            Enough::Majority(majority, _) => self.asked.len() - hopeless < majority,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::common::RequestId;
    use super::super::super::{Options, Resources};
    use super::*;
    use starl_core::Port;

    #[test]
    fn grants_that_have_ended_do_not_count_towards_a_majority() {
        let id = RequestId {
            incarnation: 1,
            number: 1,
        };
        let arbiters = (0..3).map(RobotId).collect();
        let mut request = Request::new(id, 1, Resources::new(), 0, arbiters);
        let common = Common::new(Port::named("mutex"), None, Options::default());
        let enough = Enough::Majority(2, Duration::from_seconds(2));
        let after = |seconds| Time::ZERO + Duration::from_seconds_f64(seconds);
        for (arbiter, until) in [(0, 5.0), (1, 6.0)] {
            let asked = request.asked.get_mut(&RobotId(arbiter));
            asked.expect("it was asked").granted = Some((after(until), 7));
        }
        let mut may_enter =
            |now| request.may_enter(after(now), enough, &common, &mut Post::default());
        assert_eq!(may_enter(4.5), Some((7, after(5.0))));
        assert_eq!(may_enter(5.5), None);
    }
}
