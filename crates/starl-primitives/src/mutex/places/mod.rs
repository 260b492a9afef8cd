//! Resources that are places: a robot holds one only if it sees no other robot there.
//!
//! Permissions alone do not keep robots apart where the network is in parts, or where a robot has crashed, or has
//! restarted and forgotten what it held. Such robots stand in a place or before it, and others see them. So with
//! places:
//! - a robot asks the participants and all robots that it sees near the places; the file `turns.rs` is about those that
//!   are silent;
//! - a request for a place in which a robot stands is withdrawn and made again when it has left, so that others can have
//!   the places meanwhile;
//! - a place that is granted does not count as held while another robot is seen there;
//! - the places that a robot has entered stay its own.
//!
//! Assumptions: the detector shows every robot that may ask at the same time, other bodies are no larger than the robot's
//! own, and a robot that does not hold the places stays out of them.

mod turns;

use super::{Mutex, Resources};
use crate::sight::{Sight, Sighting};
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use starl_core::{Area, Duration, Random, Robot, RobotId};

/// Robots that have stood for this time are in the way.
const STANDING: Duration = Duration::from_seconds(1);
/// A robot whose body is nearer to a place than this may not be able to stop before it, metres.
const CLEARANCE: f64 = 0.15;

/// Settings of a mutex on places. They are to be the same on all robots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceOptions {
    /// Robots that are seen no farther than this from a place may ask for it, metres. At least how far from the places
    /// robots ask, and what they drive in the time of a message. Default 2.2.
    pub near: f64,
    /// A robot that has stood near the places for this time without a word may have failed, and others go without its
    /// permission. Longer than partitions of the network usually last. Default 30 s.
    pub patience: Duration,
}

impl Default for PlaceOptions {
    fn default() -> PlaceOptions {
        PlaceOptions {
            near: 2.2,
            patience: Duration::from_seconds(30),
        }
    }
}

/// The state of a mutex on places.
#[derive(Clone, Debug)]
pub(super) struct Places {
    areas: BTreeMap<Box<str>, Area>,
    options: PlaceOptions,
    sight: Sight,
    /// The robot itself; none before its first activation.
    own: Option<Sighting>,
    /// The places in which another robot is seen.
    occupied: Resources,
    /// The resources that the program asks for, and has not given back.
    wish: Resources,
    /// Those that take part according to the program; none for the whole fleet.
    pub members: Option<BTreeSet<RobotId>>,
    asked: Option<Asked>,
    /// Whether the program may know that it holds the requested places.
    is_granted: bool,
}

/// The robots that were considered when permission was asked for.
#[derive(Clone, Debug)]
struct Asked {
    asked: BTreeSet<RobotId>,
    /// Those that were seen near the places and were not asked.
    left_out: BTreeSet<RobotId>,
}

impl Places {
    pub fn new(areas: BTreeMap<Box<str>, Area>, options: PlaceOptions) -> Places {
        Places {
            areas,
            options,
            sight: Sight::default(),
            own: None,
            occupied: Resources::new(),
            wish: Resources::new(),
            members: None,
            asked: None,
            is_granted: false,
        }
    }

    /// Whether no other robot is seen in the place with this name.
    pub fn is_free(&self, resource: &str) -> bool {
        !self.occupied.contains(resource)
    }

    /// Whether the program asks for something.
    pub fn has_wish(&self) -> bool {
        !self.wish.is_empty()
    }

    /// The resources that the program asks for, and has not given back.
    pub fn wish(&self) -> &Resources {
        &self.wish
    }

    /// The program asks for these, and for nothing else any more.
    pub fn set_wish(&mut self, resources: Resources) {
        if self.wish != resources {
            self.wish = resources;
            self.asked = None;
        }
    }

    /// The program gives these back.
    pub fn give_back(&mut self, resources: &Resources) {
        self.wish.retain(|resource| !resources.contains(resource));
    }

