//! Shared code of the conformance tests: every model of the registry, and randomness.

use starl_core::geometry::{Point, Pose};
use starl_core::math::PI;
use starl_core::motion::Estimate;
use starl_core::{Command, Duration, Random, Time};
use starl_motion::{Disturbance, Goal, Model, State, Tracking, models};
use std::sync::Arc;

/// Every model with its default parameters.
pub fn every_model() -> Vec<Arc<dyn Model>> {
    let models = models::NAMES
        .iter()
        .map(|(name, _)| models::by_name(name).expect(name));
    models.collect()
}

/// Every model, and each again slower or faster, lighter or heavier than its defaults.
pub fn every_model_and_variants() -> Vec<Arc<dyn Model>> {
    let variant = |name: &str, settings: &[(&str, f64)]| {
        let settings: Vec<_> = settings.iter().map(|(k, v)| ((*k).into(), *v)).collect();
        models::with_parameters(name, &settings).expect(name)
    };
    let mut models = every_model();
    models.extend([
        variant("create", &[("cruise_speed", 0.5), ("slow_speed", 0.4)]),
        variant(
            "create",
            &[
                ("cruise_speed", 0.1),
                ("slow_speed", 0.1),
                ("cruise_turn", 30.0),
            ],
        ),
        variant("drone", &[("cruise_speed", 0.5)]),
        variant("drone", &[("cruise_speed", 4.0)]),
        variant(
            "drone",
            &[
                ("mass", 1.5),
                ("drag", 0.5),
                ("tilt", 12.0),
                ("safe_height", 1.0),
            ],
        ),
        variant("car", &[("acceleration", 0.7), ("cruise_speed", 1.5)]),
        variant("car", &[("steering_angle", 15.0), ("steering_rate", 60.0)]),
        variant(
            "car",
            &[("wheelbase", 1.0), ("radius", 0.8), ("cruise_speed", 0.5)],
        ),
        variant("holonomic", &[("speed", 4.0), ("cruise_speed", 3.0)]),
        variant(
            "differential",
            &[("wheel_speed", 2.0), ("cruise_speed", 1.0)],
        ),
        variant(
            "differential",
            &[("wheel_distance", 0.3), ("cruise_speed", 0.1)],
        ),
    ]);
    models
}

pub const CALM: Disturbance = Disturbance {
    wind: Point::ZERO,
    speed_error: 0.0,
    turn_error: 0.0,
};

/// A command of any kind, with arguments from harmless to absurd.
pub fn any_command(random: &mut Random) -> Command {
    let scale = [0.3, 1.0, 10.0, 1e9][random.below(4) as usize];
    let mut number = || scale * random.between(-1.0, 1.0);
    let (a, b, c, d) = (number(), number(), number(), number());
    match random.below(11) {
        0 => Command::Stop,
        1 => Command::Straight { speed: a },
        2 => Command::Turn { rate: a },
        3 => Command::Curve {
            speed: a,
            radius: b,
        },
        4 => Command::Wheels { left: a, right: b },
        5 => Command::Steer { speed: a, angle: b },
        6 => Command::Velocity {
            velocity: Point::new(a, b, c),
            yaw_rate: d,
        },
        7 => Command::TakeOff,
        8 => Command::Land,
        9 => Command::Hover,
        _ => Command::Attitude {
            yaw_rate: a,
            pitch: b,
            roll: c,
            gaz: d,
        },
    }
}

/// A command that the model takes.
pub fn command_for(model: &dyn Model, random: &mut Random) -> Command {
    loop {
        let command = any_command(random);
        if model.accepts(&command) {
            return command;
        }
    }
}

/// A random place in a room of 8 m by 8 m where the model can be; `height` metres up if it flies.
pub fn place(model: &dyn Model, random: &mut Random, height: f64) -> Point {
    let point = Point::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0), height);
    model.body().reachable(point)
}

/// A random pose there; a robot that flies stands on the floor.
pub fn start(model: &dyn Model, random: &mut Random) -> Pose {
    Pose::level(
        place(model, random, 0.0).at_height(0.0),
        random.between(-PI, PI),
    )
}

/// A positioning system.
#[derive(Clone, Copy)]
pub struct Positioning {
    /// Between estimates.
    pub period: Duration,
    /// Standard deviations: metres, radians, metres per second.
    pub noise: [f64; 3],
}

impl Positioning {
    pub const EXACT: Positioning = Positioning {
        period: Duration::from_millis(50),
        noise: [0.0; 3],
    };

    pub fn estimate(&self, state: &State, at: Time, random: &mut Random) -> Estimate {
        let [position, angle, speed] = self.noise;
        let mut draw = |deviation: f64| random.normal(0.0, deviation);
        let mut estimate = Estimate {
            pose: state.pose,
            twist: state.twist,
            at,
        };
        estimate.pose.position += Point::new(draw(position), draw(position), 0.0);
        estimate.pose.yaw += draw(angle);
        estimate.twist.linear += Point::new(draw(speed), draw(speed), 0.0);
        estimate
    }
}

/// A robot that tracks waypoints by itself.
pub struct Run<'a> {
    pub model: &'a dyn Model,
    pub state: State,
    pub now: Time,
    pub tracking: Tracking,
    pub positioning: Positioning,
    pub disturbance: Disturbance,
    pub random: Random,
}

impl<'a> Run<'a> {
    pub fn new(model: &'a dyn Model, start: Pose, positioning: Positioning, seed: u64) -> Run<'a> {
        Run {
            model,
            state: model.at_rest(start),
            now: Time::ZERO,
            tracking: Tracking::default(),
            positioning,
            disturbance: CALM,
            random: Random::keyed(seed, &[7]),
        }
    }

    /// One estimate, and what the model does until the next, in steps of 10 ms.
    pub fn turn(&mut self, goal: &Goal) -> Command {
        let estimate = self
            .positioning
            .estimate(&self.state, self.now, &mut self.random);
        let command = self.model.track(&mut self.tracking, &estimate, goal);
        self.go_on(&command);
        command
    }

    /// One estimate of a robot that should be at rest, and the model's motion until the next.
    pub fn rest(&mut self) {
        let estimate = self
            .positioning
            .estimate(&self.state, self.now, &mut self.random);
        let command = self.model.rest(&mut self.tracking, &estimate);
        self.go_on(&command);
    }

    fn go_on(&mut self, command: &Command) {
        assert!(
            self.model.accepts(command),
            "{}: {command:?}",
            self.model.name()
        );
        let step = Duration::from_millis(10);
        for _ in 0..self.positioning.period.0 / step.0 {
            self.state = self
                .model
                .predict(&self.state, command, &self.disturbance, step);
        }
        self.now += self.positioning.period;
    }

    /// Metres between the robot and a point.
    pub fn distance(&self, target: Point) -> f64 {
        self.state.pose.position.distance(target)
    }
}
