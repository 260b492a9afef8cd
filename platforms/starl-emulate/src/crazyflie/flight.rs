//! How an emulated Crazyflie flies set-points and manoeuvres.

use crate::BodyHandle;
use crate::control::{self, fly};
use starl_core::math::{sincos, wrap_angle};
use starl_core::{Command, Duration as Span, Point, Pose};
use starl_crazyflie::commander::{Order, SetPoint};
use starl_motion::models::drone_mode;
use std::time::{Duration, Instant};

/// A set-point is in force for so long.
const IN_FORCE: Duration = Duration::from_millis(500);
/// When set-points have stopped for so long, the motors stop.
const GIVE_UP: Duration = Duration::from_millis(2000);
/// Climb per error of height, 1/s.
const HEIGHT_GAIN: f64 = 2.0;
/// How long a full battery lasts in the air, seconds.
const ENDURANCE_S: f64 = 420.0;

/// Bits of `supervisor.info`: it may be armed, is armed, is armed by itself, may fly, flies, lies on its side.
const CAN_BE_ARMED: u16 = 1;
const ARMED: u16 = 1 << 1;
const ARMED_BY_ITSELF: u16 = 1 << 2;
const CAN_FLY: u16 = 1 << 3;
const FLYING: u16 = 1 << 4;
const TUMBLED: u16 = 1 << 5;

#[derive(Debug)]
pub(super) struct Flight {
    body: BodyHandle,
    /// The origin of its own frame.
    home: Pose,
    armed: bool,
    tumbled: bool,
    set_point: Option<(Instant, SetPoint)>,
    manoeuvre: Option<Manoeuvre>,
    in_air: f64,
    watched: Span,
}

/// A manoeuvre that it flies by itself.
#[derive(Clone, Copy, Debug)]
enum Manoeuvre {
    /// To this height, metres.
    Rise(f64),
    /// To a place and a yaw of the world.
    Go(Point, f64),
    Land,
}

impl Flight {
    pub fn new(body: BodyHandle) -> Flight {
        Flight {
            home: body.state().pose,
            watched: body.elapsed(),
            body,
            armed: true,
            tumbled: false,
            set_point: None,
            manoeuvre: None,
            in_air: 0.0,
        }
    }

    pub fn halt(&self) {
        self.body.command(Command::Stop);
    }

    pub fn tumble(&mut self) {
        self.tumbled = true;
        self.give_up();
    }

    pub fn follow(&mut self, set_point: SetPoint) {
        if set_point == SetPoint::Stop {
            return self.give_up();
        }
        self.manoeuvre = None;
        self.set_point = Some((Instant::now(), set_point));
    }

    pub fn obey(&mut self, order: Order) {
        match order {
            Order::ReleaseSetPoints => self.set_point = None,
            Order::Arm(arm) => self.armed = arm || !self.stands(),
            Order::Stop => self.give_up(),
            // Set-points have precedence until they are released or too old.
            _ if self
                .set_point
                .is_some_and(|(at, _)| at.elapsed() < IN_FORCE) => {}
            Order::TakeOff { height, .. } => self.begin(Manoeuvre::Rise(height.into())),
            Order::Land { .. } => self.begin(Manoeuvre::Land),
            Order::GoTo {
                relative,
                position,
                yaw,
                ..
            } if !self.stands() => {
                let [x, y, z] = position.map(f64::from);
                let (origin, turn) = match relative {
                    // The place is measured in the own frame's directions, from where it is.
                    true => (self.body.state().pose.position, self.body.state().pose.yaw),
                    false => (self.home.position, self.home.yaw),
                };
                let place = origin + self.in_world(Point::new(x, y, z));
                self.begin(Manoeuvre::Go(place, wrap_angle(turn + f64::from(yaw))));
            }
            Order::GoTo { .. } => {}
        }
    }

    fn begin(&mut self, manoeuvre: Manoeuvre) {
        self.set_point = None;
        self.manoeuvre = Some(manoeuvre);
    }

    /// The motors stop.
    fn give_up(&mut self) {
        self.begin(Manoeuvre::Land);
    }

    fn stands(&self) -> bool {
        self.body.state().mode == drone_mode::LANDED
    }

