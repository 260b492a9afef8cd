//! Programs that are generated from bytes mean the same in any layout and formatted.

use crate::generate::{layout, program};
use crate::support::formatting;
use starl_core::Random;

#[test]
fn they_mean_the_same() {
    let mut compiled = 0;
    for seed in 0..300 {
        let mut random = Random::keyed(seed, &[5]);
        let length = random.below(1500);
        let bytes: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
        let text = layout::other(&program(&bytes), &bytes);
        compiled += u32::from(formatting::keeps(&text));
    }
    assert!(compiled > 200, "{compiled}");
}
