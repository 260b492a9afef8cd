//! Which packets of a session were taken already, so that none is taken twice.

/// How far behind the newest packet one may be, in packets.
const SPAN: u64 = 1024;

/// The newest packets that were taken. (RFC 6479 describes such windows.)
#[derive(Clone, Debug, Default)]
pub struct ReplayWindow {
    /// One more than the greatest number that was taken.
    end: u64,
    /// One bit for each of the last numbers, by the number modulo the span.
    taken: [u64; (SPAN / 64) as usize],
}

impl ReplayWindow {
    /// Whether a packet with this number is new. Packets that are too old to say count as taken.
    pub fn is_new(&self, number: u64) -> bool {
        let is_old = number.saturating_add(SPAN) < self.end;
        !is_old && (number >= self.end || self.taken[place(number)] & bit(number) == 0)
    }

    /// Notes that a packet was taken.
    pub fn take(&mut self, number: u64) {
        if number >= self.end {
            let fresh = (number - self.end).min(SPAN - 1);
            for passed in number - fresh..number {
                self.taken[place(passed)] &= !bit(passed);
            }
            self.end = number + 1;
        }
        self.taken[place(number)] |= bit(number);
    }
}

fn place(number: u64) -> usize {
    (number % SPAN / 64) as usize
}

fn bit(number: u64) -> u64 {
    1 << (number % 64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn no_number_is_new_twice() {
        let mut window = ReplayWindow::default();
        let mut seen = BTreeSet::new();
        let (mut number, mut state) = (0u64, 1u64);
        for _ in 0..200_000 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let jump = (state >> 33) % 1500;
            let candidate = (number + jump).saturating_sub(700);
            number = number.max(candidate);
            let is_recent = candidate + SPAN > number;
            if window.is_new(candidate) {
                assert!(seen.insert(candidate), "{candidate} was taken twice");
                window.take(candidate);
            } else {
                assert!(
                    seen.contains(&candidate) || !is_recent,
                    "{candidate} is new"
                );
            }
        }
    }
}
