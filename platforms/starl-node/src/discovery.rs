//! The obstacles that a robot knows: its map, and the obstacles that it has discovered.
//!
//! Hidden obstacles of the scenario are perceived as in the simulator, from the place where the robot believes to be.
//! Where its bumper meets something that no obstacle and no robot explains, the robot takes it for a post.

use crate::setup::Setup;
use crate::surroundings::Surroundings;
use starl_core::motion::Obstacles;
use starl_core::sensor::Contact;
use starl_core::{Obstacle, Point, Pose, Time};
use starl_motion::discovery::perceives;

/// An obstacle or a robot this near to the touched point of the bumper is what the robot has touched, metres. The two
/// halves of a Create's bumper tell the direction to 45°, which is 0.13 m, and positions err by some centimetres.
const REACH: f64 = 0.2;

/// The radius of the post that a touch stands for, metres.
const POST: f64 = 0.05;

/// A robot remembers at most so many posts, so that a bumper that is stuck costs no more than that.
const MOST_POSTS: usize = 32;

/// The robot's knowledge of obstacles.
#[derive(Debug)]
pub(crate) struct Discovery {
    known: Obstacles,
    /// Whether each obstacle of the map of the surroundings is known.
    met: Vec<bool>,
    /// How far the robot perceives those that are not, metres.
    range: f64,
    posts: Vec<Obstacle>,
}

impl Discovery {
    /// Nothing is discovered yet.
    pub fn new(setup: &Setup, surroundings: &Surroundings) -> Discovery {
        let mut discovery = Discovery {
            known: Obstacles::from([]),
            met: setup.obstacles.iter().map(|entry| !entry.hidden).collect(),
            range: setup.sensors.discovery_range,
            posts: Vec::new(),
        };
        discovery.gather(surroundings);
        discovery
    }

    /// All obstacles that the robot knows.
    pub fn known(&self) -> &Obstacles {
        &self.known
    }

    /// The map has kept these of its obstacles: see [`Surroundings::expire`].
    pub fn forget(&mut self, surroundings: &Surroundings, stays: &[bool]) {
        let mut stays = stays.iter();
        self.met.retain(|_| stays.next() == Some(&true));
        self.gather(surroundings);
    }

    /// The hidden obstacles that the robot perceives for the first time, at this place.
    pub fn look(&mut self, surroundings: &Surroundings, place: Point) -> Vec<Obstacle> {
        let (body, map) = (surroundings.own(place), surroundings.map());
        let range = self.range;
        self.find(surroundings, |index| perceives(&body, map, index, range))
    }

    /// The obstacles that become known because something touches the robot.
    pub fn touch(
        &mut self,
        surroundings: &Surroundings,
        now: Time,
        pose: &Pose,
        contact: Contact,
    ) -> Vec<Obstacle> {
        let (sin, cos) = (pose.yaw + contact.bearing).sin_cos();
        let direction = Point::planar(cos, sin);
        let radius = surroundings.own(pose.position).radius;
        let touched = pose.position + direction * radius;
        let is_near = |obstacle: &Obstacle| obstacle.body_gap(touched, 0.0, 0.0) <= REACH;
        let robot = |other: starl_motion::Neighbour| {
            touched.planar_distance(other.position) - other.radius <= REACH
        };
        if self.known.iter().any(is_near) || surroundings.others(now).any(robot) {
            return Vec::new();
        }
        let obstacles = surroundings.map().obstacles();
        let found = self.find(surroundings, |index| is_near(&obstacles[index as usize]));
        if !found.is_empty() || self.posts.len() == MOST_POSTS {
            return found;
        }
        let post = Obstacle::circle(touched + direction * POST, POST);
        self.posts.push(post.clone());
        self.gather(surroundings);
        vec![post]
    }

    /// The hidden obstacles for which this holds become known.
    fn find(
        &mut self,
        surroundings: &Surroundings,
        is_found: impl Fn(u32) -> bool,
    ) -> Vec<Obstacle> {
        let mut found = Vec::new();
        let obstacles = surroundings.map().obstacles().iter();
        for ((index, met), obstacle) in (0..).zip(&mut self.met).zip(obstacles) {
            if !*met && is_found(index) {
                *met = true;
                found.push(obstacle.clone());
            }
        }
        if !found.is_empty() {
            self.gather(surroundings);
        }
        found
    }

    fn gather(&mut self, surroundings: &Surroundings) {
        let obstacles = surroundings.map().obstacles().iter().zip(&self.met);
        let met = obstacles.filter(|(_, met)| **met);
        let met = met.map(|(obstacle, _)| obstacle);
        self.known = met.chain(&self.posts).cloned().collect();
    }
}
