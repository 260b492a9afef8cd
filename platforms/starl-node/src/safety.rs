//! When a robot's motors are stopped whatever its program wants.

use starl_core::{Duration, Time};
use std::fmt;

/// How long a robot may continue without what it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Safety {
    /// Without a fresh position.
    pub localisation: Duration,
    /// Without hearing any other robot; for ever if none.
    pub link: Option<Duration>,
}

impl Default for Safety {
    fn default() -> Safety {
        Safety {
            localisation: Duration::from_millis(1000),
            link: None,
        }
    }
}

/// Why the motors are stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Hazard {
    /// The robot does not know where it is.
    NoPosition,
    /// It hears no other robot.
    NoLink,
    /// Its program cannot continue.
    Failed(String),
}

impl fmt::Display for Hazard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Hazard::NoPosition => f.write_str("the robot does not know where it is"),
            Hazard::NoLink => f.write_str("the robot hears no other robot"),
            Hazard::Failed(why) => write!(f, "its program cannot continue: {why}"),
        }
    }
}

impl Safety {
    /// The reason that forbids motion now, if any, given the times of the last position and of the last packet from
    /// another robot.
    pub fn check(
        &self,
        now: Time,
        position: Option<Time>,
        heard: Time,
        failure: Option<&str>,
        has_others: bool,
    ) -> Option<Hazard> {
        if let Some(failure) = failure {
            return Some(Hazard::Failed(failure.to_string()));
        }
        if position.is_none_or(|at| now.since(at) > self.localisation) {
            return Some(Hazard::NoPosition);
        }
        let is_alone = self.link.is_some_and(|limit| now.since(heard) > limit);
        (is_alone && has_others).then_some(Hazard::NoLink)
    }
}
