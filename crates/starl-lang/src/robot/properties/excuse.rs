//! Excuses: reasons for which a property may be false.

use starl_core::Duration;

/// The reason for which a false property is excused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Excuse {
    /// A robot is down, or a wreck keeps it from its target.
    Down,
    /// A fault has just overwritten variables.
    Corruption,
    /// A fault was so recent that the time since has not passed.
    Recovery,
    /// The property's assumption is false.
    Assumption,
}

/// For this time after a fault has overwritten variables, a property of them is not judged, unless it says otherwise.
/// Meanwhile each robot is activated, finds that an invariant of its variables is false, and restarts.
pub const RECOVERY: Duration = Duration::from_seconds(1);
