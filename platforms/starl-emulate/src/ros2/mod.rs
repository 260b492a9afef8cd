//! An emulated ROS 2 robot: a model with two wheels behind the topics of a ground robot, over Zenoh.
//!
//! It takes velocities on `cmd_vel` and stops 0.5 s after the last one, as `diff_drive_controller` and the Create 3 do. It
//! sends odometry from its wheels, transforms, and scans of a laser that sees all round. A perfect localisation is part of
//! it: it sends where `odom` is in the frame `map`, which is the world. It differs from hardware in this: it has no
//! parameters, services, actions or diagnostics, and its laser is in the middle of its base.

mod wheels;

use crate::BodyHandle;
use crate::service::Service;
use starl_core::{Command, Pose, Random};
use starl_motion::proximity::Rays;
use starl_ros2::frames::{inside, relative};
use starl_ros2::graph::Qos;
use starl_ros2::message::{
    Header, LaserScan, Odometry, Transform, Transforms, Twist, TwistStamped,
};
use starl_ros2::node::{Context, Node, Publisher, Subscription};
use starl_zenoh::{Mode, ZenohError, ZenohOptions};
use std::f32::consts::TAU;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use wheels::{Wheels, lock};

/// How often odometry is sent.
const PERIOD: Duration = Duration::from_millis(30);
/// A scan and a position on the map come with every so many odometries.
const SCAN_EVERY: u32 = 3;
/// Rays of the laser.
const RAYS: u32 = 180;
/// How far the laser sees, metres.
const RANGE: f64 = 8.0;

/// The robot's base and its wheels' frame.
const BASE: &str = "base_link";
const ODOM: &str = "odom";

/// How a robot shows itself.
#[derive(Clone, Debug)]
pub struct Ros2Setup {
    /// The namespace of its topics, e.g. `/r1`; empty for none.
    pub namespace: String,
    /// Whether it takes `TwistStamped`, as newer robots do, or `Twist`.
    pub stamped: bool,
    /// The frame that is the world.
    pub map: String,
    /// Standard deviation of its localisation, metres.
    pub deviation: f64,
    /// Seeds the errors of its localisation.
    pub seed: u64,
}

impl Default for Ros2Setup {
    fn default() -> Ros2Setup {
        Ros2Setup {
            namespace: String::new(),
            stamped: false,
            map: "map".to_string(),
            deviation: 0.0,
            seed: 0,
        }
    }
}

/// A Zenoh router that listens at an endpoint, e.g. `tcp/127.0.0.1:7447`, for the robots of a domain.
///
/// # Errors
/// If the endpoint is malformed or in use.
pub fn router(endpoint: &str, domain: u32) -> Result<Context, ZenohError> {
    let options = ZenohOptions {
        listen: vec![endpoint.to_string()],
        mode: Mode::Router,
        ..ZenohOptions::default()
    };
    Context::open(&options, domain)
}

/// A ROS 2 robot at a router. Dropping it stops the body, and its node leaves the graph.
#[derive(Debug)]
pub struct EmulatedRos2 {
    wheels: Arc<Mutex<Wheels>>,
    voice: Arc<Voice>,
    _velocities: Subscription,
    service: Service,
}

/// The publishers of the robot.
#[derive(Debug)]
struct Voice {
    node: Node,
    odometry: Publisher,
    transforms: Publisher,
    scan: Publisher,
}

