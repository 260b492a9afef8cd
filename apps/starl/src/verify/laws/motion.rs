//! Robots move no faster than their models can, and change their velocity no faster.
//!
//! A mean velocity between two recorded poses is at most the greatest speed. Mean velocities over two intervals that
//! follow each other differ by at most the greatest acceleration, times half the length of both together. This holds
//! for steps of any length. Contacts stop a body at once, so that acceleration is not judged around them; neither is
//! the fall of a drone that has crashed.

use super::broken;
use starl_core::event::{Event, Fault};
use starl_core::motion::Body;
use starl_core::{Command, Duration, Intervention, Point, Pose, Record, RobotId, Time, math};
use starl_motion::{Disturbance, Limits, Model};
use starl_properties::{Checker, Kinds, Violation};
use starl_sim::Scenario;
use starl_sim::scenario::Wind;

const SPEED: &str = "speed_limit";
const ACCELERATION: &str = "acceleration_limit";
const TURN_RATE: &str = "turn_rate_limit";

/// Rounding of positions, metres.
const ROUNDING: f64 = 1e-6;

/// A drone that restarts while falling has caught itself after this time.
const CAUGHT_AFTER: Duration = Duration::from_seconds(3);

/// Follows all robots.
#[derive(Clone, Debug)]
pub struct Motion {
    robots: Vec<Follower>,
    joining: Vec<(Bounds, Point)>,
}

/// Bounds of a robot's motion, with the force of the wind.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    body: Body,
    speed: f64,
    vertical_speed: f64,
    acceleration: f64,
    turn_rate: f64,
}

/// A robot's last poses.
#[derive(Clone, Debug)]
struct Follower {
    bounds: Bounds,
    last: Option<(Time, Pose)>,
    /// When it was last put somewhere from outside. Its pose at that time is that of the step before, moved.
    placed: Option<Time>,
    /// The mean velocity of the interval that ended with the last pose, and the interval's length, seconds.
    velocity: Option<(Point, f64)>,
    /// When the body was last stopped by something.
    met: Option<Time>,
    falls_until: Option<Time>,
}

impl Bounds {
    fn of(model: &dyn Model, wind: &Wind) -> Bounds {
        let Limits {
            speed,
            vertical_speed,
            acceleration,
            turn_rate,
            ..
        } = model.limits();
        let strongest = wind.steady.length() + wind.gust.length();
        let (blown, pushed) = match model.body().flies() {
            true => (strongest, wind_acceleration(model, strongest)),
            false => (0.0, 0.0),
        };
        Bounds {
            body: model.body(),
            speed: speed + blown,
            vertical_speed: vertical_speed + blown,
            acceleration: acceleration + pushed,
            turn_rate,
        }
    }
}

/// The acceleration that a wind gives to a hovering robot: drag is linear in the speed through the air.
fn wind_acceleration(model: &dyn Model, wind: f64) -> f64 {
    let elapsed = Duration::from_millis(1);
    let state = model.at_rest(Pose::level(Point::new(0.0, 0.0, 10.0), 0.0));
    let after = |wind: f64| {
        let disturbance = Disturbance {
            wind: Point::planar(wind, 0.0),
            ..Disturbance::default()
        };
        let state = model.predict(&state, &Command::Hover, &disturbance, elapsed);
        state.twist.linear.x
    };
    // In a millisecond the hover begins to lean into the wind, and takes a little of this away.
    1.05 * (after(wind) - after(0.0)).abs() / elapsed.seconds()
}

impl Motion {
    pub fn new(scenario: &Scenario) -> Motion {
        let groups = scenario.fleet.groups.iter();
        let robots = groups.flat_map(|group| {
            let bounds = Bounds::of(&*group.model, &scenario.wind);
            group.starts.iter().map(move |_| Follower::new(bounds))
        });
        Motion {
            robots: robots.collect(),
            joining: Vec::new(),
        }
    }

    fn steered(&mut self, at: Time, what: &Intervention) {
        match what {
            Intervention::Push { robot, .. } => self.forget(*robot, at),
            Intervention::Leave(robots) => robots.iter().for_each(|&robot| self.forget(robot, at)),
            Intervention::Join { like, pose, .. } => {
                let like = self.robots.get(like.index());
                self.joining
                    .extend(like.map(|like| (like.bounds, pose.position)));
            }
            _ => {}
        }
    }

