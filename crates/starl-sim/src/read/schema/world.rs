//! The fields of `world`.

use super::*;

/// The world that robots move in.
pub(super) const WORLD: &[Field] = fields! {
    /// World files to read, by their paths from the scenario's folder; see `world-files.md`.
    files = Kind::Texts, Word("none");
    /// A rectangle whose sides are walls: no body leaves it.
    bounds = Kind::Table(CORNERS), Word("none");
    /// The area in which robots without a start are placed, with their whole bodies.
    start_area = Kind::Table(CORNERS),
        Depends("`bounds`, or else everything in the world and 1 m around it, or in an empty world a square around `[0, 0]`");
    /// The obstacles. Each has one of the four shapes.
    obstacle = Kind::Tables(OBSTACLE), Word("none");
    /// Obstacles from an image, such as a map of a building.
    occupancy = Kind::Tables(OCCUPANCY), Word("none");
    /// The waypoints of every program, in this order.
    way_point = Kind::Tables(WAY_POINT), Word("none");
    /// Things that detectors see.
    thing = Kind::Tables(THING), Word("none");
};

const OBSTACLE: &[Field] = &join::<Field, { SHAPE.len() + 2 }>(&[
    SHAPE,
    HIDDEN,
    fields! {
        /// It disappears at this time.
        expires = SPAN, Word("never");
    },
]);

/// Whether an obstacle is known.
pub(super) const HIDDEN: &[Field] = fields! {
    /// Robots do not know it until they meet it.
    hidden = Kind::Flag, Value("false");
};

/// The shape and place of an obstacle.
pub(super) const SHAPE: &[Field] = fields! {
    /// Shape: a convex polygon, its corners in order; a wall without thickness if there are two.
    polygon = Kind::Outline, Word("none");
    /// Shape: an upright cylinder.
    circle = Kind::Table(CIRCLE), Word("none");
    /// Shape: a rectangle with sides along the axes.
    rectangle = Kind::Table(CORNERS), Word("none");
    /// Shape: a box with sides along the axes, heights included.
    box = Kind::Table(BOX), Word("none");
    /// Lowest and highest point; without it the obstacle reaches from the floor to the sky. Not for a box, which has
    /// its own.
    height = Kind::Heights, Word("unbounded");
};

const CIRCLE: &[Field] = fields! {
    /// Its centre.
    center = Kind::PlanarPoint, Required;
    /// Its radius.
    radius = SIZE, Required;
};

const BOX: &[Field] = fields! {
    /// Corner with the lowest x, y and z.
    low = Kind::Point, Required;
    /// Corner with the highest x, y and z.
    high = Kind::Point, Required;
};

const OCCUPANCY: &[Field] = fields! {
    /// A PGM or PNG image, by its path from the scenario's folder; dark is occupied.
    image = Kind::Text, Required;
    /// Side of a pixel.
    resolution = SIZE, Required;
    /// The place of the lower left corner of the image.
    origin = Kind::PlanarPoint, Value("[0, 0]");
    /// A pixel at least this dark is an obstacle: 0 is white, 1 is black.
    threshold = Kind::Probability, Value("0.65");
    /// As for an obstacle.
    height = Kind::Heights, Word("unbounded");
    /// As for an obstacle.
    hidden = Kind::Flag, Value("false");
};

const WAY_POINT: &[Field] = fields! {
    /// Its name, which must be unique.
    name = Kind::Text, Required;
    /// Its position.
    position = Kind::Point, Required;
    /// A number by which a program can group waypoints.
    group = Kind::Count(0, u32::MAX as u64), Value("0");
};

const THING: &[Field] = fields! {
    /// Its name, which must be unique.
    name = Kind::Text, Required;
    /// Its position.
    position = Kind::Point, Required;
};
