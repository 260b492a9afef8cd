//! The spatial index over robots, rebuilt at every step: a planar grid whose cells hold about one
//! robot each, in compressed rows.
//!
//! Invariant: entries are ordered by cell and, within a cell, by robot, whatever the number of
//! threads, so every query visits robots in one order.

use crate::Neighbour;
use alloc::vec::Vec;
use starl_core::{Point, RobotId, math};

/// A robot as the index holds it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Where it is, metres.
    pub x: f64,
    /// Where it is, metres.
    pub y: f64,
    /// Its place among the bodies.
    pub robot: u32,
    /// Radius of its body, metres.
    pub radius: f32,
}

impl Entry {
    /// The robot, where the bodies are in the order of the fleet.
    pub fn robot(&self) -> RobotId {
        RobotId(self.robot)
    }

    /// Squared planar distance.
    #[inline]
    pub fn distance_squared(&self, p: Point) -> f64 {
        let (dx, dy) = (self.x - p.x, self.y - p.y);
        dx * dx + dy * dy
    }
}

/// The index.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    low: Point,
    per_cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    entries: Vec<Entry>,
    cells: Vec<u32>,
    greatest_radius: f64,
}

impl Grid {
    /// Indexes robots at their current positions, except those that are `gone` (none is if that is
    /// empty).
    pub fn rebuild(&mut self, bodies: &[Neighbour], gone: &[bool]) {
        let is_gone = |robot: usize| gone.get(robot).copied().unwrap_or(false);
        self.lay_out(bodies);
        let cells = self.columns * self.rows;
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        self.cells.clear();
        for (robot, body) in bodies.iter().enumerate() {
            let cell = self.cell(body.position);
            self.cells.push(cell as u32);
            self.starts[cell + 1] += u32::from(!is_gone(robot));
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        let blank = Entry {
            x: 0.0,
            y: 0.0,
            robot: 0,
            radius: 0.0,
        };
        let present = self.starts[cells];
        self.entries.resize(present as usize, blank);
        // Filled from the back, so that the counts end up as each cell's start.
        for (robot, body) in bodies.iter().enumerate().rev() {
            if is_gone(robot) {
                continue;
            }
            let end = &mut self.starts[self.cells[robot] as usize + 1];
            *end -= 1;
            self.entries[*end as usize] = Entry {
                x: body.position.x,
                y: body.position.y,
                robot: robot as u32,
                radius: body.radius as f32,
            };
        }
        self.starts.remove(0);
        self.starts.push(present);
    }

    fn lay_out(&mut self, bodies: &[Neighbour]) {
        let mut low = Point::planar(f64::INFINITY, f64::INFINITY);
        let mut high = Point::planar(f64::NEG_INFINITY, f64::NEG_INFINITY);
        self.greatest_radius = 0.0;
        for body in bodies {
            let p = body.position;
            low = Point::planar(low.x.min(p.x), low.y.min(p.y));
            high = Point::planar(high.x.max(p.x), high.y.max(p.y));
            self.greatest_radius = self.greatest_radius.max(body.radius);
        }
        let (width, depth) = ((high.x - low.x).max(0.0), (high.y - low.y).max(0.0));
        let count = bodies.len().max(1) as f64;
        // About one robot a cell, and never more than some two cells a robot, however the robots
        // are strewn: a thin row of them makes a thin row of cells.
        let side = math::sqrt(width * depth / count)
            .max((width + depth) / count)
            .max(2.0 * self.greatest_radius)
            .max(1e-3);
        self.low = if bodies.is_empty() { Point::ZERO } else { low };
        self.per_cell = 1.0 / side;
        self.columns = (width / side) as usize + 1;
        self.rows = (depth / side) as usize + 1;
    }

    #[inline]
    fn column(&self, x: f64) -> usize {
        // A float-to-integer cast saturates.
        (((x - self.low.x) * self.per_cell) as usize).min(self.columns - 1)
    }

    #[inline]
    fn row(&self, y: f64) -> usize {
        (((y - self.low.y) * self.per_cell) as usize).min(self.rows - 1)
    }

    #[inline]
    fn cell(&self, p: Point) -> usize {
        self.row(p.y) * self.columns + self.column(p.x)
    }

    /// The robots, those of a cell beside each other.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The radius of the largest body, metres.
    #[inline]
    pub fn greatest_radius(&self) -> f64 {
        self.greatest_radius
    }

    /// Visits at least the robots whose centres are within `reach` of `center` in the plane; some
    /// farther ones may be among them.
    #[inline]
    pub fn for_each_near(&self, center: Point, reach: f64, mut visit: impl FnMut(&Entry)) {
        if self.entries.is_empty() {
            return;
        }
        let (first, last) = (self.column(center.x - reach), self.column(center.x + reach));
        for row in self.row(center.y - reach)..=self.row(center.y + reach) {
            let cells = row * self.columns;
            let from = self.starts[cells + first] as usize;
            let to = self.starts[cells + last + 1] as usize;
            for entry in &self.entries[from..to] {
                visit(entry);
            }
        }
    }

    /// Visits the robots whose centres are within `reach` of `center` in the plane.
    #[inline]
    pub fn for_each_within(&self, center: Point, reach: f64, mut visit: impl FnMut(&Entry)) {
        let reach_squared = reach * reach;
        self.for_each_near(center, reach, |entry| {
            if entry.distance_squared(center) <= reach_squared {
                visit(entry);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use starl_core::Random;

    #[test]
    fn queries_agree_with_looking_at_every_robot() {
        let mut random = Random::keyed(7, &[]);
        for trial in 0..50 {
            let (width, depth) = (random.between(0.0, 50.0), random.between(0.0, 5.0));
            let bodies: Vec<Neighbour> = (0..trial * 5)
                .map(|_| Neighbour {
                    position: Point::planar(
                        random.between(-3.0, width),
                        random.between(9.0, 9.0 + depth),
                    ),
                    velocity: Point::ZERO,
                    radius: 0.1,
                    height: 0.1,
                })
                .collect();
            let mut grid = Grid::default();
            grid.rebuild(&bodies, &[]);
            for _ in 0..20 {
                let center = Point::planar(random.between(-9.0, 60.0), random.between(0.0, 20.0));
                let reach = random.between(0.0, 9.0);
                let mut found = Vec::new();
                grid.for_each_within(center, reach, |entry| found.push(entry.robot as usize));
                found.sort_unstable();
                let expected: Vec<usize> = (0..bodies.len())
                    .filter(|&i| bodies[i].position.planar_distance(center) <= reach)
                    .collect();
                assert_eq!(found, expected);
            }
        }
    }
}
