//! Dots on the paths at regular times, so that a picture shows where each robot was at the same moment.

use super::drawing::{Drawing, Fill, Shape, Spot, Stroke};
use super::extent;
use super::frame::Frame;
use super::labels::{Labels, Style};
use super::looks::{Looks, MOST_COLORS};
use super::palette::WHITE;
use super::{Place, PlotData};
use starl_core::{Point, Time};

/// About so many dots are on the path of a robot that moves all the time.
const COUNT: f64 = 8.0;

/// Larger fleets have dots without times.
const MOST_WITH_TIMES: usize = 8;

/// Dots nearer than this to the one before are left out.
const NEAREST: f64 = 10.0;

/// Radius of a dot.
pub const RADIUS: f64 = 2.6;

/// Seconds from one dot to the next; none if there are no dots.
pub fn step(data: &PlotData) -> Option<f64> {
    if data.robots.len() > MOST_COLORS {
        return None;
    }
    let end = most_motion_over(data);
    if end <= 0.0 {
        return None;
    }
    let small = [1e-3, 1e-2, 1e-1, 1.0].into_iter();
    let small = small.flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * power));
    let large = [10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 1800.0];
    let hours = (0..).map(|power| 3600.0 * f64::from(1u32 << power));
    let mut steps = small.chain(large).chain(hours.take(24));
    steps.find(|step| end / step <= COUNT)
}

/// Seconds after which nine tenths of all ways have been made: robots that hold their places move a little for long.
fn most_motion_over(data: &PlotData) -> f64 {
    let pairs = data.robots.iter().flat_map(|robot| robot.path.windows(2));
    let ways = pairs.map(|pair| {
        let length = pair[0].position.planar_distance(pair[1].position);
        (pair[1].at, length)
    });
    let mut ways: Vec<(Time, f64)> = ways.filter(|(_, length)| length.is_finite()).collect();
    ways.sort_by_key(|(at, _)| *at);
    let mut left = 0.9 * ways.iter().map(|(_, length)| length).sum::<f64>();
    let last = ways.iter().find(|(_, length)| {
        left -= length;
        *length > 0.0 && left <= 0.0
    });
    last.map_or(0.0, |(at, _)| at.seconds())
}

/// Draws the dots, and their times where there is room.
pub fn draw(
    drawing: &mut Drawing,
    frame: &Frame,
    data: &PlotData,
    looks: &Looks,
    labels: &mut Labels,
) {
    let Some(step) = step(data) else { return };
    for (index, robot) in data.robots.iter().enumerate() {
        let color = looks.stroke(index, robot).color;
        let mut before = robot.path.first().map(|place| frame.spot(place.position));
        let end = robot.path.last().map_or(0.0, |place| place.at.seconds());
        for number in 1..=(end / step) as u32 {
            let seconds = f64::from(number) * step;
            let Some(position) = position(&robot.path, Time((seconds * 1e9) as u64)) else {
                continue;
            };
            let spot = frame.spot(position);
            if !extent::shows(&position) || before.is_some_and(|last| is_near(last, spot)) {
                continue;
            }
            before = Some(spot);
            drawing.push(Shape::Circle {
                center: spot,
                radius: RADIUS,
                fill: Some(Fill::solid(color)),
                stroke: Some(Stroke::solid(WHITE, 1.0)),
            });
            if data.robots.len() <= MOST_WITH_TIMES {
                let style = Style {
                    size: 10.0,
                    color,
                    needed: false,
                };
                labels.write(drawing, spot, 4.0, &seconds_text(seconds), style);
            }
        }
    }
}

/// A moment in words.
pub fn seconds_text(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 300.0 => format!("{} s", (seconds * 1e3).round() / 1e3),
        seconds if seconds < 36_000.0 => format!("{} min", (seconds / 6.0).round() / 10.0),
        seconds => format!("{} h", (seconds / 360.0).round() / 10.0),
    }
}

fn is_near(a: Spot, b: Spot) -> bool {
    (a.0 - b.0).abs() < NEAREST && (a.1 - b.1).abs() < NEAREST
}

/// The position at a moment, on the straight way between the two recorded ones around it.
fn position(path: &[Place], at: Time) -> Option<Point> {
    let after = path.partition_point(|place| place.at < at);
    let next = path.get(after)?;
    let Some(last) = after.checked_sub(1).and_then(|before| path.get(before)) else {
        return Some(next.position);
    };
    let share = at.since(last.at).seconds() / next.at.since(last.at).seconds();
    let (from, to) = (last.position, next.position);
    let between = |from: f64, to: f64| from + (to - from) * share;
    Some(Point::planar(between(from.x, to.x), between(from.y, to.y)))
}
