//! Bodies that share a floor, stepped in real time.
//!
//! Invariant: bodies overlap neither obstacles nor each other. They stop where they touch, as in the simulator. One thread steps all bodies every 10 ms. A thread that wakes late catches up, but by no
//! more than [`CATCH_UP`], so a machine that was asleep does not play back hours of motion.

mod body;

pub use body::{BodyHandle, Odometer};

use body::Body;
use starl_core::event::Hit;
use starl_core::geometry::ObstacleIndex;
use starl_core::{Duration, Obstacle, Point, Pose, Random, RobotId};
use starl_motion::contact::{Contact, Contacts, Motions};
use starl_motion::proximity::Rays;
use starl_motion::scene::{Grid, Scene};
use starl_motion::{Disturbance, Model, Neighbour, State};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;
use std::time::Instant;
use thiserror::Error;

/// The time of one step.
pub const STEP: Duration = Duration::from_millis(10);

/// The most time that the world makes up for when its thread was held up.
pub const CATCH_UP: Duration = Duration::from_millis(250);

/// A body that touches something again within this time has not been away from it.
const SAME_TOUCH: Duration = Duration::from_millis(500);

/// How the motion of bodies errs from their commands: standard deviations relative to the speed, drawn for each step.
/// Wheels slip so; [`BodyHandle::odometer`] does not see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Relative error of the speed, e.g. 0.05.
    pub speed: f64,
    /// Relative error of the rate of turn.
    pub turn: f64,
    /// Seeds the errors.
    pub seed: u64,
}

impl Noise {
    /// Bodies move exactly as commanded.
    pub const NONE: Noise = Noise {
        speed: 0.0,
        turn: 0.0,
        seed: 0,
    };
}

/// Why a body cannot be added.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AddError {
    /// A body of this name is in the world already.
    #[error("there is a body `{0}` already; use another name")]
    NameTaken(String),
    /// The body would overlap an obstacle or another body.
    #[error("`{0}` would overlap an obstacle or another body; start it elsewhere")]
    Blocked(String),
}

/// A body that moved freely has run into something.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch {
    /// The world's time.
    pub at: Duration,
    /// The body's name.
    pub body: String,
    /// The other body; none for an obstacle.
    pub with: Option<String>,
    /// Where the body is stopped.
    pub place: Point,
}

/// A floor with obstacles and the bodies on and above it. Clones share the same floor.
#[derive(Clone, Debug)]
pub struct World {
    shared: Arc<Mutex<Floor>>,
}

#[derive(Debug)]
struct Floor {
    map: ObstacleIndex,
    /// When each obstacle of the map disappears.
    expiries: Vec<Duration>,
    noise: Noise,
    bodies: Vec<Body>,
    steps: u64,
    touches: Vec<Touch>,
}

impl World {
    /// An empty floor with these obstacles, whose time starts now.
    pub fn new(obstacles: Vec<Obstacle>, noise: Noise) -> World {
        let lasting = obstacles.into_iter().map(|it| (it, Duration(u64::MAX)));
        World::with_temporary(lasting.collect(), noise)
    }

    /// The same, with the world's time at which each obstacle disappears.
    pub fn with_temporary(obstacles: Vec<(Obstacle, Duration)>, noise: Noise) -> World {
        let (obstacles, expiries): (Vec<_>, Vec<_>) = obstacles.into_iter().unzip();
        let shared = Arc::new(Mutex::new(Floor {
            map: ObstacleIndex::new(&obstacles),
            expiries,
            noise,
            bodies: Vec::new(),
            steps: 0,
            touches: Vec::new(),
        }));
        let floor = Arc::downgrade(&shared);
        thread::spawn(move || keep_time(&floor));
        World { shared }
    }

    /// Puts a body that stands still at `pose`.
    ///
    /// # Errors
    /// The name is taken, or the place is occupied.
    pub fn add(
        &self,
        name: &str,
        model: Arc<dyn Model>,
        pose: Pose,
    ) -> Result<BodyHandle, AddError> {
        let mut floor = lock(&self.shared);
        if floor.bodies.iter().any(|body| body.name == name) {
            return Err(AddError::NameTaken(name.to_string()));
        }
        let body = Body::new(name, model, pose);
        if floor.blocks(&body.neighbour()) {
            return Err(AddError::Blocked(name.to_string()));
        }
        floor.bodies.push(body);
        let index = floor.bodies.len() - 1;
        Ok(BodyHandle::new(self.clone(), index))
    }

    /// The true poses of all bodies by name, in the order in which they were added, all of the same moment.
    pub fn poses(&self) -> Vec<(String, Pose)> {
        let floor = lock(&self.shared);
        let poses = floor.bodies.iter();
        poses
            .map(|body| (body.name.clone(), body.state.pose))
            .collect()
    }

    /// The touches since the last call, in the order of time. Two bodies that run into each other are one
    /// touch.
    pub fn take_touches(&self) -> Vec<Touch> {
        std::mem::take(&mut lock(&self.shared).touches)
    }

    /// The world's time: how long its bodies have moved.
    pub fn elapsed(&self) -> Duration {
        lock(&self.shared).elapsed()
    }

