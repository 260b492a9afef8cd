//! The state reported by the vehicle.

use crate::Autopilot;
use crate::autopilot::Mode;
use mavlink::dialects::common::{
    ATTITUDE_DATA, LOCAL_POSITION_NED_DATA, MavCmd, MavLandedState, MavMessage, MavModeFlag,
    MavResult,
};
use starl_core::Point;
use starl_core::math::{sincos, wrap_angle};
use starl_node::Reading;
use std::time::{Duration, Instant};

/// An autopilot refuses what it is not ready for, such as a mode whose set-points have only begun.
const PATIENCE: Duration = Duration::from_secs(3);

/// A refusal that is older was of a command that is not sent any more.
const RECENT: Duration = Duration::from_secs(1);

/// A command that the vehicle refuses.
#[derive(Clone, Copy, Debug)]
struct Refusal {
    command: MavCmd,
    result: MavResult,
    since: Instant,
    last: Instant,
}

/// The newest of each kind of message.
#[derive(Clone, Debug)]
pub(crate) struct Vehicle {
    pub autopilot: Autopilot,
    pub mode: Mode,
    pub armed: bool,
    /// Whether it has followed set-points since it stood last.
    followed: bool,
    pub landed: Option<bool>,
    /// The number of requests for messages that it has confirmed.
    pub granted: usize,
    position: Option<LOCAL_POSITION_NED_DATA>,
    attitude: Option<ATTITUDE_DATA>,
    /// Height of the floor, metres down in the vehicle's frame.
    floor: Option<f32>,
    battery: Option<f64>,
    refused: Option<Refusal>,
    /// Where it was when it was read last: north, east and yaw.
    last: Option<[f64; 3]>,
    fresh: bool,
}

impl Vehicle {
    pub fn new(autopilot: Autopilot) -> Vehicle {
        Vehicle {
            autopilot,
            mode: Mode::Other(0),
            armed: false,
            followed: false,
            landed: None,
            granted: 0,
            position: None,
            attitude: None,
            floor: None,
            battery: None,
            refused: None,
            last: None,
            fresh: false,
        }
    }

    pub fn take(&mut self, message: &MavMessage) {
        match message {
            MavMessage::HEARTBEAT(data) => {
                self.mode = self.autopilot.mode(data.custom_mode);
                let armed = MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
                self.armed = data.base_mode.contains(armed);
                self.followed = self.armed && (self.followed || self.mode == Mode::External);
            }
            MavMessage::EXTENDED_SYS_STATE(data) => {
                let landed = data.landed_state == MavLandedState::MAV_LANDED_STATE_ON_GROUND;
                self.landed = Some(landed);
            }
            MavMessage::LOCAL_POSITION_NED(data) => {
                let numbers = [data.z, data.vx, data.vy, data.vz];
                if numbers.iter().all(|number| number.is_finite()) {
                    if self.floor.is_none() || (self.landed == Some(true) && !self.armed) {
                        self.floor = Some(data.z);
                    }
                    self.position = Some(data.clone());
                    self.fresh = true;
                }
            }
            MavMessage::ATTITUDE(data) if data.yaw.is_finite() => {
                self.attitude = Some(data.clone());
            }
            MavMessage::SYS_STATUS(data) => {
                // -1 means that it does not know.
                let known = (0..=100).contains(&data.battery_remaining);
                self.battery = known.then(|| 0.01 * f64::from(data.battery_remaining));
            }
            MavMessage::COMMAND_ACK(data) => self.acknowledge(data.command, data.result),
            _ => {}
        }
    }

    /// Whether it has followed set-points and is now in the air in a mode that this driver does not request: a pilot's,
    /// or the way home of a failsafe.
    pub fn taken_over(&self) -> bool {
        self.followed && self.landed == Some(false) && matches!(self.mode, Mode::Other(_))
    }

