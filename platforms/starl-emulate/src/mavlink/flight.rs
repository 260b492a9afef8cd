//! The emulated autopilot's response to messages, and the messages that it sends.

mod reading;
mod telemetry;

use crate::BodyHandle;
use crate::control::{SetPoint, fly};
use starl_core::{Command, Point, Pose};
use starl_mavlink::Autopilot;
use starl_mavlink::autopilot::Mode;
use starl_mavlink::common::{COMMAND_ACK_DATA, COMMAND_LONG_DATA, MavCmd, MavMessage, MavResult};
use starl_motion::models::drone_mode;
use std::net::SocketAddr;
use std::time::{Duration, Instant};
use telemetry::Telemetry;

/// Its system and component.
const SYSTEM: u8 = 1;
const COMPONENT: u8 = 1;
/// When no client is heard for so long, it lands.
const LINK_LOSS: Duration = Duration::from_secs(3);

#[derive(Debug)]
pub(super) struct Flight {
    body: BodyHandle,
    autopilot: Autopilot,
    client: Option<SocketAddr>,
    /// The origin of its frame.
    home: Pose,
    mode: Mode,
    armed: bool,
    set_point: Option<(Instant, SetPoint)>,
    /// Height that a take-off is to reach, metres.
    take_off_height: f64,
    heard: Option<Instant>,
    telemetry: Telemetry,
}

impl Flight {
    pub fn new(body: BodyHandle, autopilot: Autopilot, client: Option<SocketAddr>) -> Flight {
        Flight {
            home: body.state().pose,
            body,
            autopilot,
            client,
            mode: Mode::Hold,
            armed: false,
            set_point: None,
            take_off_height: 0.0,
            heard: None,
            telemetry: Telemetry::new(),
        }
    }

    pub fn client(&self) -> Option<SocketAddr> {
        self.client
    }

    pub fn halt(&self) {
        self.body.command(Command::Stop);
    }

    /// A pilot's switch has all modes.
    pub fn switch(&mut self, mode: u32) {
        self.mode = self.autopilot.mode(mode);
    }

    pub fn mode(&self) -> u32 {
        self.autopilot.number(self.mode)
    }

    pub fn interval(&self, number: u32) -> Option<f64> {
        self.telemetry.interval(number)
    }

    /// The datagrams that are due.
    pub fn outbox(&mut self) -> Vec<Vec<u8>> {
        self.telemetry.outbox()
    }

