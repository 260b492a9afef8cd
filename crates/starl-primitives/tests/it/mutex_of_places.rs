//! A mutex on places asks all robots that are seen near them, gives way to robots that stand in them, and does not call
//! a place held while another robot is there.

use crate::harness::locker::set;
use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::sensor::{Detected, Detection};
use starl_core::{
    Area, Destination, Duration, Effect, Estimate, Input, Message, Point, Pose, Primitive, Random,
    Robot, RobotId, Sensors, Time, TimerKey, View,
};
use starl_primitives::Mutex;
use starl_primitives::mutex::{Options, PlaceOptions};
use std::collections::BTreeMap;

const STEP: Duration = Duration::from_millis(100);
const SECOND: Duration = Duration::from_seconds(1);
const BODY: Body = Body {
    radius: 0.3,
    height: 0.3,
    workspace: Workspace::Ground,
};

/// Robots that see each other, and hear each other unless the network is cut. Places: `west` around (-1, 0) and `east`
/// around (1, 0), with a radius of 0.5 m.
struct Yard {
    robots: Vec<Unit>,
    now: Time,
    is_cut: bool,
}

struct Unit {
    mutex: Mutex,
    at: Point,
    timers: BTreeMap<TimerKey, Time>,
    random: Random,
}

fn area(x: f64) -> Area {
    Area::Circle {
        center: Point::planar(x, 0.0),
        radius: 0.5,
    }
}

impl Yard {
    /// Robots that have moved, stand at these places and name no participants but themselves.
    fn new(places: &[[f64; 2]]) -> Yard {
        let areas = || {
            let areas = [("west", area(-1.0)), ("east", area(1.0))];
            areas.map(|(name, area)| (name.into(), area)).into()
        };
        let unit = |(id, &[x, y]): (u32, &[f64; 2])| Unit {
            mutex: Mutex::new("yard", Some([RobotId(id)].into()), Options::default())
                .with_places(areas(), PlaceOptions::default()),
            at: Point::planar(x, y + 0.3),
            timers: BTreeMap::new(),
            random: Random::keyed(1, &[u64::from(id)]),
        };
        let mut yard = Yard {
            robots: (0..).zip(places).map(unit).collect(),
            now: Time::ZERO,
            is_cut: false,
        };
        yard.run(STEP * 2);
        for (unit, &[x, y]) in yard.robots.iter_mut().zip(places) {
            unit.at = Point::planar(x, y);
        }
        yard.run(STEP * 2);
        yard
    }

    fn act(&mut self, index: usize, act: impl FnOnce(&mut Mutex, &mut Robot<'_>)) {
        let fleet: Vec<RobotId> = (0..self.robots.len() as u32).map(RobotId).collect();
        let others = self.robots.iter().zip(&fleet);
        let others = others.filter(|(_, id)| id.index() != index);
        let detections: Vec<Detection> = others
            .map(|(unit, &id)| Detection {
                what: Detected::Robot(id),
                position: unit.at,
            })
            .collect();
        let obstacles: Obstacles = [].into();
        let unit = &mut self.robots[index];
        let view = View {
            id: fleet[index],
            now: self.now,
            estimate: Estimate {
                pose: Pose::level(unit.at, 0.0),
                ..Estimate::default()
            },
            body: BODY,
            sensors: Sensors {
                detections: &detections,
                ..Sensors::default()
            },
            fleet: &fleet,
            way_points: &[],
            obstacles: &obstacles,
        };
        let mut effects = Effects::default();
        act(
            &mut unit.mutex,
            &mut Robot::new(&view, &mut effects, &mut unit.random),
        );
        for effect in effects.list {
            match effect {
                Effect::Transmit {
                    destination,
                    port,
                    payload,
                } if !self.is_cut => {
                    let from = fleet[index];
                    let message = Message {
                        from,
                        port,
                        payload,
                    };
                    for &to in &fleet {
                        let hears = match destination {
                            Destination::All => to != from,
                            Destination::Robot(robot) => to == robot,
                        };
                        if hears {
                            self.input(to.index(), Input::Message(message.clone()));
                        }
                    }
                }
                Effect::SetTimer { key, after } => {
                    self.robots[index].timers.insert(key, self.now + after);
                }
                Effect::CancelTimer(key) => {
                    self.robots[index].timers.remove(&key);
                }
                _ => {}
            }
        }
    }

    fn input(&mut self, index: usize, input: Input) {
        self.act(index, |mutex, robot| mutex.handle(robot, &input));
    }

    fn run(&mut self, span: Duration) {
        let end = self.now + span;
        while self.now < end {
            self.now += STEP;
            for index in 0..self.robots.len() {
                let timers = &mut self.robots[index].timers;
                let due: Vec<TimerKey> = timers
                    .iter()
                    .filter(|(_, at)| **at <= self.now)
                    .map(|(key, _)| *key)
                    .collect();
                for key in due {
                    self.robots[index].timers.remove(&key);
                    self.input(index, Input::Timer(key));
                }
                self.input(index, Input::Activate);
            }
        }
    }

    fn acquire(&mut self, index: usize, names: &[&str]) {
        let names = set(names);
        self.act(index, |mutex, robot| {
            mutex
                .acquire(robot, names)
                .expect("places are always asked for");
        });
    }

    fn holds(&self, index: usize, name: &str) -> bool {
        self.robots[index].mutex.has(name)
    }

    fn cut(&mut self) {
        self.is_cut = true;
        for index in 0..self.robots.len() {
            for other in 0..self.robots.len() as u32 {
                if other as usize != index {
                    self.input(index, Input::Suspected(RobotId(other)));
                }
            }
        }
    }
}

/// Before the two places, out of both.
const SOUTH: [f64; 2] = [0.0, -1.5];
const NORTH: [f64; 2] = [0.0, 1.5];

#[test]
fn seen_robots_are_asked_although_they_do_not_participate() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.acquire(0, &["west"]);
    yard.acquire(1, &["west", "east"]);
    yard.run(SECOND);
    assert!(yard.holds(0, "west"));
    assert!(yard.robots[1].mutex.is_waiting());
    yard.act(0, |mutex, robot| mutex.release(robot, &set(&["west"])));
    yard.run(SECOND);
    assert!(yard.holds(1, "west") && yard.holds(1, "east"));
}

