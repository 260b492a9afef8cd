//! A small world for the avoidance tests: real models driven by real pilots, no network, no programs.
//!
//! Estimates come every 50 ms unless told otherwise, each robot's at a phase of its own, with noise of
//! a given deviation in both coordinates and, where there is any, of half a degree in heading. A robot
//! sees the last estimate of each neighbour, up to a period old, which is the worst that the
//! documentation allows. Gaps are measured between true bodies at every step of 10 ms.

mod robot;
pub mod scenes;

pub use robot::Robot;

use starl_core::motion::Estimate;
use starl_core::{Duration, Obstacle, Point, Random, Time, math};
use starl_motion::avoidance::Options;
use starl_motion::{Disturbance, Neighbour};

const STEP: Duration = Duration::from_millis(10);
/// A robot this near to its goal has arrived, metres; that of Race.
pub const VICINITY: f64 = 0.075;
/// Deviation of estimated headings in worlds with noise, radians.
const HEADING_NOISE: f64 = 0.0087;

/// The initial scene.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub robots: Vec<Placed>,
    pub obstacles: Vec<Obstacle>,
}

/// A robot, where it starts and where it wants to go.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub model: &'static str,
    pub start: Point,
    pub goal: Point,
}

/// The robots' position estimates.
#[derive(Clone, Copy, Debug)]
pub struct Positioning {
    /// Deviation in each coordinate of the plane, metres.
    pub noise: f64,
    /// Steps of 10 ms from one estimate to the next.
    pub steps: u64,
    /// Probability that an estimate is lost.
    pub loss: f64,
}

/// An estimate every 50 ms, exact.
pub const EXACT: Positioning = Positioning {
    noise: 0.0,
    steps: 5,
    loss: 0.0,
};

/// Seeds 0, 1, ..., each with exact estimates and with noise of 5 and of 10 mm.
pub fn runs(seeds: u64) -> impl Iterator<Item = (Positioning, u64)> {
    (0..seeds)
        .flat_map(|seed| [0.0, 0.005, 0.01].map(|noise| (Positioning { noise, ..EXACT }, seed)))
}

/// Robots, obstacles and the clock.
pub struct World {
    pub robots: Vec<Robot>,
    pub obstacles: Vec<Obstacle>,
    /// Smallest gap between two bodies so far, metres.
    pub least_gap: f64,
    /// Smallest gap between a body and an obstacle so far, metres.
    pub least_obstacle_gap: f64,
    positioning: Positioning,
    /// Until when no estimates come, in steps.
    silent: u64,
    random: Random,
    steps: u64,
    name: String,
}

impl World {
    /// The world of a scene, with the default avoidance.
    pub fn new(scene: &Scene, positioning: Positioning, seed: u64) -> World {
        World::with_options(scene, positioning, seed, Some(Options::default()))
    }

    /// The same with these options; none switches avoidance off.
    pub fn with_options(
        scene: &Scene,
        positioning: Positioning,
        seed: u64,
        options: Option<Options>,
    ) -> World {
        let mut random = Random::keyed(seed, &[0]);
        let robots = scene.robots.iter().enumerate().map(|(index, placed)| {
            let yaw = random.between(-math::PI, math::PI);
            let phase = random.below(positioning.steps as u32);
            let own = Random::keyed(seed, &[1, index as u64]);
            Robot::new(placed, yaw, u64::from(phase), own, options.clone())
        });
        let robots = robots.collect();
        let first = scene.robots.first().map_or("nobody", |placed| placed.model);
        let count = scene.robots.len();
        World {
            robots,
            obstacles: scene.obstacles.clone(),
            least_gap: f64::INFINITY,
            least_obstacle_gap: f64::INFINITY,
            positioning,
            silent: 0,
            random,
            steps: 0,
            name: format!("{count} robots, first {first}, {positioning:?}, seed {seed}"),
        }
    }

    /// Simulated seconds so far.
    pub fn seconds(&self) -> f64 {
        self.steps as f64 * STEP.seconds()
    }

