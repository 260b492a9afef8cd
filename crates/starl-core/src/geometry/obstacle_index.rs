//! An index of obstacles by position: a static uniform grid over the floor plane.
//!
//! The grid covers the bulk of the obstacles' centres; cells at its rim reach outwards without end, so
//! every place belongs to a cell whatever its coordinates. A cell is as wide as the spacing of
//! obstacles or as their median size, whichever is more, which makes at most three cells an obstacle.
//! One that would fill more than [`MOST_CELLS`] of them (a floor, a long wall) is kept in a list that
//! every query looks through. Memory is therefore bounded by the number of obstacles alone, and no
//! query looks at an obstacle's bounds more than once a cell or allocates.
//!
//! An obstacle lies in several cells but is reported in the first that both it and the query cover, so
//! no record of those already seen is needed. The order of reports is fixed but not ascending.

use super::grid::{Cells, Grid};
use super::segment::greater;
use super::{Bounds, Obstacle, Point};
use alloc::vec::Vec;
use core::ops::{ControlFlow, RangeInclusive};

/// The most cells one obstacle may be listed in, at four bytes each.
const MOST_CELLS: u64 = 64;

/// Obstacles arranged for quick questions about a place; unchanging.
#[derive(Clone, Debug)]
pub struct ObstacleIndex {
    obstacles: Vec<Obstacle>,
    bounds: Vec<Bounds>,
    /// The cells each obstacle covers.
    covers: Vec<Cells>,
    grid: Grid,
    /// Where each cell's part of `members` starts, row by row, and the end of the last.
    starts: Vec<u32>,
    /// Obstacles by cell, ascending in each.
    members: Vec<u32>,
    /// Obstacles in no cell, ascending.
    wide: Vec<u32>,
}

