//! The tree of frames that `tf` describes (REP 105), as far as a ground robot needs it: `map`, `odom`, `base_link`.
//!
//! Only yaw counts: the frames between a map and the base of a ground robot are level.

use starl_core::math::{sincos, wrap_angle};
use starl_core::{Point, Pose};
use std::collections::BTreeMap;

/// More frames than this are not kept.
const MOST: usize = 1024;
/// More frames than this are not between a robot and its map: there is a circle.
const DEEPEST: usize = 32;

/// Where frames are in their parents.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Parent and pose in it, by child.
    parents: BTreeMap<String, (String, Pose)>,
}

impl Frames {
    /// A frame is there in its parent.
    pub fn put(&mut self, parent: &str, child: &str, pose: Pose) {
        let [parent, child] = [parent, child].map(plain);
        if self.parents.len() < MOST || self.parents.contains_key(child) {
            let place = (parent.to_string(), pose);
            self.parents.insert(child.to_string(), place);
        }
    }

    /// The pose of one frame in another, which is one of those that it is in; `None` if it is in no such frame.
    pub fn pose(&self, frame: &str, root: &str) -> Option<Pose> {
        let mut at = plain(frame);
        let mut pose = Pose::default();
        for _ in 0..DEEPEST {
            if at == plain(root) {
                return Some(pose);
            }
            let (parent, place) = self.parents.get(at)?;
            pose = inside(place, &pose);
            at = parent;
        }
        None
    }
}

/// Names of frames had a `/` before them in ROS 1, and some robots still have it.
pub(crate) fn plain(name: &str) -> &str {
    name.trim_start_matches('/')
}

/// A pose in a frame that is at `place`.
pub fn inside(place: &Pose, pose: &Pose) -> Pose {
    let (sin, cos) = sincos(place.yaw);
    let Point { x, y, z } = pose.position;
    let turned = Point::new(cos * x - sin * y, sin * x + cos * y, z);
    Pose::level(place.position + turned, wrap_angle(place.yaw + pose.yaw))
}

/// The pose of one frame in another, given both in a third.
pub fn relative(of: &Pose, within: &Pose) -> Pose {
    let (sin, cos) = sincos(within.yaw);
    let Point { x, y, z } = of.position - within.position;
    let turned = Point::new(cos * x + sin * y, cos * y - sin * x, z);
    Pose::level(turned, wrap_angle(of.yaw - within.yaw))
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUARTER: f64 = core::f64::consts::FRAC_PI_2;

    #[test]
    fn a_robot_is_found_on_the_map_by_its_odometry() {
        let mut frames = Frames::default();
        frames.put(
            "odom",
            "base_link",
            Pose::level(Point::planar(2.0, 0.0), 0.25),
        );
        assert_eq!(frames.pose("base_link", "map"), None);
        frames.put(
            "/map",
            "odom",
            Pose::level(Point::planar(1.0, 1.0), QUARTER),
        );
        let pose = frames.pose("/base_link", "map").unwrap();
        assert!(pose.position.distance(Point::planar(1.0, 3.0)) < 1e-12);
        assert!((pose.yaw - QUARTER - 0.25).abs() < 1e-12);
    }

    #[test]
    fn frames_in_a_circle_are_nowhere() {
        let mut frames = Frames::default();
        frames.put("a", "b", Pose::default());
        frames.put("b", "a", Pose::default());
        assert_eq!(frames.pose("a", "map"), None);
    }

    #[test]
    fn a_relative_pose_leads_back() {
        let base = Pose::level(Point::planar(3.0, -1.0), 2.0);
        let frame = Pose::level(Point::planar(-2.0, 0.5), -1.5);
        let back = inside(&frame, &relative(&base, &frame));
        assert!(back.position.distance(base.position) < 1e-12);
        assert!((back.yaw - base.yaw).abs() < 1e-12);
    }
}
