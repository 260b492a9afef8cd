//! Decoding CRTP packets of the Crazyflie never panics, in either direction; what is understood comes back the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_crazyflie::commander::{Order, SetPoint};
use starl_crazyflie::log::{Answer, Request};
use starl_crazyflie::packet::Packet;

/// Whether a packet means the same after it was understood and encoded again. NaN is not equal to itself, so texts are
/// compared.
fn returns<T: std::fmt::Debug>(
    packet: &Packet,
    decode: fn(&Packet) -> Option<T>,
    encode: fn(&T) -> Packet,
) {
    if let Some(understood) = decode(packet) {
        let again = decode(&encode(&understood)).expect("it was encoded here");
        assert_eq!(format!("{again:?}"), format!("{understood:?}"));
    }
}

fuzz_target!(|bytes: &[u8]| {
    let Some(packet) = Packet::decode(bytes) else {
        return;
    };
    assert_eq!(Packet::decode(&packet.encode()).as_ref(), Some(&packet));
    returns(&packet, SetPoint::decode, SetPoint::encode);
    returns(&packet, Order::decode, Order::encode);
    returns(&packet, Request::decode, Request::encode);
    returns(&packet, Answer::decode, Answer::encode);
});
