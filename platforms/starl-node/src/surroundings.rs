//! Where the other robots are, and the sensors that are served from that.
//!
//! A robot learns where another one is in two ways: the system that tells it its own position sees the other one too
//! (motion capture follows all bodies), or the other one says where it is. A fresh sighting counts before words,
//! because a robot may err about itself and its words need the network. A robot that is neither seen nor heard for a
//! while is taken to stand where it was last.
//!
//! Few robots carry a detector or a ring of distance sensors that tells robots apart. A program that needs one gets the
//! readings that the simulator defines ([`Readings`]), measured among these places and the obstacles of the scenario.

use crate::localise::Localiser;
use crate::setup::Setup;
use starl_core::event::Name;
use starl_core::geometry::ObstacleIndex;
use starl_core::motion::Body;
use starl_core::{Duration, Obstacle, Point, Pose, RobotId, Time};
use starl_motion::Neighbour;
use starl_motion::scene::{Grid, Scene};
use starl_motion::sensing::{Readings, SensorSuite};

/// A robot that is not perceived for longer stands where it was last.
const FRESH: Duration = Duration::from_millis(500);

/// The robot's knowledge of the bodies around it.
#[derive(Debug)]
pub(crate) struct Surroundings {
    me: RobotId,
    others: Vec<Other>,
    things: Vec<Point>,
    /// The names of the things, by number.
    pub thing_names: Vec<Name>,
    /// The obstacles of the scenario that have not expired, known or not.
    map: ObstacleIndex,
    /// When each of them expires.
    expiries: Vec<Time>,
    sensors: SensorSuite,
    readings: Readings,
    /// When the sensors were read.
    read: Option<Time>,
    bodies: Vec<Neighbour>,
    unknown: Vec<bool>,
    grid: Grid,
}

/// Another robot, or this one.
#[derive(Clone, Debug)]
struct Other {
    body: Body,
    /// Where it was when it last said so, and how it moved.
    told: Option<(Time, Point, Point)>,
    /// Where it was seen.
    sight: Localiser,
}

impl Surroundings {
    /// Nothing is known yet but what does not move.
    pub fn new(setup: &Setup) -> Surroundings {
        let (bodies, things) = (setup.bodies.iter(), setup.things.iter());
        let other = |body: &Body| Other {
            body: *body,
            told: None,
            sight: Localiser::new(setup.accuracy, None, true, Time::ZERO),
        };
        let obstacles = setup.obstacles.iter();
        let (obstacles, expiries): (Vec<Obstacle>, Vec<Time>) = obstacles
            .map(|entry| (entry.obstacle.clone(), entry.expires))
            .unzip();
        Surroundings {
            me: setup.id,
            others: bodies.map(other).collect(),
            things: things.clone().map(|thing| thing.position).collect(),
            thing_names: things.map(|thing| thing.name.clone()).collect(),
            map: ObstacleIndex::new(&obstacles),
            expiries,
            sensors: setup.sensors,
            readings: Readings::default(),
            read: None,
            bodies: Vec::new(),
            unknown: Vec::new(),
            grid: Grid::default(),
        }
    }

    /// A robot has said where it is and how it moves.
    pub fn hear(&mut self, robot: RobotId, at: Time, position: Point, velocity: Point) {
        if let Some(other) = self.others.get_mut(robot.index()) {
            other.told = Some((at, position, velocity));
        }
    }

    /// A robot was seen.
    pub fn see(&mut self, robot: RobotId, at: Time, pose: Pose) {
        if let Some(other) = self.others.get_mut(robot.index()) {
            other.sight.fix(at, pose);
        }
    }

    /// Where the other robots are by `now`, as far as they were ever perceived.
    pub fn others(&self, now: Time) -> impl Iterator<Item = Neighbour> {
        let numbered = (0..).map(RobotId).zip(&self.others);
        let others = numbered.filter(|(robot, _)| *robot != self.me);
        others.filter_map(move |(_, other)| other.by(now))
    }

    /// The robot's own body at this place.
    pub fn own(&self, place: Point) -> Neighbour {
        self.others[self.me.index()].at(place)
    }

