//! A small run with every kind of event in it, numbers at their extremes included.

use starl_core::event::{DropReason, Hit, Level, Mark, MarkShape};
use starl_core::event::{Fault, PrimitiveEvent, ReachAvoidEvent};
use starl_core::geometry::HeightSpan;
use starl_core::{
    Area, ConvexPolygon, Destination, Event, Fields, Obstacle, Payload, Point, Port, Pose, Record,
    RobotId, Time, Value, WayPoint,
};
use starl_trace::{Header, Outcome, RobotEntry, ViewOptions, Writer};

pub fn triangle() -> ConvexPolygon {
    let corners = [
        Point::planar(0.1, 0.2),
        Point::planar(1.5, 0.3),
        Point::planar(0.7, 1.9),
    ];
    ConvexPolygon::new(&corners).unwrap()
}

pub fn obstacles() -> Vec<Obstacle> {
    vec![
        Obstacle::polygon(triangle()),
        Obstacle::polygon(triangle()).with_height(HeightSpan::new(0.0, 0.7)),
        Obstacle::circle(Point::new(1.0 / 3.0, -2.5, 0.0), 0.25),
        Obstacle::circle(Point::planar(4.0, 4.0), 0.3).with_height(HeightSpan::new(0.5, 2.0)),
        Obstacle::cuboid(Point::new(-1.0, -1.0, 0.0), Point::new(-0.5, -0.2, 1.5)),
    ]
}

pub fn header() -> Header {
    let robot = |id: u32, name: &str, model: &str, flies| RobotEntry {
        id: RobotId(id),
        name: name.into(),
        model: model.into(),
        radius: 0.17,
        height: 0.07,
        flies,
    };
    Header {
        starl_version: "0.1.0".into(),
        program: "race".into(),
        seed: u64::MAX,
        scenario: "# \"race\"\n[network]\nloss = 0.2 # größer\n".into(),
        files: [("world.wpt".to_string(), "WAY,1,2,0,A\n".to_string())].into(),
        robots: vec![
            robot(0, "create0", "create", false),
            robot(1, "drone\"1", "drone", true),
        ],
        way_points: vec![WayPoint {
            name: "A".into(),
            position: Point::new(0.1, 2.0, 0.0),
            group: 3,
        }],
        obstacles: obstacles(),
        setting: "{\"step\":25}".into(),
    }
}

/// One or more records of each kind.
pub fn records() -> Vec<Record> {
    let events = every_event();
    let middle = events.len() as u64 / 2;
    (events.into_iter().enumerate())
        .map(|(index, event)| {
            let index = index as u64;
            // Times at both ends of the range.
            let at = if index < middle {
                Time(index * 33_333_333)
            } else {
                Time(u64::MAX - 99 + index)
            };
            let robot = match event {
                Event::Fault(_) | Event::Violated { .. } => None,
                Event::Sent { .. } => Some(RobotId(0)),
                _ => Some(RobotId(index as u32 % 2)),
            };
            Record { at, robot, event }
        })
        .collect()
}

pub fn poses() -> Vec<Pose> {
    let numbers = [
        0.0,
        -0.0,
        1.0 / 3.0,
        -1e-7,
        core::f64::consts::PI,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        1e21,
        123_456_789.123_456_78,
        f64::EPSILON,
        -f64::MAX,
    ];
    numbers
        .iter()
        .map(|&number| Pose {
            position: Point::new(number, -number, number / 7.0),
            yaw: number / 3.0,
            pitch: 0.1,
            roll: -0.2,
        })
        .collect()
}

