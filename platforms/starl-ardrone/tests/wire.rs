//! The wire formats of the AR.Drone: encoding and decoding agree, and altered datagrams are dropped.

use starl_ardrone::at::{self, AtCommand, Tilt};
use starl_ardrone::navdata::{ControlState, Demo, Navdata};
use starl_core::Random;

fn line(sequence: u32, command: &AtCommand) -> String {
    let mut out = String::new();
    command.encode(sequence, &mut out);
    out
}

#[test]
fn lines_are_those_of_the_developer_guide() {
    let refer = |fly, emergency| AtCommand::Reference { fly, emergency };
    assert_eq!(line(1, &refer(true, false)), "AT*REF=1,290718208\r");
    assert_eq!(line(2, &refer(false, false)), "AT*REF=2,290717696\r");
    assert_eq!(line(3, &refer(false, true)), "AT*REF=3,290717952\r");
    let tilt = Tilt {
        climb: -0.8,
        ..Tilt::default()
    };
    let fly = AtCommand::Fly(Some(tilt));
    assert_eq!(line(4, &fly), "AT*PCMD=4,1,0,0,-1085485875,0\r");
    assert_eq!(line(5, &AtCommand::Watchdog), "AT*COMWDG=5\r");
    let configure = AtCommand::Configure {
        key: "general:navdata_demo".into(),
        value: "TRUE".into(),
    };
    assert_eq!(
        line(6, &configure),
        "AT*CONFIG=6,\"general:navdata_demo\",\"TRUE\"\r"
    );
}

#[test]
fn commands_of_a_datagram_are_decoded() {
    let tilt = Tilt {
        roll: 0.25,
        pitch: -1.0,
        climb: 1e-3,
        yaw: 0.0,
    };
    let sent = [
        AtCommand::Reference {
            fly: true,
            emergency: true,
        },
        AtCommand::Fly(Some(tilt)),
        AtCommand::Fly(None),
        AtCommand::FlatTrim,
        AtCommand::Watchdog,
        AtCommand::Configure {
            key: "control:euler_angle_max".into(),
            value: "0.25".into(),
        },
        AtCommand::AcknowledgementSeen,
    ];
    let mut datagram = String::new();
    for (number, command) in (7..).zip(&sent) {
        command.encode(number, &mut datagram);
    }
    let numbered: Vec<_> = (7..).zip(sent).collect();
    assert_eq!(at::decode(datagram.as_bytes()), numbered);
}

#[test]
fn lines_that_do_not_fit_are_left_out() {
    let nan = f32::NAN.to_bits() as i32;
    for line in [
        "AT*REF=1,",
        "AT*REF=,5\r",
        "AT*REF=1\r",
        "AT*REF=1,x\r",
        "AT*REF=1,290718208",
        "AT*PCMD=1,1,0,0,0\r",
        "AT*CONFIG=1,\"a\r",
        "AT*CTRL=1,4,0\r",
        "AT*FLY=1\r",
        "REF=1,5\r",
        "\r\r",
        &format!("AT*PCMD=1,1,{nan},0,0,0\r"),
    ] {
        assert_eq!(at::decode(line.as_bytes()), [], "{line:?}");
    }
    // A number beyond the greatest is flown as the greatest.
    let huge = 1e9f32.to_bits();
    let [(1, AtCommand::Fly(Some(tilt)))] =
        at::decode(format!("AT*PCMD=1,1,{huge},0,0,0\r").as_bytes())[..]
    else {
        panic!("it is not understood");
    };
    assert_eq!(tilt.roll, 1.0);
}

fn navdata() -> Navdata {
    Navdata {
        state: 0x8000_0401,
        sequence: 77,
        demo: Some(Demo {
            control: ControlState::Hovering,
            battery: 64,
            pitch: -1500.0,
            roll: 250.5,
            yaw: 179_000.0,
            altitude: 1234,
            velocity: [100.0, -20.0, 3.0],
        }),
    }
}

#[test]
fn navdata_is_decoded() {
    let with = navdata();
    let without = Navdata { demo: None, ..with };
    for sent in [with, without] {
        assert_eq!(Navdata::decode(&sent.encode()), Some(sent));
    }
}

#[test]
fn navdata_that_is_cut_off_or_altered_is_dropped() {
    let right = navdata().encode();
    for length in 0..right.len() {
        assert_eq!(Navdata::decode(&right[..length]), None, "{length} bytes");
    }
    for bit in 0..8 * right.len() {
        let mut wrong = right.clone();
        wrong[bit / 8] ^= 1 << (bit % 8);
        assert_eq!(Navdata::decode(&wrong), None, "bit {bit}");
    }
}

#[test]
fn any_bytes_are_decoded_without_a_panic() {
    let mut random = Random::keyed(8, &[]);
    let datagram = navdata().encode();
    let text = line(1, &AtCommand::Fly(Some(Tilt::default())));
    for _ in 0..200_000 {
        for seed in [&datagram[..], text.as_bytes(), &[]] {
            let mut bytes = seed.to_vec();
            for _ in 0..1 + random.below(4) {
                let at = random.below(bytes.len() as u32 + 1) as usize;
                match random.below(3) {
                    0 => bytes.insert(at, random.bits() as u8),
                    1 if at < bytes.len() => bytes[at] = random.bits() as u8,
                    _ => bytes.truncate(at),
                }
            }
            let _ = Navdata::decode(&bytes);
            for (_, command) in at::decode(&bytes) {
                if let AtCommand::Fly(Some(Tilt { roll, .. })) = command {
                    assert!((-1.0..=1.0).contains(&roll));
                }
            }
        }
    }
}
