//! CRTP: the bytes of Bitcraze's documents, encoding and decoding agree, and any bytes are handled.

use starl_core::Random;
use starl_crazyflie::Packet;
use starl_crazyflie::commander::{Order, SetPoint};
use starl_crazyflie::log::{Answer, Request, kind};

fn set_points() -> Vec<SetPoint> {
    vec![
        SetPoint::Stop,
        SetPoint::Velocity {
            velocity: [0.5, -0.25, 0.125],
            yaw_rate: 30.0,
        },
        SetPoint::Height {
            roll: 1.0,
            pitch: -2.0,
            yaw_rate: 3.0,
            height: 0.5,
        },
        SetPoint::Climb {
            roll: 1.0,
            pitch: -2.0,
            yaw_rate: 3.0,
            climb: 0.25,
        },
        SetPoint::Hover {
            velocity: [0.5, -0.5],
            yaw_rate: -10.0,
            height: 1.0,
        },
        SetPoint::Position {
            position: [1.0, 2.0, 3.0],
            yaw: 90.0,
        },
    ]
}

fn orders() -> Vec<Order> {
    vec![
        Order::ReleaseSetPoints,
        Order::TakeOff {
            height: 0.5,
            duration: 2.0,
        },
        Order::Land { duration: 2.0 },
        Order::GoTo {
            relative: true,
            position: [1.0, 0.0, 0.5],
            yaw: 0.5,
            duration: 3.0,
        },
        Order::Stop,
        Order::Arm(true),
    ]
}

fn requests() -> Vec<Request> {
    vec![
        Request::Info,
        Request::Item(517),
        Request::Reset,
        Request::Create {
            block: 1,
            variables: vec![(kind::F32, 300), (kind::I16, 2)],
        },
        Request::Start {
            block: 1,
            period: 5,
        },
        Request::Stop(1),
        Request::Delete(1),
    ]
}

fn answers() -> Vec<Answer> {
    vec![
        Answer::Info {
            count: 600,
            checksum: 0xDEAD_BEEF,
        },
        Answer::Item {
            number: 258,
            kind: kind::F32,
            name: "stateEstimate.x".into(),
        },
        Answer::Done {
            request: 6,
            block: 1,
            error: 17,
        },
        Answer::Values {
            block: 1,
            time_ms: 0x0012_3456,
            values: vec![1, 2, 3],
        },
    ]
}

#[test]
fn packets_are_decoded() {
    let wire = |packet: Packet| Packet::decode(&packet.encode()).expect("it is a packet");
    for set_point in set_points() {
        assert_eq!(SetPoint::decode(&wire(set_point.encode())), Some(set_point));
    }
    for order in orders() {
        assert_eq!(Order::decode(&wire(order.encode())), Some(order));
    }
    for request in requests() {
        assert_eq!(Request::decode(&wire(request.encode())), Some(request));
    }
    for answer in answers() {
        assert_eq!(Answer::decode(&wire(answer.encode())), Some(answer));
    }
}

#[test]
fn bytes_are_those_of_the_documents() {
    let bytes = |packet: Packet| packet.encode();
    // Port 7, channel 0, kind 8, four floats.
    let velocity = SetPoint::Velocity {
        velocity: [1.0, 0.0, 0.0],
        yaw_rate: 0.0,
    };
    assert_eq!(bytes(velocity.encode())[..6], [0x7C, 8, 0, 0, 0x80, 0x3F]);
    // Port 8, command 7, group, height, yaw, whether to keep the yaw, duration.
    let up = bytes(
        Order::TakeOff {
            height: 1.0,
            duration: 1.0,
        }
        .encode(),
    );
    assert_eq!(
        up,
        [
            &[0x8C, 7, 0, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 1][..],
            &[0, 0, 0x80, 0x3F]
        ]
        .concat()
    );
    assert_eq!(bytes(Request::Item(258).encode()), [0x5C, 2, 2, 1]);
    assert_eq!(bytes(Order::Arm(true).encode()), [0xDC, 1, 1]);
}

#[test]
fn malformed_packets_are_rejected() {
    assert_eq!(Packet::decode(&[]), None);
    assert_eq!(Packet::decode(&[0xFF]), None, "a null packet");
    assert_eq!(Packet::decode(&[0x7C; 32]), None, "too long");
    let mut wrong = SetPoint::Position {
        position: [0.0; 3],
        yaw: 0.0,
    }
    .encode();
    wrong.content[1..5].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(SetPoint::decode(&wrong), None, "NaN");
}

#[test]
fn any_bytes_are_decoded_without_a_panic() {
    let mut random = Random::keyed(12, &[]);
    let mut seeds: Vec<Vec<u8>> = set_points()
        .iter()
        .map(|one| one.encode().encode())
        .collect();
    seeds.extend(orders().iter().map(|one| one.encode().encode()));
    seeds.extend(requests().iter().map(|one| one.encode().encode()));
    seeds.extend(answers().iter().map(|one| one.encode().encode()));
    for _ in 0..300_000 {
        let mut bytes = seeds[random.below(seeds.len() as u32) as usize].clone();
        for _ in 0..1 + random.below(4) {
            let place = random.below(bytes.len() as u32) as usize;
            bytes[place] = random.bits() as u8;
        }
        bytes.truncate(random.below(bytes.len() as u32 + 1) as usize);
        if let Some(packet) = Packet::decode(&bytes) {
            let _ = (SetPoint::decode(&packet), Order::decode(&packet));
            let _ = (Request::decode(&packet), Answer::decode(&packet));
        }
    }
}
