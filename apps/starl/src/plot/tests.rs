//! Required parts of a picture, for any input.

use super::*;
use starl_core::ConvexPolygon;

fn robot(name: &str, model: &str, path: Vec<Point>) -> RobotPath {
    RobotPath {
        name: name.into(),
        model: model.into(),
        radius: 0.17,
        flies: false,
        path,
        marks: BTreeMap::new(),
    }
}

fn race() -> PlotData {
    let low = Point::planar(0.3, 1.0);
    let wall = ConvexPolygon::rectangle(low, Point::planar(1.5, 1.2)).unwrap();
    let way_point = |name: &str, x, y| WayPoint {
        name: name.into(),
        position: Point::planar(x, y),
        group: 0,
    };
    PlotData {
        title: "Race & <co>".into(),
        subtitle: "seed 1".into(),
        obstacles: vec![Obstacle::polygon(wall)],
        way_points: vec![way_point("A", 0.594, 0.508), way_point("C", 2.517, 2.734)],
        robots: (0..4)
            .map(|at| {
                let y = f64::from(at);
                let path = vec![
                    Point::planar(0.0, y),
                    Point::planar(1.0, y),
                    Point::planar(2.0, 0.5),
                ];
                robot(&format!("create{at}"), "create", path)
            })
            .collect(),
        collisions: vec![Point::planar(1.0, 1.0)],
        ..PlotData::default()
    }
}

/// The elements are closed in order, and no number is missing.
fn assert_sound(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let name = tag.split([' ', '>', '/']).next().unwrap();
        if let Some(closed) = tag.strip_prefix('/') {
            let closed = closed.split('>').next().unwrap();
            assert_eq!(open.pop(), Some(closed), "in {tag}");
        } else if !tag.split('>').next().unwrap().ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?} left open");
    for bad in ["NaN", "inf"] {
        assert!(!svg.contains(bad), "{bad} in the picture");
    }
}

#[test]
fn every_robot_has_a_path_in_its_own_colour_and_a_line_in_the_legend() {
    for count in [1, 4, 8, 9, 24] {
        let mut data = race();
        let path = data.robots[0].path.clone();
        data.robots = (0..count)
            .map(|at| robot(&format!("r{at}"), "m", path.clone()))
            .collect();
        let svg = svg(&data);
        assert_sound(&svg);
        let mut colors: Vec<_> = (0..count).map(|at| palette::color(at, count)).collect();
        colors.sort();
        colors.dedup();
        assert_eq!(colors.len(), count);
        for at in 0..count {
            assert!(
                svg.contains(&format!(">r{at} (m)<")),
                "robot {at} of {count}"
            );
        }
    }
}

#[test]
fn names_cannot_break_the_file() {
    let mut data = race();
    data.robots[0].name = "<script>\"&'\u{0}\n".into();
    data.way_points[0].name = "]]>".into();
    let svg = svg(&data);
    assert_sound(&svg);
    assert!(svg.contains("Race &amp; &lt;co&gt;"));
    assert!(!svg.contains("<script"));
}

#[test]
fn a_large_fleet_is_shown_by_model() {
    let mut data = race();
    data.robots = (0..10_000u32)
        .map(|at| {
            let place = Point::planar(f64::from(at % 100), f64::from(at / 100));
            robot(
                &format!("r{at}"),
                if at % 4 == 0 { "car" } else { "create" },
                vec![place, place],
            )
        })
        .collect();
    let svg = svg(&data);
    assert_sound(&svg);
    assert!(svg.contains(">car \u{d7} 2500<") && svg.contains(">create \u{d7} 7500<"));
    assert!(!svg.contains(">r17"));
}