#[test]
fn robots_far_away_are_not_asked() {
    let mut yard = Yard::new(&[SOUTH, [0.0, 9.0]]);
    yard.acquire(1, &["west"]);
    yard.run(SECOND);
    yard.acquire(0, &["west"]);
    yard.run(SECOND);
    assert!(
        yard.holds(0, "west") && yard.holds(1, "west"),
        "nobody asked"
    );
}

#[test]
fn another_request_gives_back_what_is_held() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.acquire(0, &["west"]);
    yard.run(SECOND);
    yard.acquire(0, &["west", "east"]);
    yard.run(SECOND);
    assert!(yard.holds(0, "west") && yard.holds(0, "east"));
    yard.acquire(0, &["east"]);
    yard.run(SECOND);
    assert_eq!(*yard.robots[0].mutex.held(), set(&["east"]));
}

#[test]
fn a_place_in_which_a_robot_stands_is_left_to_others() {
    let mut yard = Yard::new(&[SOUTH, NORTH, [-1.0, 0.0]]);
    yard.acquire(0, &["west", "east"]);
    yard.run(SECOND * 2);
    assert!(yard.robots[0].mutex.is_waiting());
    yard.acquire(1, &["east"]);
    yard.run(SECOND);
    assert!(yard.holds(1, "east"), "the earlier request is not made");
    yard.act(1, |mutex, robot| mutex.release_all(robot));
    yard.robots[2].at = Point::planar(-3.0, 0.0);
    yard.run(SECOND);
    assert!(yard.holds(0, "west") && yard.holds(0, "east"));
}

#[test]
fn a_place_that_another_robot_occupies_is_given_back_before_it_is_entered() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.acquire(0, &["west"]);
    yard.run(SECOND);
    yard.robots[1].at = Point::planar(-1.0, 0.0);
    yard.run(STEP);
    assert!(!yard.holds(0, "west"), "it is occupied");
    yard.run(SECOND * 2);
    assert!(yard.robots[0].mutex.held().is_empty(), "it was given back");
    yard.robots[1].at = Point::planar(0.0, 1.5);
    yard.run(SECOND);
    assert!(yard.holds(0, "west"));
}

#[test]
fn places_that_a_robot_has_entered_stay_its_own() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.acquire(0, &["west", "east"]);
    yard.run(SECOND);
    yard.robots[0].at = Point::planar(-1.0, 0.0);
    yard.run(STEP);
    yard.robots[1].at = Point::planar(1.0, 0.0);
    yard.run(SECOND * 100);
    assert_eq!(*yard.robots[0].mutex.held(), set(&["east", "west"]));
    assert!(yard.holds(0, "west") && !yard.holds(0, "east"));
}

/// Each of two that do not hear each other believes that the other has failed.
#[test]
fn robots_that_do_not_hear_each_other_take_turns() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.cut();
    yard.acquire(0, &["west"]);
    yard.acquire(1, &["west"]);
    let mut turns: Vec<(u64, usize)> = Vec::new();
    let start = yard.now;
    for _ in 0..1900 {
        yard.run(STEP);
        let holders: Vec<usize> = (0..2).filter(|&robot| yard.holds(robot, "west")).collect();
        assert!(holders.len() < 2, "both hold it at {:?}", yard.now);
        if let [holder] = holders[..]
            && turns.last().is_none_or(|last| last.1 != holder)
        {
            turns.push((yard.now.since(start).0 / SECOND.0, holder));
        }
    }
    assert_eq!(
        turns,
        [(29, 0), (59, 1), (89, 0), (119, 1), (149, 0), (179, 1)]
    );
}

#[test]
fn a_silent_robot_that_came_earlier_is_gone_round_at_once() {
    let mut yard = Yard::new(&[SOUTH, NORTH]);
    yard.run(SECOND * 40);
    yard.robots[0].at = Point::planar(0.3, -1.5);
    yard.cut();
    yard.acquire(0, &["west"]);
    yard.run(SECOND);
    assert!(yard.holds(0, "west"));
}

#[test]
fn a_request_lasts_through_a_corruption_of_the_state() {
    for seed in 0..100 {
        let mut yard = Yard::new(&[SOUTH, NORTH]);
        yard.acquire(0, &["west"]);
        yard.run(SECOND);
        let mutex = &mut yard.robots[0].mutex;
        mutex.corrupt(&mut Random::keyed(seed, &[]), &set(&["east", "west"]));
        // The program starts again.
        yard.act(0, |mutex, robot| mutex.release_all(robot));
        assert!(yard.robots[0].mutex.held().is_empty(), "{seed}");
        yard.run(STEP * 3);
        yard.acquire(0, &["east"]);
        yard.run(SECOND);
        assert!(yard.holds(0, "east"), "{seed}");
    }
}
