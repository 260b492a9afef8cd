//! The driver: commands of the platform to set-points, telemetry to readings.

use crate::PX4_PORT;
use crate::autopilot::{Autopilot, Mode};
use crate::common::{
    HEARTBEAT_DATA, MavAutopilot, MavCmd, MavFrame, MavMessage, MavModeFlag, MavState, MavType,
    PositionTargetTypemask, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use crate::link::Link;
use crate::state::Vehicle;
use starl_core::math::tan;
use starl_core::{Command, Estimate, Point};
use starl_node::{Device, DeviceError, Reading};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::time::{Duration, Instant};

/// How to fly a vehicle.
#[derive(Clone, Copy, Debug)]
pub struct MavlinkOptions {
    /// Where the vehicle sends to: this machine's address and port.
    pub listen: SocketAddr,
    /// Where the vehicle listens, if it waits for the first message.
    pub vehicle: Option<SocketAddr>,
    /// How high it takes off, metres.
    pub take_off_height: f64,
    /// How fast it takes off, metres per second.
    pub take_off_speed: f64,
    /// Drag per mass of the model whose commands it takes, 1/s.
    pub drag: f64,
}

impl Default for MavlinkOptions {
    /// A PX4 vehicle that sends to this machine.
    fn default() -> MavlinkOptions {
        MavlinkOptions {
            listen: (IpAddr::from(Ipv4Addr::UNSPECIFIED), PX4_PORT).into(),
            vehicle: None,
            take_off_height: 0.6,
            take_off_speed: 0.5,
            // The model `drone`: 0.3 kg/s and 0.42 kg.
            drag: 0.3 / 0.42,
        }
    }
}

/// A vehicle that is silent for so long is out of reach. It sends its place 20 times a second.
const SILENCE: Duration = Duration::from_millis(2000);
/// How often the vehicle hears that there is a computer.
const HEARTBEAT: Duration = Duration::from_millis(500);
/// How often a request is repeated until the vehicle shows that it has done it.
const REPEAT: Duration = Duration::from_millis(400);
/// Numbers of the messages that are asked for: place, attitude, whether it has landed.
const TELEMETRY: [u32; 3] = [32, 30, 245];
/// Microseconds between two of them.
const INTERVAL: f32 = 50_000.0;
/// The number of requests to a vehicle that sends all messages, but does not confirm that it changes their rate. It may
/// refuse them, which is a fault only where it continues for longer.
const MOST_REQUESTS: u32 = 5;
/// The autopilot's gain from an error of velocity to an acceleration, 1/s: PX4's `MPC_XY_VEL_P_ACC` is 1.8, ArduCopter's
/// `PSC_VELXY_P` 2.
const VELOCITY_GAIN: f64 = 1.8;
const GRAVITY: f64 = 9.80665;

/// A multicopter with PX4 or ArduPilot.
///
/// An attitude of the model `drone` means an acceleration against the model's drag; it is flown as the velocity from which
/// the autopilot's own loop makes what is left of that acceleration, because the autopilot compensates the vehicle's drag by itself.
/// Where a pilot or a failsafe takes the vehicle over in the air, the driver leaves it to them
/// until it stands, or is switched back to the mode that follows set-points. Where set-points stop, the autopilot holds its place after 1 s (PX4) or 3 s
/// (ArduPilot), or does what its failsafe is set to.
#[derive(Debug)]
pub struct MavlinkVehicle {
    link: Link,
    options: MavlinkOptions,
    vehicle: Option<Vehicle>,
    greeted: Option<Instant>,
    asked: Option<Instant>,
    /// How often this vehicle was asked for messages.
    requests: u32,
    /// Whether it is to be in the air; unknown until the vehicle says whether it is.
    fly: Option<bool>,
}

impl MavlinkVehicle {
    /// Opens a socket. A vehicle that is not there shows in [`Device::read`].
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn connect(options: &MavlinkOptions) -> Result<MavlinkVehicle, DeviceError> {
        Ok(MavlinkVehicle {
            link: Link::open(options.listen, options.vehicle)?,
            options: *options,
            vehicle: None,
            greeted: None,
            asked: None,
            requests: 0,
            fly: None,
        })
    }

    /// Where it listens.
    ///
    /// # Errors
    /// If the system does not tell the port.
    pub fn address(&self) -> std::io::Result<SocketAddr> {
        self.link.address()
    }

    /// Velocity forward, left and up, and rate of turn to the left.
    fn set_velocity(&mut self, velocity: Point, yaw_rate: f64) -> Result<(), DeviceError> {
        use PositionTargetTypemask as Mask;
        let position = Mask::POSITION_TARGET_TYPEMASK_X_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_Y_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_Z_IGNORE;
        let acceleration = Mask::POSITION_TARGET_TYPEMASK_AX_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_AY_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_AZ_IGNORE;
        // Newer names of the frame are not known to PX4 before 1.14.
        #[allow(deprecated)]
        let coordinate_frame = MavFrame::MAV_FRAME_BODY_NED;
        let target_system = self.link.system();
        let message =
            MavMessage::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA {
                vx: velocity.x as f32,
                vy: -velocity.y as f32,
                vz: -velocity.z as f32,
                yaw_rate: -yaw_rate as f32,
                type_mask: position | acceleration | Mask::POSITION_TARGET_TYPEMASK_YAW_IGNORE,
                target_system,
                target_component: 1,
                coordinate_frame,
                ..SET_POSITION_TARGET_LOCAL_NED_DATA::DEFAULT
            });
        Ok(self.link.send(&message)?)
    }

    /// Announces this client to the vehicle, and requests messages.
    fn greet(&mut self) -> Result<(), DeviceError> {
        if self.greeted.is_some_and(|at| at.elapsed() < HEARTBEAT) {
            return Ok(());
        }
        self.greeted = Some(Instant::now());
        self.link.send(&MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode: 0,
            mavtype: MavType::MAV_TYPE_ONBOARD_CONTROLLER,
            autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
            base_mode: MavModeFlag::empty(),
            system_status: MavState::MAV_STATE_ACTIVE,
            mavlink_version: 3,
        }))?;
        let complete = |vehicle: &Vehicle| {
            // Messages also arrive without a request, but too seldom to fly by.
            let granted = vehicle.granted >= TELEMETRY.len() || self.requests >= MOST_REQUESTS;
            vehicle.landed.is_some() && granted
        };
        if self.link.has_peer() && !self.vehicle.as_ref().is_some_and(complete) {
            self.requests = self.requests.saturating_add(1);
            for message in TELEMETRY {
                let parameters = [message as f32, INTERVAL, 0.0, 0.0, 0.0, 0.0, 0.0];
                self.link
                    .command(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, parameters)?;
            }
        }
        Ok(())
    }

    /// Whether a request may be sent now.
    fn may_ask(&mut self) -> bool {
        let may = self.asked.is_none_or(|at| at.elapsed() >= REPEAT);
        if may {
            self.asked = Some(Instant::now());
        }
        may
    }

    fn listen(&mut self) -> Result<(), DeviceError> {
        for (new, message) in self.link.receive()? {
            if let Some(autopilot) = new {
                self.vehicle = Some(Vehicle::new(autopilot));
                self.requests = 0;
            }
            if let Some(vehicle) = &mut self.vehicle {
                vehicle.take(&message);
                if self.fly.is_none() {
                    self.fly = vehicle.landed.map(|landed| !landed);
                }
            }
        }
        Ok(())
    }

    fn check(&self) -> Result<(), DeviceError> {
        let fault = |text: String| Err(DeviceError::Fault(text));
        if self.link.silence() > SILENCE {
            return fault(format!(
                "no autopilot is heard on {}; does the vehicle send there?",
                self.options.listen
            ));
        }
        match &self.vehicle {
            Some(vehicle) if vehicle.taken_over() => fault(format!(
                "a pilot or a failsafe has taken over: the vehicle is in mode {}",
                vehicle.autopilot.number(vehicle.mode)
            )),
            Some(vehicle) => match vehicle.refusal() {
                Some(refused) => fault(format!("the autopilot refuses {refused}")),
                None => Ok(()),
            },
            None => Ok(()),
        }
    }

    /// Brings the vehicle into the mode in which it follows set-points, and arms it.
    fn take_control(&mut self, autopilot: Autopilot) -> Result<(), DeviceError> {
        let Some(vehicle) = &self.vehicle else {
            return Ok(());
        };
        let (mode, armed) = (vehicle.mode, vehicle.armed);
        if mode != Mode::External {
            if self.may_ask() {
                let [second, third] = autopilot.request(Mode::External);
                let custom = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED.bits();
                let parameters = [f32::from(custom), second, third, 0.0, 0.0, 0.0, 0.0];
                self.link.command(MavCmd::MAV_CMD_DO_SET_MODE, parameters)?;
            }
        } else if !armed && self.may_ask() {
            let parameters = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            self.link
                .command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, parameters)?;
        }
        Ok(())
    }

    fn take_off(&mut self, autopilot: Autopilot) -> Result<(), DeviceError> {
        let MavlinkOptions {
            take_off_height,
            take_off_speed,
            ..
        } = self.options;
        let vehicle = self.vehicle.as_ref();
        let height = vehicle.map_or(0.0, Vehicle::height);
        let ready = vehicle.is_some_and(|vehicle| vehicle.armed && vehicle.mode == Mode::External);
        let standing = vehicle.is_some_and(|vehicle| vehicle.landed == Some(true));
        match autopilot {
            // PX4 gives control only to a client that already sends set-points.
            Autopilot::Px4 => {
                let rises = ready && height < take_off_height;
                let climb = if rises { take_off_speed } else { 0.0 };
                self.set_velocity(Point::new(0.0, 0.0, climb), 0.0)?;
            }
            Autopilot::ArduPilot => {
                if ready && standing && self.may_ask() {
                    let height = take_off_height as f32;
                    let parameters = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, height];
                    self.link.command(MavCmd::MAV_CMD_NAV_TAKEOFF, parameters)?;
                }
            }
        }
        self.take_control(autopilot)
    }

    fn land(&mut self) -> Result<(), DeviceError> {
        let Some(vehicle) = &self.vehicle else {
            return Ok(());
        };
        let landing = vehicle.mode == Mode::Land || vehicle.landed == Some(true);
        if landing || vehicle.taken_over() || !self.may_ask() {
            return Ok(());
        }
        let nan = f32::NAN;
        let parameters = [0.0, 0.0, 0.0, nan, 0.0, 0.0, 0.0];
        Ok(self.link.command(MavCmd::MAV_CMD_NAV_LAND, parameters)?)
    }

    /// The velocity and rate of turn for a command in the air.
    fn translate(&self, command: &Command) -> (Point, f64) {
        match *command {
            Command::Attitude {
                yaw_rate,
                pitch,
                roll,
                gaz,
            } if is_flown(command) => {
                let now = self.vehicle.as_ref().map_or(Point::ZERO, Vehicle::velocity);
                // Beyond this the tangent grows without bound; no vehicle tilts so far.
                let push = |tilt: f64| GRAVITY * tan(tilt.clamp(-0.7, 0.7));
                let wanted =
                    |now: f64, push: f64| now + (push - self.options.drag * now) / VELOCITY_GAIN;
                let (ahead, left) = (wanted(now.x, push(pitch)), wanted(now.y, push(-roll)));
                (Point::new(ahead, left, gaz), yaw_rate)
            }
            _ => (Point::ZERO, 0.0),
        }
    }
}

