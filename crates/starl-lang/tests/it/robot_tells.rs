//! The output of a program to observers: events with fields, log lines, drawings.

use crate::robot_support::{World, compile};
use starl_core::event::{Level, MarkShape};
use starl_core::{Area, Event, Point, RobotId, Value};

const TELLS: &str = r#"
program Tells

enum Color {red, green}
record Pair {a: Int, b: String}

tell()
    eff
        emit("all", yes = true, number = 3, part = 0.5, text = "t", place = Point(1.0, 2.0), span = 1500ms,
            color = green, who = me, robots = peers, path = [Point(0.0, 0.0), Point(1.0, 1.0)],
            area = circle(Point(0.0, 0.0), 1.0), pair = Pair(1, "x"), numbers = [1, 2], at = now)
        log("{} of {}", 1, "two")
        draw_point("p", Point(1.0, 1.0))
        draw_line("l", [Point(0.0, 0.0), Point(1.0, 0.0, 2.0)])
        draw_circle("c", Point(0.0, 0.0), 2.0)
        draw_text("t", Point(3.0, 0.0))
        draw_nothing("n")
"#;

#[test]
fn fields_of_events_have_their_types() {
    let mut world = World::of(&compile(TELLS), 2);
    world.step();
    let (name, fields) = &world.emitted(1)[0];
    assert_eq!(name, "all");
    let text = |text: &str| Value::Text(text.to_string().into());
    let circle = Area::Circle {
        center: Point::ZERO,
        radius: 1.0,
    };
    let expected = [
        ("yes", Value::Bool(true)),
        ("number", Value::Int(3)),
        ("part", Value::Float(0.5)),
        ("text", text("t")),
        ("place", Value::Point(Point::planar(1.0, 2.0))),
        ("span", Value::Float(1.5)),
        ("color", text("green")),
        ("who", Value::Robot(RobotId(1))),
        ("robots", Value::Robots(vec![RobotId(0), RobotId(1)])),
        (
            "path",
            Value::Path(vec![Point::ZERO, Point::planar(1.0, 1.0)]),
        ),
        ("area", circle.into()),
        ("pair", text("(a = 1, b = \"x\")")),
        ("numbers", text("[1, 2]")),
        ("at", Value::Time(starl_core::Time::ZERO)),
    ];
    let expected = expected.map(|(name, value)| (name.to_string(), value));
    assert_eq!(fields[..], expected);
}

#[test]
fn lines_and_marks_are_recorded() {
    let mut world = World::of(&compile(TELLS), 1);
    world.step();
    let mut lines = Vec::new();
    let mut marks = Vec::new();
    for event in world.events_of(0) {
        match event {
            Event::Log { level, text } => lines.push((*level, text.to_string())),
            Event::Draw(mark) => marks.push((mark.label.to_string(), mark.shape.clone())),
            _ => {}
        }
    }
    assert_eq!(lines, [(Level::Info, "1 of two".to_string())]);
    let line = vec![Point::ZERO, Point::new(1.0, 0.0, 2.0)];
    let circle = MarkShape::Circle {
        center: Point::ZERO,
        radius: 2.0,
    };
    let expected = [
        ("p", MarkShape::Dot(Point::planar(1.0, 1.0))),
        ("l", MarkShape::Line(line)),
        ("c", circle),
        ("t", MarkShape::Text(Point::planar(3.0, 0.0))),
        ("n", MarkShape::Nothing),
    ];
    assert_eq!(
        marks,
        expected.map(|(label, shape)| (label.to_string(), shape))
    );
}
