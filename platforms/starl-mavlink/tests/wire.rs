//! MAVLink in datagrams: encoding and decoding agree, altered datagrams are dropped, and any bytes are handled.

use mavlink::MavHeader;
use starl_core::Random;
use starl_mavlink::autopilot::Mode;
use starl_mavlink::common::{ATTITUDE_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavMessage};
use starl_mavlink::{Autopilot, wire};

fn header(sequence: u8) -> MavHeader {
    MavHeader {
        system_id: 1,
        component_id: 1,
        sequence,
    }
}

fn messages() -> Vec<MavMessage> {
    vec![
        MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode: 77,
            ..HEARTBEAT_DATA::DEFAULT
        }),
        MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            param7: 1.5,
            target_system: 1,
            ..COMMAND_LONG_DATA::DEFAULT
        }),
        MavMessage::ATTITUDE(ATTITUDE_DATA {
            yaw: -1.25,
            ..ATTITUDE_DATA::DEFAULT
        }),
    ]
}

fn datagram() -> Vec<u8> {
    let mut out = Vec::new();
    for (sequence, message) in (0..).zip(messages()) {
        wire::encode(header(sequence), &message, &mut out);
    }
    out
}

#[test]
fn messages_of_a_datagram_are_decoded() {
    let sent: Vec<_> = (0..).map(header).zip(messages()).collect();
    assert_eq!(wire::decode(&datagram()), sent);
}

#[test]
fn message_with_a_wrong_bit_is_dropped() {
    let [message, ..] = &messages()[..] else {
        panic!("there are messages");
    };
    let mut right = Vec::new();
    wire::encode(header(3), message, &mut right);
    for bit in 0..8 * right.len() {
        let mut wrong = right.clone();
        wrong[bit / 8] ^= 1 << (bit % 8);
        // The byte of compatible flags may be anything by the protocol, but the checksum covers it.
        assert_eq!(wire::decode(&wrong), [], "bit {bit}");
    }
}

#[test]
fn messages_between_noise_are_found() {
    let mut random = Random::keyed(10, &[]);
    for _ in 0..2000 {
        let length = random.below(60);
        let mut bytes: Vec<u8> = (0..length).map(|_| random.bits() as u8).collect();
        // A start of a message in the noise could swallow the first real one.
        bytes.retain(|&byte| byte != 0xFD);
        bytes.extend(datagram());
        assert_eq!(wire::decode(&bytes).len(), 3);
    }
}

#[test]
fn any_bytes_are_decoded_without_a_panic() {
    let mut random = Random::keyed(11, &[]);
    let seed = datagram();
    for _ in 0..200_000 {
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
        assert!(wire::decode(&bytes).len() <= 3);
    }
}

#[test]
fn modes_are_decoded_from_their_numbers_and_requests() {
    for autopilot in [Autopilot::Px4, Autopilot::ArduPilot] {
        for mode in [Mode::Hold, Mode::External, Mode::Land, Mode::Other(1234)] {
            assert_eq!(
                autopilot.mode(autopilot.number(mode)),
                mode,
                "{autopilot:?}"
            );
        }
        for mode in [Mode::Hold, Mode::External, Mode::Land] {
            let [second, third] = autopilot.request(mode);
            assert_eq!(autopilot.mode(autopilot.requested(second, third)), mode);
        }
        assert_eq!(Autopilot::of(autopilot.name()), Some(autopilot));
    }
    // Offboard is main mode 6 of PX4, Guided mode 4 of ArduCopter.
    assert_eq!(Autopilot::Px4.number(Mode::External), 0x0006_0000);
    assert_eq!(Autopilot::ArduPilot.number(Mode::External), 4);
}
