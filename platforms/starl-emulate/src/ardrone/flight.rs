//! The emulated drone's response to commands, and the content of its navdata.

use crate::BodyHandle;
use starl_ardrone::at::{AtCommand, Tilt};
use starl_ardrone::navdata::{ControlState, Demo, Navdata, state};
use starl_core::math::{degrees, sincos, wrap_angle};
use starl_core::{Command, Duration, Point};
use starl_motion::models::drone_mode as mode;
use std::time::Instant;

/// After so long without commands, milliseconds, the drone says that it has not heard any.
const WATCHDOG_MS: u128 = 50;
/// After so long it takes the connection for lost, and hovers.
const LOST_MS: u128 = 2000;
/// How long a full battery lasts in the air, seconds.
const ENDURANCE_S: f64 = 720.0;
/// At this charge, per cent, the drone warns, and lands if it gets no commands.
const LOW_BATTERY: u32 = 20;

#[derive(Debug)]
pub(super) struct Flight {
    body: BodyHandle,
    /// The yaw at which it was switched on.
    zero: f64,
    /// The greatest tilt (radians), climb (metres per second) and turn (radians per second) of its configuration.
    tilt: f64,
    climb: f64,
    yaw_rate: f64,
    /// The last command taken.
    sequence: u32,
    sent: u32,
    /// Whether it is to be in the air.
    fly: bool,
    emergency_bit: bool,
    emergency: bool,
    bootstrap: bool,
    acknowledged: bool,
    watchdog: bool,
    heard: Option<Instant>,
    in_air: f64,
    watched: Duration,
}

impl Flight {
    pub fn new(body: BodyHandle) -> Flight {
        Flight {
            zero: body.state().pose.yaw,
            watched: body.elapsed(),
            body,
            tilt: 0.21,
            climb: 0.7,
            yaw_rate: 1.75,
            sequence: 0,
            sent: 0,
            fly: false,
            emergency_bit: false,
            emergency: false,
            bootstrap: true,
            acknowledged: false,
            watchdog: false,
            heard: None,
            in_air: 0.0,
        }
    }

    pub fn emergency(&self) -> bool {
        self.emergency
    }

    pub fn halt(&self) {
        self.body.command(Command::Stop);
    }

    /// A client has written to the port of navdata.
    pub fn hear(&mut self) {
        self.heard = Some(Instant::now());
    }

    /// Accepts a command if it is newer than the last one. Number 1 resets the count.
    pub fn take(&mut self, sequence: u32, command: &AtCommand) {
        if sequence <= self.sequence && sequence != 1 {
            return;
        }
        self.sequence = sequence;
        self.hear();
        match command {
            AtCommand::Reference { fly, emergency } => self.refer(*fly, *emergency),
            AtCommand::Fly(tilt) => self.steer(*tilt),
            AtCommand::Watchdog => self.watchdog = false,
            AtCommand::Configure { key, value } => self.configure(key, value),
            AtCommand::AcknowledgementSeen => self.acknowledged = false,
            AtCommand::FlatTrim => {}
        }
    }

    fn refer(&mut self, fly: bool, emergency: bool) {
        if emergency && !self.emergency_bit {
            self.emergency = !self.emergency;
        }
        self.emergency_bit = emergency;
        let fly = fly && !self.emergency;
        let before = std::mem::replace(&mut self.fly, fly);
        match (before, fly) {
            (false, true) => self.body.command(Command::TakeOff),
            (_, false) => self.body.command(Command::Land),
            (true, true) => {}
        }
    }

    fn steer(&mut self, tilt: Option<Tilt>) {
        let now = self.body.state().mode;
        // Until it is high enough the drone obeys only the command to land.
        if !self.fly || matches!(now, mode::LANDED | mode::TAKING_OFF) {
            return;
        }
        self.body.command(match tilt {
            None => Command::Hover,
            Some(tilt) => Command::Attitude {
                yaw_rate: -f64::from(tilt.yaw) * self.yaw_rate,
                pitch: -f64::from(tilt.pitch) * self.tilt,
                roll: f64::from(tilt.roll) * self.tilt,
                gaz: f64::from(tilt.climb) * self.climb,
            },
        });
    }