impl EmulatedRos2 {
    /// Puts `body` behind the topics of a robot.
    ///
    /// # Errors
    /// The session is closed, or the namespace is invalid.
    pub fn start(
        body: BodyHandle,
        context: &Context,
        setup: &Ros2Setup,
    ) -> Result<EmulatedRos2, ZenohError> {
        let node = context.node(&setup.namespace, "robot")?;
        let voice = Arc::new(Voice {
            odometry: node.publish::<Odometry>("odom", Qos::DEFAULT)?,
            transforms: node.publish::<Transforms>("tf", Qos::TRANSFORMS)?,
            scan: node.publish::<LaserScan>("scan", Qos::SENSOR_DATA)?,
            node,
        });
        let wheels = Arc::new(Mutex::new(Wheels::new(body.clone())));
        let driven = wheels.clone();
        let velocities = match setup.stamped {
            true => voice.node.subscribe("cmd_vel", Qos::DEFAULT, {
                move |message: TwistStamped| lock(&driven).drive(&message.twist)
            })?,
            false => voice.node.subscribe("cmd_vel", Qos::DEFAULT, {
                move |message: Twist| lock(&driven).drive(&message)
            })?,
        };
        let mut sender = Sender {
            body,
            setup: setup.clone(),
            wheels: wheels.clone(),
            voice: voice.clone(),
            rays: Rays::even(RAYS, RANGE),
            due: Instant::now(),
            sent: 0,
        };
        Ok(EmulatedRos2 {
            wheels,
            voice,
            _velocities: velocities,
            service: Service::start(move || {
                sender.turn();
                Ok(())
            }),
        })
    }

    /// Sends bytes where messages should be: on its own topics, and to its wheels.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn interfere(&self, bytes: &[u8]) -> Result<(), ZenohError> {
        let Voice {
            node,
            odometry,
            transforms,
            scan,
        } = &*self.voice;
        let velocities = node.publish::<Twist>("cmd_vel", Qos::DEFAULT)?;
        for publisher in [odometry, transforms, scan, &velocities] {
            publisher.put_bytes(bytes.to_vec())?;
        }
        Ok(())
    }
}

impl Drop for EmulatedRos2 {
    fn drop(&mut self) {
        self.service.end();
        lock(&self.wheels).halt();
    }
}

/// Sends the robot's measurements.
struct Sender {
    body: BodyHandle,
    setup: Ros2Setup,
    wheels: Arc<Mutex<Wheels>>,
    voice: Arc<Voice>,
    rays: Rays,
    due: Instant,
    sent: u32,
}

impl Sender {
    fn turn(&mut self) {
        std::thread::sleep(self.due.saturating_duration_since(Instant::now()));
        self.due = Instant::now() + PERIOD;
        let (odometry, velocity) = lock(&self.wheels).turn();
        let scans = self.sent.is_multiple_of(SCAN_EVERY);
        let mut transforms = vec![transform(ODOM, BASE, odometry)];
        if scans {
            let origin = inside(&self.located(), &relative(&Pose::default(), &odometry));
            transforms.push(transform(&self.setup.map, ODOM, origin));
        }
        self.sent = self.sent.wrapping_add(1);
        // A session that is closed is at its end.
        let _ = self.voice.odometry.put(&Odometry {
            header: Header::now(ODOM),
            child: BASE.to_string(),
            pose: odometry,
            twist: velocity,
        });
        let _ = self.voice.transforms.put(&Transforms(transforms));
        if scans {
            let _ = self.voice.scan.put(&self.scan());
        }
    }

    /// Where its localisation believes it is.
    fn located(&self) -> Pose {
        let mut pose = self.body.state().pose;
        let mut random = Random::keyed(self.setup.seed, &[u64::from(self.sent)]);
        pose.position.x += random.normal(0.0, self.setup.deviation);
        pose.position.y += random.normal(0.0, self.setup.deviation);
        pose
    }

    fn scan(&self) -> LaserScan {
        let ranges = self.body.scan(&self.rays);
        LaserScan {
            header: Header::now(BASE),
            first: 0.0,
            step: TAU / RAYS as f32,
            nearest: 0.05,
            farthest: RANGE as f32,
            period: (PERIOD * SCAN_EVERY).as_secs_f32(),
            ranges: ranges.into_iter().map(|range| range as f32).collect(),
        }
    }
}

fn transform(parent: &str, child: &str, pose: Pose) -> Transform {
    Transform {
        header: Header::now(parent),
        child: child.to_string(),
        pose,
    }
}

/// Whether a model has two wheels that velocities drive.
pub fn is_driven_by_velocities(body: &BodyHandle) -> bool {
    let still = Command::Wheels {
        left: 0.0,
        right: 0.0,
    };
    body.model().accepts(&still)
}
