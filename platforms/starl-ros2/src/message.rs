//! The messages of ground robots: velocities, odometry, transforms and laser scans.
//!
//! Fields that robots and the platform have no use for are written as zero, which ROS takes for "not known", and passed
//! over when a message is read: covariances, intensities.

use crate::cdr::{Reader, Writer};
use starl_core::{Point, Pose};
use std::time::{SystemTime, UNIX_EPOCH};

/// A message of ROS 2.
pub trait Message: Sized {
    /// The name of its type, as in DDS.
    const TYPE: &'static str;
    /// The hash of its type's definition (REP 2016). It is the same in all versions of ROS that have hashes.
    const HASH: &'static str;

    /// Writes its fields.
    fn write(&self, out: &mut Writer);

    /// Reads its fields; `None` if they make no sense.
    fn read(from: &mut Reader<'_>) -> Option<Self>;

    /// The bytes of the message.
    fn encode(&self) -> Vec<u8> {
        let mut out = Writer::default();
        self.write(&mut out);
        out.finish()
    }

    /// The message in these bytes; `None` if they make no sense.
    fn decode(bytes: &[u8]) -> Option<Self> {
        Self::read(&mut Reader::new(bytes)?)
    }
}

/// When and in which frame something was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// Seconds of the sender's clock.
    pub seconds: i32,
    /// Nanoseconds beyond the seconds.
    pub nanoseconds: u32,
    /// The name of the frame.
    pub frame: String,
}

impl Header {
    /// A header of this moment.
    pub fn now(frame: &str) -> Header {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let since = since.unwrap_or_default();
        Header {
            seconds: since.as_secs() as i32,
            nanoseconds: since.subsec_nanos(),
            frame: frame.to_string(),
        }
    }

    fn write(&self, out: &mut Writer) {
        out.i32(self.seconds);
        out.u32(self.nanoseconds);
        out.text(&self.frame);
    }

    fn read(from: &mut Reader<'_>) -> Option<Header> {
        Some(Header {
            seconds: from.i32()?,
            nanoseconds: from.u32()?,
            frame: from.text()?,
        })
    }
}

/// A velocity in the robot's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Metres per second ahead, left and up.
    pub linear: Point,
    /// Radians per second about these axes.
    pub angular: Point,
}

impl Message for Twist {
    const TYPE: &'static str = "geometry_msgs::msg::dds_::Twist_";
    const HASH: &'static str =
        "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a";

    fn write(&self, out: &mut Writer) {
        for Point { x, y, z } in [self.linear, self.angular] {
            out.f64s(&[x, y, z]);
        }
    }

    fn read(from: &mut Reader<'_>) -> Option<Twist> {
        Some(Twist {
            linear: point(from)?,
            angular: point(from)?,
        })
    }
}

/// A velocity, with the time at which it was asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TwistStamped {
    /// When, and in which frame.
    pub header: Header,
    /// The velocity.
    pub twist: Twist,
}

impl Message for TwistStamped {
    const TYPE: &'static str = "geometry_msgs::msg::dds_::TwistStamped_";
    const HASH: &'static str =
        "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64";

    fn write(&self, out: &mut Writer) {
        self.header.write(out);
        self.twist.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Option<TwistStamped> {
        Some(TwistStamped {
            header: Header::read(from)?,
            twist: Twist::read(from)?,
        })
    }
}

/// Where a robot believes it is by its wheels, and how it moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Odometry {
    /// When, and the frame that the pose is in, usually `odom`.
    pub header: Header,
    /// The robot's own frame, usually `base_link` or `base_footprint`.
    pub child: String,
    /// The pose.
    pub pose: Pose,
    /// The velocity in the robot's own frame.
    pub twist: Twist,
}

impl Message for Odometry {
    const TYPE: &'static str = "nav_msgs::msg::dds_::Odometry_";
    const HASH: &'static str =
        "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0";

