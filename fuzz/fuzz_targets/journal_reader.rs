//! Reading the journal of a robot never panics.
//!
//! The first byte says where the input is cut into two messages. Seeds: the messages on `/starl/inputs` of a trace.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::{RobotId, Time};
use starl_host::journal::Reader;

fuzz_target!(|bytes: &[u8]| {
    let Some((&cut, bytes)) = bytes.split_first() else {
        return;
    };
    let (first, second) = bytes.split_at(bytes.len() * usize::from(cut) / 256);
    let mut reader = Reader::new(RobotId(0));
    for message in [first, second] {
        // Its output is read to the last byte.
        let read = reader.read(Time::ZERO, message, &mut |at, observed| {
            assert!(!format!("{at:?} {observed:?}").is_empty());
        });
        if read.is_err() {
            return;
        }
    }
});
