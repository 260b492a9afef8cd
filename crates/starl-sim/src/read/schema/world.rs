//! The fields of `world`.

use super::*;

/// The world that robots move in.
pub(super) const WORLD: &[Field] = &[
    field(
        "files",
        Kind::Texts,
        Default::Word("none"),
        "World files to read, by their paths from the scenario's folder; see `world-files.md`.",
    ),
    field(
        "bounds",
        Kind::Table(CORNERS),
        Default::Word("none"),
        "A rectangle whose sides are walls: no body leaves it.",
    ),
    field(
        "start_area",
        Kind::Table(CORNERS),
        Default::Depends(
            "`bounds`, or else everything in the world and 1 m around it, or in an empty world a square around `[0, 0]`",
        ),
        "The area in which robots without a start are placed, with their whole bodies.",
    ),
    tables(
        "obstacle",
        OBSTACLE,
        "The obstacles. Each has one of the four shapes.",
    ),
    tables(
        "occupancy",
        OCCUPANCY,
        "Obstacles from an image, such as a map of a building.",
    ),
    tables(
        "way_point",
        WAY_POINT,
        "The waypoints of every program, in this order.",
    ),
    tables("thing", THING, "Things that detectors see."),
];

const OBSTACLE: &[Field] = &join::<{ SHAPE.len() + 2 }>(&[
    SHAPE,
    &[
        HIDDEN,
        field(
            "expires",
            SPAN,
            Default::Word("never"),
            "It disappears at this time.",
        ),
    ],
]);

/// Whether an obstacle is known.
pub(super) const HIDDEN: Field = field(
    "hidden",
    Kind::Flag,
    Default::Value("false"),
    "Robots do not know it until they meet it.",
);

/// The shape and place of an obstacle.
pub(super) const SHAPE: &[Field] = &[
    field(
        "polygon",
        Kind::Outline,
        Default::Word("none"),
        "Shape: a convex polygon, its corners in order; a wall without thickness if there are two.",
    ),
    field(
        "circle",
        Kind::Table(CIRCLE),
        Default::Word("none"),
        "Shape: an upright cylinder.",
    ),
    field(
        "rectangle",
        Kind::Table(CORNERS),
        Default::Word("none"),
        "Shape: a rectangle with sides along the axes.",
    ),
    field(
        "box",
        Kind::Table(BOX),
        Default::Word("none"),
        "Shape: a box with sides along the axes, heights included.",
    ),
    field(
        "height",
        Kind::Heights,
        Default::Word("unbounded"),
        "Lowest and highest point; without it the obstacle reaches from the floor to the sky. Not \
         for a box, which has its own.",
    ),
];

const CIRCLE: &[Field] = &[
    field(
        "center",
        Kind::PlanarPoint,
        Default::Required,
        "Its centre.",
    ),
    field("radius", SIZE, Default::Required, "Its radius."),
];

const BOX: &[Field] = &[
    field(
        "low",
        Kind::Point,
        Default::Required,
        "Corner with the lowest x, y and z.",
    ),
    field(
        "high",
        Kind::Point,
        Default::Required,
        "Corner with the highest x, y and z.",
    ),
];

const OCCUPANCY: &[Field] = &[
    field(
        "image",
        Kind::Text,
        Default::Required,
        "A PGM or PNG image, by its path from the scenario's folder; dark is occupied.",
    ),
    field("resolution", SIZE, Default::Required, "Side of a pixel."),
    field(
        "origin",
        Kind::PlanarPoint,
        Default::Value("[0, 0]"),
        "The place of the lower left corner of the image.",
    ),
    field(
        "threshold",
        Kind::Probability,
        Default::Value("0.65"),
        "A pixel at least this dark is an obstacle: 0 is white, 1 is black.",
    ),
    field(
        "height",
        Kind::Heights,
        Default::Word("unbounded"),
        "As for an obstacle.",
    ),
    field(
        "hidden",
        Kind::Flag,
        Default::Value("false"),
        "As for an obstacle.",
    ),
];

const WAY_POINT: &[Field] = &[
    field(
        "name",
        Kind::Text,
        Default::Required,
        "Its name, which must be unique.",
    ),
    field("position", Kind::Point, Default::Required, "Its position."),
    field(
        "group",
        Kind::Count(0, u32::MAX as u64),
        Default::Value("0"),
        "A number by which a program can group waypoints.",
    ),
];

const THING: &[Field] = &[
    field(
        "name",
        Kind::Text,
        Default::Required,
        "Its name, which must be unique.",
    ),
    field("position", Kind::Point, Default::Required, "Its position."),
];
