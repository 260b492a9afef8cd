//! The drone's equations of motion and their integration.
//!
//! With R = Rz(yaw) Ry(pitch) Rx(roll) the thrust T acts along R e_z, which is (z up, x ahead, y left)
//!
//! ```text
//! cos(yaw) cos(roll) sin(pitch) + sin(yaw) sin(roll)
//! sin(yaw) cos(roll) sin(pitch) - cos(yaw) sin(roll)
//! cos(roll) cos(pitch)
//! ```
//!
//! The drone sets T = m (g + z'') / (cos(roll) cos(pitch)) for the climb z'' that its vertical loop
//! asks for, so the horizontal acceleration is (g + z'') times the first two rows over the third, less
//! drag: D/m (velocity - wind).

use super::GRAVITY;
use super::mode;
use crate::{Disturbance, State};
use starl_core::math::{sincos, wrap_angle};
use starl_core::{Command, Point, Pose, Twist};

/// The longest step of integration, seconds: a fifth of the fastest loop's time constant at its
/// default frequency of 10 rad/s.
const LONGEST_STEP: f64 = 0.02;

/// At this part of the safe height taking off is over.
const HIGH_ENOUGH: f64 = 0.98;

/// A drone that starts to hold its position chooses the one that it would reach after this time, seconds, so that it
/// brakes without flying back.
const BRAKING_TIME: f64 = 0.6;

/// The constants of the equations, in SI units and radians.
#[derive(Clone, Debug)]
pub(super) struct Dynamics {
    /// Drag per mass, 1/s.
    pub drag: f64,
    pub tilt: f64,
    pub yaw_rate: f64,
    pub climb: f64,
    pub attitude_frequency: f64,
    pub yaw_time: f64,
    pub climb_time: f64,
    pub safe_height: f64,
    pub landing_speed: f64,
}

/// The variables that are integrated: position, velocity, (yaw, pitch, roll) and their rates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    angles: [f64; 3],
    rates: [f64; 3],
}

/// Second derivatives: of the position and of the angles.
struct Acceleration {
    linear: [f64; 3],
    angular: [f64; 3],
}

impl Dynamics {
    /// The state after `seconds` under a command that the drone accepts.
    pub fn advance(
        &self,
        state: &State,
        command: &Command,
        disturbance: &Disturbance,
        seconds: f64,
    ) -> State {
        let high = |z: f64| z >= HIGH_ENOUGH * self.safe_height;
        let before = state.mode;
        let mut mode = mode::after(before, command, high(state.pose.position.z));
        if mode == mode::LANDED {
            let pose = Pose::level(state.pose.position, state.pose.yaw);
            return State {
                pose,
                twist: Twist::default(),
                mode,
                ..*state
            };
        }
        let mut motion = Motion::of(state);
        let mut anchor = state.memory;
        if mode::holds_place(mode) && !mode::holds_place(before) {
            let braking = if before == mode::LANDED {
                0.0
            } else {
                BRAKING_TIME
            };
            anchor = [0, 1].map(|axis| motion.position[axis] + braking * motion.velocity[axis]);
        }
        let steps = (seconds / LONGEST_STEP - 1e-9).max(0.0) as u32 + 1;
        let step = seconds / f64::from(steps);
        for _ in 0..steps {
            motion = self.step(&motion, mode, command, anchor, disturbance, step);
            if motion.position[2] <= 0.0 {
                motion.position[2] = 0.0;
                if motion.velocity[2] < 0.0 {
                    motion.velocity[2] = 0.0;
                }
                if mode == mode::LANDING {
                    motion = motion.standing();
                    mode = mode::LANDED;
                    break;
                }
            }
        }
        if mode == mode::TAKING_OFF && high(motion.position[2]) {
            mode = mode::HOVERING;
        }
        motion.state(mode, anchor)
    }

