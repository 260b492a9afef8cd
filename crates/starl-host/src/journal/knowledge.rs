//! A robot's latest knowledge: a view that owns its data.

use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_core::event::Name;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::sensor::{Contact, Detection, Ray};
use starl_core::{Estimate, Point, Pose, RobotId, Sensors, Time, Twist, View, WayPoint};

/// Everything in a [`View`] except the robot's number and the time. The writer and the reader of a
/// journal keep the same knowledge.
#[derive(Clone, Debug)]
pub struct Knowledge {
    /// How far the robot's clock is ahead of the host's, nanoseconds, modulo 2^64.
    pub ahead: u64,
    pub estimate: Estimate,
    pub body: Body,
    pub bumper: Option<Contact>,
    /// The latest readings that were not empty, and whether the view shows them.
    pub proximity: Vec<Ray>,
    pub shows_proximity: bool,
    /// The same of detections.
    pub detections: Vec<Detection>,
    pub shows_detections: bool,
    pub holding: Option<u32>,
    pub thing_names: Vec<Name>,
    pub fleet: Arc<[RobotId]>,
    pub way_points: Arc<[WayPoint]>,
    pub obstacles: Obstacles,
}

impl Default for Knowledge {
    /// A robot's knowledge before its first entry.
    fn default() -> Knowledge {
        Knowledge {
            ahead: 0,
            estimate: Estimate::default(),
            body: Body {
                radius: 0.0,
                height: 0.0,
                workspace: Workspace::Ground,
            },
            bumper: None,
            proximity: Vec::new(),
            shows_proximity: false,
            detections: Vec::new(),
            shows_detections: false,
            holding: None,
            thing_names: Vec::new(),
            fleet: Arc::new([]),
            way_points: Arc::new([]),
            obstacles: Arc::new([]),
        }
    }
}

impl Knowledge {
    /// The view of a robot that knows this.
    pub fn view(&self, id: RobotId, at: Time) -> View<'_> {
        let mut sensors = Sensors {
            bumper: self.bumper,
            holding: self.holding,
            thing_names: &self.thing_names,
            ..Sensors::default()
        };
        if self.shows_proximity {
            sensors.proximity = &self.proximity;
        }
        if self.shows_detections {
            sensors.detections = &self.detections;
        }
        View {
            id,
            now: Time(at.0.wrapping_add(self.ahead)),
            estimate: self.estimate,
            body: self.body,
            sensors,
            fleet: &self.fleet,
            way_points: &self.way_points,
            obstacles: &self.obstacles,
        }
    }
}

/// The numbers of an estimate, without its time.
pub fn estimate_words(estimate: &Estimate) -> [u64; 12] {
    let Estimate { pose, twist, .. } = estimate;
    let (place, speed) = (pose.position, twist.linear);
    [
        place.x,
        place.y,
        place.z,
        pose.yaw,
        pose.pitch,
        pose.roll,
        speed.x,
        speed.y,
        speed.z,
        twist.yaw,
        twist.pitch,
        twist.roll,
    ]
    .map(f64::to_bits)
}

/// The estimate with these numbers.
pub fn estimate_of(words: &[u64; 12], at: Time) -> Estimate {
    let [
        x,
        y,
        z,
        yaw,
        pitch,
        roll,
        vx,
        vy,
        vz,
        yaw_rate,
        pitch_rate,
        roll_rate,
    ] = words.map(f64::from_bits);
    Estimate {
        pose: Pose {
            position: Point { x, y, z },
            yaw,
            pitch,
            roll,
        },
        twist: Twist {
            linear: Point {
                x: vx,
                y: vy,
                z: vz,
            },
            yaw: yaw_rate,
            pitch: pitch_rate,
            roll: roll_rate,
        },
        at,
    }
}

/// How many numbers a ray has.
const RAY: usize = 3;

/// The numbers of proximity rays.
pub fn ray_words(rays: &[Ray]) -> impl ExactSizeIterator<Item = u64> {
    (0..rays.len() * RAY).map(|index| {
        let ray = &rays[index / RAY];
        [ray.bearing, ray.distance, ray.nearness][index % RAY].to_bits()
    })
}

/// The rays with these numbers; `None` if there are too few or too many.
pub fn rays_of(words: &[u64]) -> Option<Vec<Ray>> {
    let (rays, rest) = words.as_chunks::<RAY>();
    let ray = |ray: &[u64; RAY]| {
        let [bearing, distance, nearness] = ray.map(f64::from_bits);
        Ray {
            bearing,
            distance,
            nearness,
        }
    };
    rest.is_empty().then(|| rays.iter().map(ray).collect())
}

/// Whether two points are the same to the last bit.
pub fn same_point(a: Point, b: Point) -> bool {
    let bits = |point: Point| [point.x, point.y, point.z].map(f64::to_bits);
    bits(a) == bits(b)
}
