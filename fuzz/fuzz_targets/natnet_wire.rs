//! Decoding NatNet in any version never panics, and takes no more memory than the datagram is long.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_natnet::Message;

fuzz_target!(|bytes: &[u8]| {
    for version in [(3, 0), (3, 1), (4, 0), (4, 1)] {
        match Message::decode(bytes, version) {
            Some(Message::Frame(frame)) => assert!(38 * frame.bodies.len() <= bytes.len()),
            Some(Message::Descriptions(bodies)) => assert!(5 * bodies.len() <= bytes.len()),
            _ => {}
        }
    }
});