    /// The obstacles of the scenario that have not expired, known or not.
    pub fn map(&self) -> &ObstacleIndex {
        &self.map
    }

    /// Removes the obstacles that have expired by `now` from the map. Returns which of its obstacles have stayed; none if
    /// all have.
    pub fn expire(&mut self, now: Time) -> Option<Vec<bool>> {
        if self.expiries.iter().all(|at| *at > now) {
            return None;
        }
        let stays: Vec<bool> = self.expiries.iter().map(|at| *at > now).collect();
        let staying = self.map.obstacles().iter().zip(&stays);
        let obstacles: Vec<Obstacle> = staying
            .filter(|(_, stays)| **stays)
            .map(|(obstacle, _)| obstacle.clone())
            .collect();
        self.map = ObstacleIndex::new(&obstacles);
        self.expiries.retain(|at| *at > now);
        Some(stays)
    }

    /// Computes the readings of the robot's sensors at `now`, with the robot at `pose`; nothing for a robot without
    /// sensors.
    pub fn sense(&mut self, now: Time, pose: &Pose) {
        let SensorSuite {
            proximity,
            detector,
            ..
        } = self.sensors;
        if (proximity.is_none() && detector.is_none()) || self.read == Some(now) {
            return;
        }
        self.read = Some(now);
        self.bodies.clear();
        self.unknown.clear();
        for (robot, other) in (0..).map(RobotId).zip(&self.others) {
            let here = (robot == self.me).then(|| other.at(pose.position));
            let place = here.or_else(|| other.by(now));
            self.unknown.push(place.is_none());
            self.bodies.push(place.unwrap_or(other.at(pose.position)));
        }
        self.grid.rebuild(&self.bodies, &self.unknown);
        let scene = Scene {
            bodies: &self.bodies,
            grid: &self.grid,
            map: &self.map,
        };
        let things = (0..).zip(self.things.iter().copied());
        self.readings
            .read(&self.sensors, &scene, things, self.me, pose.yaw);
    }

    /// The last readings of [`Surroundings::sense`].
    pub fn readings(&self) -> &Readings {
        &self.readings
    }
}

impl Other {
    /// Where it is by `now`. A measured position is preferred to a received one, and a received velocity to a measured
    /// one, since that is a difference of positions with errors.
    fn by(&self, now: Time) -> Option<Neighbour> {
        let is_fresh = |at: Time| now.since(at) <= FRESH;
        let seen = self.sight.estimate();
        let seen = seen.map(|(estimate, at)| (at, estimate.pose.position, estimate.twist.linear));
        let (at, position, velocity) = match (seen, self.told) {
            (Some(seen), Some(told)) if is_fresh(seen.0) && is_fresh(told.0) => {
                (seen.0, seen.1, told.2)
            }
            (Some(seen), Some(told)) if told.0 > seen.0 => told,
            (Some(seen), _) => seen,
            (None, told) => told?,
        };
        let neighbour = self.at(position);
        Some(match is_fresh(at) {
            true => Neighbour {
                position: position + velocity * now.since(at).seconds(),
                velocity,
                ..neighbour
            },
            false => neighbour,
        })
    }

