//! Packets of strangers never panic, and none of them is taken for a robot's content.
//!
//! Pieces of the input are sent to one end of an established session, to one that waits for the answer to its
//! handshake, and to one without keys. The first byte says how long the pieces are.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::Time;
use starl_node::link::channel::{Channel, Opened};
use starl_node::link::frame::Frame;

fuzz_target!(|bytes: &[u8]| {
    let Some((&size, bytes)) = bytes.split_first() else {
        return;
    };
    let end = |me| Channel::new(me, "fleet", vec![[7; 32]]);
    let (mut one, mut other, mut waiting) = (end(0), end(1), end(2));
    one.want(1);
    waiting.want(1);
    waiting.due(Time::ZERO);
    for (_, packet) in one.due(Time::ZERO) {
        if let Opened::Handshake {
            answer: Some(answer),
            ..
        } = other.open(Time::ZERO, &packet)
        {
            one.open(Time::ZERO, &answer);
        }
    }
    let sealed = one.seal(1, b"content").expect("there is a session");
    assert!(matches!(
        other.open(Time::ZERO, &sealed),
        Opened::Content { .. }
    ));
    let mut open = Channel::new(3, "fleet", Vec::new());
    for piece in bytes.chunks(1 + usize::from(size)) {
        for channel in [&mut one, &mut other, &mut waiting] {
            assert!(!matches!(
                channel.open(Time::ZERO, piece),
                Opened::Content { .. }
            ));
        }
        if let Opened::Content { content, .. } = open.open(Time::ZERO, piece) {
            let _ = postcard::from_bytes::<Frame>(&content);
        }
        if let Ok(frame) = postcard::from_bytes::<Frame>(piece) {
            let again = postcard::to_allocvec(&frame).expect("it is finite");
            let read: Frame = postcard::from_bytes(&again).expect("it was encoded here");
            assert_eq!(format!("{read:?}"), format!("{frame:?}"));
        }
    }
    // The session still works.
    let sealed = one.seal(1, b"more").expect("there is a session");
    assert!(matches!(
        other.open(Time::ZERO, &sealed),
        Opened::Content { .. }
    ));
});