fn every_event() -> Vec<Event> {
    let mut events: Vec<Event> = Vec::new();
    for pose in poses() {
        events.push(Event::Moved(pose));
        events.push(Event::Estimated(pose));
    }
    for length in 0..8u8 {
        events.push(Event::Sent {
            sequence: u32::MAX - u32::from(length),
            destination: if length % 2 == 0 {
                Destination::All
            } else {
                Destination::Robot(RobotId(u32::MAX))
            },
            port: Port(u32::MAX),
            payload: Payload::from_vec((0..length).map(|byte| byte.wrapping_mul(97)).collect()),
        });
    }
    events.push(Event::Delivered {
        from: RobotId(0),
        sequence: u32::MAX,
    });
    for reason in [
        DropReason::Loss,
        DropReason::Range,
        DropReason::Partition,
        DropReason::Down,
        DropReason::Bandwidth,
        DropReason::Size,
    ] {
        events.push(Event::Dropped {
            from: RobotId(0),
            to: Some(RobotId(1)),
            sequence: 7,
            reason,
        });
    }
    events.push(Event::Dropped {
        from: RobotId(0),
        to: None,
        sequence: u32::MAX,
        reason: DropReason::Range,
    });
    events.push(Event::Collided {
        with: Hit::Robot(RobotId(1)),
    });
    events.push(Event::Collided {
        with: Hit::Obstacle(4),
    });
    events.push(Event::Action("go \"home\"\\\n\t\u{1}ü🤖\u{7f}".into()));
    events.push(Event::Program {
        name: "empty".into(),
        fields: Fields::new(),
    });
    events.push(Event::Program {
        name: "full".into(),
        fields: every_value(),
    });
    // An event of another primitive, one that only looks like one of ours, and one that is.
    for primitive in ["elevator", "reach_avoid"] {
        events.push(Event::Primitive {
            port: Port::named(primitive),
            event: PrimitiveEvent::named(primitive, "done", every_value()),
        });
    }
    let done = ReachAvoidEvent::Done {
        position: Point::new(0.1, 0.2, 0.3),
    };
    events.push(Event::Primitive {
        port: Port::named("reach_avoid"),
        event: done.into(),
    });
    for level in [Level::Debug, Level::Info, Level::Warning, Level::Error] {
        events.push(Event::Log {
            level,
            text: "a line".into(),
        });
    }
    let here = Point::new(0.1, 0.2, 0.3);
    for shape in [
        MarkShape::Dot(here),
        MarkShape::Circle {
            center: here,
            radius: 0.5,
        },
        MarkShape::Line(vec![here, Point::ZERO, here]),
        MarkShape::Line(Vec::new()),
        MarkShape::Text(here),
        MarkShape::Nothing,
    ] {
        events.push(Event::Draw(Mark {
            label: "target".into(),
            shape,
        }));
    }
    events.push(Event::Fault(Fault::Crash));
    events.push(Event::Fault(Fault::Other("flat battery".into())));
    events.extend(obstacles().into_iter().map(Event::Discovered));
    events.push(Event::Finished);
    events.push(Event::Failed("no way".into()));
    events.push(Event::Violated {
        property: "no_collision".into(),
        text: "0 met 1".into(),
    });
    events.push(Event::Took(2));
    events.push(Event::PutDown {
        thing: 2,
        position: starl_core::Point::new(0.1, 0.2, 0.3),
    });
    let heal = starl_core::Intervention::Fault(starl_core::FaultKind::Heal);
    events.push(Event::Intervention(Box::new(heal)));
    events
}

fn every_value() -> Fields {
    let values: Vec<(&'static str, Value)> = vec![
        ("yes", true.into()),
        ("least", Value::Int(i64::MIN)),
        ("most", Value::Int(i64::MAX)),
        ("third", (1.0 / 3.0).into()),
        ("whole", 2.0.into()),
        ("minus zero", (-0.0).into()),
        ("infinite", f64::INFINITY.into()),
        ("infinite", f64::NEG_INFINITY.into()),
        ("text", "ü\"".into()),
        ("time", Time(u64::MAX).into()),
        ("point", Point::new(1e300, -1e-300, 0.0).into()),
        ("path", vec![Point::ZERO, Point::new(0.1, 0.2, 0.3)].into()),
        ("no path", Vec::<Point>::new().into()),
        ("robot", RobotId(u32::MAX).into()),
        ("robots", vec![RobotId(0), RobotId(9)].into()),
        ("obstacles", Value::Obstacles(obstacles().into())),
        (
            "circle",
            Area::Circle {
                center: Point::ZERO,
                radius: 1.5,
            }
            .into(),
        ),
        ("polygon", Area::Polygon(triangle()).into()),
        (
            "box",
            Area::Box {
                low: Point::ZERO,
                high: Point::new(1.0, 2.0, 3.0),
            }
            .into(),
        ),
    ];
    values
        .into_iter()
        .map(|(name, value)| (name.into(), value))
        .collect()
}

pub fn outcome() -> Outcome {
    Outcome {
        outcome: "finished".into(),
        digest: 0x0123_4567_89ab_cdef,
        end: Time(u64::MAX),
    }
}

/// The small run as a file.
pub fn file(options: &ViewOptions) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), &header(), options).unwrap();
    for record in records() {
        writer.write(&record).unwrap();
    }
    writer.finish(&outcome()).unwrap()
}

/// Where the checksums of attachments, chunks, the data section and the summary stand.
pub fn checksums(file: &[u8]) -> Vec<usize> {
    let mut found = Vec::new();
    let mut at = 8;
    while at + 9 < file.len() {
        let length = u64::from_le_bytes(file[at + 1..at + 9].try_into().unwrap()) as usize;
        let (body, end) = (at + 9, at + 9 + length);
        match file[at] {
            0x06 => found.push(body + 24),
            0x09 | 0x02 => found.push(end - 4),
            0x0f => found.push(body),
            _ => {}
        }
        at = end;
    }
    found
}