impl ObstacleIndex {
    /// An index of these obstacles; its answers are their places in the list.
    pub fn new(obstacles: &[Obstacle]) -> ObstacleIndex {
        let bounds: Vec<Bounds> = obstacles.iter().map(Obstacle::bounds).collect();
        let grid = Grid::over(&bounds);
        let covers: Vec<Cells> = bounds.iter().map(|bounds| grid.cells(bounds)).collect();
        let mut starts = alloc::vec![0u32; grid.columns as usize * grid.rows as usize + 1];
        let mut wide = Vec::new();
        for (index, cells) in covers.iter().enumerate() {
            if cells.count() > MOST_CELLS {
                wide.push(index as u32);
                continue;
            }
            cells.each(&grid, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut members = alloc::vec![0u32; starts[starts.len() - 1] as usize];
        for (index, cells) in covers
            .iter()
            .enumerate()
            .filter(|(_, c)| c.count() <= MOST_CELLS)
        {
            cells.each(&grid, |cell| {
                members[next[cell] as usize] = index as u32;
                next[cell] += 1;
            });
        }
        ObstacleIndex {
            obstacles: obstacles.to_vec(),
            bounds,
            covers,
            grid,
            starts,
            members,
            wide,
        }
    }

    /// The obstacles, in the order given.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// The smallest box around each obstacle, in the same order.
    pub fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    /// Calls `visit` once for every obstacle whose bounds overlap these, until it breaks.
    pub fn for_each_near<B>(
        &self,
        bounds: &Bounds,
        mut visit: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let near = |index: u32| self.bounds[index as usize].overlaps(bounds);
        let query = self.grid.cells(bounds);
        if query.count() >= self.bounds.len() as u64 {
            return (0..self.bounds.len() as u32)
                .filter(|&index| near(index))
                .try_for_each(visit);
        }
        self.wide
            .iter()
            .copied()
            .filter(|&index| near(index))
            .try_for_each(&mut visit)?;
        for row in query.bottom..=query.top {
            for column in query.left..=query.right {
                for &index in self.members(row, column) {
                    let covers = &self.covers[index as usize];
                    let first = column == query.left.max(covers.left)
                        && row == query.bottom.max(covers.bottom);
                    if first && near(index) {
                        visit(index)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Calls `visit` once for every obstacle whose bounds, moved outwards by `margin` metres, may meet the segment from
    /// `a` to `b`, until it breaks: all of those, and few others. For a long slanting segment it visits only the cells
    /// along it, not all cells of its bounds.
    pub fn for_each_near_segment<B>(
        &self,
        a: Point,
        b: Point,
        margin: f64,
        mut visit: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let bounds = Bounds::of_segment(a, b).inflated(margin);
        let query = self.grid.cells(&bounds);
        if query.left == query.right
            || query.bottom == query.top
            || query.count() >= self.bounds.len() as u64
        {
            return self.for_each_near(&bounds, visit);
        }
        let near = |index: u32| self.bounds[index as usize].overlaps(&bounds);
        self.wide
            .iter()
            .copied()
            .filter(|&index| near(index))
            .try_for_each(&mut visit)?;
        let mut below = None::<RangeInclusive<u32>>;
        for row in query.bottom..=query.top {
            let columns = self.grid.columns_along(a, b, margin, row, &query);
            for column in columns.clone() {
                for &index in self.members(row, column) {
                    let covers = &self.covers[index as usize];
                    // The rows in which segment and obstacle share a column follow one another.
                    let seen = covers.bottom < row
                        && below.as_ref().is_some_and(|below| {
                            *below.start() <= covers.right && *below.end() >= covers.left
                        });
                    if !seen && column == covers.left.max(*columns.start()) && near(index) {
                        visit(index)?;
                    }
                }
            }
            below = Some(columns);
        }
        ControlFlow::Continue(())
    }

    /// Whether `test` holds for an obstacle whose bounds overlap these.
    pub fn any_near(&self, bounds: &Bounds, mut test: impl FnMut(u32) -> bool) -> bool {
        self.for_each_near(bounds, |index| break_if(test(index)))
            .is_break()
    }

    /// The obstacles whose bounds overlap these, ascending; this one allocates.
    pub fn near(&self, bounds: &Bounds) -> Vec<u32> {
        let mut found = Vec::new();
        let _ = self.for_each_near(bounds, |index| {
            found.push(index);
            ControlFlow::<()>::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// Whether an obstacle blocks the segment; see [`Obstacle::blocks_segment`].
    pub fn blocks_segment(&self, a: Point, b: Point, clearance: f64) -> bool {
        self.for_each_near_segment(a, b, greater(clearance, 0.0), |index| {
            break_if(self.obstacles[index as usize].blocks_segment(a, b, clearance))
        })
        .is_break()
    }

    /// Whether an obstacle blocks the body; see [`Obstacle::blocks_body`].
    pub fn blocks_body(&self, a: Point, b: Point, radius: f64, body_height: f64) -> bool {
        let margin = greater(greater(radius, body_height), 0.0);
        self.for_each_near_segment(a, b, margin, |index| {
            break_if(self.obstacles[index as usize].blocks_body(a, b, radius, body_height))
        })
        .is_break()
    }

    /// The first obstacle a horizontal ray meets and the distance to it in metres; of several at the
    /// same distance the first in the list. See [`Obstacle::ray`].
    pub fn ray(&self, origin: Point, direction: Point, range: f64) -> Option<(u32, f64)> {
        let end = origin + direction.at_height(0.0) * range;
        let mut first = None::<(u32, f64)>;
        let _ = self.for_each_near_segment(origin, end, 0.0, |index| {
            let limit = first.map_or(range, |(_, distance)| distance);
            let hit = self.obstacles[index as usize].ray(origin, direction, limit);
            if let Some(distance) = hit
                && first.is_none_or(|(before, least)| distance < least || index < before)
            {
                first = Some((index, distance));
            }
            ControlFlow::<()>::Continue(())
        });
        first
    }

    fn members(&self, row: u32, column: u32) -> &[u32] {
        let cell = self.grid.cell(row, column);
        &self.members[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}

fn break_if(condition: bool) -> ControlFlow<()> {
    if condition {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}