impl Device for MavlinkVehicle {
    /// Takes `TakeOff`, `Land`, `Hover`, `Stop` (which hovers) and `Attitude`. Any other command makes it hover and is
    /// a fault. A landing continues until `TakeOff`.
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        self.greet()?;
        match command {
            Command::TakeOff => self.fly = Some(true),
            Command::Land => self.fly = Some(false),
            _ => {}
        }
        if let Some(vehicle) = &self.vehicle
            && !vehicle.taken_over()
        {
            let autopilot = vehicle.autopilot;
            match (self.fly, command) {
                (Some(true), Command::TakeOff) => self.take_off(autopilot)?,
                (Some(true), _) => {
                    let (velocity, yaw_rate) = self.translate(command);
                    self.set_velocity(velocity, yaw_rate)?;
                    self.take_control(autopilot)?;
                }
                (Some(false), _) => self.land()?,
                (None, _) => {}
            }
        }
        if !is_flown(command) {
            return Err(DeviceError::Fault(format!(
                "a MAVLink vehicle cannot do {command:?}; use TakeOff, Land, Hover, Stop or Attitude"
            )));
        }
        self.check()
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.greet()?;
        self.fly = Some(false);
        // It brakes even if the request to land is lost.
        self.set_velocity(Point::ZERO, 0.0)?;
        self.land()
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        self.listen()?;
        self.greet()?;
        if self.link.silence() > SILENCE {
            // It may come back with another address, or have been switched off.
            self.link.forget_peer();
            self.vehicle = None;
        }
        self.check()?;
        let Some(vehicle) = self.vehicle.as_mut() else {
            return Ok(None);
        };
        if vehicle.landed.is_none() {
            return Ok(None);
        }
        Ok(vehicle.reading())
    }
}