    /// The periodic step.
    pub fn tick(&mut self) {
        let now = self.body.elapsed();
        if !self.stands() {
            self.in_air += Span(now.0 - self.watched.0).seconds();
        }
        self.watched = now;
        if let Some((at, _)) = self.set_point
            && at.elapsed() > GIVE_UP
        {
            self.give_up();
        }
        if self.stands() && (!self.can_fly() || matches!(self.manoeuvre, Some(Manoeuvre::Land))) {
            self.manoeuvre = None;
            self.set_point = None;
            return self.body.command(Command::Stop);
        }
        match (self.set_point, self.manoeuvre) {
            (Some((at, _)), _) if at.elapsed() > IN_FORCE => self.body.command(Command::Hover),
            (Some((_, set_point)), _) => fly(&self.body, self.command(set_point)),
            (None, Some(Manoeuvre::Land)) => self.body.command(Command::Land),
            (None, Some(Manoeuvre::Rise(height))) => {
                let climb = control::SetPoint::climb(HEIGHT_GAIN * (height - self.position().z));
                fly(&self.body, climb.command(&self.body.state()));
            }
            (None, Some(Manoeuvre::Go(position, yaw))) => {
                let goal = control::SetPoint {
                    position: Some(position),
                    yaw: Some(yaw),
                    ..control::SetPoint::default()
                };
                fly(&self.body, goal.command(&self.body.state()));
            }
            (None, None) if self.stands() => self.body.command(Command::Stop),
            (None, None) => self.body.command(Command::Hover),
        }
    }

    fn command(&self, set_point: SetPoint) -> Command {
        let radians = |degrees: f32| f64::from(degrees).to_radians();
        let climb = |height: f32| {
            let error = f64::from(height) - self.position().z;
            (HEIGHT_GAIN * error).clamp(-0.7, 0.7)
        };
        let tilt = |roll, pitch, yaw_rate, gaz| Command::Attitude {
            yaw_rate: radians(yaw_rate),
            pitch: -radians(pitch),
            roll: radians(roll),
            gaz,
        };
        let goal = match set_point {
            SetPoint::Stop => return Command::Land,
            SetPoint::Height {
                roll,
                pitch,
                yaw_rate,
                height,
            } => {
                return tilt(roll, pitch, yaw_rate, climb(height));
            }
            SetPoint::Climb {
                roll,
                pitch,
                yaw_rate,
                climb,
            } => {
                return tilt(roll, pitch, yaw_rate, climb.into());
            }
            SetPoint::Velocity { velocity, yaw_rate } => {
                let [x, y, z] = velocity.map(f64::from);
                control::SetPoint {
                    velocity: Some(self.in_world(Point::new(x, y, z))),
                    yaw_rate: Some(radians(yaw_rate)),
                    ..control::SetPoint::default()
                }
            }
            SetPoint::Hover {
                velocity: [x, y],
                yaw_rate,
                height,
            } => control::SetPoint {
                velocity: Some(Point::new(x.into(), y.into(), climb(height))),
                body: true,
                yaw_rate: Some(radians(yaw_rate)),
                ..control::SetPoint::default()
            },
            SetPoint::Position { position, yaw } => {
                let [x, y, z] = position.map(f64::from);
                control::SetPoint {
                    position: Some(self.home.position + self.in_world(Point::new(x, y, z))),
                    yaw: Some(wrap_angle(self.home.yaw + radians(yaw))),
                    ..control::SetPoint::default()
                }
            }
        };
        goal.command(&self.body.state())
    }

    /// Turns a vector of the own frame into the world's.
    fn in_world(&self, Point { x, y, z }: Point) -> Point {
        let (sin, cos) = sincos(self.home.yaw);
        Point::new(cos * x - sin * y, sin * x + cos * y, z)
    }

    fn in_own_frame(&self, Point { x, y, z }: Point) -> Point {
        let (sin, cos) = sincos(self.home.yaw);
        Point::new(cos * x + sin * y, cos * y - sin * x, z)
    }

    /// Where it is in its own frame.
    pub fn position(&self) -> Point {
        self.in_own_frame(self.body.state().pose.position - self.home.position)
    }

    pub fn velocity(&self) -> Point {
        self.in_own_frame(self.body.state().twist.linear)
    }

    pub fn yaw(&self) -> f64 {
        wrap_angle(self.body.state().pose.yaw - self.home.yaw)
    }

    /// Charge, 0 to 1.
    pub fn battery(&self) -> f64 {
        (1.0 - self.in_air / ENDURANCE_S).clamp(0.0, 1.0)
    }

    pub fn can_fly(&self) -> bool {
        self.armed && !self.tumbled
    }

    pub fn info(&self) -> u16 {
        let bits = [
            (!self.tumbled, CAN_BE_ARMED),
            (self.armed, ARMED),
            (true, ARMED_BY_ITSELF),
            (self.can_fly(), CAN_FLY),
            (!self.stands(), FLYING),
            (self.tumbled, TUMBLED),
        ];
        let set = bits.iter().filter(|(is_set, _)| *is_set);
        set.fold(0, |info, (_, bit)| info | bit)
    }

    pub fn time_ms(&self) -> u32 {
        (self.body.elapsed().0 / 1_000_000) as u32 & 0x00FF_FFFF
    }
}