    /// Distances along rays from the centre of a body, metres; infinite where a ray meets nothing.
    fn scan(&self, index: usize, rays: &Rays) -> Vec<f64> {
        let floor = lock(&self.shared);
        let (bodies, grid) = floor.indexed();
        let scene = Scene {
            bodies: &bodies,
            grid: &grid,
            map: &floor.map,
        };
        let mut distances = vec![f64::INFINITY; rays.bearings.len()];
        let yaw = floor.bodies[index].state.pose.yaw;
        rays.measure(&scene, index, yaw, &mut Vec::new(), |ray, distance| {
            distances[ray] = bodies[index].radius + distance;
        });
        distances
    }

    fn with<T>(&self, index: usize, look: impl FnOnce(&mut Body) -> T) -> T {
        look(&mut lock(&self.shared).bodies[index])
    }
}

impl Floor {
    fn elapsed(&self) -> Duration {
        Duration(self.steps * STEP.0)
    }

    /// Removes the obstacles that have expired.
    fn expire(&mut self) {
        let now = self.elapsed();
        if self.expiries.iter().all(|at| *at > now) {
            return;
        }
        let obstacles = self.map.obstacles().iter().zip(&self.expiries);
        let staying = obstacles.filter(|(_, at)| **at > now);
        let staying: Vec<Obstacle> = staying.map(|(obstacle, _)| obstacle.clone()).collect();
        self.map = ObstacleIndex::new(&staying);
        self.expiries.retain(|at| *at > now);
    }

    fn step(&mut self) {
        self.expire();
        let predicted: Vec<_> = (0u64..)
            .zip(&self.bodies)
            .map(|(index, body)| body.predict(&self.disturbance(index)))
            .collect();
        let contacts = self.contacts(&predicted);
        self.note_touches(&contacts);
        for ((body, predicted), contact) in self.bodies.iter_mut().zip(predicted).zip(contacts) {
            body.advance(&predicted, contact.map(|contact| contact.impact));
        }
        self.steps += 1;
    }

    fn note_touches(&mut self, contacts: &[Option<Contact>]) {
        let at = self.elapsed();
        for (index, contact) in contacts.iter().enumerate() {
            let Some(contact) = contact else {
                continue;
            };
            let before = self.bodies[index].touched_at.replace(at);
            if before.is_some_and(|before| at.0 - before.0 <= SAME_TOUCH.0) {
                continue;
            }
            let with = match contact.with {
                Hit::Obstacle(_) => None,
                Hit::Robot(other) => {
                    let back = contacts[other.index()].map(|contact| contact.with);
                    let is_mutual = back == Some(Hit::Robot(RobotId(index as u32)));
                    if is_mutual && other.index() < index {
                        continue;
                    }
                    Some(self.bodies[other.index()].name.clone())
                }
            };
            self.touches.push(Touch {
                at,
                body: self.bodies[index].name.clone(),
                with,
                place: contact.impact.place,
            });
        }
    }

    /// Whether a body would overlap an obstacle or another body.
    fn blocks(&self, new: &Neighbour) -> bool {
        let at = new.position;
        let overlaps = |other: Neighbour| {
            at.planar_distance(other.position) < new.radius + other.radius
                && at.z < other.position.z + other.height
                && other.position.z < at.z + new.height
        };
        self.map.blocks_body(at, at, new.radius, new.height)
            || self.bodies.iter().map(Body::neighbour).any(overlaps)
    }

    /// All bodies, and an index of them.
    fn indexed(&self) -> (Vec<Neighbour>, Grid) {
        let bodies: Vec<_> = self.bodies.iter().map(Body::neighbour).collect();
        let mut grid = Grid::default();
        grid.rebuild(&bodies, &[]);
        (bodies, grid)
    }

    /// For each body the contact that stops it on its way to the predicted state.
    fn contacts(&self, predicted: &[State]) -> Vec<Option<Contact>> {
        let (bodies, grid) = self.indexed();
        let next: Vec<_> = predicted.iter().map(|state| state.pose.position).collect();
        let standing: Vec<u32> = (0..).take(self.map.obstacles().len()).collect();
        let scene = Scene {
            bodies: &bodies,
            grid: &grid,
            map: &self.map,
        };
        let motions = Motions::new(scene, &standing, &next);
        let mut found = Vec::new();
        motions.first_contacts(grid.entries(), &mut found);
        let mut contacts = Contacts::default();
        contacts.settle(&motions, found);
        let bodies = 0..bodies.len() as u32;
        bodies
            .map(|body| contacts.of(RobotId(body)).copied())
            .collect()
    }

    fn disturbance(&self, index: u64) -> Disturbance {
        let Noise { speed, turn, seed } = self.noise;
        if speed == 0.0 && turn == 0.0 {
            return Disturbance::default();
        }
        let mut random = Random::keyed(seed, &[index, self.steps]);
        Disturbance {
            speed_error: random.normal(0.0, speed),
            turn_error: random.normal(0.0, turn),
            ..Disturbance::default()
        }
    }
}

/// Steps the floor until its last user drops it.
fn keep_time(floor: &Weak<Mutex<Floor>>) {
    let step = std::time::Duration::from_nanos(STEP.0);
    let most_late = std::time::Duration::from_nanos(CATCH_UP.0);
    let mut due = Instant::now() + step;
    loop {
        thread::sleep(due.saturating_duration_since(Instant::now()));
        let Some(shared) = floor.upgrade() else {
            return;
        };
        let now = Instant::now();
        if now > due + most_late {
            due = now - most_late;
        }
        let mut floor = lock(&shared);
        while due <= now {
            floor.step();
            due += step;
        }
    }
}

/// A panic in one device leaves the floor as it was between two steps.
fn lock(shared: &Mutex<Floor>) -> MutexGuard<'_, Floor> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