/// Whether a command is one of a drone's, with finite numbers.
fn is_flown(command: &Command) -> bool {
    match *command {
        Command::Stop | Command::Hover | Command::TakeOff | Command::Land => true,
        Command::Attitude {
            yaw_rate,
            pitch,
            roll,
            gaz,
        } => [yaw_rate, pitch, roll, gaz]
            .iter()
            .all(|number| number.is_finite()),
        _ => false,
    }
}

impl Drop for MavlinkVehicle {
    /// Lands a vehicle in the air. Sends the command several times, since there is no acknowledgement.
    fn drop(&mut self) {
        for _ in 0..5 {
            self.asked = None;
            let _ = self.stop();
            let landed = |vehicle: &Vehicle| vehicle.landed == Some(true);
            if self.vehicle.as_ref().is_none_or(landed) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common::{ATTITUDE_DATA, LOCAL_POSITION_NED_DATA};
    use starl_core::math::atan;

    /// A driver of a vehicle that looks north and moves with this velocity: north and east, metres per second.
    fn driver(north: f32, east: f32) -> MavlinkVehicle {
        let options = MavlinkOptions {
            listen: (IpAddr::from(Ipv4Addr::LOCALHOST), 0).into(),
            ..MavlinkOptions::default()
        };
        let mut driver = MavlinkVehicle::connect(&options).expect("a port is free");
        let mut vehicle = Vehicle::new(Autopilot::Px4);
        vehicle.take(&MavMessage::ATTITUDE(ATTITUDE_DATA::DEFAULT));
        vehicle.take(&MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
            vx: north,
            vy: east,
            ..LOCAL_POSITION_NED_DATA::DEFAULT
        }));
        driver.vehicle = Some(vehicle);
        driver
    }

