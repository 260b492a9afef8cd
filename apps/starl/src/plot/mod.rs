//! Pictures of a run from above, as in figure 2.2 of the thesis: obstacles grey, waypoints as red
//! circles, each robot's path in its own colour with marks of time, one scale in metres for both axes.
//! Things, crashes, collisions and ranges are shown too. The picture shows the part of the world in which
//! robots move, and says where there is more.
//!
//! A picture is first a list of shapes ([`drawing`]), made by [`scene`]; [`svg`] and [`png`] write the
//! same list. Text in a PNG is drawn with a font that is part of the program (DejaVu Sans), so it
//! looks the same on a machine without fonts.

pub mod drawing;
mod extent;
mod frame;
mod labels;
mod legend;
mod looks;
mod marks;
pub mod palette;
mod ranges;
#[cfg(feature = "png")]
mod raster;
mod scene;
mod signs;
#[cfg(test)]
mod tests;
mod times;
mod vector;

pub use labels::text_width;

use starl_core::event::MarkShape;
use starl_core::{Obstacle, Point, Time, WayPoint};
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
    /// The places where things have been.
    pub things: Vec<Thing>,
    /// The robots, in the order in which they get their colours.
    pub robots: Vec<RobotPath>,
    /// Where and when bodies met something.
    pub collisions: Vec<Place>,
    /// Where and when robots crashed.
    pub crashes: Vec<Crash>,
    /// Radio range, metres; none where robots hear each other everywhere.
    pub radio_range: Option<f64>,
}

/// A place at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// When.
    pub at: Time,
    /// Where, metres.
    pub position: Point,
}

/// A place where a thing has been.
#[derive(Clone, Debug)]
pub struct Thing {
    /// Its name.
    pub name: String,
    /// Where, metres.
    pub position: Point,
    /// Whether it has been removed.
    pub is_gone: bool,
}

/// A crash of a robot.
#[derive(Clone, Copy, Debug)]
pub struct Crash {
    /// Which robot, by its place in the list of robots.
    pub robot: usize,
    /// Where and when.
    pub place: Place,
    /// When the robot restarted; none if it did not.
    pub restarted: Option<Time>,
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
    /// Range of its detector, metres; none if it has no detector.
    pub detector: Option<f64>,
    /// Its true positions in the order of time.
    pub path: Vec<Place>,
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
pub fn file(drawing: &drawing::Drawing, picture: crate::picture::Picture) -> Vec<u8> {
    match picture {
        crate::picture::Picture::Svg => vector::svg(drawing).into_bytes(),
        #[cfg(feature = "png")]
        crate::picture::Picture::Png => raster::png(drawing, 2.0),
    }
}
