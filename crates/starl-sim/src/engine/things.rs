//! The world's things: where they are, and which robot holds them.

use crate::scenario::Thing;
use starl_core::event::Name;
use starl_core::{Point, RobotId, Time};

/// A robot takes hold of what is this near to its body's edge, metres.
const REACH: f64 = 0.15;

/// The requests of robots to their grippers in one step.
#[derive(Clone, Copy, Debug)]
pub struct Grip {
    pub at: Time,
    pub robot: RobotId,
    /// The thing to take; none to put down the held one.
    pub thing: Option<u32>,
}

/// All things, by index.
#[derive(Clone, Debug, Default)]
pub struct Things {
    /// Their names; empty for a removed one.
    pub names: Vec<Name>,
    list: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    position: Point,
    holder: Option<RobotId>,
}

impl Things {
    /// Things where a scenario puts them.
    pub fn new(things: &[Thing]) -> Things {
        let place = |thing: &Thing| Place {
            position: thing.position,
            holder: None,
        };
        Things {
            names: things
                .iter()
                .map(|thing| thing.name.clone().into())
                .collect(),
            list: things.iter().map(place).collect(),
        }
    }

    /// The things that lie about, with their indices.
    pub fn lying(&self) -> impl Iterator<Item = (u32, Point)> {
        let all = (0..).zip(self.list.iter().zip(&self.names));
        all.filter(|(_, (place, name))| place.holder.is_none() && !name.is_empty())
            .map(|(index, (place, _))| (index, place.position))
    }

    /// Where a thing is; of one that is held where it was taken.
    pub fn position(&self, thing: u32) -> Option<Point> {
        self.list.get(thing as usize).map(|place| place.position)
    }

    /// The robot that holds a thing.
    pub fn holder(&self, thing: u32) -> Option<RobotId> {
        self.list.get(thing as usize)?.holder
    }

    fn find(&self, name: &str) -> Option<u32> {
        let index = self.names.iter().position(|known| known == name)?;
        Some(index as u32)
    }

    /// Puts a thing somewhere, out of the hands of its holder; returns that robot.
    pub fn set(&mut self, name: &str, position: Point) -> Option<RobotId> {
        match self.find(name) {
            Some(thing) => {
                let place = &mut self.list[thing as usize];
                place.position = position;
                place.holder.take()
            }
            None => {
                self.names.push(name.to_string().into());
                self.list.push(Place {
                    position,
                    holder: None,
                });
                None
            }
        }
    }

    /// Removes a thing from the world; returns the robot that held it. An error if there is no such thing.
    pub fn remove(&mut self, name: &str) -> Result<Option<RobotId>, ()> {
        let thing = self.find(name).ok_or(())?;
        self.names[thing as usize] = Name::Borrowed("");
        Ok(self.list[thing as usize].holder.take())
    }

    /// A robot takes a thing that lies within reach of its body; whether it does.
    pub fn take(&mut self, thing: u32, robot: RobotId, body: Point, radius: f64) -> bool {
        let (Some(place), Some(name)) = (
            self.list.get_mut(thing as usize),
            self.names.get(thing as usize),
        ) else {
            return false;
        };
        let is_near = place.position.planar_distance(body) <= radius + REACH;
        let takes = is_near && place.holder.is_none() && !name.is_empty();
        if takes {
            place.holder = Some(robot);
        }
        takes
    }

    /// A robot puts a thing down where it is.
    pub fn put_down(&mut self, thing: u32, position: Point) {
        if let Some(place) = self.list.get_mut(thing as usize) {
            place.holder = None;
            place.position = position;
        }
    }
}