    fn forget(&mut self, robot: RobotId, at: Time) {
        if let Some(follower) = self.robots.get_mut(robot.index()) {
            (follower.last, follower.velocity) = (None, None);
            follower.placed = Some(at);
        }
    }
}

impl Checker for Motion {
    fn properties(&self) -> &'static [&'static str] {
        &[SPEED, ACCELERATION, TURN_RATE]
    }

    fn needs(&self, _: &str) -> Kinds {
        Kinds::MOVED
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        let Record { at, robot, event } = record;
        let Some(robot) = *robot else {
            if let Event::Intervention(what) = event {
                self.steered(*at, what);
            }
            return;
        };
        if let Event::Moved(pose) = event
            && robot.index() == self.robots.len()
        {
            let mut joining = self.joining.iter();
            if let Some(found) = joining.position(|(_, place)| *place == pose.position) {
                let bounds = self.joining.swap_remove(found).0;
                self.robots.push(Follower {
                    placed: Some(*at),
                    ..Follower::new(bounds)
                });
            }
        }
        let Some(follower) = self.robots.get_mut(robot.index()) else {
            return;
        };
        match event {
            Event::Moved(pose) => follower.moved(robot, *at, *pose, violations),
            Event::Collided { .. } => follower.met = Some(*at),
            Event::Fault(Fault::Crash) => follower.falls_until = Some(Time::NEVER),
            Event::Fault(Fault::Restart) => follower.falls_until = Some(*at + CAUGHT_AFTER),
            _ => {}
        }
    }
}

impl Follower {
    fn new(bounds: Bounds) -> Follower {
        Follower {
            bounds,
            last: None,
            placed: None,
            velocity: None,
            met: None,
            falls_until: None,
        }
    }

    fn moved(&mut self, robot: RobotId, at: Time, pose: Pose, violations: &mut Vec<Violation>) {
        if self.placed == Some(at) {
            return;
        }
        let Some((before, last)) = self.last.replace((at, pose)) else {
            return;
        };
        let seconds = at.since(before).seconds();
        if seconds <= 0.0 {
            return;
        }
        let bounds = &self.bounds;
        let flies = bounds.body.flies();
        let falls = flies && self.falls_until.is_some_and(|until| before <= until);
        let mut break_law = |law, what: &str, found: f64, most: f64, unit: &str| {
            let text = format!(
                "the {what} of robot {robot} is {found:.4} {unit} from {before} to {at}, and at most \
                 {most:.4} {unit} is possible"
            );
            violations.push(broken(law, at, vec![robot], text));
        };
        let way = pose.position - last.position;
        let rounding = ROUNDING / seconds;
        let speed = way.planar_length() / seconds;
        if speed > bounds.speed + rounding {
            break_law(SPEED, "speed", speed, bounds.speed, "m/s");
        }
        let climb = way.z.abs() / seconds;
        if climb > bounds.vertical_speed + rounding && !falls {
            break_law(SPEED, "rate of climb", climb, bounds.vertical_speed, "m/s");
        }
        let turn = math::wrap_angle(pose.yaw - last.yaw).abs() / seconds;
        if turn > bounds.turn_rate + rounding {
            break_law(TURN_RATE, "rate of turn", turn, bounds.turn_rate, "rad/s");
        }
        let velocity = way * (1.0 / seconds);
        let earlier = self.velocity.replace((velocity, seconds));
        let Some((earlier, length)) = earlier else {
            return;
        };
        let span = (seconds + length) / 2.0;
        let begin = Time(before.0.saturating_sub((length * 1e9) as u64));
        let meets = self.met.is_some_and(|met| met >= begin);
        let lands = flies && (pose.position.z <= ROUNDING || last.position.z <= ROUNDING);
        let change = (velocity - earlier).length() / span;
        let rounding = 4.0 * rounding / span;
        if change > bounds.acceleration + rounding && !meets && !lands && !falls {
            break_law(
                ACCELERATION,
                "acceleration",
                change,
                bounds.acceleration,
                "m/s\u{b2}",
            );
        }
    }
}
