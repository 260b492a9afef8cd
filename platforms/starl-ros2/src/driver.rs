//! The driver: commands of the platform to velocities, odometry to readings.

use crate::graph::{Qos, Role, Topic, topic_of_token};
use crate::localisation::{Localisation, Track, lock};
use crate::message::{Header, Message, Odometry, Transforms, Twist, TwistStamped};
use crate::node::{Context, Node, Publisher, Subscription};
use crate::{ROUTER, frames, graph};
use starl_core::{Command, Estimate, Point, Pose};
use starl_node::{Device, DeviceError, Reading};
use starl_zenoh::{Mode, ZenohError, ZenohOptions};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

/// How to drive a ROS 2 robot.
#[derive(Clone, Debug)]
pub struct Ros2Options {
    /// The Zenoh router of the robot, e.g. `tcp/192.168.0.21:7447`.
    pub router: String,
    /// The domain of its nodes (`ROS_DOMAIN_ID`).
    pub domain: u32,
    /// The namespace of its topics, e.g. `/r1`; empty for none.
    pub namespace: String,
    /// The frame that is the scenario's world.
    pub map: String,
    /// The greatest speed of a wheel, metres per second.
    pub speed: f64,
    /// The greatest rate of turn, radians per second. With the speed it gives the distance between the wheels.
    pub turn_rate: f64,
}

impl Default for Ros2Options {
    /// A Create 3 or TurtleBot 4 without a namespace, whose router is on this machine.
    fn default() -> Ros2Options {
        Ros2Options {
            router: ROUTER.to_string(),
            domain: 0,
            namespace: String::new(),
            map: "map".to_string(),
            speed: 0.306,
            turn_rate: 1.9,
        }
    }
}

/// A robot that is silent for so long is switched off or out of reach. Robots send odometry 20 times a second or more.
const SILENCE: Duration = Duration::from_millis(1000);
/// It takes a while to connect.
const BEGINNING: Duration = Duration::from_secs(5);
/// More types of one topic than this are not sent.
const MOST_TOPICS: usize = 4;
/// More tokens of subscriptions than this are not kept.
const MOST_TOKENS: usize = 64;
/// Slip and late messages can show a motion this much longer than the robot can drive, metres.
const SLACK: f64 = 0.2;

/// A ROS 2 robot with two wheels.
///
/// It takes `Twist` or `TwistStamped` on `cmd_vel`, whichever a node of the robot has subscribed to. A robot's own
/// drivers stop it when no more velocities arrive: after 0.5 s with `diff_drive_controller` and the Create 3.
#[derive(Debug)]
pub struct Ros2Robot {
    options: Ros2Options,
    heard: Arc<Mutex<Heard>>,
    track: Arc<Mutex<Track>>,
    link: Arc<OnceLock<Result<Link, ZenohError>>>,
    publishers: BTreeMap<Topic, Publisher>,
    begun: Instant,
    /// The odometry of the last reading, and when it came.
    last: Option<(Pose, Instant)>,
}

/// The connection, once there is one.
#[derive(Debug)]
struct Link {
    node: Node,
    _subscriptions: [Subscription; 3],
}

/// The latest news from the robot.
#[derive(Debug, Default)]
struct Heard {
    odometry: Option<(Odometry, Instant)>,
    is_fresh: bool,
    /// The topics that nodes take velocities from, by the tokens of their subscriptions.
    listeners: BTreeMap<String, Topic>,
}

