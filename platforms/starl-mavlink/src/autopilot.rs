//! The names of the modes of PX4 and ArduPilot that are used here.

use mavlink::dialects::common::MavAutopilot;

/// The software of a vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autopilot {
    /// PX4.
    #[default]
    Px4,
    /// ArduPilot's ArduCopter.
    ArduPilot,
}

/// A flight mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// It holds its place: PX4's Hold, ArduCopter's Loiter.
    Hold,
    /// It follows set-points of a computer: PX4's Offboard, ArduCopter's Guided.
    External,
    /// It takes off by itself: PX4's Takeoff. ArduCopter does that in Guided.
    TakeOff,
    /// It lands.
    Land,
    /// Any other, by its number.
    Other(u32),
}

const MODES: [Mode; 4] = [Mode::Hold, Mode::External, Mode::TakeOff, Mode::Land];

impl Autopilot {
    /// The autopilot that names itself so in its heartbeat; `None` if it is neither.
    pub fn of(name: MavAutopilot) -> Option<Autopilot> {
        match name {
            MavAutopilot::MAV_AUTOPILOT_PX4 => Some(Autopilot::Px4),
            MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA => Some(Autopilot::ArduPilot),
            _ => None,
        }
    }

    /// How it names itself in its heartbeat.
    pub fn name(self) -> MavAutopilot {
        match self {
            Autopilot::Px4 => MavAutopilot::MAV_AUTOPILOT_PX4,
            Autopilot::ArduPilot => MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        }
    }

    /// The custom mode of a heartbeat that means this mode.
    pub fn number(self, mode: Mode) -> u32 {
        // PX4 packs a main mode and a sub mode.
        let px4 = |main: u32, sub: u32| main << 16 | sub << 24;
        match (self, mode) {
            (Autopilot::Px4, Mode::Hold) => px4(4, 3),
            (Autopilot::Px4, Mode::External) => px4(6, 0),
            (Autopilot::Px4, Mode::TakeOff) => px4(4, 2),
            (Autopilot::Px4, Mode::Land) => px4(4, 6),
            (Autopilot::ArduPilot, Mode::Hold) => 5,
            (Autopilot::ArduPilot, Mode::External | Mode::TakeOff) => 4,
            (Autopilot::ArduPilot, Mode::Land) => 9,
            (_, Mode::Other(number)) => number,
        }
    }

    /// The mode of a heartbeat's custom mode.
    pub fn mode(self, number: u32) -> Mode {
        MODES
            .into_iter()
            .find(|&mode| self.number(mode) == number)
            .unwrap_or(Mode::Other(number))
    }

    /// The custom mode that the second and third parameter of `MAV_CMD_DO_SET_MODE` ask for.
    pub fn requested(self, second: f32, third: f32) -> u32 {
        match self {
            Autopilot::Px4 => (second as u32 & 0xFF) << 16 | (third as u32 & 0xFF) << 24,
            Autopilot::ArduPilot => second as u32,
        }
    }

    /// The second and third parameter of `MAV_CMD_DO_SET_MODE` for a mode.
    pub fn request(self, mode: Mode) -> [f32; 2] {
        let number = self.number(mode);
        match self {
            Autopilot::Px4 => [(number >> 16 & 0xFF) as f32, (number >> 24) as f32],
            Autopilot::ArduPilot => [number as f32, 0.0],
        }
    }
}
