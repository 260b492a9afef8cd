//! Views: what Foxglove draws, made from the records in Foxglove's own schemas.

use crate::writer::Output;
use crate::{Header, WriteError};
use starl_core::{Duration, Event, RobotId, Time};
use std::io::Write;

/// Which views to write beside the records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewOptions {
    /// Whether to write any.
    pub enabled: bool,
    /// At least this long between two poses of a robot.
    pub period: Duration,
    /// Fleets larger than this get no topics of their own for each robot, only frames and bodies.
    pub most_robot_topics: u32,
}

impl Default for ViewOptions {
    fn default() -> ViewOptions {
        ViewOptions { enabled: true, period: Duration::from_millis(100), most_robot_topics: 64 }
    }
}

impl ViewOptions {
    /// Records only.
    pub fn none() -> ViewOptions {
        ViewOptions { enabled: false, ..ViewOptions::default() }
    }
}

/// What the views have to remember.
pub(crate) struct Views;

impl Views {
    pub fn new<W: Write>(_: &mut Output<W>, _: &Header, _: &ViewOptions) -> Result<Views, WriteError> {
        Ok(Views)
    }

    pub fn event<W: Write>(
        &mut self,
        _: &mut Output<W>,
        _: Time,
        _: Option<RobotId>,
        _: &Event,
    ) -> Result<(), WriteError> {
        Ok(())
    }

    pub fn finish<W: Write>(&mut self, _: &mut Output<W>, _: Time) -> Result<(), WriteError> {
        Ok(())
    }
}