    #[allow(deprecated, reason = "ground stations still send SET_MODE")]
    pub fn take(&mut self, message: &MavMessage, from: SocketAddr) {
        match message {
            MavMessage::HEARTBEAT(_) => {
                self.client = Some(from);
                self.heard = Some(Instant::now());
            }
            MavMessage::COMMAND_LONG(data) if is_ours(data.target_system) => {
                let result = self.obey(data);
                self.telemetry
                    .push(&MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
                        command: data.command,
                        result,
                    }));
            }
            MavMessage::SET_MODE(data) if is_ours(data.target_system) => {
                self.enter(self.autopilot.mode(data.custom_mode));
            }
            MavMessage::SET_POSITION_TARGET_LOCAL_NED(data) if is_ours(data.target_system) => {
                if let Some(set_point) = reading::read(data, &self.body.state().pose, &self.home) {
                    self.set_point = Some((Instant::now(), set_point));
                }
            }
            _ => {}
        }
    }

    fn obey(&mut self, command: &COMMAND_LONG_DATA) -> MavResult {
        let accepted = |done| match done {
            true => MavResult::MAV_RESULT_ACCEPTED,
            false => MavResult::MAV_RESULT_TEMPORARILY_REJECTED,
        };
        let standing = self.stands();
        match command.command {
            MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => {
                let arm = command.param1 == 1.0;
                if !arm && !standing {
                    // Motors are not cut in the air.
                    return MavResult::MAV_RESULT_DENIED;
                }
                self.armed = arm;
                MavResult::MAV_RESULT_ACCEPTED
            }
            MavCmd::MAV_CMD_DO_SET_MODE => {
                let number = self.autopilot.requested(command.param2, command.param3);
                accepted(self.enter(self.autopilot.mode(number)))
            }
            MavCmd::MAV_CMD_NAV_TAKEOFF => {
                // ArduPilot takes off in Guided only.
                let guided = self.autopilot == Autopilot::Px4 || self.mode == Mode::External;
                if !self.armed || !standing || !guided {
                    return MavResult::MAV_RESULT_TEMPORARILY_REJECTED;
                }
                let asked = f64::from(command.param7);
                self.take_off_height = if asked > 0.0 { asked } else { 1.0 };
                self.mode = Mode::TakeOff;
                MavResult::MAV_RESULT_ACCEPTED
            }
            MavCmd::MAV_CMD_NAV_LAND => accepted(self.enter(Mode::Land)),
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL => {
                accepted(self.telemetry.set_interval(command.param1, command.param2))
            }
            _ => MavResult::MAV_RESULT_UNSUPPORTED,
        }
    }

    /// Goes over to a mode if that is possible now.
    fn enter(&mut self, mode: Mode) -> bool {
        let possible = match mode {
            Mode::Hold | Mode::Land => true,
            // PX4 follows only a client that already sends set-points.
            Mode::External => self.autopilot == Autopilot::ArduPilot || self.has_set_point(),
            Mode::TakeOff | Mode::Other(_) => false,
        };
        if possible {
            self.mode = mode;
        }
        possible
    }

    fn stands(&self) -> bool {
        self.body.state().mode == drone_mode::LANDED
    }

    fn has_set_point(&self) -> bool {
        // PX4's COM_OF_LOSS_T and ArduCopter's GUID_TIMEOUT.
        let patience = match self.autopilot {
            Autopilot::Px4 => Duration::from_secs(1),
            Autopilot::ArduPilot => Duration::from_secs(3),
        };
        self.set_point
            .as_ref()
            .is_some_and(|(at, _)| at.elapsed() < patience)
    }

    /// The periodic step: failsafes, control, telemetry.
    pub fn tick(&mut self) {
        if self.heard.is_some_and(|at| at.elapsed() > LINK_LOSS) && !self.stands() {
            self.mode = Mode::Land;
        }
        self.control();
        self.report();
    }

    fn control(&mut self) {
        let state = self.body.state();
        let height = state.pose.position.z - self.home.position.z;
        if !self.armed {
            self.body.command(Command::Stop);
            return;
        }
        match self.mode {
            Mode::Land => {
                self.body.command(Command::Land);
                // It disarms by itself once it stands.
                if self.stands() {
                    self.armed = false;
                    self.mode = Mode::Hold;
                }
            }
            Mode::TakeOff => {
                if height >= 0.95 * self.take_off_height {
                    // ArduPilot is in Guided all the time, and PX4 goes to Hold.
                    self.mode = match self.autopilot {
                        Autopilot::Px4 => Mode::Hold,
                        Autopilot::ArduPilot => Mode::External,
                    };
                    self.set_point = None;
                }
                let climb = SetPoint::climb(self.take_off_height - height);
                self.follow(&climb);
            }
            Mode::External => match self.set_point.clone() {
                Some((_, set_point)) if self.has_set_point() => self.follow(&set_point),
                _ => {
                    if self.autopilot == Autopilot::Px4 {
                        self.mode = Mode::Hold;
                    }
                    self.body.command(Command::Hover);
                }
            },
            Mode::Hold | Mode::Other(_) => self.body.command(Command::Hover),
        }
    }

    fn follow(&self, set_point: &SetPoint) {
        fly(&self.body, set_point.command(&self.body.state()));
    }

    fn report(&mut self) {
        let landed = self.stands();
        let state = self.body.state();
        let velocity = state.twist.linear;
        let position = state.pose.position - self.home.position;
        let down = |point: Point| [point.x, -point.y, -point.z].map(|value| value as f32);
        self.telemetry.report(&telemetry::Report {
            autopilot: self.autopilot,
            mode: self.mode,
            armed: self.armed,
            landed,
            position: down(position),
            velocity: down(velocity),
            angles: [state.pose.roll, -state.pose.pitch, -state.pose.yaw].map(|a| a as f32),
            elapsed: self.body.elapsed(),
        });
    }
}

/// Whether a message is for this vehicle, or for all.
fn is_ours(system: u8) -> bool {
    system == SYSTEM || system == 0
}