impl Ros2Robot {
    /// Begins to connect. A router or a robot that is not there shows in [`Device::read`], and may come later.
    ///
    /// # Errors
    /// If the endpoint or a name is malformed, or the system gives no thread.
    pub fn connect(options: &Ros2Options) -> Result<Ros2Robot, DeviceError> {
        let namespace = &options.namespace;
        let is_name = namespace.starts_with('/') && graph::is_name(namespace);
        if !(is_name || namespace.is_empty()) {
            return Err(DeviceError::Fault(format!(
                "namespace: {namespace:?} is not a name of ROS; use one such as \"/r1\""
            )));
        }
        let zenoh = ZenohOptions {
            connect: vec![options.router.clone()],
            mode: Mode::Client,
            ..ZenohOptions::default()
        };
        starl_zenoh::config(&zenoh)
            .map_err(|error| DeviceError::Fault(format!("router: {error}")))?;
        let robot = Ros2Robot {
            options: options.clone(),
            heard: Arc::default(),
            track: Arc::new(Mutex::new(Track::new(&options.map))),
            link: Arc::default(),
            publishers: BTreeMap::new(),
            begun: Instant::now(),
            last: None,
        };
        let (domain, namespace) = (options.domain, namespace.clone());
        let (link, heard, track) = (robot.link.clone(), robot.heard.clone(), robot.track.clone());
        thread::Builder::new()
            .name("ros2".to_string())
            .spawn(move || {
                // A client waits for its router, however long that takes.
                let joined = Link::open(&zenoh, domain, &namespace, &heard, &track);
                let _ = link.set(joined);
            })?;
        Ok(robot)
    }

    /// Where the robot is on its map, by its own localisation.
    pub fn localisation(&self) -> Localisation {
        Localisation::new(self.track.clone())
    }

    /// The velocity for a command, within the limits of the wheels; none if the robot cannot drive it.
    fn twist(&self, command: &Command) -> Option<Twist> {
        let Ros2Options {
            speed, turn_rate, ..
        } = self.options;
        let wheel_distance = 2.0 * speed / turn_rate;
        let (ahead, turn) = match *command {
            Command::Stop => (0.0, 0.0),
            Command::Straight { speed } => (speed, 0.0),
            Command::Turn { rate } => (0.0, rate),
            Command::Curve { speed, radius } if radius != 0.0 && radius.is_finite() => {
                (speed, speed / radius)
            }
            Command::Wheels { left, right } => {
                (0.5 * (left + right), (right - left) / wheel_distance)
            }
            _ => return None,
        };
        // The faster wheel; slowing both down keeps the radius.
        let fastest = ahead.abs() / speed + turn.abs() / turn_rate;
        let part = 1.0 / fastest.max(1.0);
        let is_finite = ahead.is_finite() && turn.is_finite();
        is_finite.then(|| Twist {
            linear: Point::planar(part * ahead, 0.0),
            angular: Point::new(0.0, 0.0, part * turn),
        })
    }

    fn send(&mut self, twist: Twist) -> Result<(), DeviceError> {
        let Some(Ok(link)) = self.link.get() else {
            return Ok(());
        };
        let topics: BTreeSet<Topic> = lock(&self.heard).listeners.values().cloned().collect();
        self.publishers.retain(|topic, _| topics.contains(topic));
        for topic in topics.into_iter().take(MOST_TOPICS) {
            if let Entry::Vacant(place) = self.publishers.entry(topic) {
                let topic = place.key().clone();
                let publisher = link.node.publish_as(topic, Qos::DEFAULT);
                place.insert(publisher.map_err(fault)?);
            }
        }
        for (topic, publisher) in &self.publishers {
            let done = match topic.kind == TwistStamped::TYPE {
                true => publisher.put(&TwistStamped {
                    header: Header::now("base_link"),
                    twist,
                }),
                false => publisher.put(&twist),
            };
            done.map_err(fault)?;
        }
        Ok(())
    }

