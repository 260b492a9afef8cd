//! A robot's memory is bounded, for any number of sent, lost and repeated messages, and with garbage.

use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{
    Duration, Effect, Estimate, Input, Message, Payload, Port, Random, Robot, RobotId, Sensors,
    Time, View,
};
use starl_primitives::reliable::{Notice, Options, Reliable};

const PORT: Port = Port::named("memory");
const FLEET: [RobotId; 2] = [RobotId(0), RobotId(1)];

/// Runs `act` on an end of the protocol at robot `id`; what it transmits is returned.
fn with<T>(
    id: u32,
    random: &mut Random,
    act: impl FnOnce(&mut Robot<'_>) -> T,
) -> (T, Vec<Payload>) {
    let obstacles: Obstacles = [].into();
    let view = View {
        id: RobotId(id),
        now: Time::ZERO,
        estimate: Estimate::default(),
        body: Body {
            radius: 0.1,
            height: 0.1,
            workspace: Workspace::Ground,
        },
        sensors: Sensors::default(),
        fleet: &FLEET,
        way_points: &[],
        obstacles: &obstacles,
    };
    let mut effects = Effects::default();
    let result = act(&mut Robot::new(&view, &mut effects, random));
    let transmitted = effects.list.into_iter().filter_map(|effect| match effect {
        Effect::Transmit { payload, .. } => Some(payload),
        _ => None,
    });
    (result, transmitted.collect())
}

fn message(from: u32, payload: Payload) -> Input {
    Input::Message(Message {
        from: RobotId(from),
        port: PORT,
        payload,
    })
}

fn size(end: &Reliable) -> usize {
    format!("{end:?}").len()
}

/// Two ends that have greeted each other: the first sends to the second.
fn acquainted(options: Options, random: &mut Random) -> (Reliable, Reliable) {
    let mut sender = Reliable::new(PORT, options);
    let mut receiver = Reliable::new(PORT, options);
    let (_, sent) = with(0, random, |robot| {
        sender.send(robot, RobotId(1), Payload::new())
    });
    let mut to = 1;
    let mut flying = sent[0].clone();
    for _ in 0..3 {
        let input = message(1 - to, flying);
        let end = if to == 1 { &mut receiver } else { &mut sender };
        let (_, mut sent) = with(to, random, |robot| end.handle(robot, &input));
        to = 1 - to;
        flying = match sent.pop() {
            Some(payload) => payload,
            // It answers a little later.
            None => return (sender, receiver),
        };
    }
    (sender, receiver)
}

#[test]
fn gaps_and_messages_held_back_are_limited() {
    for first_in_first_out in [false, true] {
        let options = Options {
            first_in_first_out,
            window: 16,
            most_outstanding: 5000,
            ..Options::default()
        };
        let mut random = Random::keyed(1, &[]);
        let (mut sender, mut receiver) = acquainted(options, &mut random);
        let mut after_100 = 0;
        let mut taken = 0;
        for number in 0..4000 {
            let content = Payload::from_slice(&[7; 20]);
            let (_, sent) = with(0, &mut random, |robot| {
                sender.send(robot, RobotId(1), content)
            });
            // Every other datagram is lost permanently.
            if number % 2 == 1 {
                let input = message(0, sent[0].clone());
                let (notices, _) = with(1, &mut random, |robot| receiver.handle(robot, &input));
                taken += notices.len();
            }
            if number == 100 {
                after_100 = size(&receiver);
            }
        }
        assert!(
            size(&receiver) <= after_100 + 50,
            "{} and {after_100}",
            size(&receiver)
        );
        assert_eq!(taken, if first_in_first_out { 0 } else { 8 });
    }
}

#[test]
fn settled_messages_leave_nothing_behind() {
    let mut random = Random::keyed(1, &[]);
    // An answer to each message at once.
    let options = Options {
        first_timeout: Duration(0),
        ..Options::default()
    };
    let (mut sender, mut receiver) = acquainted(options, &mut random);
    let mut after_10 = (0, 0);
    for number in 1..=3000 {
        let content = Payload::from_slice(&[7; 20]);
        let ((id, _), sent) = with(0, &mut random, |robot| {
            sender.send(robot, RobotId(1), content)
        });
        let input = message(0, sent[0].clone());
        let (_, answer) = with(1, &mut random, |robot| receiver.handle(robot, &input));
        assert_eq!(answer.len(), 1);
        assert!(answer[0].len() <= 11, "answers are small");
        let input = message(1, answer[0].clone());
        let (notices, _) = with(0, &mut random, |robot| sender.handle(robot, &input));
        assert_eq!(notices.last(), Some(&Notice::Acknowledged(id)));
        assert!(!sender.is_outstanding(id));
        if number == 10 {
            after_10 = (size(&sender), size(&receiver));
        }
    }
    assert!(
        size(&sender) <= after_10.0 + 10,
        "a counter has grown by two digits"
    );
    assert!(size(&receiver) <= after_10.1 + 10);
}

#[test]
fn garbage_does_no_harm() {
    let mut random = Random::keyed(1, &[]);
    let (mut sender, mut receiver) = acquainted(Options::default(), &mut random);
    let mut garbage = Random::keyed(2, &[]);
    let content = Payload::from_slice(b"content");
    let (_, genuine) = with(0, &mut random, |robot| {
        sender.send(robot, RobotId(1), content)
    });
    let mut arrived = 0;
    for _ in 0..20_000 {
        let mut bytes = genuine[0].clone();
        for _ in 0..=garbage.below(3) {
            let at = garbage.below(bytes.len() as u32) as usize;
            bytes[at] = garbage.bits() as u8;
        }
        bytes.truncate(1 + garbage.below(30) as usize);
        let from = garbage.below(4);
        let input = message(from, bytes);
        let (notices, _) = with(1, &mut random, |robot| receiver.handle(robot, &input));
        assert!(
            from == 0 || notices.is_empty(),
            "only the other robot of the fleet is heard"
        );
        arrived += notices.len();
    }
    assert!(arrived > 0, "some of it looks like messages");
    assert!(size(&receiver) < 5_000, "{}", size(&receiver));
}
