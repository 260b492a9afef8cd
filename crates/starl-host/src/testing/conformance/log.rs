//! The records of a test.

use super::{Cue, Host};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::{Event, Record, RobotId, Time, Value};

/// One input, as a [`super::Probe`] reports it.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// When, by the host.
    pub at: Time,
    /// The text of a [`Cue`].
    pub what: String,
    /// When, by the robot's own clock.
    pub now: Time,
    /// Which input it was, counted from 1 in each life.
    pub count: i64,
}

/// The records of a test.
pub struct Log {
    records: Vec<Record>,
    lateness: starl_core::Duration,
}

impl Log {
    /// The log of a host.
    pub fn of(host: &impl Host) -> Log {
        Log {
            records: host.records(),
            lateness: host.lateness(),
        }
    }

    /// The events of a robot, in the order in which they are on record.
    pub fn events(&self, robot: RobotId) -> impl Iterator<Item = (Time, &Event)> {
        let own = self
            .records
            .iter()
            .filter(move |record| record.robot == Some(robot));
        own.map(|record| (record.at, &record.event))
    }

    /// How many events of a robot are like this.
    pub fn count(&self, robot: RobotId, is_meant: impl Fn(&Event) -> bool) -> usize {
        self.events(robot)
            .filter(|(_, event)| is_meant(event))
            .count()
    }

    /// All inputs of a robot.
    pub fn told(&self, robot: RobotId) -> Vec<Told> {
        let told = self.events(robot).filter_map(|(at, event)| {
            let Event::Program { name, fields } = event else {
                return None;
            };
            let field = |wanted: &str| {
                let mut fields = fields.iter();
                let found = fields.find(|(name, _)| name == wanted);
                found.map(|(_, value)| value)
            };
            match (field("what")?, field("now")?, field("count")?) {
                (Value::Text(what), Value::Time(now), Value::Int(count)) if name == "told" => {
                    Some(Told {
                        at,
                        what: String::from(&**what),
                        now: *now,
                        count: *count,
                    })
                }
                _ => None,
            }
        });
        told.collect()
    }

    /// The saved numbers that a robot has found, and when.
    pub fn found(&self, robot: RobotId) -> Vec<(Time, i64)> {
        let found = self.events(robot).filter_map(|(at, event)| match event {
            Event::Program { name, fields } if name == "found" => match fields.first()?.1 {
                Value::Int(number) => Some((at, number)),
                _ => None,
            },
            _ => None,
        });
        found.collect()
    }

    /// All inputs of a robot except estimates and activations.
    pub fn heard(&self, robot: RobotId) -> Vec<Told> {
        let mut told = self.told(robot);
        told.retain(|told| !told.is(Cue::Located) && !told.is(Cue::Activate));
        told
    }

    /// The times at which a robot got this input.
    pub fn times(&self, robot: RobotId, cue: Cue) -> Vec<Time> {
        let told = self.told(robot);
        told.iter()
            .filter(|told| told.is(cue))
            .map(|told| told.at)
            .collect()
    }

    /// Checks that a robot got this input at exactly these times.
    #[track_caller]
    pub fn check_times(&self, robot: RobotId, cue: Cue, wanted: &[Time]) {
        let times = self.times(robot, cue);
        let is_on_time =
            |(&at, &wanted): (&Time, &Time)| wanted <= at && at <= wanted + self.lateness;
        let are_on_time = times.len() == wanted.len() && times.iter().zip(wanted).all(is_on_time);
        assert!(
            are_on_time,
            "{cue:?} of robot {robot}: at {times:?} and not at {wanted:?}"
        );
    }

    /// Checks that a robot got exactly these inputs, except estimates and activations.
    #[track_caller]
    pub fn check_heard(&self, robot: RobotId, wanted: &[Cue]) {
        let heard: Vec<String> = self
            .heard(robot)
            .into_iter()
            .map(|told| told.what)
            .collect();
        let wanted: Vec<String> = wanted.iter().map(|cue| format!("{cue:?}")).collect();
        assert_eq!(heard, wanted, "robot {robot}");
    }
}

impl Told {
    /// Whether it was this.
    pub fn is(&self, cue: Cue) -> bool {
        self.what == format!("{cue:?}")
    }
}