    /// One step of the classical fourth-order Runge-Kutta method.
    fn step(
        &self,
        start: &Motion,
        mode: u32,
        command: &Command,
        anchor: [f64; 2],
        disturbance: &Disturbance,
        step: f64,
    ) -> Motion {
        let slope = |motion: &Motion| self.acceleration(motion, mode, command, anchor, disturbance);
        let first = slope(start);
        let early = start.moved(start, &first, 0.5 * step);
        let second = slope(&early);
        let late = start.moved(&early, &second, 0.5 * step);
        let third = slope(&late);
        let last = start.moved(&late, &third, step);
        let fourth = slope(&last);
        let sixth = step / 6.0;
        let sum = |a: f64, b: f64, c: f64, d: f64| sixth * (a + 2.0 * b + 2.0 * c + d);
        let mut end = *start;
        for i in 0..3 {
            let (a, b) = (start.velocity[i], early.velocity[i]);
            end.position[i] += sum(a, b, late.velocity[i], last.velocity[i]);
            let (a, b) = (first.linear[i], second.linear[i]);
            end.velocity[i] += sum(a, b, third.linear[i], fourth.linear[i]);
            end.angles[i] += sum(start.rates[i], early.rates[i], late.rates[i], last.rates[i]);
            let (a, b) = (first.angular[i], second.angular[i]);
            end.rates[i] += sum(a, b, third.angular[i], fourth.angular[i]);
        }
        end
    }

    fn acceleration(
        &self,
        motion: &Motion,
        mode: u32,
        command: &Command,
        anchor: [f64; 2],
        disturbance: &Disturbance,
    ) -> Acceleration {
        let [yaw, pitch, roll] = motion.angles;
        let [yaw_rate, pitch_rate, roll_rate] = motion.rates;
        let (sin_yaw, cos_yaw) = sincos(yaw);
        let (sin_pitch, cos_pitch) = sincos(pitch);
        let (sin_roll, cos_roll) = sincos(roll);
        let wanted = self.references(
            mode,
            command,
            anchor,
            motion,
            (sin_yaw, cos_yaw),
            disturbance,
        );

        let climbing = (wanted.climb - motion.velocity[2]) / self.climb_time;
        let thrust = GRAVITY + climbing;
        let ahead = thrust * sin_pitch / cos_pitch;
        let left = -thrust * sin_roll / (cos_roll * cos_pitch);
        let Point {
            x: wind_x,
            y: wind_y,
            ..
        } = disturbance.wind;
        let linear = [
            ahead * cos_yaw - left * sin_yaw - self.drag * (motion.velocity[0] - wind_x),
            ahead * sin_yaw + left * cos_yaw - self.drag * (motion.velocity[1] - wind_y),
            climbing,
        ];

        let frequency = self.attitude_frequency;
        let attitude = |reference: f64, angle: f64, rate: f64| {
            frequency * (frequency * (reference - angle) - 2.0 * rate)
        };
        let angular = [
            (wanted.yaw_rate - yaw_rate) / self.yaw_time,
            attitude(wanted.pitch, pitch, pitch_rate),
            attitude(wanted.roll, roll, roll_rate),
        ];
        Acceleration { linear, angular }
    }
}

impl Motion {
    fn of(state: &State) -> Motion {
        let Pose {
            position: Point { x, y, z },
            yaw,
            pitch,
            roll,
        } = state.pose;
        let twist = &state.twist;
        Motion {
            position: [x, y, z],
            velocity: [twist.linear.x, twist.linear.y, twist.linear.z],
            angles: [yaw, pitch, roll],
            rates: [twist.yaw, twist.pitch, twist.roll],
        }
    }

    fn state(&self, mode: u32, memory: [f64; 2]) -> State {
        let ([x, y, z], [vx, vy, vz]) = (self.position, self.velocity);
        let ([yaw, pitch, roll], rates) = (self.angles, self.rates);
        let pose = Pose {
            position: Point::new(x, y, z),
            yaw: wrap_angle(yaw),
            pitch,
            roll,
        };
        let linear = Point::new(vx, vy, vz);
        let twist = Twist {
            linear,
            yaw: rates[0],
            pitch: rates[1],
            roll: rates[2],
        };
        State {
            pose,
            twist,
            mode,
            memory,
        }
    }

    /// This motion moved on by `seconds` along the slopes found at `at`.
    fn moved(&self, at: &Motion, slope: &Acceleration, seconds: f64) -> Motion {
        let mut moved = *self;
        for i in 0..3 {
            moved.position[i] += seconds * at.velocity[i];
            moved.velocity[i] += seconds * slope.linear[i];
            moved.angles[i] += seconds * at.rates[i];
            moved.rates[i] += seconds * slope.angular[i];
        }
        moved
    }

    /// The same place, level and at rest.
    fn standing(&self) -> Motion {
        let [yaw, ..] = self.angles;
        Motion {
            velocity: [0.0; 3],
            angles: [yaw, 0.0, 0.0],
            rates: [0.0; 3],
            ..*self
        }
    }
}