    fn configure(&mut self, key: &str, value: &str) {
        let number = |low: f64, high: f64, unit: f64| {
            let number: f64 = value.parse().ok()?;
            (low..=high).contains(&number).then_some(number * unit)
        };
        match key {
            "general:navdata_demo" => self.bootstrap = false,
            "control:euler_angle_max" => self.tilt = number(0.0, 0.52, 1.0).unwrap_or(self.tilt),
            "control:control_vz_max" => {
                self.climb = number(200.0, 2000.0, 0.001).unwrap_or(self.climb);
            }
            "control:control_yaw" => {
                self.yaw_rate = number(0.7, 6.11, 1.0).unwrap_or(self.yaw_rate)
            }
            _ => {}
        }
        self.acknowledged = true;
    }

    /// Whether the connection counts as lost.
    pub fn lost(&self) -> bool {
        self.silence_ms().is_none_or(|silence| silence > LOST_MS)
    }

    fn silence_ms(&self) -> Option<u128> {
        self.heard.map(|heard| heard.elapsed().as_millis())
    }

    /// The drone's reaction to missing commands.
    pub fn watch(&mut self) {
        let now = self.body.elapsed();
        let flying = self.body.state().mode != mode::LANDED;
        if flying {
            self.in_air += Duration(now.0 - self.watched.0).seconds();
        }
        self.watched = now;
        if self
            .silence_ms()
            .is_some_and(|silence| silence > WATCHDOG_MS)
        {
            self.watchdog = true;
        }
        if self.lost() && self.fly && self.body.state().mode == mode::FLYING {
            self.body.command(Command::Hover);
        }
        if self.battery() == 0 || (self.lost() && self.battery() <= LOW_BATTERY) {
            self.fly = false;
            self.body.command(Command::Land);
        }
    }

    fn battery(&self) -> u32 {
        (100.0 * (1.0 - self.in_air / ENDURANCE_S)).clamp(0.0, 100.0) as u32
    }

    /// The next datagram of navdata.
    pub fn navdata(&mut self) -> Navdata {
        self.sent += 1;
        let flying = self.body.state().mode != mode::LANDED;
        let bits = [
            (flying, state::FLYING),
            (self.acknowledged, state::ACKNOWLEDGED),
            (!self.bootstrap, state::DEMO),
            (self.bootstrap, state::BOOTSTRAP),
            (self.lost(), state::LOST),
            (self.battery() <= LOW_BATTERY, state::LOW_BATTERY),
            (self.watchdog, state::WATCHDOG),
            (self.emergency, state::EMERGENCY),
        ];
        let set = bits.iter().filter(|(set, _)| *set);
        Navdata {
            state: set.fold(0, |bits, (_, bit)| bits | bit),
            sequence: self.sent,
            demo: (!self.bootstrap).then(|| self.demo()),
        }
    }

    fn demo(&self) -> Demo {
        let now = self.body.state();
        let thousandths = |angle: f64| (1000.0 * degrees(angle)) as f32;
        let (sin, cos) = sincos(now.pose.yaw);
        let Point { x, y, z } = now.twist.linear;
        let velocity = [cos * x + sin * y, sin * x - cos * y, -z];
        Demo {
            control: match now.mode {
                mode::LANDED => ControlState::Landed,
                mode::TAKING_OFF => ControlState::TakingOff,
                mode::FLYING => ControlState::Flying,
                mode::LANDING => ControlState::Landing,
                _ => ControlState::Hovering,
            },
            battery: self.battery(),
            pitch: -thousandths(now.pose.pitch),
            roll: thousandths(now.pose.roll),
            yaw: -thousandths(wrap_angle(now.pose.yaw - self.zero)),
            altitude: (1000.0 * now.pose.position.z) as i32,
            velocity: velocity.map(|speed| (1000.0 * speed) as f32),
        }
    }
}
