//! A picture as a list of shapes, later ones over earlier ones. Units are those of the SVG, about a
//! pixel on a screen; x to the right, y down.

/// A colour: red, green, blue.
pub type Color = [u8; 3];

/// A place in the picture.
pub type Spot = (f64, f64);

/// A picture.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Width and height.
    pub size: (f64, f64),
    /// The shapes, from the back to the front.
    pub shapes: Vec<Shape>,
}

/// A line's look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Its width.
    pub width: f64,
    /// How much it covers, 0 to 1.
    pub opacity: f64,
    /// Whether it is dashed.
    pub dashed: bool,
}

impl Stroke {
    /// An opaque line.
    pub fn solid(color: Color, width: f64) -> Stroke {
        Stroke {
            color,
            width,
            opacity: 1.0,
            dashed: false,
        }
    }
}

/// The look of a shape's inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// Its colour.
    pub color: Color,
    /// How much it covers, 0 to 1.
    pub opacity: f64,
}

impl Fill {
    /// An opaque fill.
    pub fn solid(color: Color) -> Fill {
        Fill {
            color,
            opacity: 1.0,
        }
    }
}

/// Which end of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// One thing that is drawn.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Straight lines from each point to the next.
    Line {
        /// The points.
        points: Vec<Spot>,
        /// Whether the last is joined to the first.
        closed: bool,
        /// Its inside, if closed.
        fill: Option<Fill>,
        /// Its outline.
        stroke: Option<Stroke>,
    },
    /// A circle.
    Circle {
        /// Its centre.
        center: Spot,
        /// Its radius.
        radius: f64,
        /// Its inside.
        fill: Option<Fill>,
        /// Its outline.
        stroke: Option<Stroke>,
    },
    /// A line of text.
    Text {
        /// Where its base line has the anchor.
        at: Spot,
        /// Which end that is.
        anchor: Anchor,
        /// The text.
        text: String,
        /// Height of a line.
        size: f64,
        /// Its colour.
        color: Color,
        /// Whether a white rim sets it off from what is behind.
        rim: bool,
    },
    /// Clips everything that follows to this rectangle, given by two corners; none ends the clipping.
    Clip(Option<(Spot, Spot)>),
}

impl Drawing {
    /// Adds a shape.
    pub fn push(&mut self, shape: Shape) {
        self.shapes.push(shape);
    }

    /// Adds a line.
    pub fn line(&mut self, points: Vec<Spot>, stroke: Stroke) {
        self.push(Shape::Line {
            points,
            closed: false,
            fill: None,
            stroke: Some(stroke),
        });
    }

    /// Adds a text without a rim.
    pub fn text(
        &mut self,
        at: Spot,
        anchor: Anchor,
        text: impl Into<String>,
        size: f64,
        color: Color,
    ) {
        self.push(Shape::Text {
            at,
            anchor,
            text: text.into(),
            size,
            color,
            rim: false,
        });
    }

    /// Adds a cross, half as wide as `reach`.
    pub fn cross(&mut self, (x, y): Spot, reach: f64, stroke: Stroke) {
        self.line(vec![(x - reach, y - reach), (x + reach, y + reach)], stroke);
        self.line(vec![(x - reach, y + reach), (x + reach, y - reach)], stroke);
    }
}

/// Lengths of a dash and of the gap after it.
pub const DASH: [f64; 2] = [7.0, 3.0];
