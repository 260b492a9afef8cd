//! ReachAvoid on a bench: the test says where the robot is and what the planner answers.

use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, PlanRequest, Workspace};
use starl_core::sensor::Detection;
use starl_core::{
    ConvexPolygon, Duration, Effect, Estimate, Event, Input, MotionRequest, Obstacle, Point, Pose,
    Primitive, Random, Robot, RobotId, Sensors, Time, TimerKey, Twist, View,
};
use starl_primitives::ReachAvoid;
use starl_primitives::reach_avoid::Options;

pub struct Bench {
    pub reach_avoid: ReachAvoid,
    pub position: Point,
    pub velocity: Point,
    /// Radians.
    pub heading: f64,
    pub now: Time,
    pub body: Body,
    pub known: Obstacles,
    /// The readings of its detector.
    pub detections: Vec<Detection>,
    /// All requests to the planner, in order.
    pub plans: Vec<PlanRequest>,
    /// The waypoint tracked and the one after it; none once halted.
    pub tracked: Option<(Point, Option<Point>)>,
    /// Names of the events.
    pub events: Vec<String>,
    pub timer: Option<(TimerKey, Duration)>,
    random: Random,
}

pub const GROUND: Body = Body {
    radius: 0.2,
    height: 0.2,
    workspace: Workspace::Ground,
};
pub const AIR: Body = Body {
    workspace: Workspace::Air { lowest: 0.5 },
    ..GROUND
};

impl Bench {
    pub fn new(options: Options) -> Bench {
        Bench {
            reach_avoid: ReachAvoid::new("test", options),
            position: Point::ZERO,
            velocity: Point::ZERO,
            heading: 0.0,
            now: Time::ZERO,
            body: GROUND,
            known: [].into(),
            detections: Vec::new(),
            plans: Vec::new(),
            tracked: None,
            events: Vec::new(),
            timer: None,
            random: Random::keyed(1, &[]),
        }
    }

    /// Commands the robot to a target.
    pub fn go(&mut self, target: Point, unsafe_set: Obstacles) {
        self.with(|reach_avoid, robot| reach_avoid.reach_avoid(robot, target, unsafe_set));
    }

    /// The planner answers its last request.
    pub fn answer(&mut self, path: Option<Vec<Point>>) {
        let ticket = self.plans.last().expect("a request").ticket;
        self.input(Input::Planned { ticket, path });
    }

    /// The robot is found at a position.
    pub fn at(&mut self, position: Point) {
        self.position = position;
        self.input(Input::Estimate);
    }

    /// The timer fires.
    pub fn time_out(&mut self) {
        let (key, _) = self.timer.take().expect("a timer is armed");
        self.input(Input::Timer(key));
    }

    /// The flags active, done, failed.
    pub fn flags(&self) -> (bool, bool, bool) {
        (
            self.reach_avoid.active(),
            self.reach_avoid.done(),
            self.reach_avoid.failed(),
        )
    }

    pub fn input(&mut self, input: Input) {
        self.with(|reach_avoid, robot| reach_avoid.handle(robot, &input));
    }

    pub fn with(&mut self, act: impl FnOnce(&mut ReachAvoid, &mut Robot<'_>)) {
        let view = View {
            id: RobotId(0),
            now: self.now,
            estimate: Estimate {
                pose: Pose::level(self.position, self.heading),
                twist: Twist {
                    linear: self.velocity,
                    ..Twist::default()
                },
                ..Estimate::default()
            },
            body: self.body,
            sensors: Sensors {
                detections: &self.detections,
                ..Sensors::default()
            },
            fleet: &[RobotId(0)],
            way_points: &[],
            obstacles: &self.known,
        };
        let mut effects = Effects::default();
        act(
            &mut self.reach_avoid,
            &mut Robot::new(&view, &mut effects, &mut self.random),
        );
        for effect in effects.list {
            match effect {
                Effect::Move(MotionRequest::Plan(request)) => self.plans.push(request),
                Effect::Move(MotionRequest::Track { target, next }) => {
                    self.tracked = Some((target, next));
                }
                Effect::Move(MotionRequest::Halt) => self.tracked = None,
                Effect::SetTimer { key, after } => self.timer = Some((key, after)),
                Effect::CancelTimer(_) => self.timer = None,
                Effect::Record(Event::Primitive { event, .. }) => {
                    self.events.push(event.name().to_string());
                }
                other => panic!("ReachAvoid does not ask for {other:?}"),
            }
        }
    }
}

/// A point on the floor.
pub fn p(x: f64, y: f64) -> Point {
    Point::planar(x, y)
}

/// A rectangle from the floor to the sky.
pub fn block(low: Point, high: Point) -> Obstacle {
    Obstacle::polygon(ConvexPolygon::rectangle(low, high).expect("a rectangle"))
}
