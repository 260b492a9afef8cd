//! The interface through which a robot records its run.

use starl_core::{Event, Program, Time};
use starl_host::Observed;

/// Takes down what happens.
pub trait Recorder {
    /// Something happened on this robot.
    fn record(&mut self, at: Time, event: Event);

    /// Something was done to its software.
    fn observe(&mut self, at: Time, observed: Observed<'_>);

    /// All events until now have been recorded.
    fn advance(&mut self, now: Time);

    /// Everything that was recorded must survive the process from now on: something is about to leave the robot that
    /// shows it.
    fn commit(&mut self) {}

    /// The person in front of the robot should know this.
    fn notice(&mut self, at: Time, text: &str);

    /// The state of the program in a word, if it has one.
    fn state(&self, program: &dyn Program) -> Option<String> {
        let _ = program;
        None
    }
}
