//! The bytes of a journal do not change unnoticed.

use crate::support::{Deed, World, messages, read, said, saved, saves, wall};
use starl_core::motion::{PlanRequest, Planner};
use starl_core::sensor::{Contact, Detected, Detection, Ray};
use starl_core::{
    Command, Destination, Duration, Effect, Input, Message, MotionRequest, Payload, Point, Port,
    Random, RobotId, Time, TimerKey, random, timers,
};
use starl_host::journal::VERSION;

timers! {
    enum Alarm {
        Look(u32),
    }
}

fn inputs() -> Vec<Input> {
    let key = TimerKey::new(Port::named("x"), Alarm::Look(3));
    vec![
        Input::Start,
        Input::Activate,
        Input::Estimate,
        Input::Message(Message {
            from: RobotId(3),
            port: Port::PROGRAM,
            payload: Payload::from_slice(b"hello"),
        }),
        Input::Timer(key),
        Input::Planned {
            ticket: 1,
            path: Some(vec![Point::planar(1.0, 2.0)]),
        },
        Input::Suspected(RobotId(1)),
        Input::Trusted(RobotId(1)),
    ]
}

fn effects() -> Vec<Effect> {
    let key = TimerKey::new(Port::named("x"), Alarm::Look(3));
    let plan = PlanRequest {
        ticket: 1,
        target: Point::planar(3.0, 4.0),
        vicinity: 0.1,
        unsafe_set: [wall()].into(),
        around_robots: true,
        planner: Planner::RrtStar,
        most_nodes: 100,
        seed: 7,
    };
    vec![
        Effect::Transmit {
            destination: Destination::Robot(RobotId(2)),
            port: Port::PROGRAM,
            payload: Payload::from_slice(b"hello"),
        },
        Effect::SetTimer {
            key,
            after: Duration::from_millis(30),
        },
        Effect::CancelTimer(key),
        Effect::Move(MotionRequest::Drive(Command::TakeOff)),
        Effect::Move(MotionRequest::Plan(plan)),
        Effect::Move(MotionRequest::Track {
            target: Point::ZERO,
            next: None,
        }),
        Effect::Move(MotionRequest::Halt),
        said("a line"),
        Effect::Save(saves()[1].clone()),
        Effect::Finish,
        Effect::Fail("no way".into()),
    ]
}

/// Every kind of input and effect, with everything that a robot can know.
fn deeds() -> Vec<(Time, Deed)> {
    let random = Random::keyed(1, &[]);
    let mut world = World::default();
    let mut deeds = vec![
        (Time(5), Deed::Started(random.clone(), Some(saved()))),
        (Time(6), Deed::Corrupted(random)),
    ];
    for input in inputs() {
        world.now = Time(world.now.0 + 100);
        deeds.push((
            Time(7),
            Deed::Input(Box::new(world.clone()), input, effects()),
        ));
        world.estimate.twist.yaw += 0.25;
        world.bumper = Some(Contact { bearing: 0.5 });
        world.proximity = vec![Ray {
            bearing: 0.0,
            distance: 1.0,
            nearness: 0.25,
        }];
        world.detections = vec![Detection {
            what: Detected::Thing(2),
            position: Point::planar(1.0, 1.0),
        }];
    }
    deeds
}

/// A change of a type that a journal contains fails here, because older journals would have another
/// meaning then.
#[test]
fn the_bytes_are_those_of_this_version() {
    let messages = messages(&deeds(), 3);
    assert!(read(&messages).is_ok());
    let bytes: Vec<u64> = messages
        .iter()
        .flat_map(|(_, bytes)| bytes.iter().map(|&byte| u64::from(byte)))
        .collect();
    let hash = random::hash_key(u64::from(VERSION), &bytes);
    assert_eq!(
        (VERSION, bytes.len(), format!("{hash:016x}")),
        (1, 2103, "258e0ea7389ad225".to_string()),
        "raise starl_host::journal::VERSION if traces with the bytes of before have been handed out"
    );
}