    fn write(&self, out: &mut Writer) {
        self.header.write(out);
        out.text(&self.child);
        write_pose(&self.pose, out);
        out.f64s(&[0.0; 36]);
        self.twist.write(out);
        out.f64s(&[0.0; 36]);
    }

    fn read(from: &mut Reader<'_>) -> Option<Odometry> {
        let header = Header::read(from)?;
        let child = from.text()?;
        let pose = read_pose(from)?;
        from.f64s::<36>()?;
        let twist = Twist::read(from)?;
        from.f64s::<36>()?;
        Some(Odometry {
            header,
            child,
            pose,
            twist,
        })
    }
}

/// Where one frame is in another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transform {
    /// When, and the parent frame.
    pub header: Header,
    /// The child frame.
    pub child: String,
    /// The child's pose in the parent.
    pub pose: Pose,
}

/// The least that a transform takes: a header with an empty name, an empty name, seven numbers.
const LEAST_TRANSFORM: usize = 8 + 4 + 4 + 7 * 8;

/// A message of `tf`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transforms(pub Vec<Transform>);

impl Message for Transforms {
    const TYPE: &'static str = "tf2_msgs::msg::dds_::TFMessage_";
    const HASH: &'static str =
        "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087";

    fn write(&self, out: &mut Writer) {
        out.u32(self.0.len() as u32);
        for transform in &self.0 {
            transform.header.write(out);
            out.text(&transform.child);
            write_pose(&transform.pose, out);
        }
    }

    fn read(from: &mut Reader<'_>) -> Option<Transforms> {
        let length = from.length(LEAST_TRANSFORM)?;
        let mut one = || {
            Some(Transform {
                header: Header::read(from)?,
                child: from.text()?,
                pose: read_pose(from)?,
            })
        };
        (0..length)
            .map(|_| one())
            .collect::<Option<_>>()
            .map(Transforms)
    }
}

/// Distances all round, or in a sector.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaserScan {
    /// When, and the frame of the scanner.
    pub header: Header,
    /// Direction of the first ray, radians to the left of the frame's x axis.
    pub first: f32,
    /// From one ray to the next, radians.
    pub step: f32,
    /// The least distance that is measured, metres.
    pub nearest: f32,
    /// The greatest distance that is measured, metres.
    pub farthest: f32,
    /// The time of a whole scan, seconds.
    pub period: f32,
    /// Distances, metres; infinite where a ray meets nothing.
    pub ranges: Vec<f32>,
}

impl Message for LaserScan {
    const TYPE: &'static str = "sensor_msgs::msg::dds_::LaserScan_";
    const HASH: &'static str =
        "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828";

    fn write(&self, out: &mut Writer) {
        self.header.write(out);
        let last = self.first + self.step * self.ranges.len().saturating_sub(1) as f32;
        // All rays are measured at the same moment.
        out.f32s(&[self.first, last, self.step, 0.0]);
        out.f32s(&[self.period, self.nearest, self.farthest]);
        out.f32_list(&self.ranges);
        out.f32_list(&[]);
    }

    fn read(from: &mut Reader<'_>) -> Option<LaserScan> {
        let header = Header::read(from)?;
        let first = from.f32()?;
        let _last = from.f32()?;
        let step = from.f32()?;
        let _between_rays = from.f32()?;
        Some(LaserScan {
            header,
            first,
            step,
            period: from.f32()?,
            nearest: from.f32()?,
            farthest: from.f32()?,
            ranges: from.f32_list()?,
        })
    }
}

fn point(from: &mut Reader<'_>) -> Option<Point> {
    let [x, y, z] = from.f64s()?;
    Some(Point::new(x, y, z))
}

fn write_pose(pose: &Pose, out: &mut Writer) {
    let Point { x, y, z } = pose.position;
    out.f64s(&[x, y, z]);
    out.f64s(&pose.quaternion());
}

fn read_pose(from: &mut Reader<'_>) -> Option<Pose> {
    let position = point(from)?;
    Pose::of_quaternion(position, from.f64s()?)
}
