//! Tells stories as streams of records and lets the checkers judge them.

use starl_core::event::{Event, Fault, Fields, Hit, PrimitiveEvent, Value};
use starl_core::motion::{Body, Workspace};
use starl_core::{Area, Destination, Duration, Obstacle, Point, Port, Pose, Record, RobotId, Time};
use starl_properties::{Checker, Excuse, Setting, Violation, Watch, checkers};

/// The engine's step: how often checkers receive the time.
const STEP_MS: u64 = 25;

/// A ground robot.
pub const GROUND: Body = Body {
    radius: 0.2,
    height: 0.1,
    workspace: Workspace::Ground,
};

/// A robot that flies at 1 m or higher.
pub const FLYER: Body = Body {
    radius: 0.3,
    height: 0.2,
    workspace: Workspace::Air { lowest: 1.0 },
};

/// The events of a run, in any order.
#[derive(Clone)]
pub struct Story {
    pub setting: Setting,
    records: Vec<Record>,
}

pub fn ms(millis: u64) -> Time {
    Time::ZERO + Duration::from_millis(millis)
}

pub fn seconds(seconds: u64) -> Duration {
    Duration::from_seconds(seconds)
}

/// A point on the floor.
pub fn at(x: f64, y: f64) -> Point {
    Point::planar(x, y)
}

impl Story {
    /// Of these robots in an empty world.
    pub fn of(bodies: &[Body]) -> Story {
        Story {
            setting: Setting {
                bodies: bodies.to_vec(),
                ..Setting::default()
            },
            records: Vec::new(),
        }
    }

    /// A story of this number of ground robots in an empty world.
    pub fn of_ground_robots(robots: usize) -> Story {
        Story::of(&vec![GROUND; robots])
    }

    /// Something happens.
    pub fn record(&mut self, millis: u64, robot: Option<u32>, event: Event) -> &mut Story {
        self.records.push(Record {
            at: ms(millis),
            robot: robot.map(RobotId),
            event,
        });
        self
    }

    /// A robot's true pose.
    pub fn moved(&mut self, millis: u64, robot: u32, place: Point) -> &mut Story {
        self.record(millis, Some(robot), Event::Moved(Pose::level(place, 0.0)))
    }

    /// A robot stands still, with a pose every 100 ms, both ends included.
    pub fn stays(&mut self, from: u64, to: u64, robot: u32, place: Point) -> &mut Story {
        self.walks(from, to, robot, place, place)
    }

    /// A robot moves straight at constant speed, with a pose every 100 ms, both ends included.
    pub fn walks(
        &mut self,
        from: u64,
        to: u64,
        robot: u32,
        start: Point,
        end: Point,
    ) -> &mut Story {
        for millis in (from..=to).step_by(100) {
            let fraction = (millis - from) as f64 / (to - from) as f64;
            self.moved(millis, robot, start.lerp(end, fraction));
        }
        self
    }

    pub fn collided(&mut self, millis: u64, robot: u32, with: Hit) -> &mut Story {
        self.record(millis, Some(robot), Event::Collided { with })
    }

    /// A fault of a robot, or of the world.
    pub fn fault(&mut self, millis: u64, robot: Option<u32>, name: &'static str) -> &mut Story {
        self.record(millis, robot, Event::Fault(Fault::named(name.into())))
    }