    /// Reads the detector.
    pub fn look(&mut self, robot: &Robot<'_>) {
        let (position, now) = (robot.position(), robot.now());
        self.own = Some(match self.own {
            Some(own) => own.again(position, now),
            None => Sighting::new(position, now),
        });
        self.sight.look(robot);
        let radius = robot.body().radius;
        let areas = self.areas.iter();
        let occupied = areas.filter(|(_, area)| {
            let mut others = self.sight.iter();
            others.any(|(_, other)| area.distance(other.at) < radius)
        });
        self.occupied = occupied.map(|(name, _)| name.clone()).collect();
    }

    /// The areas of the places that the program asks for.
    fn wished(&self) -> impl Iterator<Item = &Area> {
        self.wish.iter().filter_map(|name| self.areas.get(name))
    }

    /// Whether another robot stands in one of these places.
    fn is_obstructed(&self, robot: &Robot<'_>) -> bool {
        let (radius, now) = (robot.body().radius, robot.now());
        let mut standing = self.sight.iter().map(|(_, other)| other);
        standing.any(|other| {
            other.stands(STANDING, now)
                && self.wished().any(|area| area.distance(other.at) < radius)
        })
    }

    /// Whether the robot is in one of the places that it asks for, or too near to stop.
    fn is_inside(&self, robot: &Robot<'_>) -> bool {
        let (position, reach) = (robot.position(), robot.body().radius + CLEARANCE);
        self.wished().any(|area| area.distance(position) < reach)
    }

    pub fn corrupt(&mut self, random: &mut Random) {
        let names = self.areas.keys();
        self.wish = names.filter(|_| random.chance(0.5)).cloned().collect();
        self.sight.clear();
        self.own = None;
        self.is_granted = random.chance(0.5);
        if random.chance(0.5) {
            self.asked = None;
        }
    }
}

impl Mutex {
    /// Asks for the places that the program wishes for, or gives way to others, at each activation.
    pub(super) fn tend_places(&mut self, robot: &mut Robot<'_>) {
        let Some(mut places) = self.places.take() else {
            return;
        };
        self.tend(&mut places, robot);
        self.places = Some(places);
    }

    fn tend(&mut self, places: &mut Places, robot: &mut Robot<'_>) {
        let held = &self.common.held;
        let holds_others = !held.is_empty() && *held != places.wish;
        if holds_others || places.wish.is_empty() && self.is_waiting() {
            // Another wish, or a fault: everything needed is requested at once.
            let known = self.known_resources();
            self.release_by_algorithm(robot, &known);
        }
        if places.wish.is_empty() {
            (places.asked, places.is_granted) = (None, false);
            return;
        }
        let holds = self.common.held.is_superset(&places.wish);
        let is_asking = self.wanted() == Some(&places.wish);
        if holds && places.is_granted && places.is_inside(robot) {
            return;
        }
        if !holds && !is_asking {
            places.asked = None;
        }
        match &places.asked {
            None => {
                places.is_granted = false;
                if !places.is_obstructed(robot) {
                    self.ask_for(places, robot);
                }
            }
            Some(_) if places.is_obstructed(robot) || !self.is_agreed(places, robot) => {
                let wish = places.wish.clone();
                self.release_by_algorithm(robot, &wish);
                (places.asked, places.is_granted) = (None, false);
            }
            Some(asked) if !holds => {
                let to_ask = self.to_ask(places, robot);
                if !asked.asked.is_subset(&to_ask) {
                    self.ask_for(places, robot);
                }
            }
            Some(_) => {}
        }
        let is_held = self.common.held.is_superset(&places.wish);
        let mut wish = places.wish.iter();
        let is_free = wish.all(|name| places.is_free(name));
        places.is_granted |= is_held && is_free;
    }

    /// Asks all whose permission it needs.
    fn ask_for(&mut self, places: &mut Places, robot: &mut Robot<'_>) {
        let asked = self.to_ask(places, robot);
        let near = places.near(robot).map(|(other, _)| other);
        let left_out = near.filter(|other| !asked.contains(other)).collect();
        self.common.participants = Some(asked.clone());
        places.asked = Some(Asked { asked, left_out });
        // It holds nothing that it does not ask for.
        let _ = self.request(robot, places.wish.clone());
    }
}
