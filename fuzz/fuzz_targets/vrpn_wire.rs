//! Reading the stream of a VRPN connection never panics, in pieces of any size.
//!
//! The first byte says how long the pieces are.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_vrpn::wire::{Decoder, Place, greeting};

fuzz_target!(|bytes: &[u8]| {
    let Some((&size, bytes)) = bytes.split_first() else {
        return;
    };
    let mut decoder = Decoder::default();
    decoder.push(&greeting());
    for piece in bytes.chunks(1 + usize::from(size)) {
        decoder.push(piece);
        while let Ok(Some(message)) = decoder.pop() {
            let _ = (message.name(), Place::decode(&message.body));
        }
    }
});