    /// Its body, standing there.
    fn at(&self, position: Point) -> Neighbour {
        Neighbour {
            position,
            velocity: Point::ZERO,
            radius: self.body.radius,
            height: self.body.height,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Safety;
    use crate::localise::Accuracy;
    use crate::setup::{MapObstacle, Thing};
    use starl_core::motion::Workspace;
    use starl_core::sensor::Detected;
    use starl_core::{Program, Random, Robot};
    use starl_host::Hardware;
    use starl_motion::sensing::{Detector, Proximity};

    const ME: RobotId = RobotId(0);

    #[derive(Clone, starl_core::Primitives)]
    struct Idle;

    impl Program for Idle {
        fn activate(&mut self, _: &mut Robot<'_>) {}
    }

    fn ms(millis: u64) -> Time {
        Time::ZERO + Duration::from_millis(millis)
    }

    fn place(x: f64) -> Point {
        Point::planar(x, 0.0)
    }

    /// Robot 0 of three, with sensors of a range of 3 m, a thing at 1 m behind it, and this obstacle.
    fn surroundings(obstacle: Option<Obstacle>) -> Surroundings {
        let body = Body {
            radius: 0.2,
            height: 0.1,
            workspace: Workspace::Ground,
        };
        Surroundings::new(&Setup {
            id: ME,
            bodies: vec![body; 3],
            program: Box::new(Idle),
            random: Random::keyed(1, &[]),
            hardware: Hardware {
                body,
                control_period: Duration::ZERO,
                drive: None,
            },
            sensors: SensorSuite {
                proximity: Some(Proximity {
                    rays: 4,
                    range: 3.0,
                }),
                detector: Some(Detector { range: 3.0 }),
                ..SensorSuite::default()
            },
            things: vec![Thing {
                name: "lamp".into(),
                position: place(-1.0),
            }],
            way_points: Vec::new(),
            obstacles: obstacle
                .map(|obstacle| MapObstacle {
                    obstacle,
                    hidden: false,
                    expires: Time::NEVER,
                })
                .into_iter()
                .collect(),
            positioning_period: Duration::from_millis(100),
            accuracy: Accuracy::default(),
            start: None,
            safety: Safety::default(),
        })
    }

    fn detected(surroundings: &mut Surroundings, now: Time) -> Vec<(Detected, f64)> {
        surroundings.sense(now, &Pose::level(Point::ZERO, 0.0));
        let seen = surroundings.readings().detections.iter();
        seen.map(|seen| (seen.what.clone(), seen.position.x))
            .collect()
    }

    #[test]
    fn a_detector_shows_robots_and_things_in_range_nearest_first() {
        let mut surroundings = surroundings(None);
        let lamp = (Detected::Thing(0), -1.0);
        assert_eq!(
            detected(&mut surroundings, ms(0)),
            std::slice::from_ref(&lamp)
        );
        surroundings.hear(RobotId(1), ms(10), place(2.0), Point::ZERO);
        surroundings.hear(RobotId(2), ms(10), place(3.5), Point::ZERO);
        let robot = (Detected::Robot(RobotId(1)), 2.0);
        assert_eq!(detected(&mut surroundings, ms(10)), [lamp, robot]);
        let ahead = surroundings.readings().proximity[0].distance;
        assert!((ahead - 1.6).abs() < 1e-9, "{ahead}");
        assert_eq!(surroundings.readings().proximity[1].distance, 3.0);
    }

    #[test]
    fn an_obstacle_hides_bodies_behind_it() {
        let wall = Obstacle::cuboid(Point::planar(1.0, -1.0), Point::new(1.2, 1.0, 1.0));
        let mut surroundings = surroundings(Some(wall));
        surroundings.hear(RobotId(1), ms(10), place(2.0), Point::ZERO);
        let lamp = (Detected::Thing(0), -1.0);
        assert_eq!(detected(&mut surroundings, ms(10)), [lamp]);
        let ahead = surroundings.readings().proximity[0].distance;
        assert!((ahead - 0.8).abs() < 1e-9, "{ahead}");
    }

    #[test]
    fn a_robot_is_where_it_was_seen_and_not_where_it_says_it_is() {
        let mut surroundings = surroundings(None);
        let other = RobotId(1);
        surroundings.hear(other, ms(100), place(2.0), place(1.0));
        surroundings.see(other, ms(100), Pose::level(place(2.5), 0.0));
        let by = |surroundings: &Surroundings, now: Time| {
            let other = surroundings.others(now).next().expect("it is known");
            (other.position.x, other.velocity.x)
        };
        assert_eq!(by(&surroundings, ms(100)), (2.5, 1.0));
        assert_eq!(by(&surroundings, ms(200)), (2.6, 1.0));
        // The cameras see it no more, but it still says where it is.
        surroundings.hear(other, ms(900), place(2.8), Point::ZERO);
        assert_eq!(by(&surroundings, ms(900)), (2.8, 0.0));
        // Nothing is heard of it either: it stands there.
        surroundings.hear(other, ms(1000), place(3.0), place(1.0));
        assert_eq!(by(&surroundings, ms(5000)), (3.0, 0.0));
    }
}
