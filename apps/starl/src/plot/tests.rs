//! Required parts of a picture, for any input.

use super::*;
use starl_core::ConvexPolygon;

fn robot(name: &str, model: &str, path: Vec<Point>) -> RobotPath {
    RobotPath {
        name: name.into(),
        model: model.into(),
        radius: 0.17,
        flies: false,
        detector: None,
        path: (0..)
            .zip(path)
            .map(|(second, position)| place(second, position))
            .collect(),
        marks: BTreeMap::new(),
    }
}

fn place(second: u64, position: Point) -> Place {
    Place {
        at: Time(second * 1_000_000_000),
        position,
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
        collisions: vec![place(1, Point::planar(1.0, 1.0))],
        ..PlotData::default()
    }
}

fn thing(name: &str, position: Point) -> Thing {
    Thing {
        name: name.into(),
        position,
        is_gone: false,
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
        let path = data.robots[0].path.iter();
        let path: Vec<Point> = path.map(|place| place.position).collect();
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
            let corner = Point::planar(f64::from(at % 100), f64::from(at / 100));
            robot(
                &format!("r{at}"),
                if at % 4 == 0 { "car" } else { "create" },
                vec![corner, corner],
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
            let far = Point::planar(x, 1.0);
            let mut data = race();
            data.arena = Some((far, Point::ZERO));
            data.collisions.push(place(1, far));
            data.way_points[0].position = far;
            data.radio_range = Some(radius);
            data.things = vec![thing("far", far)];
            data.crashes = vec![Crash {
                robot: 9,
                place: place(2, far),
                restarted: Some(Time::NEVER),
            }];
            data.robots[0].path = vec![place(1, far); 3];
            data.robots[1].path = Vec::new();
            data.robots[2].path.insert(1, place(1, far));
            data.robots[3].radius = radius;
            data.robots[3].detector = Some(radius);
            data.obstacles.push(Obstacle::circle(far, radius));
            data.obstacles.push(Obstacle::cuboid(Point::ZERO, far));
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
fn drawings_of_programs_are_shown() {
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

#[test]
fn things_crashes_times_and_ranges_are_shown_and_explained() {
    let mut data = race();
    data.things = vec![thing("cup", Point::planar(0.5, 1.5))];
    data.things.push(Thing {
        is_gone: true,
        ..thing("cap", Point::planar(1.5, 1.5))
    });
    data.crashes.push(Crash {
        robot: 2,
        place: place(1, Point::planar(1.0, 2.0)),
        restarted: Some(Time(12_340_000_000)),
    });
    data.robots[1].detector = Some(0.8);
    data.radio_range = Some(1.25);
    let picture = svg(&data);
    assert_sound(&picture);
    for text in [
        "cup",
        "create2 down 1 s to 12.3 s",
        "0.5 s",
        "every 0.5 s",
        "detector, 0.8 m",
        "radio, 1.25 m",
        "thing",
        "thing was here",
        "crash \u{d7} 1",
        "collision \u{d7} 1",
    ] {
        assert!(
            picture.contains(&format!(">{text}<")),
            "no {text}: {picture}"
        );
    }
    let circles = |data: &PlotData, radius: f64| {
        let frame = frame::Frame::around(data);
        let sought = radius * frame.scale;
        let shapes = scene::draw(data).shapes.into_iter();
        let is_one = |shape: &drawing::Shape| matches!(shape, drawing::Shape::Circle { radius, .. } if (radius - sought).abs() < 1e-9);
        shapes.filter(is_one).count()
    };
    assert_eq!((circles(&data, 0.8), circles(&data, 1.25)), (1, 4));
    let crowd: Vec<RobotPath> = data.robots.iter().cycle().take(40).cloned().collect();
    data.robots = crowd;
    assert_eq!((circles(&data, 0.8), circles(&data, 1.25)), (0, 0));
    assert!(svg(&data).contains(">radio, 1.25 m (not drawn)<"));
}

#[test]
fn a_dot_lies_where_the_robot_was_at_its_time() {
    let mut data = race();
    let at = |x| Point::planar(x, 0.0);
    // It rests from 2 s to 6 s, and continues at 1 m/s.
    let path = [(0, at(0.0)), (2, at(2.0)), (6, at(2.0)), (8, at(4.0))];
    data.robots.truncate(1);
    data.robots[0].path = path
        .map(|(second, position)| place(second, position))
        .into();
    let frame = frame::Frame::around(&data);
    let shapes = scene::draw(&data).shapes.into_iter();
    let dots: Vec<f64> = shapes
        .filter_map(|shape| match shape {
            drawing::Shape::Circle { center, radius, .. } if radius == times::RADIUS => {
                Some((center.0 - frame.spot(Point::ZERO).0) / frame.scale)
            }
            _ => None,
        })
        .collect();
    // The last is the sample of the legend.
    let (sample, dots) = dots.split_last().unwrap();
    assert!(*sample > 4.0);
    let expected = [1.0, 2.0, 3.0, 4.0];
    assert_eq!(dots.len(), expected.len(), "{dots:?}");
    for (dot, expected) in dots.iter().zip(expected) {
        assert!((dot - expected).abs() < 1e-9, "{dots:?}");
    }
}

#[test]
fn a_large_world_is_shown_where_robots_move() {
    let mut data = race();
    let near = frame::Frame::around(&data);
    assert!(near.world.is_none());
    data.arena = Some((Point::planar(-20.0, 0.0), Point::planar(60.0, 80.0)));
    data.way_points[0].position = Point::planar(59.0, 79.0);
    let far = frame::Frame::around(&data);
    assert!(far.scale > near.scale / 2.0, "{} {}", far.scale, near.scale);
    for robot in &data.robots {
        assert!(robot.path.iter().all(|place| far.has(&place.position)));
    }
    let picture = svg(&data);
    assert_sound(&picture);
    assert!(
        picture.contains(">more world: 80 m by 80.2 m<"),
        "{picture}"
    );
    assert!(picture.contains(">waypoint, 1 of 2 shown<"));
    assert!(!picture.contains(">A<") && picture.contains(">C<"));
    // Where no robot moves there is nothing to look at closely.
    for robot in &mut data.robots {
        robot.path.truncate(1);
    }
    assert!(frame::Frame::around(&data).world.is_none());
}

/// The rectangle of a text, with its width in DejaVu Sans if the build draws PNG.
fn covered(shape: &drawing::Shape) -> Option<(f64, f64, f64, f64)> {
    let drawing::Shape::Text {
        at,
        anchor,
        text,
        size,
        ..
    } = shape
    else {
        return None;
    };
    #[cfg(feature = "png")]
    let width = raster::width(text, *size);
    #[cfg(not(feature = "png"))]
    let width = text_width(text, *size);
    assert!(width <= text_width(text, *size), "{text}");
    let left = match anchor {
        drawing::Anchor::Start => at.0,
        drawing::Anchor::Middle => at.0 - width / 2.0,
        drawing::Anchor::End => at.0 - width,
    };
    Some((left, at.1 - size * 0.8, left + width, at.1 + size * 0.2))
}

#[test]
fn no_text_lies_over_another_or_leaves_the_picture() {
    let names = [
        "WWWWWWWWWWWWWWWWWWWW",
        "il",
        "\u{673a}\u{5668}\u{4eba}",
        "a name that is much too long to be written out in full",
    ];
    for (count, size) in [(1, 1.0), (4, 1e-3), (9, 1e6), (24, 30.0), (60, 3.0)] {
        let mut data = race();
        data.title = names[count % 4].repeat(9);
        data.robots = (0..count)
            .map(|at| {
                let y = at as f64 * size / 9.0;
                let path = vec![Point::planar(0.0, y), Point::planar(size, y)];
                robot(names[at % 4], &format!("model{}", at / 2), path)
            })
            .collect();
        data.way_points.clear();
        data.obstacles.clear();
        for at in 0..10 {
            let spot = place(at, Point::planar(size * 0.5, size * at as f64 / 90.0));
            data.collisions.push(spot);
            data.things
                .push(thing(names[at as usize % 4], spot.position));
        }
        let picture = scene::draw(&data);
        let texts: Vec<_> = picture.shapes.iter().filter_map(covered).collect();
        for (index, a) in texts.iter().enumerate() {
            let (width, height) = picture.size;
            let is_inside = a.0 >= 0.0 && a.1 >= 0.0 && a.2 <= width && a.3 <= height;
            assert!(
                is_inside,
                "{count} robots: {a:?} outside of {width} by {height}"
            );
            for b in &texts[..index] {
                let is_over = a.0 < b.2 && b.0 < a.2 && a.1 < b.3 && b.1 < a.3;
                assert!(!is_over, "{count} robots: {a:?} over {b:?}");
            }
        }
    }
}
