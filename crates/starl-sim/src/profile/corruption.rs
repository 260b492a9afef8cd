//! Variables are overwritten at random.

use super::Trouble;
use crate::scenario::FaultKind;
use starl_core::{Duration, Time};

/// Up to three times in the first half, of one robot or several.
pub(super) fn corrupt(trouble: &mut Trouble<'_>) {
    let robots = trouble.robots();
    for _ in 0..trouble.count(1, 3) {
        let at = Time::ZERO + Duration::from_millis(trouble.span(0.0, 0.6).0 / 1_000_000);
        let count = trouble.count(1, robots.len() as u32) as usize;
        let mut struck = trouble.some(robots.clone(), count);
        struck.sort_unstable();
        if !struck.is_empty() {
            trouble.add(at, FaultKind::CorruptState(struck));
        }
    }
}
