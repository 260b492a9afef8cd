//! The messages that the vehicle sends, each kind at its own rate.

use super::{COMPONENT, SYSTEM};
use mavlink::MavHeader;
use starl_core::Duration;
use starl_mavlink::autopilot::Mode;
use starl_mavlink::common::{
    ATTITUDE_DATA, EXTENDED_SYS_STATE_DATA, HEARTBEAT_DATA, LOCAL_POSITION_NED_DATA,
    MavLandedState, MavMessage, MavModeFlag, MavState, MavType, MavVtolState, SYS_STATUS_DATA,
};
use starl_mavlink::{Autopilot, wire};
use std::time::Instant;

/// The messages by number, with how often they are sent unless a client asks for more, seconds.
const MESSAGES: [(u32, f64); 5] = [(0, 1.0), (1, 1.0), (30, 0.25), (32, 0.25), (245, 0.5)];
/// The shortest time between two messages of a kind, seconds.
const SHORTEST: f64 = 0.005;
/// How long a full battery lasts, seconds.
const ENDURANCE_S: f64 = 1200.0;

/// The reported state in the vehicle's frame: north, east, down; angles roll, pitch (nose up) and yaw (right).
#[derive(Debug)]
pub(super) struct Report {
    pub autopilot: Autopilot,
    pub mode: Mode,
    pub armed: bool,
    pub landed: bool,
    pub position: [f32; 3],
    pub velocity: [f32; 3],
    pub angles: [f32; 3],
    pub elapsed: Duration,
}

#[derive(Debug)]
pub(super) struct Telemetry {
    outbox: Vec<Vec<u8>>,
    sequence: u8,
    /// Seconds between two messages of each kind; infinite if it is not sent.
    intervals: [f64; MESSAGES.len()],
    due: [Instant; MESSAGES.len()],
}

impl Telemetry {
    pub fn new() -> Telemetry {
        Telemetry {
            outbox: Vec::new(),
            sequence: 0,
            intervals: MESSAGES.map(|(_, interval)| interval),
            due: [Instant::now(); MESSAGES.len()],
        }
    }

    /// Sets the microseconds between two messages of this number: 0 for the usual, -1 for none. False if it is never
    /// sent.
    pub fn set_interval(&mut self, number: f32, microseconds: f32) -> bool {
        let Some(index) = MESSAGES
            .iter()
            .position(|(known, _)| *known as f32 == number)
        else {
            return false;
        };
        self.intervals[index] = match f64::from(microseconds) {
            none if none < 0.0 => f64::INFINITY,
            0.0 => MESSAGES[index].1,
            asked => (1e-6 * asked).max(SHORTEST),
        };
        self.due[index] = Instant::now();
        true
    }

    pub fn interval(&self, number: u32) -> Option<f64> {
        let index = MESSAGES.iter().position(|(known, _)| *known == number)?;
        Some(self.intervals[index])
    }

    /// Queues a message.
    pub fn push(&mut self, message: &MavMessage) {
        let header = MavHeader {
            system_id: u32::from(SYSTEM),
            component_id: COMPONENT,
            sequence: self.sequence,
        };
        self.sequence = self.sequence.wrapping_add(1);
        let mut datagram = Vec::new();
        wire::encode(header, message, &mut datagram);
        self.outbox.push(datagram);
    }

    pub fn outbox(&mut self) -> Vec<Vec<u8>> {
        std::mem::take(&mut self.outbox)
    }

    /// Queues the messages that are due.
    pub fn report(&mut self, report: &Report) {
        let now = Instant::now();
        for (index, (number, _)) in MESSAGES.iter().enumerate() {
            if now < self.due[index] || self.intervals[index].is_infinite() {
                continue;
            }
            self.due[index] = now + std::time::Duration::from_secs_f64(self.intervals[index]);
            self.push(&report.message(*number));
        }
    }
}

impl Report {
    fn message(&self, number: u32) -> MavMessage {
        let time_boot_ms = (self.elapsed.0 / 1_000_000) as u32;
        let [x, y, z] = self.position;
        let [vx, vy, vz] = self.velocity;
        let [roll, pitch, yaw] = self.angles;
        match number {
            1 => {
                let spent = self.elapsed.seconds() / ENDURANCE_S;
                MavMessage::SYS_STATUS(SYS_STATUS_DATA {
                    battery_remaining: (100.0 * (1.0 - spent)).clamp(0.0, 100.0) as i8,
                    voltage_battery: 15_000,
                    ..SYS_STATUS_DATA::DEFAULT
                })
            }
            30 => MavMessage::ATTITUDE(ATTITUDE_DATA {
                time_boot_ms,
                roll,
                pitch,
                yaw,
                ..ATTITUDE_DATA::DEFAULT
            }),
            32 => MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
                time_boot_ms,
                x,
                y,
                z,
                vx,
                vy,
                vz,
            }),
            245 => MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
                vtol_state: MavVtolState::MAV_VTOL_STATE_UNDEFINED,
                landed_state: match (self.landed, self.mode) {
                    (true, _) => MavLandedState::MAV_LANDED_STATE_ON_GROUND,
                    (false, Mode::TakeOff) => MavLandedState::MAV_LANDED_STATE_TAKEOFF,
                    (false, Mode::Land) => MavLandedState::MAV_LANDED_STATE_LANDING,
                    (false, _) => MavLandedState::MAV_LANDED_STATE_IN_AIR,
                },
            }),
            _ => self.heartbeat(),
        }
    }

    fn heartbeat(&self) -> MavMessage {
        let mut base_mode = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
        if self.armed {
            base_mode |= MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
        }
        if self.autopilot == Autopilot::ArduPilot {
            // ArduPilot sets this flag for any pilot.
            base_mode |= MavModeFlag::MAV_MODE_FLAG_MANUAL_INPUT_ENABLED;
        }
        MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode: self.autopilot.number(self.mode),
            mavtype: MavType::MAV_TYPE_QUADROTOR,
            autopilot: self.autopilot.name(),
            base_mode,
            system_status: match self.landed {
                true => MavState::MAV_STATE_STANDBY,
                false => MavState::MAV_STATE_ACTIVE,
            },
            mavlink_version: 3,
        })
    }
}
