//! Round outlines in the plane: everything that is within a radius of a convex polygon, a wall or a point.

use super::ray::Ray;
use starl_core::math;

/// A corner of an outline and the way to the next.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Where it is, metres.
    pub at: [f64; 2],
    /// Unit vector.
    pub along: [f64; 2],
    /// Metres.
    pub length: f64,
}

/// Where the line through the segment enters and leaves the outline; the first is greater if it does
/// not. The outline is the union of the polygon, a strip on either side of each edge and a disc about
/// each corner, and convex: it is entered where the first of these is and left where the last is.
pub fn clip_outline<const D: usize>(corners: &[Corner], radius: f64, ray: &Ray<D>) -> (f64, f64) {
    let mut whole = (f64::INFINITY, f64::NEG_INFINITY);
    let mut unite = |(enter, leave): (f64, f64)| {
        if enter <= leave {
            whole.0 = if enter < whole.0 { enter } else { whole.0 };
            whole.1 = if leave > whole.1 { leave } else { whole.1 };
        }
    };
    let (way_x, way_y) = (ray.way[0], ray.way[1]);
    let squared = way_x * way_x + way_y * way_y;
    let mut polygon = (f64::NEG_INFINITY, f64::INFINITY);
    for corner in corners {
        let (x, y) = (ray.from[0] - corner.at[0], ray.from[1] - corner.at[1]);
        let [along_x, along_y] = corner.along;
        let start = (x * along_x + y * along_y, along_x * y - along_y * x);
        let rate = (
            way_x * along_x + way_y * along_y,
            along_x * way_y - along_y * way_x,
        );
        polygon = common(polygon, within(start.1, rate.1, 0.0, f64::INFINITY));
        if corners.len() > 1 {
            let strip = within(start.1, rate.1, -radius, radius);
            unite(common(strip, within(start.0, rate.0, 0.0, corner.length)));
        }
        if radius > 0.0 {
            unite(within_disc(
                x * way_x + y * way_y,
                squared,
                x * x + y * y - radius * radius,
            ));
        }
    }
    if corners.len() > 2 {
        unite(polygon);
    }
    whole
}

/// The times at which `start + rate * time` lies in the interval.
fn within(start: f64, rate: f64, low: f64, high: f64) -> (f64, f64) {
    if rate == 0.0 {
        let inside = low <= start && start <= high;
        return if inside { EVER } else { NEVER };
    }
    let (a, b) = ((low - start) / rate, (high - start) / rate);
    if rate > 0.0 { (a, b) } else { (b, a) }
}

/// The times at which `squared * time^2 + 2 * half * time + rest` is not above zero.
fn within_disc(half: f64, squared: f64, rest: f64) -> (f64, f64) {
    let discriminant = half * half - squared * rest;
    if squared == 0.0 {
        return if rest <= 0.0 { EVER } else { NEVER };
    }
    if discriminant < 0.0 {
        return NEVER;
    }
    let root = math::sqrt(discriminant);
    ((-half - root) / squared, (root - half) / squared)
}

const EVER: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const NEVER: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

fn common(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (
        if a.0 > b.0 { a.0 } else { b.0 },
        if a.1 < b.1 { a.1 } else { b.1 },
    )
}
