//! Decoding the Open Interface of the iRobot Create never panics, in either direction, in pieces of any size.
//!
//! The first byte says how long the pieces are.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_create::command::CommandDecoder;
use starl_create::sensor;
use starl_create::stream::FrameDecoder;

fuzz_target!(|bytes: &[u8]| {
    let Some((&size, bytes)) = bytes.split_first() else {
        return;
    };
    let mut commands = CommandDecoder::default();
    let mut frames = FrameDecoder::new(&[43, 44, 7, 35, 25, 26, 9, 10, 11, 12]);
    for piece in bytes.chunks(1 + usize::from(size)) {
        commands.push(piece);
        while let Some(command) = commands.pop() {
            let mut out = Vec::new();
            command.encode(&mut out);
            assert!(out.len() <= 257);
        }
        frames.push(piece);
        while let Some(values) = frames.pop() {
            assert_eq!(values.len(), 10);
        }
    }
    let _ = sensor::value(size, bytes);
});
