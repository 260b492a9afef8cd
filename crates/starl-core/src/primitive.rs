//! The contract of every primitive.

use crate::{Input, Port, Robot};

/// A building block of programs: a pure state machine that answers inputs with effects.
///
/// A program owns its primitives as fields, calls their methods, and reads their flags. Inputs reach
/// the primitives that it shows by [`crate::Primitives`] before the program itself. A message or
/// timer goes to the one primitive with its port, every other input to all of them. The findings of a
/// failure detector among them reach all of them next.
pub trait Primitive {
    /// The endpoint of this instance.
    fn port(&self) -> Port;

    /// Takes an input and pushes effects through the handle.
    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input);

    /// Saves the state that must survive a crash ([`Robot::save`]), if it has changed. Called after each input,
    /// only on robots with storage. [`Input::Start`] contains the saved state.
    fn save(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }
}
