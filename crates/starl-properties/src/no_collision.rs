//! Bodies never touch: neither each other nor obstacles.
//!
//! There are three independent sources: the collisions that the host reports, bodies that overlap in the
//! recorded poses, and bodies that pass through something from one recorded pose to the next. Robots are compared only
//! at poses of the same moment. All contacts from the first touch until the two are [`APART`] are one collision,
//! reported once. Contacts of a robot that has crashed in the air and falls do not count, nor those with robots that it
//! lands on.

use super::bodies::{Sweep, gap};
use super::passing::{self, Passing, Way};
use super::track::DEVIATIONS;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use starl_core::event::{Event, Fault, Hit};
use starl_core::geometry::{Bounds, ObstacleIndex};
use starl_core::motion::Body;
use starl_core::{Duration, Intervention, Obstacle, Point, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::SQRT_2;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;

const NO_COLLISION: &str = "no_collision";

/// Overlaps are to be greater than this, metres: bodies that the host stops at each other may overlap
/// by rounding.
const OVERLAP: f64 = 0.001;

/// Once bodies are this far from each other a collision is over, metres: farther than a body that is
/// stopped stands off what it would have hit.
const APART: f64 = 0.1;

/// A fallen robot lies still when its height has not decreased for this time.
const LIES_AFTER: Duration = Duration::from_millis(500);

/// One that restarts in its fall has caught itself by then: three times what an AR.Drone's rate of climb takes to
/// follow.
const CAUGHT_AFTER: Duration = Duration::from_seconds(1);

/// The name of the walls around the world.
const EDGE: &str = "the edge of the world";

/// Watches all bodies.
#[derive(Clone, Debug)]
pub(super) struct NoCollision {
    bodies: Vec<Body>,
    /// Overlaps of a body with an obstacle are to be greater than this, metres, and with another body.
    overlap: f64,
    overlap_of_pairs: f64,
    obstacles: Arc<ObstacleIndex>,
    /// When each obstacle vanishes.
    expires: Arc<[Time]>,
    /// Which of them are the walls around the world: behind those of the start come those that have appeared.
    edges: Range<usize>,
    /// Robots that are to join, if their places are free.
    joining: Vec<(Body, Point)>,
    /// Each robot's last pose.
    positions: Vec<Option<Point>>,
    round: Round,
    passing: Passing,
    /// Robots that touch, the lower number first.
    pairs: BTreeSet<(RobotId, RobotId)>,
    /// The obstacles that each robot touches.
    walls: Vec<Vec<Wall>>,
    /// Robots that have crashed in the air, until they have started again and rise.
    falls: BTreeMap<RobotId, Fall>,
    excused: Excused,
}

/// A robot that has crashed in the air.
#[derive(Clone, Copy, Debug)]
struct Fall {
    /// The least height that it has come to, metres, and when it came there.
    lowest: f64,
    since: Time,
    /// When it has started again. It sinks on for a moment, whatever its program does.
    restarted: Option<Time>,
}

/// An obstacle that a robot touches.
#[derive(Clone, Debug)]
struct Wall {
    index: u32,
    /// The robot's place when they met.
    met: Point,
}

/// The poses of one moment.
#[derive(Clone, Debug, Default)]
struct Round {
    at: Time,
    poses: Vec<Option<Point>>,
    count: usize,
    sweep: Sweep,
}

impl Fall {
    fn lasts(self, now: Time) -> bool {
        let is_caught = |restarted| now.since(restarted) > CAUGHT_AFTER;
        now.since(self.since) <= LIES_AFTER && !self.restarted.is_some_and(is_caught)
    }
}

impl NoCollision {
    pub fn new(setting: &Setting) -> NoCollision {
        let robots = setting.bodies.len();
        let (obstacles, expires): (Vec<Obstacle>, Vec<Time>) =
            setting.obstacles.iter().cloned().unzip();
        // Outside simulators poses are measured.
        let error = match setting.simulated {
            true => 0.0,
            false => DEVIATIONS * setting.position_noise,
        };
        NoCollision {
            overlap: OVERLAP + error,
            overlap_of_pairs: OVERLAP + SQRT_2 * error,
            bodies: setting.bodies.clone(),
            obstacles: Arc::new(ObstacleIndex::new(&obstacles)),
            edges: expires.len() - setting.walls.min(expires.len())..expires.len(),
            joining: Vec::new(),
            expires: expires.into(),
            positions: vec![None; robots],
            round: Round {
                poses: vec![None; robots],
                ..Round::default()
            },
            passing: Passing::default(),
            pairs: BTreeSet::new(),
            walls: vec![Vec::new(); robots],
            falls: BTreeMap::new(),
            excused: Excused::default(),
        }
    }

    /// Whether contacts of a robot are excused now, because it has crashed and falls.
    fn falls(&self, robot: RobotId, at: Time) -> bool {
        self.falls.get(&robot).is_some_and(|fall| fall.lasts(at))
    }

    /// Whether a robot that has crashed in the air lies on another one, or on others of the same height: it touches them
    /// whenever one of them moves.
    fn lies_on(&self, robot: RobotId, other: RobotId) -> bool {
        let top = |other: RobotId| {
            let place = self.positions.get(other.index()).copied().flatten();
            place.map(|place| place.z + self.bodies[other.index()].height)
        };
        let place = self.positions.get(robot.index()).copied().flatten();
        let is_down = |fall: &Fall| fall.restarted.is_none();
        self.falls.get(&robot).is_some_and(is_down)
            && matches!((place, top(other)), (Some(place), Some(top)) if place.z + OVERLAP >= top)
    }

    /// Notes how low one is that has crashed in the air. Once it has started again and rises it falls no more.
    fn follow_fall(&mut self, at: Time, robot: RobotId, height: f64) {
        let Some(fall) = self.falls.get_mut(&robot) else {
            return;
        };
        if height < fall.lowest - OVERLAP {
            (fall.lowest, fall.since) = (height, at);
        } else if fall.restarted.is_some() && height > fall.lowest + OVERLAP {
            self.falls.remove(&robot);
        }
    }

    fn changed(&mut self, at: Time, robot: RobotId, fault: &Fault) {
        let Some(&Some(place)) = self.positions.get(robot.index()) else {
            return;
        };
        match fault {
            Fault::Crash if place.z > OVERLAP => {
                let fall = Fall {
                    lowest: place.z,
                    since: at,
                    restarted: None,
                };
                self.falls.insert(robot, fall);
            }
            Fault::Restart => {
                if let Some(fall) = self.falls.get_mut(&robot) {
                    fall.restarted = Some(at);
                }
            }
            _ => {}
        }
    }

    /// The host says that a robot has met something.
    fn collided(&mut self, at: Time, robot: RobotId, with: Hit, found: &mut Vec<Violation>) {
        let Some(&place) = self.positions.get(robot.index()) else {
            return;
        };
        let (is_new, other) = match with {
            Hit::Robot(other) if other.index() >= self.bodies.len() => return,
            Hit::Robot(other) => {
                let pair = (robot.min(other), robot.max(other));
                (self.pairs.insert(pair), format!("robot {other}"))
            }
            Hit::Obstacle(index) => {
                let is_new = self.touch(robot, index, place.unwrap_or_default());
                (is_new, self.name(index))
            }
        };
        if !is_new {
            return;
        }
        let is_of_fall = match with {
            Hit::Robot(other) => {
                self.falls(other, at) || self.lies_on(robot, other) || self.lies_on(other, robot)
            }
            Hit::Obstacle(_) => false,
        };
        if is_of_fall || self.falls(robot, at) {
            return self.excused.note(NO_COLLISION, Excuse::Fall);
        }
        let near = place.map_or(String::new(), |place| format!(" near {place}"));
        let mut robots = vec![robot];
        if let Hit::Robot(other) = with {
            robots.push(other);
        }
        found.push(Violation {
            property: NO_COLLISION.into(),
            at,
            robots,
            text: format!("robot {robot} ran into {other}{near}"),
        });
    }

    /// Notes that a robot at `met` touches an obstacle; whether that is new.
    fn touch(&mut self, robot: RobotId, index: u32, met: Point) -> bool {
        let walls = &mut self.walls[robot.index()];
        let is_new = walls.iter().all(|wall| wall.index != index);
        if is_new {
            walls.push(Wall { index, met });
        }
        is_new
    }

    /// The world or the fleet changes.
    fn steered(&mut self, at: Time, what: &Intervention) {
        let stands = |index: u32| {
            let expires = self.expires.get(index as usize);
            let is_edge = self.edges.contains(&(index as usize));
            expires.is_some_and(|&expires| expires > at) && !is_edge
        };
        let mut obstacles = self.obstacles.obstacles().to_vec();
        let mut expires = self.expires.to_vec();
        let index = match what {
            Intervention::AddObstacle { obstacle, .. } => {
                obstacles.push(obstacle.clone());
                expires.push(Time::NEVER);
                obstacles.len() as u32 - 1
            }
            Intervention::MoveObstacle { index, obstacle } if stands(*index) => {
                obstacles[*index as usize] = obstacle.clone();
                *index
            }
            Intervention::RemoveObstacle { index } if stands(*index) => {
                expires[*index as usize] = at;
                self.expires = expires.into();
                return;
            }
            Intervention::Join { like, pose, .. } => {
                let body = self.bodies.get(like.index());
                let position = pose.position;
                self.joining.extend(body.map(|&body| (body, position)));
                return;
            }
            Intervention::Push { robot, .. } => return self.passing.forget(*robot),
            Intervention::Leave(robots) => {
                return robots.iter().for_each(|&robot| self.left(robot));
            }
            _ => return,
        };
        self.obstacles = Arc::new(ObstacleIndex::new(&obstacles));
        self.expires = expires.into();
        // A robot can do nothing about an obstacle that comes to it.
        let obstacle = &obstacles[index as usize];
        for place in 0..self.bodies.len() {
            let (Some(position), body) = (self.positions[place], self.bodies[place]) else {
                continue;
            };
            let gap = obstacle.body_gap(position, body.radius, body.height);
            if gap < APART
                && self.touch(RobotId(place as u32), index, position)
                && gap < -self.overlap
            {
                self.excused.note(NO_COLLISION, Excuse::Obstacle);
            }
        }
    }

    /// A robot has joined if it appears where one was to join.
    fn joined(&mut self, robot: RobotId, position: Point) {
        let mut joining = self.joining.iter();
        let found = joining.position(|(_, place)| *place == position);
        if let Some(found) = found
            && robot.index() == self.bodies.len()
        {
            self.bodies.push(self.joining.swap_remove(found).0);
            self.positions.push(None);
            self.round.poses.push(None);
            self.walls.push(Vec::new());
        }
    }

    /// A robot is removed, and its body too.
    fn left(&mut self, robot: RobotId) {
        let Some(position) = self.positions.get_mut(robot.index()) else {
            return;
        };
        *position = None;
        if self.round.poses[robot.index()].take().is_some() {
            self.round.count -= 1;
        }
        self.walls[robot.index()].clear();
        self.falls.remove(&robot);
        self.passing.forget(robot);
        self.pairs.retain(|&(a, b)| a != robot && b != robot);
    }

    fn moved(&mut self, at: Time, robot: RobotId, position: Point, found: &mut Vec<Violation>) {
        let index = robot.index();
        if index >= self.bodies.len() {
            self.joined(robot, position);
        }
        if index >= self.bodies.len() || !position.is_finite() {
            return;
        }
        self.positions[index] = Some(position);
        self.follow_fall(at, robot, position.z);
        self.check_obstacles(at, robot, position, found);
        let round = &mut self.round;
        round.at = at;
        if round.poses[index].replace(position).is_none() {
            round.count += 1;
        }
        if round.count == self.bodies.len() {
            self.close_round(found);
        }
    }

    /// The name of an obstacle.
    fn name(&self, index: u32) -> String {
        let index = index as usize;
        let has_appeared = index >= self.edges.end && index < self.expires.len();
        match index < self.edges.start || has_appeared {
            true => format!("obstacle {index}"),
            false => EDGE.into(),
        }
    }

    fn check_obstacles(
        &mut self,
        at: Time,
        robot: RobotId,
        position: Point,
        found: &mut Vec<Violation>,
    ) {
        let Body { radius, height, .. } = self.bodies[robot.index()];
        let map = self.obstacles.clone();
        let gap = |index: u32| {
            let obstacle = map.obstacles().get(index as usize);
            obstacle.map(|obstacle| obstacle.body_gap(position, radius, height))
        };
        self.walls[robot.index()]
            .retain(|wall| gap(wall.index).unwrap_or_else(|| wall.met.distance(position)) < APART);
        let around = Bounds::of_body(position, position, radius, height);
        let _ = map.for_each_near(&around, |index| {
            let gap = gap(index).unwrap_or(f64::INFINITY);
            let stands = at <= self.expires[index as usize];
            if gap < -self.overlap && stands && self.touch(robot, index, position) {
                if self.falls(robot, at) {
                    self.excused.note(NO_COLLISION, Excuse::Fall);
                    return ControlFlow::Continue(());
                }
                found.push(Violation {
                    property: NO_COLLISION.into(),
                    at,
                    robots: vec![robot],
                    text: format!(
                        "the body of robot {robot} at {position} reaches {:.3} m into {}",
                        -gap,
                        self.name(index),
                    ),
                });
            }
            ControlFlow::<()>::Continue(())
        });
    }

    /// Compares the poses of a moment.
    fn close_round(&mut self, found: &mut Vec<Violation>) {
        let Round {
            at,
            poses,
            count,
            sweep,
        } = &mut self.round;
        let (bodies, pairs, falls) = (&self.bodies, &mut self.pairs, &self.falls);
        let excused = &mut self.excused;
        let falls = |robot: RobotId| falls.get(&robot).is_some_and(|fall| fall.lasts(*at));
        let place = |robot: RobotId| poses[robot.index()];
        pairs.retain(|&(a, b)| match (place(a), place(b)) {
            (Some(p), Some(q)) => gap((&bodies[a.index()], p), (&bodies[b.index()], q)) < APART,
            _ => true,
        });
        sweep.overlaps(bodies, poses, self.overlap_of_pairs, |a, b, gap| {
            if !pairs.insert((a, b)) {
                return;
            }
            if falls(a) || falls(b) {
                excused.note(NO_COLLISION, Excuse::Fall);
            } else {
                let near = place(a).map_or(String::new(), |place| format!(" near {place}"));
                found.push(Violation {
                    property: NO_COLLISION.into(),
                    at: *at,
                    robots: vec![a, b],
                    text: format!(
                        "the bodies of robots {a} and {b} overlap by {:.3} m{near}",
                        -gap,
                    ),
                });
            }
        });
        let (ended, ways) = self.passing.close(*at, poses, bodies);
        passing::pairs(&ways, self.overlap_of_pairs, |a, b, depth| {
            if !falls(a.robot) && !falls(b.robot) && pairs.insert((a.robot, b.robot)) {
                found.push(Violation {
                    property: NO_COLLISION.into(),
                    at: ended,
                    robots: vec![a.robot, b.robot],
                    text: format!(
                        "robots {} and {} pass through each other, {:.3} m deep, near {}",
                        a.robot, b.robot, -depth, a.to,
                    ),
                });
            }
        });
        poses.fill(None);
        *count = 0;
        for way in &ways {
            if !self.falls(way.robot, ended) {
                self.pass_obstacles(ended, way, found);
            }
        }
    }

    /// Whether a robot went through an obstacle on its way.
    fn pass_obstacles(&mut self, ended: Time, way: &Way, found: &mut Vec<Violation>) {
        let map = self.obstacles.clone();
        let _ = map.for_each_near(&way.bounds(), |index| {
            let depth = way.into(&map.obstacles()[index as usize]);
            let stands = ended <= self.expires[index as usize];
            if depth < -self.overlap && stands && self.touch(way.robot, index, way.to) {
                found.push(Violation {
                    property: NO_COLLISION.into(),
                    at: ended,
                    robots: vec![way.robot],
                    text: format!(
                        "robot {} passes through {}, {:.3} m deep, near {}",
                        way.robot,
                        self.name(index),
                        -depth,
                        way.to,
                    ),
                });
            }
            ControlFlow::<()>::Continue(())
        });
    }

    /// Closes the round if its moment has passed.
    fn catch_up(&mut self, now: Time, found: &mut Vec<Violation>) {
        if self.round.count > 0 && now > self.round.at {
            self.close_round(found);
        }
    }
}

impl Checker for NoCollision {
    fn properties(&self) -> &'static [&'static str] {
        &[NO_COLLISION]
    }

    fn bears_missing_robots(&self) -> bool {
        true
    }

    fn heeds(&self) -> Kinds {
        Kinds::MOVED | Kinds::COLLIDED | Kinds::FAULT | Kinds::INTERVENTION
    }

    fn needs(&self, _: &str) -> Kinds {
        Kinds::MOVED
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match (&record.event, record.robot) {
            (Event::Moved(pose), Some(robot)) => {
                self.catch_up(record.at, violations);
                self.moved(record.at, robot, pose.position, violations);
            }
            (&Event::Collided { with }, Some(robot)) => {
                self.catch_up(record.at, violations);
                self.collided(record.at, robot, with, violations);
            }
            (Event::Fault(fault), Some(robot)) => self.changed(record.at, robot, fault),
            (Event::Intervention(what), None) => {
                self.catch_up(record.at, violations);
                self.steered(record.at, what);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.catch_up(now, violations);
    }
}
