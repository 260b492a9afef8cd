//! Draws a story.

mod foot;
mod layout;
mod marks;
mod messages;

use super::Extent;
use super::axis::Axis;
use super::story::{Partition, Story};
use crate::plot::drawing::{Anchor, Color, Drawing, Fill, Shape, Spot, Stroke};
use crate::plot::palette::{BLACK, GRID, INK, WHITE};
use crate::plot::text_width;
use layout::{colors, lanes, rows};
use starl_core::{Port, RobotId};
use std::collections::BTreeMap;

/// The colour of violations.
const WRONG: Color = [200, 20, 20];
/// Robots that are down.
const DOWN: Color = [150, 150, 150];
/// The parts of a network.
const PARTS: [Color; 4] = [
    [255, 210, 120],
    [150, 200, 255],
    [190, 230, 160],
    [225, 190, 240],
];

const MARGIN: f64 = 16.0;
/// Height of labels, and of the lane of one.
const LABEL: f64 = 10.5;
const LANE: f64 = 12.5;

/// The drawing of the shown part of a story.
pub fn draw(story: &Story, extent: &Extent) -> Drawing {
    let names = story.robots.iter().map(|name| text_width(name, 12.5));
    let left = MARGIN + names.fold(0.0, f64::max) + 14.0;
    let axis = Axis::new(story, extent, left);
    let lanes = lanes(story, &axis);
    let mut scene = Scene {
        story,
        rows: rows(story, &lanes),
        colors: colors(story, &axis),
        axis,
        left,
        drawing: Drawing::default(),
    };
    scene.background();
    scene.messages();
    scene.marks(&lanes);
    scene.violation();
    scene.foot(&lanes)
}

struct Scene<'a> {
    story: &'a Story,
    axis: Axis,
    /// Where each robot's line lies.
    rows: Vec<f64>,
    colors: BTreeMap<Port, Color>,
    left: f64,
    drawing: Drawing,
}

impl Scene<'_> {
    fn row(&self, robot: RobotId) -> f64 {
        self.rows.get(robot.index()).copied().unwrap_or_default()
    }

    fn top(&self) -> f64 {
        50.0
    }

    fn bottom(&self) -> f64 {
        self.rows.last().copied().unwrap_or(self.top()) + 26.0
    }

    fn shade(&mut self, (x1, y1): Spot, (x2, y2): Spot, color: Color, opacity: f64) {
        self.drawing.push(Shape::Line {
            points: vec![(x1, y1), (x2, y1), (x2, y2), (x1, y2)],
            closed: true,
            fill: Some(Fill { color, opacity }),
            stroke: None,
        });
    }

    /// Times, robots' lines, partitions, and robots that are down.
    fn background(&mut self) {
        let (top, bottom, right) = (self.top(), self.bottom(), self.axis.right());
        for (at, x) in self.axis.ticks(74.0) {
            self.drawing
                .line(vec![(x, top), (x, bottom)], Stroke::solid(GRID, 1.0));
            let text = format!("{:.4} s", at.seconds());
            self.drawing
                .text((x, bottom + 14.0), Anchor::Middle, text, 10.5, INK);
        }
        let story = self.story;
        for partition in &story.partitions {
            self.partition(partition);
        }
        for (index, name) in story.robots.iter().enumerate() {
            let y = self.rows[index];
            self.drawing
                .text((self.left - 10.0, y + 4.0), Anchor::End, name, 12.5, BLACK);
            self.drawing.line(
                vec![(self.left, y), (right + 8.0, y)],
                Stroke::solid(INK, 1.4),
            );
        }
        for &(robot, from, to) in &story.outages {
            if from > self.axis.end() || to < self.axis.start() {
                continue;
            }
            let (from, to, y) = (self.axis.place(from), self.axis.place(to), self.row(robot));
            self.shade((from, y - 9.0), (to, y + 9.0), WHITE, 1.0);
            self.shade((from, y - 9.0), (to, y + 9.0), DOWN, 0.55);
        }
    }

    /// Shades the time, and each robot's line by the part that it is in.
    fn partition(&mut self, partition: &Partition) {
        if partition.from > self.axis.end() || partition.to < self.axis.start() {
            return;
        }
        let (from, to) = (
            self.axis.place(partition.from),
            self.axis.place(partition.to),
        );
        let (top, bottom) = (self.top(), self.bottom());
        self.shade((from, top), (to, bottom), PARTS[0], 0.14);
        self.drawing.text(
            (from + 3.0, top - 4.0),
            Anchor::Start,
            "network partitioned",
            10.5,
            INK,
        );
        for index in 0..self.rows.len() {
            let part = self.story.part_of(partition, RobotId(index as u32));
            let y = self.rows[index];
            self.shade(
                (from, y - 12.0),
                (to, y + 12.0),
                PARTS[part % PARTS.len()],
                0.6,
            );
        }
    }
}
