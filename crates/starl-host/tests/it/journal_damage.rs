//! Reading any bytes as a journal returns an error or entries, and never panics.

use crate::support::{messages, random_deeds, read};
use starl_core::{Random, Time};

#[test]
fn bytes_that_were_changed() {
    let mut random = Random::keyed(1, &[]);
    let mut refused = 0;
    for round in 0..3_000 {
        let mut messages = messages(&random_deeds(round % 20, 30), 4);
        let index = random.below(messages.len() as u32) as usize;
        let message = &mut messages[index].1;
        let at = random.below(message.len() as u32) as usize;
        match random.below(3) {
            0 => message.truncate(at),
            1 => message[at] = random.below(256) as u8,
            _ => message[at] ^= 1 << random.below(8),
        }
        refused += u32::from(read(&messages).is_err());
    }
    assert!(refused > 1_000, "{refused}");
}

#[test]
fn bytes_of_any_kind() {
    let mut random = Random::keyed(2, &[]);
    for length in 0..3_000 {
        let bytes = (0..length % 300).map(|_| random.below(256) as u8).collect();
        let _ = read(&[(Time(u64::MAX), bytes)]);
    }
}

/// An entry that names a list which was never written.
#[test]
fn a_message_that_is_missing() {
    let all = messages(&random_deeds(3, 200), 1);
    let refused = (0..all.len()).filter(|&left_out| {
        let mut messages = all.clone();
        messages.remove(left_out);
        read(&messages).is_err()
    });
    assert!(refused.count() > 0);
}
