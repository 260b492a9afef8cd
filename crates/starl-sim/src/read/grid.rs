//! Bodies that already stand somewhere, in square cells, to find those near a place quickly.
//!
//! Cells are at least as wide as the farthest two bodies can touch, so only the nine cells around a
//! place matter. Places outside the grid count as in its outermost cells.

use starl_core::Point;

/// A body's place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub position: Point,
    pub radius: f64,
    pub height: f64,
}

/// The bodies, by cell.
pub(super) struct Grid {
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// The last body of each cell, or [`NONE`].
    last: Vec<u32>,
    /// The body before each in its cell, or [`NONE`].
    before: Vec<u32>,
    bodies: Vec<Body>,
}

const NONE: u32 = u32::MAX;

impl Grid {
    /// A grid over a rectangle for `count` bodies, of which no two are looked for farther apart than
    /// `reach`, metres.
    pub fn new(low: Point, high: Point, reach: f64, count: usize) -> Grid {
        let (width, height) = (high.x - low.x, high.y - low.y);
        // About one body a cell in a wide area, so that cells do not outnumber bodies by much.
        let cell = reach
            .max((width * height / (count + 1) as f64).sqrt())
            .max(1e-3);
        let cells = |length: f64| (length / cell).floor().clamp(1.0, 10_000.0) as usize;
        let (columns, rows) = (cells(width), cells(height));
        let last = vec![NONE; columns * rows];
        let (before, bodies) = (Vec::with_capacity(count), Vec::with_capacity(count));
        // The last cell of a row takes what is left over.
        let cell = cell.max(width / 10_000.0).max(height / 10_000.0);
        Grid {
            low,
            cell,
            columns,
            rows,
            last,
            before,
            bodies,
        }
    }

    /// Adds a body.
    pub fn insert(&mut self, body: Body) {
        let (column, row) = self.cell_of(body.position);
        let cell = row * self.columns + column;
        self.before.push(self.last[cell]);
        self.last[cell] = self.bodies.len() as u32;
        self.bodies.push(body);
    }

    /// The first body taken in that `test` holds for, of those that may be within reach.
    pub fn find(&self, position: Point, test: impl Fn(&Body) -> bool) -> Option<usize> {
        let (column, row) = self.cell_of(position);
        let mut found = None;
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                let mut at = self.last[row * self.columns + column];
                while at != NONE {
                    let index = at as usize;
                    if found.is_none_or(|found| index < found) && test(&self.bodies[index]) {
                        found = Some(index);
                    }
                    at = self.before[index];
                }
            }
        }
        found
    }

    fn cell_of(&self, position: Point) -> (usize, usize) {
        // A negative number becomes zero in the conversion.
        let index = |offset: f64, most: usize| ((offset / self.cell) as usize).min(most - 1);
        let offset = position - self.low;
        (index(offset.x, self.columns), index(offset.y, self.rows))
    }
}
