//! Draws a story.

use super::Extent;
use super::axis::Axis;
use super::story::{Mark, MarkKind, Message, Partition, Story};
use crate::plot::drawing::{Anchor, Color, Drawing, Fill, Shape, Spot, Stroke};
use crate::plot::palette::{self, BLACK, GRID, INK, WHITE};
use crate::plot::text_width;
use starl_core::event::DropReason;
use starl_core::{Port, RobotId};
use std::collections::BTreeMap;

/// What goes wrong.
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
/// More lanes than this would hide the arrows.
const MOST_LANES: usize = 7;
/// Height of a row without labels.
const ROW: f64 = 58.0;

/// The drawing of what is to be shown of a story.
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

/// Labels with the lanes that they are in, above their robots' lines; none where there is no room.
type Lanes<'a> = Vec<(&'a Mark, Option<usize>)>;

/// Gives each label the lowest lane in which it is clear of others.
fn lanes<'a>(story: &'a Story, axis: &Axis) -> Lanes<'a> {
    let mut ends: BTreeMap<(RobotId, usize), f64> = BTreeMap::new();
    let shown = story.marks.iter().filter(|mark| axis.shows(mark.at));
    let lane = |mark: &'a Mark| {
        let x = axis.place(mark.at);
        let free = |lane: &usize| ends.get(&(mark.robot, *lane)).is_none_or(|&end| end <= x);
        let lane = (0..MOST_LANES).find(free);
        if let Some(lane) = lane {
            let end = x + text_width(&mark.text, LABEL) * 0.95 + 6.0;
            ends.insert((mark.robot, lane), end);
        }
        (mark, lane)
    };
    shown.map(lane).collect()
}

/// Where the robots' lines lie, each with room for its labels above.
fn rows(story: &Story, lanes: &Lanes<'_>) -> Vec<f64> {
    let mut y = 62.0;
    let row = |robot: usize| {
        let own = lanes.iter().filter(|(mark, _)| mark.robot.index() == robot);
        let used = own.filter_map(|(_, lane)| *lane).map(|lane| lane + 1).max();
        y += used.unwrap_or(0) as f64 * LANE + if robot == 0 { 8.0 } else { ROW };
        y
    };
    (0..story.robots.len()).map(row).collect()
}

