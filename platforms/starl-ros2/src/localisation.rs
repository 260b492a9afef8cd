//! Where the robot is on the map, by its own localisation: `tf` says where `odom` is in `map`, odometry where the robot is
//! in `odom`.

use crate::frames::{Frames, plain};
use crate::message::{Odometry, Transform};
use starl_core::Pose;
use starl_node::DeviceError;
use starl_node::motors::PositionSource;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A localisation that says nothing for so long does not work. It has a while to begin.
const SILENCE: Duration = Duration::from_secs(3);

/// A map that knows where `odom` is does not help where nothing says for so long where the robot is in `odom`.
const OLDEST_BASE: Duration = Duration::from_secs(1);

/// The robot's own localisation as a source of positions: AMCL, slam_toolbox and others.
///
/// The scenario's world is the frame `map`: the same axes and the same origin, in metres. A position is as old as the last
/// transform whose parent is that frame.
#[derive(Debug)]
pub struct Localisation {
    track: Arc<Mutex<Track>>,
    begun: Instant,
    seen: Option<Instant>,
}

/// The robot's way on the map, as far as messages tell.
#[derive(Debug)]
pub(crate) struct Track {
    map: String,
    frames: Frames,
    /// The robot's own frame, as its odometry calls it.
    base: Option<String>,
    /// Whether `tf` says where the robot's frame is: it knows better than the wheels.
    has_base: bool,
    /// When its place in its parent was heard last.
    based: Option<Instant>,
    fix: Option<(Instant, Pose)>,
}

impl Track {
    pub fn new(map: &str) -> Track {
        Track {
            map: map.to_string(),
            frames: Frames::default(),
            base: None,
            has_base: false,
            based: None,
            fix: None,
        }
    }

    pub fn odometry(&mut self, odometry: &Odometry) {
        let Odometry { header, child, .. } = odometry;
        if self.base.as_ref() != Some(child) {
            self.base = Some(child.clone());
            self.has_base = false;
        }
        if !self.has_base {
            self.frames.put(&header.frame, child, odometry.pose);
            self.based = Some(Instant::now());
            self.locate(&header.frame);
        }
    }

    pub fn transforms(&mut self, transforms: &[Transform]) {
        for transform in transforms {
            let Transform {
                header,
                child,
                pose,
            } = transform;
            self.frames.put(&header.frame, child, *pose);
            if self.base.as_deref().map(plain) == Some(plain(child)) {
                self.has_base = true;
                self.based = Some(Instant::now());
            }
        }
        // All of them belong to one moment.
        for transform in transforms {
            self.locate(&transform.header.frame);
        }
    }

    /// Finds the robot on the map, if a pose in this frame can lead there.
    fn locate(&mut self, parent: &str) {
        let is_based = self.based.is_some_and(|at| at.elapsed() < OLDEST_BASE);
        if !is_based || plain(parent) != plain(&self.map) {
            return;
        }
        let base = self.base.as_deref();
        let pose = base.and_then(|base| self.frames.pose(base, &self.map));
        self.fix = pose.map(|pose| (Instant::now(), pose)).or(self.fix.take());
    }
}

impl Localisation {
    pub(crate) fn new(track: Arc<Mutex<Track>>) -> Localisation {
        Localisation {
            track,
            begun: Instant::now(),
            seen: None,
        }
    }
}

impl PositionSource for Localisation {
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError> {
        let mut track = lock(&self.track);
        if let Some(fix) = track.fix.take() {
            self.seen = Some(fix.0);
            return Ok(Some(fix));
        }
        if self.seen.unwrap_or(self.begun).elapsed() < SILENCE {
            return Ok(None);
        }
        let map = &track.map;
        Err(DeviceError::Fault(format!(
            "positions: no transform leads from `{map}` to the robot; does its localisation run?"
        )))
    }
}

pub(crate) fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message::Header;
    use starl_core::Point;

    fn header(frame: &str) -> Header {
        Header {
            frame: frame.to_string(),
            ..Header::default()
        }
    }

    fn odometry(x: f64) -> Odometry {
        Odometry {
            header: header("odom"),
            child: "base_link".to_string(),
            pose: Pose::level(Point::planar(x, 0.0), 0.0),
            ..Odometry::default()
        }
    }

    fn transform(parent: &str, child: &str, x: f64) -> Transform {
        Transform {
            header: header(parent),
            child: child.to_string(),
            pose: Pose::level(Point::planar(x, 0.0), 0.0),
        }
    }

    #[test]
    fn only_a_transform_from_the_map_renews_the_position() {
        let mut track = Track::new("map");
        track.odometry(&odometry(1.0));
        assert_eq!(track.fix, None);
        track.transforms(&[transform("map", "odom", 10.0)]);
        let (_, pose) = track.fix.take().unwrap();
        assert_eq!(pose.position.x, 11.0);
        track.odometry(&odometry(1.5));
        track.transforms(&[transform("base_link", "camera", 0.1)]);
        assert_eq!(track.fix, None);
        track.transforms(&[transform("map", "odom", 10.0)]);
        assert_eq!(track.fix.take().unwrap().1.position.x, 11.5);
    }

    #[test]
    fn a_map_without_odometry_gives_no_position() {
        let mut track = Track::new("map");
        track.odometry(&odometry(1.0));
        track.based = Instant::now().checked_sub(OLDEST_BASE);
        track.transforms(&[transform("map", "odom", 10.0)]);
        assert_eq!(track.fix, None);
    }

    #[test]
    fn transforms_know_better_than_the_wheels() {
        let mut track = Track::new("map");
        track.odometry(&odometry(1.0));
        let message = [
            transform("odom", "base_link", 2.0),
            transform("map", "odom", 10.0),
        ];
        track.transforms(&message);
        track.odometry(&odometry(1.0));
        track.transforms(&message[1..]);
        assert_eq!(track.fix.take().unwrap().1.position.x, 12.0);
    }

    #[test]
    fn odometry_may_be_on_the_map_itself() {
        let mut track = Track::new("odom");
        track.odometry(&odometry(3.0));
        assert_eq!(track.fix.take().unwrap().1.position.x, 3.0);
    }
}
