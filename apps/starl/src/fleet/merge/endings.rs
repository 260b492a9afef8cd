//! How the traces of robots end, and whether their robots ended with them.
//!
//! A trace that has reached its limit says so. A trace without an end is that of a killed process, which has done
//! nothing since, unless another robot has received something from the robot that the trace does not contain: then it
//! could not be written any more.

use crate::fleet::recorder::LIMIT_REACHED;
use starl_core::{RobotId, Time};
use starl_trace::Summary;
use std::collections::BTreeMap;

/// A robot that ended so long before the others was down for that time. Robots that are stopped together end within
/// less, seconds.
const TOGETHER: f64 = 1.0;

/// How a trace ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ending {
    /// The robot was stopped.
    Stopped,
    /// The trace has reached its limit, and the robot continued.
    LimitReached,
    /// The trace has no end.
    Cut,
}

impl Ending {
    pub fn of(summary: Option<&Summary>) -> Ending {
        match summary {
            None => Ending::Cut,
            Some(summary) if summary.outcome.outcome == LIMIT_REACHED => Ending::LimitReached,
            Some(_) => Ending::Stopped,
        }
    }
}

/// The time that one life of a robot is recorded for, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub begin: f64,
    pub end: f64,
    pub ending: Ending,
}

/// The recorded lives of each robot in their order, on one time axis.
#[derive(Debug, Default)]
pub(super) struct Endings {
    pub lives: BTreeMap<RobotId, Vec<Span>>,
    /// When a datagram arrived from a robot that its traces do not contain, seconds.
    pub strays: Vec<(RobotId, f64)>,
}

impl Endings {
    /// When records of a robot begin to be missing although it continued; in the order of time.
    pub fn unrecorded(&self) -> Vec<(RobotId, Time)> {
        let mut unrecorded: Vec<(RobotId, Time)> = Vec::new();
        for (&robot, lives) in &self.lives {
            let numbers = 0..lives.len();
            let lost = numbers.filter(|&number| self.continued(robot, number));
            unrecorded.extend(lost.map(|number| (robot, time(lives[number].end))));
            if lives.is_empty() && self.strays.iter().any(|(from, _)| *from == robot) {
                unrecorded.push((robot, Time::ZERO));
            }
        }
        unrecorded.sort_by_key(|(robot, at)| (*at, *robot));
        unrecorded
    }

    /// Whether a robot went down at the end of a life's trace.
    pub fn went_down(&self, robot: RobotId, number: usize) -> bool {
        let lives = &self.lives[&robot];
        let all = self.lives.values().flatten();
        let end = all.map(|life| life.end).fold(0.0, f64::max);
        let life = lives[number];
        let is_last = number + 1 == lives.len();
        let is_early = life.ending == Ending::Cut || life.end + TOGETHER < end;
        !self.continued(robot, number) && (!is_last || is_early)
    }

    /// Robots that have left no traces, and of which nothing was heard.
    pub fn never_seen(&self) -> impl Iterator<Item = RobotId> {
        let silent = |robot: &RobotId| self.strays.iter().all(|(from, _)| from != robot);
        let without = self.lives.iter().filter(|(_, lives)| lives.is_empty());
        without.map(|(robot, _)| *robot).filter(silent)
    }

    /// Whether a robot continued after the end of a life's trace.
    fn continued(&self, robot: RobotId, number: usize) -> bool {
        let lives = &self.lives[&robot];
        let life = lives[number];
        let next = lives
            .get(number + 1)
            .map_or(f64::INFINITY, |next| next.begin);
        let is_later = |at: f64| (life.end..next).contains(&at);
        let mut strays = self.strays.iter();
        match life.ending {
            Ending::Stopped => false,
            Ending::LimitReached => true,
            Ending::Cut => strays.any(|&(from, at)| from == robot && is_later(at)),
        }
    }
}

fn time(seconds: f64) -> Time {
    Time((seconds * 1e9).max(0.0) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: RobotId = RobotId(1);

    fn life(begin: f64, end: f64, ending: Ending) -> Span {
        Span { begin, end, ending }
    }

    /// Robot 0, stopped after a minute, and robot 1 with these lives.
    fn endings(lives: &[Span], strays: &[f64]) -> Endings {
        let whole = vec![life(0.0, 60.0, Ending::Stopped)];
        Endings {
            lives: [(RobotId(0), whole), (ONE, lives.to_vec())].into(),
            strays: strays.iter().map(|at| (ONE, *at)).collect(),
        }
    }

    #[test]
    fn a_robot_whose_trace_has_reached_its_limit_continues() {
        let endings = endings(&[life(0.0, 20.0, Ending::LimitReached)], &[]);
        assert_eq!(endings.unrecorded(), [(ONE, Time(20_000_000_000))]);
        assert!(!endings.went_down(ONE, 0));
    }

    #[test]
    fn a_killed_robot_goes_down() {
        let lives = [life(0.0, 20.0, Ending::Cut), life(25.0, 60.0, Ending::Cut)];
        let endings = endings(&lives, &[]);
        assert_eq!(endings.unrecorded(), []);
        assert!(endings.went_down(ONE, 0) && endings.went_down(ONE, 1));
    }

    #[test]
    fn a_robot_that_is_heard_after_its_trace_was_cut_continues() {
        let lives = [life(0.0, 20.0, Ending::Cut), life(25.0, 40.0, Ending::Cut)];
        let endings = endings(&lives, &[41.0]);
        assert_eq!(endings.unrecorded(), [(ONE, Time(40_000_000_000))]);
        assert!(endings.went_down(ONE, 0) && !endings.went_down(ONE, 1));
    }

    #[test]
    fn a_robot_that_was_stopped_before_the_others_is_down() {
        let stopped = |end| endings(&[life(0.0, end, Ending::Stopped)], &[]);
        assert!(stopped(20.0).went_down(ONE, 0));
        assert!(!stopped(59.5).went_down(ONE, 0));
    }

    #[test]
    fn a_robot_without_a_trace_is_down_unless_it_was_heard() {
        let silent = endings(&[], &[]);
        assert_eq!(silent.never_seen().collect::<Vec<_>>(), [ONE]);
        assert_eq!(silent.unrecorded(), []);
        let heard = endings(&[], &[3.0]);
        assert_eq!(heard.never_seen().count(), 0);
        assert_eq!(heard.unrecorded(), [(ONE, Time::ZERO)]);
    }
}