    fn tilted(pitch: f64, roll: f64) -> Command {
        Command::Attitude {
            yaw_rate: 0.0,
            pitch,
            roll,
            gaz: 0.0,
        }
    }

    #[test]
    fn a_tilt_that_balances_drag_keeps_the_velocity() {
        let drag = MavlinkOptions::default().drag;
        let tilt = |speed: f64| atan(drag * speed / GRAVITY);
        let (velocity, _) = driver(1.5, 0.0).translate(&tilted(tilt(1.5), 0.0));
        assert!(
            velocity.distance(Point::planar(1.5, 0.0)) < 1e-6,
            "{velocity:?}"
        );
        let (velocity, _) = driver(0.0, 1.0).translate(&tilted(0.0, tilt(1.0)));
        assert!(
            velocity.distance(Point::planar(0.0, -1.0)) < 1e-6,
            "{velocity:?}"
        );
    }

    #[test]
    fn a_level_vehicle_that_moves_is_slowed_by_drag() {
        let drag = MavlinkOptions::default().drag;
        let (velocity, _) = driver(1.0, 0.0).translate(&tilted(0.0, 0.0));
        let wanted = 1.0 - drag / VELOCITY_GAIN;
        assert!(
            velocity.distance(Point::planar(wanted, 0.0)) < 1e-6,
            "{velocity:?}"
        );
    }
}
