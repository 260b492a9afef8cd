//! Drawings in SVG are read as waypoints: each line is a group, in millimetres, with y upwards.

use crate::reading::{self, Files};
use starl_core::{Point, WayPoint};
use starl_sim::read;

fn way_points(svg: &str) -> Result<Vec<WayPoint>, String> {
    let text = "program = \"painting\"\n[world]\nfiles = [\"drawing.svg\"]\n[[robots]]\nmodel = \"drone\"\n";
    let mut files = Files::default();
    files
        .0
        .insert("drawing.svg".into(), svg.as_bytes().to_vec());
    match read::scenario(&reading::request(text, &[]), &files) {
        Ok(read) => Ok(read.scenario.world.way_points),
        Err(problems) => Err(problems.to_string()),
    }
}

/// The strokes of a drawing of 4 m by 3 m.
fn strokes(elements: &str) -> Vec<Vec<(f64, f64)>> {
    let svg = format!(r#"<svg viewBox="0 0 4000 3000">{elements}</svg>"#);
    let points = way_points(&svg).unwrap_or_else(|problems| panic!("{problems}"));
    let last = points.iter().map(|point| point.group).max().unwrap_or(0);
    let group = |group| {
        let those = points.iter().filter(move |point| point.group == group);
        those.map(|point| (point.position.x, point.position.y))
    };
    (1..=last).map(|number| group(number).collect()).collect()
}

#[test]
fn a_path_is_a_stroke_each_time_the_pen_is_put_down() {
    let path = r#"<path d="M 0 3000 h 1000 V 0 M 2000,1000 l 500 500 z"/>"#;
    let first = vec![(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)];
    let second = vec![(2.0, 2.0), (2.5, 1.5), (2.0, 2.0)];
    assert_eq!(strokes(path), [first, second]);
}

#[test]
fn shapes_are_strokes_too() {
    let drawn = strokes(
        r#"<line x1="0" y1="0" x2="100" y2="0"/><polyline points="1 2 3 4 5 6"/>
        <polygon points="0,0 100,0 0,100"/><rect x="1000" y="1000" width="200" height="100"/>"#,
    );
    assert_eq!(drawn.iter().map(Vec::len).collect::<Vec<_>>(), [2, 3, 4, 5]);
    assert_eq!(drawn[3][0], (1.0, 2.0));
    assert_eq!(drawn[3][2], (1.2, 1.9));
}

#[test]
fn curves_become_short_lines() {
    let circle = &strokes(r#"<circle cx="2000" cy="1000" r="500"/>"#)[0];
    assert_eq!(circle.first(), circle.last());
    assert_eq!(circle.len(), 64);
    for &(x, y) in circle {
        let away = Point::planar(x, y).distance(Point::planar(2.0, 2.0));
        assert!((away - 0.5).abs() < 1e-9, "{away}");
    }
    let curve = &strokes(r#"<path d="M 0 3000 C 0 2000 1000 2000 1000 3000"/>"#)[0];
    assert_eq!(curve.last(), Some(&(1.0, 0.0)));
    let middle = curve[curve.len() / 2];
    assert!(
        (middle.0 - 0.5).abs() < 0.02 && (middle.1 - 0.75).abs() < 0.02,
        "{middle:?}"
    );
}

#[test]
fn transforms_of_groups_apply() {
    let drawn = strokes(
        r#"<g transform="translate(1000 0)"><line transform="scale(2)" x1="0" y1="0" x2="100" y2="1500"/></g>"#,
    );
    assert_eq!(drawn, [[(1.0, 3.0), (1.2, 0.0)]]);
}

#[test]
fn unsupported_drawings_are_reported_with_their_position() {
    for (svg, says) in [
        ("<svg viewBox='0 0 1 1'>", "this is not a drawing in SVG"),
        ("<svg/>", "the drawing has no size"),
        ("<svg height='2in'/>", "the drawing has no size"),
        (
            "<svg height='9'>\n<text>hi</text></svg>",
            "drawing.svg:2:1: `text` has no lines",
        ),
        (
            "<svg height='9'><line x1='1cm'/></svg>",
            "x1=\"1cm\" is not a number",
        ),
        (
            "<svg height='9'><path d='M 1 1 L x'/></svg>",
            "the path cannot be read",
        ),
        (
            "<svg height='9'><path transform='turn(1)' d='M 1 1 L 2 2'/></svg>",
            "transform=",
        ),
    ] {
        let problems = way_points(svg).expect_err(svg);
        assert!(problems.contains(says), "{svg}: {problems}");
    }
}
