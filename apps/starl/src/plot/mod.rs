//! Pictures of a run from above, as in figure 2.2 of the thesis: obstacles grey, waypoints as red
//! circles, each robot's path in its own colour, one scale in metres for both axes.
//!
//! A picture is first a list of shapes ([`drawing`]), made by [`scene`]; [`svg`] and [`png`] write the
//! same list. Text in a PNG is drawn with a font that is part of the program (DejaVu Sans), so it
//! looks the same on a machine without fonts.

pub mod drawing;
mod frame;
mod legend;
mod marks;
pub mod palette;
#[cfg(feature = "png")]
mod raster;
mod scene;
#[cfg(test)]
mod tests;
mod vector;

pub use legend::text_width;

use starl_core::event::MarkShape;
use starl_core::{Obstacle, Point, WayPoint};
use std::collections::BTreeMap;

pub use frame::{label, step_for, ticks};

/// The content of a picture. Coordinates that are not finite are omitted.
#[derive(Clone, Debug, Default)]
pub struct PlotData {
    /// First line of the heading, e.g. the example's name.
    pub title: String,
    /// Second line of the heading, e.g. seed and outcome.
    pub subtitle: String,
    /// Two opposite corners of the floor, metres; none to show as much as anything needs.
    pub arena: Option<(Point, Point)>,
    /// The world's obstacles.
    pub obstacles: Vec<Obstacle>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The robots, in the order in which they get their colours.
    pub robots: Vec<RobotPath>,
    /// Where bodies met something.
    pub collisions: Vec<Point>,
}

/// Where a robot has been.
#[derive(Clone, Debug, Default)]
pub struct RobotPath {
    /// Its name.
    pub name: String,
    /// Its model, e.g. `create`.
    pub model: String,
    /// Radius of its body, metres.
    pub radius: f64,
    /// Whether it flies.
    pub flies: bool,
    /// Its true positions in the order of time, metres.
    pub path: Vec<Point>,
    /// Its program's current drawings, by label.
    pub marks: BTreeMap<String, MarkShape>,
}

/// The picture as SVG.
pub fn svg(data: &PlotData) -> String {
    vector::svg(&scene::draw(data))
}

/// The picture as PNG, two pixels for each unit of the SVG.
#[cfg(feature = "png")]
pub fn png(data: &PlotData) -> Vec<u8> {
    raster::png(&scene::draw(data), 2.0)
}

/// Any other drawing in the format of a file's name.
pub fn file(drawing: &drawing::Drawing, picture: crate::outputs::Picture) -> Vec<u8> {
    match picture {
        crate::outputs::Picture::Svg => vector::svg(drawing).into_bytes(),
        #[cfg(feature = "png")]
        crate::outputs::Picture::Png => raster::png(drawing, 2.0),
    }
}
