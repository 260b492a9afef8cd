//! Decoding AT commands and navdata of the AR.Drone never panics; what is understood comes back the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_ardrone::at;
use starl_ardrone::navdata::Navdata;

fuzz_target!(|bytes: &[u8]| {
    let commands = at::decode(bytes);
    let mut text = String::new();
    for (sequence, command) in &commands {
        command.encode(*sequence, &mut text);
    }
    assert_eq!(at::decode(text.as_bytes()), commands);
    if let Some(navdata) = Navdata::decode(bytes) {
        assert_eq!(Navdata::decode(&navdata.encode()), Some(navdata));
    }
});
