//! The wire format of the Open Interface: encoding and decoding agree, with any other bytes on the line.

use starl_core::Random;
use starl_create::command::{CommandDecoder, OpenInterface};
use starl_create::sensor;
use starl_create::stream::{FrameDecoder, encode_frame};

fn noise(random: &mut Random, most: u32) -> Vec<u8> {
    let length = random.below(most);
    (0..length).map(|_| random.bits() as u8).collect()
}

fn command(random: &mut Random) -> OpenInterface {
    let mut word = || random.bits() as i16;
    let (a, b) = (word(), word());
    match random.below(14) {
        0 => OpenInterface::Reset,
        1 => OpenInterface::Start,
        2 => OpenInterface::Safe,
        3 => OpenInterface::Full,
        4 => OpenInterface::Passive,
        5 => OpenInterface::Drive {
            speed: a,
            radius: b,
        },
        6 => OpenInterface::DriveDirect { right: a, left: b },
        7 => OpenInterface::DrivePower { right: a, left: b },
        8 => OpenInterface::Sensors(a as u8),
        9 => OpenInterface::Query(noise(random, 300).into_iter().take(255).collect()),
        10 => OpenInterface::Stream(noise(random, 20)),
        11 => OpenInterface::StreamOn(a > 0),
        _ => OpenInterface::Stop,
    }
}

#[test]
fn commands_arrive_as_they_were_sent_in_pieces_of_any_size() {
    let mut random = Random::keyed(3, &[]);
    let sent: Vec<_> = (0..5000).map(|_| command(&mut random)).collect();
    let mut bytes = Vec::new();
    sent.iter().for_each(|command| command.encode(&mut bytes));
    let mut decoder = CommandDecoder::default();
    let mut arrived = Vec::new();
    let mut rest = &bytes[..];
    while !rest.is_empty() {
        let (piece, after) = rest.split_at(rest.len().min(1 + random.below(9) as usize));
        decoder.push(piece);
        arrived.extend(std::iter::from_fn(|| decoder.pop()));
        rest = after;
    }
    assert_eq!(arrived, sent);
}

#[test]
fn drive_commands_are_those_of_the_specification() {
    let bytes = |command: OpenInterface| {
        let mut out = Vec::new();
        command.encode(&mut out);
        out
    };
    // The example of the specification: -200 mm/s along a radius of 500 mm.
    let drive = OpenInterface::Drive {
        speed: -200,
        radius: 500,
    };
    assert_eq!(bytes(drive), [137, 255, 56, 1, 244]);
    let direct = OpenInterface::DriveDirect {
        right: 300,
        left: -1,
    };
    assert_eq!(bytes(direct), [145, 1, 44, 255, 255]);
    assert_eq!(bytes(OpenInterface::Query(vec![29, 13])), [149, 2, 29, 13]);
}

#[test]
fn command_gets_through_after_noise_if_it_is_repeated() {
    let mut random = Random::keyed(4, &[]);
    let wanted = OpenInterface::DriveDirect { right: 0, left: 0 };
    for _ in 0..2000 {
        let mut decoder = CommandDecoder::default();
        decoder.push(&noise(&mut random, 400));
        let mut repeated = Vec::new();
        // The longest command is a song of 255 notes.
        for _ in 0..120 {
            wanted.encode(&mut repeated);
        }
        decoder.push(&repeated);
        let last = std::iter::from_fn(|| decoder.pop()).last();
        assert_eq!(last.as_ref(), Some(&wanted));
    }
}

#[test]
fn groups_have_the_lengths_of_the_specification() {
    let groups = [
        (0, 26),
        (1, 10),
        (2, 6),
        (3, 10),
        (4, 14),
        (5, 12),
        (6, 52),
        (100, 80),
        (101, 28),
        (106, 12),
        (107, 9),
    ];
    for (group, wanted) in groups {
        let lengths = sensor::members(group).filter_map(sensor::length);
        assert_eq!(lengths.sum::<usize>(), wanted, "group {group}");
    }
}

#[test]
fn values_of_packets_are_decoded() {
    for packet in 7..=58 {
        for value in [0, 1, 77, -1, -128, -32_768, 255, 32_767, 65_535] {
            let mut bytes = Vec::new();
            sensor::encode(packet, value, &mut bytes);
            let Some(read) = sensor::value(packet, &bytes) else {
                panic!("packet {packet} has no length");
            };
            let mask = if bytes.len() == 1 { 0xFF } else { 0xFFFF };
            assert_eq!(read & mask, value & mask, "packet {packet}");
            assert!(
                read == value || !(0..=127).contains(&value),
                "packet {packet}"
            );
            assert_eq!(sensor::value(packet, &bytes[1..]), None);
        }
    }
}

const PACKETS: [u8; 4] = [43, 44, 7, 35];

fn frame(values: [i32; 4]) -> Vec<u8> {
    let mut content = Vec::new();
    for (packet, value) in PACKETS.into_iter().zip(values) {
        content.push(packet);
        sensor::encode(packet, value, &mut content);
    }
    let mut out = Vec::new();
    encode_frame(&content, &mut out);
    out
}

#[test]
fn every_frame_between_noise_is_found() {
    let mut random = Random::keyed(5, &[]);
    let mut decoder = FrameDecoder::new(&PACKETS);
    let (mut sent, mut found) = (Vec::new(), Vec::new());
    for count in 0..3000 {
        let values = [count, 65_535 - count, 3, 2];
        decoder.push(&noise(&mut random, 30));
        let frame = frame(values);
        let (head, tail) = frame.split_at(random.below(frame.len() as u32) as usize);
        decoder.push(head);
        found.extend(std::iter::from_fn(|| decoder.pop()));
        decoder.push(tail);
        found.extend(std::iter::from_fn(|| decoder.pop()));
        sent.push(values.to_vec());
    }
    assert_eq!(found, sent);
}

#[test]
fn frame_with_a_wrong_bit_is_dropped() {
    let right = frame([1000, 2000, 0, 2]);
    for bit in 0..8 * right.len() {
        let mut wrong = right.clone();
        wrong[bit / 8] ^= 1 << (bit % 8);
        let mut decoder = FrameDecoder::new(&PACKETS);
        decoder.push(&wrong);
        assert_eq!(decoder.pop(), None, "bit {bit}");
        decoder.push(&right);
        assert!(decoder.pop().is_some(), "bit {bit} hides the next frame");
    }
}