    /// A primitive of a robot reports something.
    pub fn report<const N: usize>(
        &mut self,
        millis: u64,
        robot: u32,
        (primitive, name): (&'static str, &'static str),
        fields: [(&'static str, Value); N],
    ) -> &mut Story {
        let fields: Fields = fields
            .into_iter()
            .map(|(name, value)| (name.into(), value))
            .collect();
        let port = Port::named(primitive);
        let event = PrimitiveEvent::named(primitive, name, fields);
        assert!(
            !matches!(event, PrimitiveEvent::Other(_)),
            "no checker knows {event:?}"
        );
        self.record(millis, Some(robot), Event::Primitive { port, event })
    }

    /// A robot is sent to a target, vicinity 0.1 m.
    pub fn starts(
        &mut self,
        millis: u64,
        robot: u32,
        target: Point,
        unsafe_set: &[Obstacle],
    ) -> &mut Story {
        let fields = [
            ("target", target.into()),
            ("vicinity", 0.1.into()),
            ("unsafe_set", Value::Obstacles(unsafe_set.into())),
        ];
        self.report(millis, robot, ("reach_avoid", "start"), fields)
    }

    /// A robot's ReachAvoid comes to an end.
    pub fn ends(&mut self, millis: u64, robot: u32, how: &'static str) -> &mut Story {
        let how = ("reach_avoid", how);
        match how.1 {
            "stop" => self.report(millis, robot, how, []),
            "give_up" => self.report(millis, robot, how, [("reason", "stuck".into())]),
            _ => self.report(millis, robot, how, [("position", Point::ZERO.into())]),
        }
    }

    /// A robot sends its message of this number to all.
    pub fn broadcasts(&mut self, millis: u64, robot: u32, number: u32) -> &mut Story {
        self.report(
            millis,
            robot,
            ("broadcast", "broadcast"),
            [
                ("number", number.into()),
                ("incarnation", 7u32.into()),
                ("retry_span", 4.0.into()),
            ],
        )
    }

    /// A robot sends its message of this number to an area, and repeats it for 4 s.
    pub fn geocasts(&mut self, millis: u64, robot: u32, number: u32, area: Area) -> &mut Story {
        self.report(
            millis,
            robot,
            ("geocast", "geocast"),
            [
                ("number", number.into()),
                ("incarnation", 7u32.into()),
                ("retry_span", 4.0.into()),
                ("area", area.into()),
            ],
        )
    }

    /// A message reaches a robot.
    pub fn delivers(
        &mut self,
        millis: u64,
        robot: u32,
        primitive: &'static str,
        (from, number): (u32, u32),
    ) -> &mut Story {
        self.report(
            millis,
            robot,
            (primitive, "deliver"),
            [
                ("from", RobotId(from).into()),
                ("number", number.into()),
                ("incarnation", 7u32.into()),
            ],
        )
    }

    /// A robot gives up a broadcast to some.
    pub fn fails(&mut self, millis: u64, robot: u32, number: u32, to: &[u32]) -> &mut Story {
        let to: Vec<RobotId> = to.iter().copied().map(RobotId).collect();
        self.report(
            millis,
            robot,
            ("broadcast", "fail"),
            [
                ("number", number.into()),
                ("incarnation", 7u32.into()),
                ("to", to.into()),
            ],
        )
    }

    /// A robot has a shared memory.
    pub fn shares(&mut self, millis: u64, robot: u32) -> &mut Story {
        self.report(millis, robot, ("shared_memory", "start"), [])
    }

    /// A robot's shared memory reports a write to a variable: its time by the writer's clock, its
    /// writer, and its value.
    pub fn shows(
        &mut self,
        millis: u64,
        robot: u32,
        name: &'static str,
        variable: &'static str,
        (written, writer, value): (u64, u32, i64),
    ) -> &mut Story {
        let fields = [
            ("variable", variable.trim_end_matches("[]").into()),
            ("single_writer", variable.ends_with("[]").into()),
            ("time", ms(written).into()),
            ("count", 0u32.into()),
            ("writer", RobotId(writer).into()),
            ("incarnation", 0u32.into()),
            ("value", value.into()),
        ];
        self.report(millis, robot, ("shared_memory", name), fields)
    }

    /// A robot's mutex reports something of a resource.
    pub fn locks(
        &mut self,
        millis: u64,
        robot: u32,
        name: &'static str,
        resource: &'static str,
    ) -> &mut Story {
        self.report(
            millis,
            robot,
            ("mutex", name),
            [("resource", resource.into())],
        )
    }

    /// A robot gets a resource for a lease, with a number, for clocks with a drift of at most 0.01.
    pub fn leases(
        &mut self,
        millis: u64,
        robot: u32,
        resource: &'static str,
        number: i64,
    ) -> &mut Story {
        let fields = [
            ("resource", resource.into()),
            ("fencing", number.into()),
            ("drift", 0.01.into()),
        ];
        self.report(millis, robot, ("mutex", "enter"), fields)
    }

    /// A datagram reaches a robot.
    pub fn sends(&mut self, millis: u64, from: u32, sequence: u32, to: u32) -> &mut Story {
        let sent = Event::Sent {
            sequence,
            destination: Destination::All,
            port: Port::named("shared_memory"),
            payload: Default::default(),
        };
        let from_id = RobotId(from);
        let delivered = Event::Delivered {
            from: from_id,
            sequence,
        };
        self.record(millis, Some(from), sent);
        self.record(millis + 30, Some(to), delivered)
    }

    /// The verdict at the end of a run of this length. It is the same for a live run and for a trace.
    pub fn verdict(&self, end: u64) -> Vec<Violation> {
        let mut records = self.records.clone();
        records.sort_by_key(|record| (record.at, record.robot));
        let mut live = checkers(&self.setting);
        let mut read = live.clone();
        let (mut seen_live, mut seen_read) = (Vec::new(), Vec::new());
        let mut rest = &records[..];
        for now in (0..=end).step_by(STEP_MS as usize) {
            let (these, later) = rest.split_at(rest.partition_point(|r| r.at <= ms(now)));
            rest = later;
            feed(&mut live, these, ms(now), &mut seen_live);
        }
        assert!(rest.is_empty(), "the story goes on after its end");
        feed(&mut read, &records, ms(end), &mut seen_read);
        let key = |violation: &Violation| (violation.property.clone(), violation.at);
        seen_live.sort_by_key(key);
        seen_read.sort_by_key(key);
        assert_eq!(seen_live, seen_read);
        seen_live
    }

    fn watched(&self, end: u64) -> Watch {
        let mut records = self.records.clone();
        records.sort_by_key(|record| (record.at, record.robot));
        let mut watch = Watch::new(checkers(&self.setting));
        watch.observe(&records, ms(end));
        watch
    }

    /// The properties that apply until then.
    pub fn applying(&self, end: u64) -> Vec<String> {
        let verdicts = self.watched(end).verdicts().into_iter();
        let applying = verdicts.filter(|verdict| verdict.used);
        applying
            .map(|verdict| verdict.property.to_string())
            .collect()
    }

    /// The excuses of a property until then, by reason.
    pub fn excused(&self, end: u64, property: &str) -> Vec<(Excuse, u64)> {
        let excused = self.watched(end).excused().into_iter();
        excused
            .filter(|(of, ..)| of == property)
            .map(|(_, excuse, count)| (excuse, count))
            .collect()
    }
}

fn feed(
    checkers: &mut [Box<dyn Checker>],
    records: &[Record],
    now: Time,
    violations: &mut Vec<Violation>,
) {
    for checker in checkers {
        for record in records {
            checker.observe(record, violations);
        }
        checker.advance(now, violations);
    }
}

/// There is this one violation.
#[track_caller]
pub fn assert_only(violations: &[Violation], property: &str, millis: u64, robots: &[u32]) {
    let [violation] = violations else {
        panic!("not one violation: {violations:#?}");
    };
    let ids: Vec<RobotId> = robots.iter().copied().map(RobotId).collect();
    assert_eq!(
        (&*violation.property, violation.at, &violation.robots),
        (property, ms(millis), &ids),
        "{}",
        violation.text,
    );
}

/// Nothing is violated.
#[track_caller]
pub fn assert_none(violations: &[Violation]) {
    assert_eq!(violations, []);
}
