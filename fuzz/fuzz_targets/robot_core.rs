//! The runtime of a robot does not panic, whatever arrives from the network, the device and the localisation. The robot's
//! positions and commands remain finite numbers.
//!
//! The input is a list of events, each with a kind and its content. The robot has two others, a program with messages and
//! primitives, and a network without keys, so that everything that a key would keep out arrives.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::motion::Path;
use starl_core::sensor::Contact;
use starl_core::{Command, Estimate, Event, Point, Pose, RobotId, Saved, Time};
use starl_host::hardware::Drive;
use starl_host::{PlanJob, StoreJob};
use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::robot::{Code, RobotProgram};
use starl_motion::Neighbour;
use starl_node::Reading;
use starl_node::link::{Arrival, Channel, Member, OPERATORS, Origin};
use starl_node::motors::Report;
use starl_node::robot::{Core, Equipment, Incoming};
use starl_node::writer::Written;
use std::sync::{Arc, OnceLock};
use std::time::Instant;
use support::{Notes, at, setup};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../platforms/starl-node/tests/it/support/mod.rs"]
mod support;

const PROGRAM: &str = r#"
program Listener

record Pair {first: Int, second: Point?}
message Numbers(numbers: List[Int], name: String)
message Pairs(pairs: Map[String, Pair], late: Duration, to: RobotId)

motion = ReachAvoid()
radio = Broadcast()
around = Geocast()
lock = Mutex("door", peers)
head = LeaderElection(peers)
allwrite board: List[String] = []
allread place[RobotId]: Point
heard: Int = 0

on Numbers(from, numbers, name)
    heard += numbers.size() + name.size()

on Pairs(from, pairs, late, to)
    heard += pairs.size()

go()
    pre not motion.active
    eff motion.reach_avoid(Point(1.0, 1.0), obstacles())

look()
    eff
        place = position
        heard += board.size()
"#;

/// Refuses commands and estimates with numbers that are not finite.
struct Checks;

impl Equipment for Checks {
    fn saved(&self) -> Option<Arc<Saved>> {
        None
    }

    fn has_fixes(&self) -> bool {
        true
    }

    fn drive(&mut self, command: Command, estimate: &Estimate) {
        let text = format!("{command:?} {estimate:?}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }

    fn stop(&mut self) {}

    fn end(&mut self) {}

    fn find(&mut self, _: PlanJob, _: Vec<Neighbour>) {}

    fn write(&mut self, _: StoreJob) {}

    fn send(&mut self, _: Member, _: &[u8]) -> std::io::Result<()> {
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

/// The rest of the input.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn number(&mut self) -> Option<f64> {
        // Most numbers are small, and some are any number.
        let small = self.byte()?;
        if small != 255 {
            return Some(0.1 * (f64::from(small) - 127.0));
        }
        let (number, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(f64::from_le_bytes(*number))
    }

    fn point(&mut self) -> Option<Point> {
        Some(Point::new(self.number()?, self.number()?, self.number()?))
    }

    fn pose(&mut self) -> Option<Pose> {
        Some(Pose::level(self.point()?, self.number()?))
    }

    fn packet(&mut self) -> Option<Vec<u8>> {
        let from = self.byte()?;
        let from = u32::from(from % 16) + if from >= 128 { OPERATORS } else { 0 };
        let length = usize::from(self.byte()?).min(self.0.len());
        let (content, rest) = self.0.split_at(length);
        self.0 = rest;
        // The mark of a packet without protection, and the sender.
        let mut packet = vec![4];
        packet.extend(from.to_le_bytes());
        packet.extend(content);
        Some(packet)
    }

    fn reading(&mut self) -> Option<Reading> {
        let parts = self.byte()?;
        let has = |bit: u8| parts & (1 << bit) != 0;
        let mut reading = Reading::default();
        if has(0) {
            reading.moved = Some(self.point()?);
        }
        if has(1) {
            reading.turned = Some(self.number()?);
        }
        if has(2) {
            reading.velocity = Some(self.point()?);
        }
        if has(3) {
            reading.height = Some(self.number()?);
        }
        if has(4) {
            reading.heading = Some(self.number()?);
        }
        if has(5) {
            let bearing = self.number()?;
            reading.bumper = Some(Some(Contact { bearing }));
        }
        if has(6) {
            reading.battery = Some(self.number()?);
        }
        Some(reading)
    }

    /// The next event, and whether time passes after it.
    fn event(&mut self, now: Time) -> Option<(Incoming, bool)> {
        let kind = self.byte()?;
        let incoming = match kind % 8 {
            0..=2 => Incoming::Packet(Arrival {
                at: Instant::now(),
                origin: Origin::Named,
                packet: self.packet()?,
            }),
            3 => Incoming::Device(Report::Measured(now, self.reading()?)),
            4 => Incoming::Device(Report::Seen(now, self.pose()?)),
            5 => {
                let robot = RobotId(u32::from(self.byte()? % 4));
                Incoming::Device(Report::SawOther(robot, now, self.pose()?))
            }
            6 => Incoming::Planned(u32::from(self.byte()?), None::<Path>),
            _ => Incoming::Written(Written::Done(self.byte()?.into())),
        };
        Some((incoming, kind >= 64))
    }
}

fn code() -> &'static Code {
    static CODE: OnceLock<Code> = OnceLock::new();
    CODE.get_or_init(|| {
        let bytecode = compile(&check(PROGRAM, &NoLibraries));
        let bytecode = bytecode.unwrap_or_else(|problems| panic!("{problems:#?}"));
        Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"))
    })
}

fuzz_target!(|bytes: &[u8]| {
    let program = RobotProgram::new(code(), &[]).expect("it has no parameters");
    let mut setup = setup(program);
    setup.bodies = vec![setup.hardware.body; 3];
    setup.sensors.bumper = true;
    setup.hardware.drive = Some(Drive {
        model: starl_motion::models::by_name("create").expect("there is such a model"),
        avoidance: Some(Default::default()),
        position_error: 0.0,
        seed: 1,
    });
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(at(0), setup, channel, Checks, Notes::default());
    let (mut bytes, mut ms) = (Bytes(bytes), 0);
    core.step(at(ms), &mut Vec::new());
    while let Some((incoming, passes)) = bytes.event(at(ms)) {
        ms += if passes { 10 } else { 0 };
        core.step(at(ms), &mut vec![incoming]);
    }
    for (_, event) in core.end(at(ms)).0 {
        if let Event::Moved(pose) = event {
            assert!(
                pose.position.is_finite() && pose.yaw.is_finite(),
                "{pose:?}"
            );
        }
    }
});
