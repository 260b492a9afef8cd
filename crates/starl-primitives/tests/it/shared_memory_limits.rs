//! Initial values are older than any write, and writes that cannot be kept or sent are refused.

use crate::harness;
use starl_core::{Payload, RobotId};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::{Options, WriteError};

fn bytes(value: &[u8]) -> Payload {
    value.into()
}

#[test]
fn an_initial_value_is_read_until_something_is_written() {
    let mut memory = SharedMemory::new("memory", Options::default());
    harness::alone(0, |robot| {
        assert_eq!(memory.read("a"), None);
        memory.initialize(robot, "a", bytes(b"first"));
        assert_eq!(memory.read("a"), Some(&b"first"[..]));
        assert_eq!(memory.stamp("a"), None);
        assert_eq!(memory.read_of("a", RobotId(1)), None);
        memory.initialize_elements(robot, "a", bytes(b"each"));
        assert_eq!(memory.read_of("a", RobotId(1)), Some(&b"each"[..]));
        assert_eq!(memory.all("a").count(), 0);
        let stamp = memory.write(robot, "a", bytes(b"second")).unwrap();
        assert_eq!(memory.read("a"), Some(&b"second"[..]));
        assert_eq!(memory.stamp("a"), Some(stamp));
        memory.initialize(robot, "a", bytes(b"too late"));
        assert_eq!(memory.read("a"), Some(&b"second"[..]));
        memory.write_own(robot, "a", bytes(b"mine")).unwrap();
        assert_eq!(memory.read_of("a", RobotId(0)), Some(&b"mine"[..]));
        assert_eq!(memory.read_of("a", RobotId(1)), Some(&b"each"[..]));
        assert_eq!(
            memory.all("a").collect::<Vec<_>>(),
            [(RobotId(0), &b"mine"[..])]
        );
    });
}

#[test]
fn each_write_has_a_later_stamp() {
    let mut memory = SharedMemory::new("memory", Options::default());
    harness::alone(0, |robot| {
        let stamps: Vec<_> = (0..100)
            .map(|n: u8| memory.write(robot, "a", bytes(&[n / 2])).unwrap())
            .collect();
        assert!(stamps.is_sorted_by(|earlier, later| earlier < later));
    });
}

#[test]
fn values_that_cannot_be_kept_or_sent_are_rejected() {
    let options = Options {
        longest_value: 10,
        most_elements: 2,
        ..Options::default()
    };
    let mut memory = SharedMemory::new("memory", options);
    harness::alone(0, |robot| {
        let long_name = "n".repeat(256);
        let refused = memory.write(robot, &long_name, bytes(b""));
        assert_eq!(refused, Err(WriteError::NameTooLong));
        assert!(memory.write(robot, &long_name[..255], bytes(b"")).is_ok());
        let refused = memory.write(robot, "a", bytes(&[0; 11]));
        assert_eq!(refused, Err(WriteError::ValueTooLong));
        assert!(memory.write(robot, "a", bytes(&[0; 10])).is_ok());
        let refused = memory.write_own(robot, "a", bytes(b"x"));
        assert_eq!(refused, Err(WriteError::Full));
        assert!(memory.write(robot, "a", bytes(b"again")).is_ok());
        assert_eq!(memory.elements(), 2);
    });
}
