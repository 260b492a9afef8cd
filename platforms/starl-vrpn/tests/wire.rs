//! The wire format of VRPN: what is encoded is decoded, in pieces of any size, and any bytes are taken.

use starl_core::Random;
use starl_vrpn::wire::{Broken, Decoder, KIND_NAME, Message, PLACE, Place, SENDER_NAME, greeting};

fn messages() -> Vec<Message> {
    let place = Place {
        sensor: 0,
        position: [1.5, -2.0, 0.25],
        rotation: [0.0, 0.0, 0.6, 0.8],
    };
    vec![
        Message::naming(KIND_NAME, 0, PLACE),
        Message::naming(SENDER_NAME, 3, "r1"),
        Message {
            time: (1_700_000_000, 999_999),
            sender: 3,
            kind: 0,
            body: place.encode(),
        },
        Message::default(),
    ]
}

fn stream() -> Vec<u8> {
    let mut out = greeting().to_vec();
    for message in messages() {
        message.encode(&mut out);
    }
    out
}

#[test]
fn messages_arrive_as_they_were_sent_in_pieces_of_any_size() {
    for size in 1..60 {
        let mut decoder = Decoder::default();
        let mut arrived = Vec::new();
        for piece in stream().chunks(size) {
            decoder.push(piece);
            while let Some(message) = decoder.pop().unwrap() {
                arrived.push(message);
            }
        }
        assert_eq!(arrived, messages(), "{size}");
    }
}

#[test]
fn names_and_places_come_back() {
    let [kind, sender, place, _] = &messages()[..] else {
        panic!("there are four");
    };
    assert_eq!(kind.name().as_deref(), Some(PLACE));
    assert_eq!(sender.name().as_deref(), Some("r1"));
    let place = Place::decode(&place.body).unwrap();
    assert_eq!(place.position, [1.5, -2.0, 0.25]);
    assert_eq!(place.rotation, [0.0, 0.0, 0.6, 0.8]);
    let not_a_number = Place {
        position: [f64::NAN, 0.0, 0.0],
        ..place
    };
    assert_eq!(Place::decode(&not_a_number.encode()), None);
}

#[test]
fn other_streams_are_rejected() {
    for start in [&b"HTTP/1.1"[..], b"vrpn: ver. 08.00", b"\0"] {
        let mut decoder = Decoder::default();
        decoder.push(start);
        assert_eq!(decoder.pop(), Err(Broken), "{start:?}");
    }
    for length in [0u32, 23, 5000, u32::MAX] {
        let mut decoder = Decoder::default();
        decoder.push(&greeting());
        decoder.push(&length.to_be_bytes());
        assert_eq!(decoder.pop(), Err(Broken), "{length}");
    }
}

#[test]
fn any_bytes_are_decoded_without_a_panic() {
    let mut random = Random::keyed(12, &[]);
    let seed = stream();
    for _ in 0..100_000 {
        let mut bytes = seed.clone();
        for _ in 0..1 + random.below(6) {
            let at = random.below(bytes.len() as u32 + 1) as usize;
            match random.below(4) {
                0 => bytes.insert(at, random.bits() as u8),
                1 => bytes.truncate(at),
                _ if at < bytes.len() => bytes[at] = random.bits() as u8,
                _ => {}
            }
        }
        let mut decoder = Decoder::default();
        decoder.push(&bytes);
        while let Ok(Some(message)) = decoder.pop() {
            let _ = (message.name(), Place::decode(&message.body));
        }
    }
}