/// A colour for each port that something shown belongs to.
fn colors(story: &Story, axis: &Axis) -> BTreeMap<Port, Color> {
    let sent = story
        .messages
        .iter()
        .filter(|message| axis.shows(message.at));
    let mut ports: Vec<Port> = sent.map(|message| message.port).collect();
    ports.extend(
        story
            .marks
            .iter()
            .filter(|mark| axis.shows(mark.at))
            .filter_map(|mark| match mark.kind {
                MarkKind::Primitive(port) => Some(port),
                _ => None,
            }),
    );
    ports.sort_unstable();
    ports.dedup();
    let many = ports.len();
    let colored = ports.into_iter().enumerate();
    colored
        .map(|(index, port)| (port, palette::color(index, many)))
        .collect()
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

    /// Times, robots' lines, partitions, and who is down.
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
            "network in parts",
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

    fn messages(&mut self) {
        let story = self.story;
        for message in &story.messages {
            if message.at >= self.axis.start() && message.sent <= self.axis.end() {
                self.message(message);
            }
        }
    }

    fn message(&mut self, message: &Message) {
        let color = self.colors.get(&message.port).copied().unwrap_or(INK);
        let start = (self.axis.place(message.sent), self.row(message.from));
        let Some(to) = message.to else {
            // Too large, or the queue was full: it never left.
            let cross = (start.0, start.1 - 7.0);
            return self.drawing.cross(cross, 3.0, Stroke::solid(WRONG, 1.4));
        };
        let end = (self.axis.place(message.at), self.row(to));
        let stroke = Stroke {
            color,
            width: 1.1,
            opacity: 0.85,
            dashed: message.lost.is_some(),
        };
        match message.lost {
            Some(DropReason::Down) => {
                self.arrow(start, end, stroke);
                self.drawing.cross(end, 3.5, Stroke::solid(WRONG, 1.6));
            }
            // Its fate is known when it is sent; the line only shows whom it was for.
            Some(_) => {
                let down = if end.1 > start.1 { 1.0 } else { -1.0 };
                let stop = (start.0 + 7.0, start.1 + down * 21.0);
                self.drawing.line(vec![start, stop], stroke);
                self.drawing.cross(stop, 3.0, Stroke::solid(WRONG, 1.5));
            }
            None if message.at > self.axis.end() => self.drawing.line(vec![start, end], stroke),
            None => self.arrow(start, end, stroke),
        }
    }

    fn arrow(&mut self, start: Spot, end: Spot, stroke: Stroke) {
        self.drawing.line(vec![start, end], stroke);
        let (dx, dy) = (end.0 - start.0, end.1 - start.1);
        let length = (dx * dx + dy * dy).sqrt();
        if length < 1.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let back = |along: f64, aside: f64| {
            (
                end.0 - ux * along - uy * aside,
                end.1 - uy * along + ux * aside,
            )
        };
        self.drawing.push(Shape::Line {
            points: vec![end, back(7.0, 2.8), back(7.0, -2.8)],
            closed: true,
            fill: Some(Fill::solid(stroke.color)),
            stroke: None,
        });
    }

    fn marks(&mut self, lanes: &Lanes<'_>) {
        for &(mark, lane) in lanes {
            let (x, y) = (self.axis.place(mark.at), self.row(mark.robot));
            let color = match mark.kind {
                MarkKind::Primitive(port) => self.colors.get(&port).copied().unwrap_or(INK),
                MarkKind::Program => INK,
                MarkKind::Fault => WRONG,
                MarkKind::End => BLACK,
            };
            if let Some(lane) = lane {
                let foot = y - 13.0 - lane as f64 * LANE;
                let thread = Stroke {
                    opacity: 0.5,
                    ..Stroke::solid(color, 0.8)
                };
                self.drawing.line(vec![(x, y), (x, foot + 2.0)], thread);
                self.drawing.push(Shape::Text {
                    at: (x + 2.0, foot),
                    anchor: Anchor::Start,
                    text: mark.text.clone(),
                    size: LABEL,
                    color,
                    rim: true,
                });
            }
            self.drawing.push(Shape::Circle {
                center: (x, y),
                radius: 3.2,
                fill: Some(Fill::solid(color)),
                stroke: Some(Stroke::solid(WHITE, 0.8)),
            });
        }
    }

    /// What went wrong first: a line through that moment, and a ring round the robot.
    fn violation(&mut self) {
        let shown = |violation: &&super::story::Violation| self.axis.shows(violation.at);
        let Some(violation) = self.story.violations.iter().find(shown) else {
            return;
        };
        let x = self.axis.place(violation.at);
        let (top, bottom) = (self.top(), self.bottom());
        self.drawing
            .line(vec![(x, top), (x, bottom)], Stroke::solid(WRONG, 1.8));
        if let Some(robot) = violation.robot {
            self.drawing.push(Shape::Circle {
                center: (x, self.row(robot)),
                radius: 8.0,
                fill: None,
                stroke: Some(Stroke::solid(WRONG, 2.2)),
            });
        }
    }

    /// The heading and the legend; gives the whole drawing.
    fn foot(mut self, lanes: &Lanes<'_>) -> Drawing {
        let story = self.story;
        let part = format!(
            "from {:.3} s to {:.3} s; room for silence by its logarithm",
            self.axis.start().seconds(),
            self.axis.end().seconds()
        );
        let mut right = (self.axis.right() + 24.0).max(MARGIN + text_width(&part, 11.0));
        let labels = lanes.iter().filter(|(_, lane)| lane.is_some());
        for (mark, _) in labels {
            right = right.max(self.axis.place(mark.at) + text_width(&mark.text, LABEL));
        }
        let mut y = self.bottom() + 40.0;
        let mut x = MARGIN;
        for (port, color) in &self.colors {
            let name = match story.ports.get(port) {
                Some(name) => name.clone(),
                None if *port == Port::PROGRAM => "program".to_string(),
                None => "other messages".to_string(),
            };
            self.drawing.line(
                vec![(x, y - 4.0), (x + 22.0, y - 4.0)],
                Stroke::solid(*color, 2.0),
            );
            self.drawing
                .text((x + 27.0, y), Anchor::Start, &name, 11.0, INK);
            x += 45.0 + text_width(&name, 11.0);
        }
        self.drawing
            .cross((x + 5.0, y - 4.0), 3.0, Stroke::solid(WRONG, 1.5));
        self.drawing
            .text((x + 14.0, y), Anchor::Start, "lost", 11.0, INK);
        x += 55.0;
        self.shade((x, y - 10.0), (x + 22.0, y + 1.0), DOWN, 0.55);
        self.drawing
            .text((x + 27.0, y), Anchor::Start, "down", 11.0, INK);
        right = right.max(x + 70.0);
        for violation in story.violations.iter().take(1) {
            let text = format!("{}: {}", violation.property, violation.text);
            for line in wrapped(&text, ((right - MARGIN) / 7.2) as usize) {
                y += 17.0;
                self.drawing
                    .text((MARGIN, y), Anchor::Start, line, 12.0, WRONG);
            }
        }
        let heading = Anchor::Start;
        self.drawing
            .text((MARGIN, 20.0), heading, story.title.clone(), 15.0, BLACK);
        self.drawing.text((MARGIN, 36.0), heading, part, 11.0, INK);
        right = right.max(MARGIN + text_width(&story.title, 15.0));
        self.drawing.size = (right + MARGIN, y + MARGIN);
        self.drawing
    }
}

/// Lines of at most so many letters.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().filter(|line| {
            line.is_empty() || line.chars().count() + 1 + word.chars().count() <= width
        });
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_string()),
        }
    }
    lines
}