#[test]
fn nothing_to_show_and_numbers_out_of_range_still_make_a_picture() {
    assert_sound(&svg(&PlotData::default()));
    let far = [
        f64::NAN,
        f64::INFINITY,
        -f64::INFINITY,
        f64::MAX,
        1e13,
        1e11,
        5e-324,
        0.0,
    ];
    for x in far {
        for radius in [f64::NAN, f64::INFINITY, 0.0, -1.0, 0.2] {
            let place = Point::planar(x, 1.0);
            let mut data = race();
            data.arena = Some((place, Point::ZERO));
            data.collisions.push(place);
            data.way_points[0].position = place;
            data.robots[0].path = vec![place; 3];
            data.robots[1].path = Vec::new();
            data.robots[2].path.insert(1, place);
            data.robots[3].radius = radius;
            data.obstacles.push(Obstacle::circle(place, radius));
            data.obstacles.push(Obstacle::cuboid(Point::ZERO, place));
            assert_sound(&svg(&data));
            #[cfg(feature = "png")]
            if radius == 0.2 {
                assert!(!png(&data).is_empty());
            }
        }
    }
}

#[test]
fn both_axes_have_one_scale() {
    let data = race();
    let frame = frame::Frame::around(&data);
    let origin = frame.spot(Point::ZERO);
    let (right, up) = (
        frame.spot(Point::planar(1.0, 0.0)),
        frame.spot(Point::planar(0.0, 1.0)),
    );
    assert!(((right.0 - origin.0) - (origin.1 - up.1)).abs() < 1e-9);
    assert!(
        right.0 > origin.0 && up.1 < origin.1,
        "x to the right, y up"
    );
    // A body is drawn as large as it is.
    let radius = format!(" r=\"{:.2}\"", 0.17 * frame.scale);
    assert!(
        svg(&data).contains(radius.trim_end_matches("0\"")),
        "{radius}"
    );
}

#[cfg(feature = "png")]
#[test]
fn a_png_shows_the_same_picture_with_text_on_a_machine_without_fonts() {
    let data = race();
    let pixels = tiny_skia::Pixmap::decode_png(&png(&data)).unwrap();
    let size = scene::draw(&data).size;
    assert_eq!(pixels.width(), 2 * size.0.ceil() as u32);
    let pixel = |(x, y): (f64, f64)| {
        let color = pixels.pixel((2.0 * x) as u32, (2.0 * y) as u32).unwrap();
        [color.red(), color.green(), color.blue()]
    };
    let frame = frame::Frame::around(&data);
    let near_obstacle = frame.spot(Point::planar(0.4, 1.15));
    assert_eq!(pixel(near_obstacle), palette::OBSTACLE);
    let (x, y) = frame.spot(data.way_points[1].position);
    assert_eq!(pixel((x - 7.0, y)), palette::WAY_POINT);
    assert_eq!(
        pixel(frame.spot(Point::planar(0.5, 3.0))),
        palette::color(3, 4)
    );
    // The heading's letters: black on white.
    let dark = (20..60).flat_map(|x| (20..50).map(move |y| (x, y)));
    let dark = dark
        .filter(|&(x, y)| pixels.pixel(x, y).unwrap().red() < 60)
        .count();
    assert!((50..900).contains(&dark), "{dark} dark pixels");
}

#[test]
fn what_programs_draw_is_shown() {
    let mut data = race();
    let plain = svg(&data);
    let corner = Point::planar(0.5, 2.0);
    let marks = [
        (
            "line",
            MarkShape::Line(vec![corner, Point::planar(1.5, 2.5)]),
        ),
        ("here <1>", MarkShape::Text(corner)),
        ("gone", MarkShape::Nothing),
        ("nowhere", MarkShape::Dot(Point::planar(f64::NAN, 0.0))),
    ];
    data.robots[0].marks = marks.map(|(label, mark)| (label.into(), mark)).into();
    let drawn = svg(&data);
    assert!(drawn.contains("here &lt;1&gt;"));
    assert!(!drawn.contains("gone") && !drawn.contains("nowhere"));
    let lines =
        |picture: &str| picture.matches("<polyline").count() + picture.matches("<path").count();
    assert_eq!(lines(&drawn), lines(&plain) + 1);
}
