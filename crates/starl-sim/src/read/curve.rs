//! An order of places in which neighbours are mostly near each other: along Morton's curve (Morton
//! 1966, "A computer oriented geodetic data base and a new technique in file sequencing").
//!
//! Robots that are numbered in this order lie in memory as they do on the floor, which a large fleet's
//! engine runs much faster with.

use crate::scenario::Bounds;
use starl_core::Point;

/// Where the place is on the curve through the area; places outside count as on its edge.
pub(super) fn position(area: &Bounds, place: Point) -> u64 {
    let Bounds { low, high } = area;
    let part = |x: f64, low: f64, high: f64| {
        // A float-to-integer cast saturates, and takes NaN, of an area without extent, to 0.
        ((x - low) / (high - low) * f64::from(u32::MAX)) as u32
    };
    spread(part(place.x, low.x, high.x)) | spread(part(place.y, low.y, high.y)) << 1
}

/// The bits of a number, at the even places.
fn spread(number: u32) -> u64 {
    let masks = [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ];
    masks.iter().fold(u64::from(number), |bits, (shift, mask)| {
        (bits | bits << shift) & mask
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_goes_through_quarters_of_quarters() {
        let area = Bounds {
            low: Point::planar(1.0, 1.0),
            high: Point::planar(5.0, 5.0),
        };
        let at = |x: f64, y: f64| position(&area, Point::planar(x + 1.5, y + 1.5));
        let places = [
            (0, 0),
            (1, 0),
            (0, 1),
            (1, 1),
            (2, 0),
            (3, 1),
            (0, 2),
            (3, 3),
        ];
        let along: Vec<u64> = places.map(|(x, y)| at(x.into(), y.into())).into();
        assert!(along.is_sorted(), "{along:?}");
        assert_eq!(position(&area, Point::ZERO), 0);
        assert_eq!(position(&area, Point::planar(9.0, 9.0)), u64::MAX);
    }
}
