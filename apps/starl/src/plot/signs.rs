//! Signs for waypoints, things, crashes and collisions.

use super::drawing::{Drawing, Fill, Shape, Spot, Stroke};
use super::frame::Frame;
use super::labels::{Labels, Style, short_name};
use super::palette::{BLACK, CRASH, THING, WAY_POINT, WHITE};
use super::times::seconds_text;
use super::{Crash, PlotData};

/// With more than this of a kind they have no names or times.
const MOST_NAMES: usize = 24;

/// The sign for a thing, filled unless it has been removed.
pub fn thing(drawing: &mut Drawing, (x, y): Spot, is_gone: bool) {
    let reach = 6.0;
    let points = vec![
        (x, y - reach),
        (x + reach, y),
        (x, y + reach),
        (x - reach, y),
    ];
    drawing.push(Shape::Line {
        points,
        closed: true,
        fill: Some(Fill::solid(if is_gone { WHITE } else { THING })),
        stroke: Some(Stroke::solid(THING, 1.6)),
    });
}

/// The sign for a crash.
pub fn crash(drawing: &mut Drawing, at: Spot) {
    drawing.push(Shape::Circle {
        center: at,
        radius: 7.0,
        fill: Some(Fill::solid(CRASH)),
        stroke: Some(Stroke::solid(WHITE, 1.0)),
    });
    drawing.cross(at, 3.2, Stroke::solid(WHITE, 2.0));
}

/// The sign for a collision.
pub fn collision(drawing: &mut Drawing, at: Spot) {
    drawing.cross(at, 5.0, Stroke::solid(WHITE, 4.0));
    drawing.cross(at, 5.0, Stroke::solid(BLACK, 2.0));
}

/// Draws all of them.
pub fn draw(drawing: &mut Drawing, frame: &Frame, data: &PlotData, labels: &mut Labels) {
    let style = |size, color| Style {
        size,
        color,
        needed: false,
    };
    let things = data.things.iter();
    let things: Vec<_> = things.filter(|thing| frame.has(&thing.position)).collect();
    let way_points = data.way_points.iter();
    let way_points: Vec<_> = way_points.filter(|way| frame.has(&way.position)).collect();
    for place in things.iter().map(|thing| thing.position) {
        labels.keep_off(frame.spot(place), 6.0);
    }
    for crash in &data.crashes {
        labels.keep_off(frame.spot(crash.place.position), 7.0);
    }
    let are_many = way_points.len() > MOST_NAMES;
    for way_point in way_points {
        let center = frame.spot(way_point.position);
        if are_many {
            drawing.push(Shape::Circle {
                center,
                radius: 1.5,
                fill: Some(Fill::solid(WAY_POINT)),
                stroke: None,
            });
            continue;
        }
        for stroke in [Stroke::solid(WHITE, 4.5), Stroke::solid(WAY_POINT, 2.2)] {
            drawing.push(Shape::Circle {
                center,
                radius: 7.0,
                fill: None,
                stroke: Some(stroke),
            });
        }
        labels.keep_off(center, 7.0);
        let needed = Style {
            needed: true,
            ..style(15.0, WAY_POINT)
        };
        labels.write(drawing, center, 9.0, &short_name(&way_point.name), needed);
    }
    for place in &things {
        let spot = frame.spot(place.position);
        thing(drawing, spot, place.is_gone);
        if things.len() <= MOST_NAMES {
            labels.write(
                drawing,
                spot,
                8.0,
                &short_name(&place.name),
                style(12.0, THING),
            );
        }
    }
    let collisions = data.collisions.iter();
    for place in collisions.filter(|place| frame.has(&place.position)) {
        let spot = frame.spot(place.position);
        collision(drawing, spot);
        if data.collisions.len() <= MOST_NAMES {
            let text = moment(place.at.seconds());
            labels.write(drawing, spot, 7.0, &text, style(10.0, BLACK));
        }
    }
    let crashes = data.crashes.iter();
    for place in crashes.filter(|crash| frame.has(&crash.place.position)) {
        let spot = frame.spot(place.place.position);
        crash(drawing, spot);
        if data.crashes.len() <= MOST_NAMES {
            let needed = Style {
                needed: true,
                ..style(10.0, CRASH)
            };
            labels.write(drawing, spot, 9.0, &crash_text(data, place), needed);
        }
    }
}

/// Which robot was down, and when.
fn crash_text(data: &PlotData, crash: &Crash) -> String {
    let name = data.robots.get(crash.robot).map_or("", |robot| &robot.name);
    let from = crash.place.at.seconds();
    let when = match crash.restarted {
        Some(until) => format!("{} to {}", moment(from), moment(until.seconds())),
        None => format!("from {}", moment(from)),
    };
    format!("{} down {when}", short_name(name))
}

/// A moment to the tenth of a second.
fn moment(seconds: f64) -> String {
    seconds_text((seconds * 10.0).round() / 10.0)
}
