//! A uniform grid over the floor plane whose rim reaches outwards without end.
//!
//! Invariant: a greater coordinate never has a smaller cell, so bodies that overlap share a cell, independent of
//! rounding.

use super::segment::{greater, lesser};
use super::{Bounds, Point};
use crate::math;
use alloc::vec::Vec;
use core::ops::RangeInclusive;

/// Where the cells are.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    origin: Point,
    /// Metres.
    side: f64,
    /// One over `side`; a product is much faster than a quotient.
    cells_per_metre: f64,
    pub(super) columns: u32,
    pub(super) rows: u32,
}

/// A rectangle of cells, ends included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) bottom: u32,
    pub(super) top: u32,
}

impl Cells {
    /// How many cells.
    pub(super) fn count(&self) -> u64 {
        u64::from(self.right - self.left + 1) * u64::from(self.top - self.bottom + 1)
    }

    /// Calls `visit` for the place of each cell in the grid, row by row.
    pub(super) fn each(&self, grid: &Grid, mut visit: impl FnMut(usize)) {
        for row in self.bottom..=self.top {
            for column in self.left..=self.right {
                visit(grid.cell(row, column));
            }
        }
    }
}

impl Grid {
    /// A grid for these obstacles, with at most three cells for each and one more.
    pub(super) fn over(bounds: &[Bounds]) -> Grid {
        let (left, width) = bulk(bounds.iter().map(|b| 0.5 * b.low.x + 0.5 * b.high.x));
        let (bottom, height) = bulk(bounds.iter().map(|b| 0.5 * b.low.y + 0.5 * b.high.y));
        let size = |b: &Bounds| greater(b.high.x - b.low.x, b.high.y - b.low.y);
        let mut sizes: Vec<f64> = bounds.iter().map(size).filter(|s| s.is_finite()).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);

        let count = greater(bounds.len() as f64, 1.0);
        let spacing = math::sqrt(width / count) * math::sqrt(height);
        let longest = greater(width, height) / count;
        // Far below this the rounding of coordinates would blur the limits of cells.
        let farthest = greater(left.abs() + width, bottom.abs() + height);
        let side = greater(greater(spacing, median), greater(longest, farthest * 1e-9));
        let along = |length: f64| {
            if side > 0.0 && side.is_finite() {
                lesser(math::ceil(length / side), count).max(1.0) as u32
            } else {
                1
            }
        };
        let (columns, rows) = (along(width), along(height));
        let side = if side > 0.0 { side } else { 1.0 };
        let origin = Point::planar(left, bottom);
        Grid {
            origin,
            side,
            cells_per_metre: 1.0 / side,
            columns,
            rows,
        }
    }

    /// The place of a cell in a list of all of them, row by row.
    pub(super) fn cell(&self, row: u32, column: u32) -> usize {
        row as usize * self.columns as usize + column as usize
    }

    #[inline]
    fn column(&self, x: f64) -> u32 {
        // The conversion rounds towards zero and saturates.
        (((x - self.origin.x) * self.cells_per_metre) as u32).min(self.columns - 1)
    }

    #[inline]
    fn row(&self, y: f64) -> u32 {
        (((y - self.origin.y) * self.cells_per_metre) as u32).min(self.rows - 1)
    }

    /// The cells these bounds cover.
    pub(super) fn cells(&self, bounds: &Bounds) -> Cells {
        let (left, bottom) = (self.column(bounds.low.x), self.row(bounds.low.y));
        // Bounds that are not numbers must still be a range.
        let right = self.column(bounds.high.x).max(left);
        let top = self.row(bounds.high.y).max(bottom);
        Cells {
            left,
            right,
            bottom,
            top,
        }
    }

    /// The columns in which the segment, `a` not above `b` in y, comes within `margin` of a row.
    pub(super) fn columns_along(
        &self,
        a: Point,
        b: Point,
        margin: f64,
        row: u32,
        query: &Cells,
    ) -> RangeInclusive<u32> {
        if a.y >= b.y {
            return query.left..=query.right;
        }
        // A little more than the row, so that rounding loses nothing.
        let largest = a.x.abs() + b.x.abs() + a.y.abs() + b.y.abs();
        let slack = margin + self.side / 16.0 + largest * 1e-14;
        let at = |row: u32| self.origin.y + f64::from(row) * self.side;
        let x = |y: f64| {
            let fraction = (y - a.y) / (b.y - a.y);
            a.x + (b.x - a.x) * fraction.clamp(0.0, 1.0)
        };
        let from = if row == query.bottom {
            a.x
        } else {
            x(at(row) - slack)
        };
        let to = if row == query.top {
            b.x
        } else {
            x(at(row + 1) + slack)
        };
        let left = self.column(lesser(from, to) - slack).max(query.left);
        let right = self.column(greater(from, to) + slack).min(query.right);
        // Numbers that are not usable give every column.
        if left <= right {
            left..=right
        } else {
            query.left..=query.right
        }
    }
}

/// Where the bulk of these numbers starts and how far it extends: all except the first and
/// last sixteenth, and an eighth more either way if there are any, so that outliers do not spread the grid.
fn bulk(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut numbers: Vec<f64> = numbers.filter(|number| number.is_finite()).collect();
    if numbers.is_empty() {
        return (0.0, 0.0);
    }
    numbers.sort_unstable_by(f64::total_cmp);
    let (least, most) = (numbers[0], numbers[numbers.len() - 1]);
    let (low, high) = (
        numbers[numbers.len() / 16],
        numbers[numbers.len() - 1 - numbers.len() / 16],
    );
    let reach = 0.125 * (high - low);
    let (start, end) = (greater(least, low - reach), lesser(most, high + reach));
    (start, end - start)
}