    fn acknowledge(&mut self, command: MavCmd, result: MavResult) {
        let now = Instant::now();
        let before = self.refused.filter(|refusal| refusal.command == command);
        let accepted = result == MavResult::MAV_RESULT_ACCEPTED;
        if accepted && command == MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL {
            self.granted += 1;
        }
        let done = [
            MavResult::MAV_RESULT_ACCEPTED,
            MavResult::MAV_RESULT_IN_PROGRESS,
        ];
        if !done.contains(&result) {
            self.refused = Some(Refusal {
                command,
                result,
                since: before.map_or(now, |refusal| refusal.since),
                last: now,
            });
        } else if before.is_some() {
            self.refused = None;
        }
    }

    /// The request that the vehicle has refused for longer than it takes to become ready.
    pub fn refusal(&self) -> Option<String> {
        let refusal = self.refused?;
        let goes_on = refusal.last.elapsed() < RECENT && refusal.since.elapsed() > PATIENCE;
        goes_on.then(|| format!("{:?}: {:?}", refusal.command, refusal.result))
    }

    /// Velocity in the vehicle's frame: metres per second forward, left and up.
    pub fn velocity(&self) -> Point {
        let (Some(position), Some(attitude)) = (&self.position, &self.attitude) else {
            return Point::ZERO;
        };
        let [north, east, down] = [position.vx, position.vy, position.vz].map(f64::from);
        let (sin, cos) = sincos(f64::from(attitude.yaw));
        Point::new(cos * north + sin * east, sin * north - cos * east, -down)
    }

    /// Metres above the floor from which it has taken off.
    pub fn height(&self) -> f64 {
        match (&self.position, self.floor) {
            (Some(position), Some(floor)) => f64::from(floor - position.z),
            _ => 0.0,
        }
    }

    /// The measurements since the last call.
    pub fn reading(&mut self) -> Option<Reading> {
        let attitude = self.attitude.as_ref()?;
        if !std::mem::take(&mut self.fresh) {
            return None;
        }
        let place = self
            .position
            .as_ref()
            .map(|position| [position.x, position.y, attitude.yaw].map(f64::from));
        let place = place.filter(|place| place[0].is_finite() && place[1].is_finite());
        let way = place.zip(self.last).and_then(|(now, last)| way(last, now));
        self.last = place;
        Some(Reading {
            moved: way.map(|way| way.0),
            turned: way.map(|way| way.1),
            velocity: Some(self.velocity()),
            height: Some(self.height()),
            // The vehicle measures from north to the right.
            heading: Some(-f64::from(attitude.yaw)),
            battery: self.battery,
            ..Reading::default()
        })
    }
}

/// The autopilot corrects its position by jumps, e.g. when its satellite fix changes. They are no motion, metres.
const JUMP: f64 = 1.0;

/// How far a vehicle has moved, in its own frame before the turn, and how far it has turned to the left, between two places
/// given by north, east and yaw; none for a jump.
fn way(last: [f64; 3], now: [f64; 3]) -> Option<(Point, f64)> {
    let (north, east) = (now[0] - last[0], now[1] - last[1]);
    let (sin, cos) = sincos(last[2]);
    let moved = Point::planar(cos * north + sin * east, sin * north - cos * east);
    let turned = wrap_angle(last[2] - now[2]);
    (moved.planar_length() < JUMP).then_some((moved, turned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_is_in_the_frame_of_the_vehicle() {
        // It looks east, and moves 0.2 m east and 0.1 m north: ahead and to the left.
        let east = std::f64::consts::FRAC_PI_2;
        let (moved, turned) = way([1.0, 2.0, east], [1.1, 2.2, east - 0.3]).expect("no jump");
        assert!(moved.distance(Point::planar(0.2, 0.1)) < 1e-12, "{moved:?}");
        assert!((turned - 0.3).abs() < 1e-12, "{turned}");
    }

    #[test]
    fn a_jump_of_the_position_is_not_taken_as_motion() {
        assert_eq!(way([0.0, 0.0, 0.0], [3.0, 0.0, 0.0]), None);
    }
}
