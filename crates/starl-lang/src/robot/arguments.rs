//! The arguments of a call, read one after the other.

use crate::machine::{Body, HostCall, List, Object};
use alloc::borrow::Cow;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::motion::Obstacles;
use starl_core::{Area, Duration, Point, Robot, RobotId};

/// The result of a host function: the fuel it costs beyond one, or the reason of the failure.
pub type Called = Result<u64, Cow<'static, str>>;

/// Arguments that have not been read yet. Missing arguments read as zero and empty.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'a> {
    scalars: &'a [u64],
    objects: &'a [Object],
}

impl<'a> Arguments<'a> {
    /// All arguments of a call.
    pub fn of(call: &'a HostCall<'_>) -> Arguments<'a> {
        Arguments {
            scalars: call.scalars,
            objects: call.objects,
        }
    }

    /// The arguments of a primitive's function after the first, which is the instance's number.
    pub fn after_instance(call: &'a HostCall<'_>) -> Arguments<'a> {
        let mut arguments = Arguments::of(call);
        arguments.int();
        arguments
    }

    /// The next scalars and objects, of these numbers.
    pub fn block(&mut self, scalars: usize, objects: usize) -> (&'a [u64], &'a [Object]) {
        let (block, rest) = self.scalars.split_at(scalars.min(self.scalars.len()));
        let (object_block, object_rest) = self.objects.split_at(objects.min(self.objects.len()));
        (self.scalars, self.objects) = (rest, object_rest);
        (block, object_block)
    }

    /// All unread arguments.
    pub fn rest(self) -> (&'a [u64], &'a [Object]) {
        (self.scalars, self.objects)
    }

    fn scalar(&mut self) -> u64 {
        let (block, _) = self.block(1, 0);
        block.first().copied().unwrap_or(0)
    }

    pub fn bool(&mut self) -> bool {
        self.scalar() != 0
    }

    pub fn int(&mut self) -> i64 {
        self.scalar() as i64
    }

    pub fn float(&mut self) -> f64 {
        f64::from_bits(self.scalar())
    }

    pub fn duration(&mut self) -> Duration {
        Duration(self.scalar())
    }

    pub fn robot(&mut self) -> RobotId {
        RobotId(self.scalar() as u32)
    }

    /// A Point, metres.
    pub fn point(&mut self) -> Point {
        Point::new(self.float(), self.float(), self.float())
    }

    /// A list of Points, metres.
    pub fn points(&mut self) -> Vec<Point> {
        let scalars = self.object().list().map_or(&[][..], List::scalars);
        let (points, _) = scalars.as_chunks::<3>();
        let points = points.iter().map(|point| {
            let [x, y, z] = point.map(f64::from_bits);
            Point::new(x, y, z)
        });
        points.collect()
    }

    /// The participants of a primitive, if they are given. A set of the whole fleet is none: the fleet at each moment,
    /// robots that join later too. Otherwise `peers` would be another set on each robot when one joins.
    pub fn participants(&mut self, robot: &Robot<'_>) -> Option<Option<BTreeSet<RobotId>>> {
        let given = self.optional(|arguments| {
            let scalars = arguments.object().list().map_or(&[][..], List::scalars);
            let robots = scalars.iter().map(|&robot| RobotId(robot as u32));
            robots.collect::<BTreeSet<RobotId>>()
        })?;
        Some((!given.iter().eq(robot.fleet())).then_some(given))
    }

    /// A text, collection, area or obstacles.
    pub fn object(&mut self) -> &'a Object {
        const EMPTY: &Object = &Object::EMPTY;
        let (_, block) = self.block(0, 1);
        block.first().unwrap_or(EMPTY)
    }

    pub fn text(&mut self) -> &'a str {
        self.object().text()
    }

    /// An area; a variable that was never assigned may have none.
    pub fn area(&mut self) -> Result<&'a Area, Cow<'static, str>> {
        self.object().area().ok_or("there is no area".into())
    }

    /// Obstacles; a variable that was never assigned has none.
    pub fn obstacles(&mut self) -> Obstacles {
        match self.object().body() {
            Some(Body::Obstacles(obstacles)) => obstacles.clone(),
            _ => [].into(),
        }
    }

    /// A Duration, or this one if none is given.
    pub fn duration_or(&mut self, default: Duration) -> Duration {
        self.optional(Arguments::duration).unwrap_or(default)
    }

    /// A variant of an enum whose variants stand for these values, or this value if none is given. `what` is the enum
    /// in an error.
    pub fn choice<T: Copy>(
        &mut self,
        what: &str,
        variants: &[(&str, T)],
        default: T,
    ) -> Result<T, Cow<'static, str>> {
        match self.optional(Arguments::int) {
            None => Ok(default),
            Some(number) => match variants.get(number as usize) {
                Some((_, value)) => Ok(*value),
                None => Err(alloc::format!("there is no such {what}").into()),
            },
        }
    }

    /// A value or none.
    pub fn optional<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> Option<T> {
        let present = self.bool();
        let value = read(self); // it takes its place even if there is none
        present.then_some(value)
    }
}
