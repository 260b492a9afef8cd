//! Finding MAVLink messages in a datagram never panics; those that are found come back the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_mavlink::wire;

fuzz_target!(|bytes: &[u8]| {
    let mut again = Vec::new();
    let found = wire::decode(bytes);
    for (header, message) in &found {
        wire::encode(*header, message, &mut again);
    }
    assert_eq!(wire::decode(&again).len(), found.len());
});