    /// Fails while the robot cannot be reached.
    fn check(&self) -> Result<(), DeviceError> {
        let fault = |text: String| Err(DeviceError::Fault(text));
        if let Some(Err(error)) = self.link.get() {
            return fault(error.to_string());
        }
        if self.begun.elapsed() < BEGINNING {
            return Ok(());
        }
        let Ros2Options {
            router,
            domain,
            namespace,
            ..
        } = &self.options;
        if self.link.get().is_none() {
            return fault(format!(
                "no Zenoh router answers at {router}; does `rmw_zenohd` run on the robot?"
            ));
        }
        let heard = lock(&self.heard);
        if heard
            .odometry
            .as_ref()
            .is_none_or(|(_, at)| at.elapsed() > SILENCE)
        {
            return fault(format!(
                "no odometry comes on {} in domain {domain}; is the robot on, and are its namespace and domain right?",
                graph::full_name(namespace, "odom")
            ));
        }
        if heard.listeners.is_empty() {
            return fault(format!(
                "no node takes velocities from {}; do the robot's motors run?",
                graph::full_name(namespace, "cmd_vel")
            ));
        }
        Ok(())
    }

    /// The motion since the last reading; none if odometry has begun from a new zero.
    fn motion(&mut self, pose: Pose, at: Instant) -> Option<Pose> {
        let (before, then) = self.last.replace((pose, at))?;
        let longest = SLACK + 2.0 * self.options.speed * (at - then).as_secs_f64();
        let motion = frames::relative(&pose, &before);
        (motion.position.length() <= longest).then_some(motion)
    }
}

impl Link {
    fn open(
        zenoh: &ZenohOptions,
        domain: u32,
        namespace: &str,
        heard: &Arc<Mutex<Heard>>,
        track: &Arc<Mutex<Track>>,
    ) -> Result<Link, ZenohError> {
        let node = Context::open(zenoh, domain)?.node(namespace, "starl")?;
        let (told, way) = (heard.clone(), track.clone());
        let odometry = node.subscribe("odom", Qos::SENSOR_DATA, move |odometry: Odometry| {
            lock(&way).odometry(&odometry);
            let mut heard = lock(&told);
            heard.odometry = Some((odometry, Instant::now()));
            heard.is_fresh = true;
        })?;
        let way = track.clone();
        let transforms = node.subscribe("tf", Qos::TRANSFORMS, move |message: Transforms| {
            lock(&way).transforms(&message.0);
        })?;
        let told = heard.clone();
        let listeners = node.watch(Role::Subscription, "cmd_vel", move |token, is_there| {
            let mut heard = lock(&told);
            if !is_there {
                heard.listeners.remove(token);
            } else if heard.listeners.len() < MOST_TOKENS
                && let Some(topic) = topic_of_token(token)
                && [Twist::TYPE, TwistStamped::TYPE].contains(&topic.kind.as_str())
            {
                heard.listeners.insert(token.to_string(), topic);
            }
        })?;
        Ok(Link {
            node,
            _subscriptions: [odometry, transforms, listeners],
        })
    }
}

fn fault(error: ZenohError) -> DeviceError {
    DeviceError::Fault(error.to_string())
}

impl Device for Ros2Robot {
    /// Takes `Straight`, `Turn`, `Curve`, `Wheels` and `Stop`; any other command stops the robot and is a fault.
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        let Some(twist) = self.twist(command) else {
            self.stop()?;
            return Err(DeviceError::Fault(format!(
                "a robot on two wheels cannot drive {command:?}; use Straight, Turn, Curve, Wheels or Stop"
            )));
        };
        self.send(twist)?;
        self.check()
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.send(Twist::default())
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        self.check()?;
        let odometry = {
            let mut heard = lock(&self.heard);
            let is_fresh = std::mem::take(&mut heard.is_fresh);
            heard.odometry.clone().filter(|_| is_fresh)
        };
        let Some((odometry, at)) = odometry else {
            return Ok(None);
        };
        let motion = self.motion(odometry.pose, at);
        let velocity = odometry.twist.linear;
        Ok(Some(Reading {
            moved: motion.map(|motion| motion.position.at_height(0.0)),
            turned: motion.map(|motion| motion.yaw),
            velocity: velocity.is_finite().then_some(velocity),
            ..Reading::default()
        }))
    }
}

impl Drop for Ros2Robot {
    fn drop(&mut self) {
        let _ = self.stop();
    }
}