    /// Moves everything on by one step.
    pub fn step(&mut self) {
        for index in 0..self.robots.len() {
            let due = self.steps + self.robots[index].phase;
            if due.is_multiple_of(self.positioning.steps)
                && self.steps >= self.silent
                && !self.random.chance(self.positioning.loss)
            {
                self.steer(index);
            }
        }
        for index in 0..self.robots.len() {
            self.advance(index);
        }
        self.steps += 1;
        self.measure();
    }

    /// Advances the world by this number of seconds.
    pub fn run_for(&mut self, seconds: f64) {
        let end = self.seconds() + seconds;
        while self.seconds() < end {
            self.step();
        }
    }

    /// Advances everything by a number of seconds without any estimate.
    pub fn lose_estimates(&mut self, seconds: f64) {
        self.silent = self.steps + (seconds / STEP.seconds()) as u64;
        self.run_for(seconds);
    }

    /// Runs until all robots have been at their goals; the time it took, none if longer than `bound`
    /// seconds.
    pub fn run(&mut self, bound: f64) -> Option<f64> {
        while self.seconds() < bound {
            self.step();
            for robot in &mut self.robots {
                robot.arrived |= robot.position().planar_distance(robot.goal) < VICINITY;
            }
            if self.robots.iter().all(|robot| robot.arrived) {
                return Some(self.seconds());
            }
        }
        None
    }

    /// Fails unless all robots have been at their goals within `bound` seconds, without a contact.
    pub fn must_arrive(&mut self, bound: f64) {
        let took = self.run(bound);
        self.must_be_clear();
        assert!(took.is_some(), "{}: not there in {bound} s", self.name);
    }

    /// Fails if bodies have touched one another or an obstacle.
    pub fn must_be_clear(&self) {
        let (robots, obstacles) = (self.least_gap, self.least_obstacle_gap);
        assert!(robots >= 0.0, "{}: overlap of {} m", self.name, -robots);
        assert!(
            obstacles >= 0.0,
            "{}: {} m into a wall",
            self.name,
            -obstacles
        );
    }

    /// A new estimate for the robot, and its command.
    fn steer(&mut self, index: usize) {
        let noise = self.positioning.noise;
        let mut normal = || self.random.normal(0.0, 1.0);
        let error = Point::planar(normal() * noise, normal() * noise);
        let turn = if noise > 0.0 {
            normal() * HEADING_NOISE
        } else {
            0.0
        };
        let robot = &mut self.robots[index];
        let mut seen = Estimate {
            pose: robot.state.pose,
            twist: robot.state.twist,
            at: Time::ZERO + STEP * self.steps,
        };
        seen.pose.position += error;
        seen.pose.yaw += turn;
        robot.seen = seen;
        let range = robot.pilot.wants_neighbours().unwrap_or(0.0);
        let others = (0..self.robots.len()).filter(|&other| other != index);
        let neighbours: Vec<Neighbour> = others
            .map(|other| self.robots[other].neighbour())
            .filter(|other| other.position.planar_distance(seen.pose.position) <= range)
            .collect();
        let robot = &mut self.robots[index];
        robot.command = robot.pilot.command(
            &*robot.model,
            &seen,
            &neighbours,
            &self.obstacles,
            &mut robot.random,
        );
    }

    /// Moves one robot on; a body that runs into an obstacle is stopped there.
    fn advance(&mut self, index: usize) {
        let robot = &mut self.robots[index];
        let body = robot.model.body();
        let next = robot
            .model
            .predict(&robot.state, &robot.command, &Disturbance::default(), STEP);
        let place = next.pose.position;
        let mut is_blocked = false;
        for obstacle in &self.obstacles {
            let gap = obstacle.body_gap(place, body.radius, body.height);
            self.least_obstacle_gap = self.least_obstacle_gap.min(gap);
            is_blocked |= gap < 0.0;
        }
        let before = std::mem::replace(&mut robot.state, next);
        if is_blocked {
            robot.model.stop_at(&mut robot.state, before.pose.position);
        }
    }

    fn measure(&mut self) {
        for (index, one) in self.robots.iter().enumerate() {
            for other in &self.robots[..index] {
                self.least_gap = self.least_gap.min(one.gap(other));
            }
        }
    }
}
