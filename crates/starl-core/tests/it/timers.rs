//! The keys of timers: ordered by owner, variant and number, and read back by their owner alone.

use starl_core::timer::Token;
use starl_core::{Port, Timer, TimerKey, timers};

timers! {
    enum Alarm {
        Resend(u8),
        Look,
        Retry(u32),
    }
}

#[test]
fn keys_are_ordered_by_port_then_by_variant_then_by_number() {
    let timers = [
        Alarm::Resend(0),
        Alarm::Resend(255),
        Alarm::Look,
        Alarm::Retry(1),
        Alarm::Retry(u32::MAX),
    ];
    let ports = [Port::PROGRAM, Port(1), Port(u32::MAX)];
    let keys = ports.map(|port| timers.map(|timer| TimerKey::new(port, timer)));
    assert!(keys.as_flattened().is_sorted_by(|one, next| one < next));
}

#[test]
fn a_timer_is_read_back() {
    for timer in [Alarm::Resend(7), Alarm::Look, Alarm::Retry(u32::MAX)] {
        assert_eq!(TimerKey::new(Port(3), timer).read(), Some(timer));
    }
}

#[test]
fn tokens_without_a_variant_are_unknown() {
    let unknown = [
        Token::new(0, 256), // Resend holds a byte
        Token::new(1, 1),   // Look holds nothing
        Token::new(3, 0),
    ];
    for token in unknown {
        assert_eq!(Alarm::from_token(token), None, "{token}");
    }
}
