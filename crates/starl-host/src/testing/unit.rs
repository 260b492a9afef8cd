//! One robot of the test host: its node, its senses, and a body that goes along straight lines.

use crate::{Clock, Hardware, Node, Store};
use alloc::vec::Vec;
use starl_core::motion::{Body, Workspace};
use starl_core::sensor::{Contact, Detection, Ray};
use starl_core::{Agent, Duration, Estimate, MotionRequest, Point, Pose, RobotId, Time};

/// A robot with the surroundings of its node.
#[derive(Clone)]
pub struct Unit {
    /// The robot's node.
    pub node: Node,
    /// Its body, and how often its program is activated. It has no drive: the host moves it.
    pub hardware: Hardware,
    /// Where it is and where it goes.
    pub travel: Travel,
    /// Its readings at each activation.
    pub rays: Vec<Ray>,
    /// Its detections.
    pub detections: Vec<Detection>,
    /// Its contact.
    pub bumper: Option<Contact>,
    /// The thing that it holds. It can take any thing unless it already holds one.
    pub holding: Option<u32>,
    /// Its storage; none if it keeps nothing over a crash.
    pub store: Option<Store>,
    /// When it hears next where it is, if it does so periodically.
    pub(super) next_location: Time,
}

/// A body that moves straight to its program's target, through everything.
#[derive(Clone, Debug)]
pub struct Travel {
    /// Metres per second; infinite for instant moves.
    pub speed: f64,
    /// The number of commands to stop.
    pub halts: u32,
    position: Point,
    /// When it was at `position`.
    since: Time,
    target: Option<Point>,
}

impl Unit {
    /// A robot at the origin that starts at time 0, is not activated, and moves instantly.
    pub fn new(id: RobotId, agent: Agent) -> Unit {
        Unit {
            node: Node::new(id, Clock::default(), agent, Time::ZERO),
            hardware: Hardware {
                body: Body {
                    radius: 0.1,
                    height: 0.2,
                    workspace: Workspace::Ground,
                },
                control_period: Duration::ZERO,
                drive: None,
            },
            travel: Travel {
                speed: f64::INFINITY,
                halts: 0,
                position: Point::ZERO,
                since: Time::ZERO,
                target: None,
            },
            rays: Vec::new(),
            detections: Vec::new(),
            bumper: None,
            holding: None,
            store: None,
            next_location: Time::ZERO,
        }
    }

    /// The same robot, activated every `period`.
    pub fn with_period(mut self, period: Duration) -> Unit {
        self.hardware.control_period = period;
        self
    }

    /// The same robot, at this speed in metres per second.
    pub fn with_speed(mut self, speed: f64) -> Unit {
        self.travel.speed = speed;
        self
    }

    /// The same robot, with this clock.
    pub fn with_clock(mut self, clock: Clock) -> Unit {
        self.node.set_clock(clock);
        self
    }

    /// Where the robot is.
    pub(super) fn estimate(&self, now: Time) -> Estimate {
        Estimate {
            pose: Pose::level(self.travel.position(now), 0.0),
            ..Estimate::default()
        }
    }
}

impl Travel {
    /// Where the robot is at a moment, metres.
    pub fn position(&self, now: Time) -> Point {
        match self.target {
            None => self.position,
            Some(target) if now >= self.arrival() => target,
            Some(target) => {
                let way = now.since(self.since).seconds() * self.speed;
                self.position
                    .lerp(target, way / self.position.distance(target))
            }
        }
    }

    pub(super) fn is_under_way(&self) -> bool {
        self.target.is_some()
    }

    /// The time of its arrival; [`Time::NEVER`] if it does not move.
    pub fn arrival(&self) -> Time {
        self.target.map_or(Time::NEVER, |target| {
            let span = self.position.distance(target) / self.speed;
            self.since + Duration::from_seconds_f64(span)
        })
    }

    /// It stands here from now on.
    pub fn place(&mut self, now: Time, position: Point) {
        self.position = position;
        self.since = now;
        self.target = None;
    }

    /// It arrives at its target.
    pub(super) fn arrive(&mut self, now: Time) {
        self.place(now, self.target.unwrap_or(self.position));
    }

    pub(super) fn request(&mut self, now: Time, request: &MotionRequest) {
        let here = self.position(now);
        self.place(now, here);
        match request {
            MotionRequest::Track { target, .. } => self.target = Some(*target),
            MotionRequest::Halt => self.halts += 1,
            MotionRequest::Plan(_) | MotionRequest::Drive(_) => {}
        }
    }
}
