//! Reads an element of `world.occupancy`: an image whose dark pixels are obstacles.
//!
//! The image is a plain or raw PGM (Netpbm P2, P5) or a PNG. As in maps of ROS, its first row is the
//! one with the highest y. Dark pixels are gathered greedily into rectangles.

mod image;

use super::inputs::Recorder;
use super::obstacle::height;
use super::section::Section;
use crate::scenario::WorldObstacle;
use image::Image;
use starl_core::{ConvexPolygon, Obstacle, Point, Time};

/// The obstacles of an image.
pub(super) fn read(table: Section<'_>, files: &Recorder<'_>) -> Vec<WorldObstacle> {
    let resolution = table.optional_number("resolution");
    let origin = table
        .point("origin")
        .map_or(Point::ZERO, |(point, _)| point);
    let threshold = table.number("threshold");
    let height = height(table);
    let hidden = table.flag("hidden");
    let Some(path) = table.text("image") else {
        return Vec::new();
    };
    let image = match files.load(&path).map(|bytes| image::decode(&bytes)) {
        Ok(Ok(image)) => image,
        Ok(Err(reason)) => {
            let message = format!("{path} is not an image that can be read: {reason}");
            table.problem("image", message, "give a PGM (P2 or P5) or a PNG file");
            return Vec::new();
        }
        Err(reason) => {
            let message = format!("cannot read {path}: {reason}");
            table.problem("image", message, "give a PGM or a PNG file");
            return Vec::new();
        }
    };
    let Some(resolution) = resolution else {
        return Vec::new();
    };
    let occupied = |darkness: f64| darkness >= threshold && darkness > 0.0;
    let rectangles = rectangles(&image, occupied);
    let corner = |column: usize, row_from_below: usize| {
        origin + Point::planar(column as f64, row_from_below as f64) * resolution
    };
    let obstacle = |part: &Rectangle| {
        let low = corner(part.left, image.rows - part.bottom);
        let high = corner(part.right, image.rows - part.top);
        let base = ConvexPolygon::rectangle(low, high).ok()?;
        let obstacle = match height {
            Some(height) => Obstacle::polygon(base).with_height(height),
            None => Obstacle::polygon(base),
        };
        Some(WorldObstacle {
            obstacle,
            hidden,
            expires: Time::NEVER,
        })
    };
    rectangles.iter().filter_map(obstacle).collect()
}

/// A block of pixels; right and bottom are the first outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rectangle {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

/// Disjoint rectangles that cover the occupied pixels: from the first pixel not covered, in the order
/// of reading, as far to the right and then as far down as there are such pixels.
fn rectangles(image: &Image, occupied: impl Fn(f64) -> bool) -> Vec<Rectangle> {
    let mut open: Vec<bool> = image
        .darkness
        .iter()
        .map(|&pixel| occupied(pixel))
        .collect();
    let mut found = Vec::new();
    for top in 0..image.rows {
        let mut left = 0;
        while left < image.columns {
            let row = &open[top * image.columns..(top + 1) * image.columns];
            let width = row[left..].iter().take_while(|&&open| open).count();
            if width == 0 {
                left += 1;
                continue;
            }
            let right = left + width;
            let span = |row: usize| row * image.columns + left..row * image.columns + right;
            let mut bottom = top + 1;
            while bottom < image.rows && open[span(bottom)].iter().all(|&open| open) {
                bottom += 1;
            }
            for row in top..bottom {
                open[span(row)].fill(false);
            }
            found.push(Rectangle {
                left,
                right,
                top,
                bottom,
            });
            left = right;
        }
    }
    found
}
