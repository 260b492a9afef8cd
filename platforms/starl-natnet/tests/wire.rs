//! The wire format of NatNet: encoding and decoding agree in each version, and any bytes are handled.

use starl_core::Random;
use starl_natnet::{Frame, Message, RigidBody, ServerInfo, Version};

const VERSIONS: [Version; 4] = [(3, 0), (3, 1), (4, 0), (4, 1)];

fn frame() -> Frame {
    let body = |number| RigidBody {
        number,
        position: [1.5, -2.0, 0.25],
        rotation: [0.0, 0.0, 0.6, 0.8],
        error: 0.001,
        tracked: number == 2,
    };
    Frame {
        number: 9,
        bodies: vec![body(2), body(700)],
        timestamp: 12.5,
        exposed: 1_000_000,
        sent: 6_000_000,
    }
}

fn messages() -> Vec<Message> {
    vec![
        Message::Connect,
        Message::ServerInfo(ServerInfo {
            application: "Motive".into(),
            version: (4, 1),
            ticks_per_second: 10_000_000,
        }),
        Message::RequestDescriptions,
        Message::Descriptions(vec![(2, "r1".into()), (700, "".into())]),
        Message::Frame(frame()),
        Message::KeepAlive,
        Message::Unrecognized,
    ]
}

#[test]
fn messages_are_decoded_in_each_version() {
    for version in VERSIONS {
        for sent in messages() {
            let datagram = sent.encode(version);
            assert_eq!(
                Message::decode(&datagram, version),
                Some(sent),
                "{version:?}"
            );
        }
    }
}

/// Puts one section: a count, in newer versions a length, and content.
fn section(version: Version, count: u32, content: &[u8], out: &mut Vec<u8>) {
    out.extend(count.to_le_bytes());
    if version >= (4, 1) {
        out.extend((content.len() as u32).to_le_bytes());
    }
    out.extend(content);
}

fn datagram(number: u16, body: &[u8]) -> Vec<u8> {
    let mut out = number.to_le_bytes().to_vec();
    out.extend((body.len() as u16).to_le_bytes());
    out.extend(body);
    out
}

/// A frame as a busy studio sends it: something in every section.
fn busy(version: Version) -> Vec<u8> {
    let body = |number: u32| {
        let mut bytes = number.to_le_bytes().to_vec();
        for value in [1.5f32, -2.0, 0.25, 0.0, 0.0, 0.6, 0.8, 0.001] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(1u16.to_le_bytes());
        bytes
    };
    let one = 1u32.to_le_bytes();
    let mut out = 9u32.to_le_bytes().to_vec();
    let set = [b"all\0".as_slice(), &2u32.to_le_bytes(), &[7; 24]].concat();
    section(version, 1, &set, &mut out);
    section(version, 3, &[7; 36], &mut out);
    section(version, 1, &body(2), &mut out);
    let skeleton = [&one[..], &2u32.to_le_bytes(), &body(3), &body(4)].concat();
    section(version, 1, &skeleton, &mut out);
    if version >= (4, 1) {
        section(version, 1, &[5; 77], &mut out);
    }
    section(version, 2, &[7; 52], &mut out);
    let plate = [&one[..], &one, &2u32.to_le_bytes(), &[7; 8]].concat();
    section(version, 1, &plate, &mut out);
    section(version, 1, &plate, &mut out);
    out.extend([0; 8]);
    out.extend(12.5f64.to_le_bytes());
    for stamp in [100u64, 200, 300] {
        out.extend(stamp.to_le_bytes());
    }
    out.extend([0; 14]);
    datagram(7, &out)
}

#[test]
fn other_sections_are_passed_over() {
    for version in VERSIONS {
        let Some(Message::Frame(frame)) = Message::decode(&busy(version), version) else {
            panic!("{version:?} is not understood");
        };
        let numbers: Vec<u32> = frame.bodies.iter().map(|body| body.number).collect();
        assert_eq!(numbers, [2], "{version:?}");
        assert_eq!(frame.timestamp, 12.5, "{version:?}");
        assert_eq!((frame.exposed, frame.sent), (100, 300), "{version:?}");
    }
}

#[test]
fn names_are_found_among_other_descriptions() {
    for version in VERSIONS {
        let set = [b"all\0".as_slice(), &1u32.to_le_bytes(), b"m1\0"].concat();
        let mut body = [b"r1\0".as_slice(), &5u32.to_le_bytes(), &[0; 16]].concat();
        body.extend(1u32.to_le_bytes());
        body.extend([0; 16]);
        if version >= (4, 0) {
            body.extend(b"m1\0");
        }
        let mut out = 3u32.to_le_bytes().to_vec();
        for (kind, content) in [(0u32, &set), (1, &body), (2, &vec![9; 11])] {
            out.extend(kind.to_le_bytes());
            if version >= (4, 1) {
                out.extend((content.len() as u32).to_le_bytes());
            }
            out.extend(content);
        }
        let found = Message::decode(&datagram(5, &out), version);
        assert_eq!(
            found,
            Some(Message::Descriptions(vec![(5, "r1".into())])),
            "{version:?}"
        );
    }
}

#[test]
fn any_bytes_are_decoded_without_a_panic() {
    let mut random = Random::keyed(9, &[]);
    for version in VERSIONS {
        let mut seeds: Vec<_> = messages()
            .iter()
            .map(|message| message.encode(version))
            .collect();
        seeds.push(busy(version));
        for _ in 0..50_000 {
            let mut bytes = seeds[random.below(seeds.len() as u32) as usize].clone();
            for _ in 0..1 + random.below(6) {
                let at = random.below(bytes.len() as u32 + 1) as usize;
                match random.below(4) {
                    0 => bytes.insert(at, random.bits() as u8),
                    1 => bytes.truncate(at),
                    _ if at < bytes.len() => bytes[at] = random.bits() as u8,
                    _ => {}
                }
            }
            if let Some(Message::Frame(frame)) = Message::decode(&bytes, version) {
                assert!(38 * frame.bodies.len() <= bytes.len());
            }
        }
    }
}
