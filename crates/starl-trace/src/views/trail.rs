//! A robot's path in bounded memory.

use starl_core::Point;

/// No more points than this are kept.
const MOST: usize = 512;
/// At first, points nearer to each other than this are left out, metres.
const SPACING: f64 = 0.02;

/// Points along a path, at least a spacing apart. When there are too many, every second one is removed and the spacing
/// doubles: a long path is shown from its beginning too, only coarser.
#[derive(Clone, Debug)]
pub struct Trail {
    kept: Vec<Point>,
    latest: Option<Point>,
    spacing: f64,
}

impl Default for Trail {
    fn default() -> Trail {
        Trail {
            kept: Vec::new(),
            latest: None,
            spacing: SPACING,
        }
    }
}

impl Trail {
    /// Extends the trail to a point.
    pub fn extend(&mut self, point: Point) {
        self.latest = Some(point);
        let near = |last: &Point| (point - *last).length_squared() < self.spacing * self.spacing;
        if self.kept.last().is_some_and(near) {
            return;
        }
        self.kept.push(point);
        if self.kept.len() > MOST {
            let mut index = 0;
            self.kept.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing *= 2.0;
        }
    }

    /// The points, the latest always among them.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        let latest = self
            .latest
            .filter(|latest| self.kept.last() != Some(latest));
        self.kept.iter().copied().chain(latest)
    }
}
