//! The phases of an AR.Drone ([`crate::State::mode`]), and how commands change them.

use starl_core::Command;

/// It stands on the floor with its rotors off.
pub const LANDED: u32 = 0;
/// It rises to the safe height.
pub const TAKING_OFF: u32 = 1;
/// It holds its place.
pub const HOVERING: u32 = 2;
/// It flies at the commanded attitude.
pub const FLYING: u32 = 3;
/// It sinks to the floor.
pub const LANDING: u32 = 4;

/// The mode that `command` brings about. On the floor only `TakeOff` does anything; in the air a new
/// command aborts the one before it. `high` says whether the drone has reached its safe height.
pub(super) fn after(mode: u32, command: &Command, high: bool) -> u32 {
    match (mode, command) {
        (LANDED, Command::TakeOff) => TAKING_OFF,
        (LANDED, _) => LANDED,
        (_, Command::TakeOff) => {
            if high {
                HOVERING
            } else {
                TAKING_OFF
            }
        }
        (_, Command::Land) => LANDING,
        (_, Command::Attitude { .. }) => FLYING,
        _ => HOVERING,
    }
}

/// Whether the drone holds its place in the floor plane in this mode.
pub(super) fn holds_place(mode: u32) -> bool {
    matches!(mode, TAKING_OFF | HOVERING | LANDING)
}
