//! The states that are equally far from the start and are expanded now.

use crate::known::Known;

/// For so many states the rows are copied at once.
const AT_ONCE: usize = 1 << 11;

/// The numbers of states, in order, and a copy of the rows of those that are next. They are expanded while others are
/// entered.
#[derive(Clone, Default)]
pub(crate) struct Level {
    /// How many words a row has.
    width: usize,
    states: Vec<u32>,
    /// The next one.
    next: usize,
    /// The rows of the states from this one on.
    first: usize,
    rows: Vec<u32>,
}

impl Level {
    pub fn new(width: usize) -> Level {
        Level {
            width,
            ..Level::default()
        }
    }

    /// Begins with these states, and leaves an empty list. Returns how many are omitted because others cover them.
    pub fn begin(&mut self, states: &mut Vec<u32>, known: &Known) -> usize {
        self.states.clear();
        std::mem::swap(&mut self.states, states);
        let all = self.states.len();
        self.states.retain(|&state| !known.is_covered(state));
        self.next = 0;
        all - self.states.len()
    }

    /// Copies the rows of the states that are next.
    pub fn load(&mut self, known: &Known) {
        self.first = self.next;
        self.rows.clear();
        for &state in self.states[self.next..].iter().take(AT_ONCE) {
            self.rows.extend_from_slice(known.row(state));
        }
    }

    /// Takes the next state whose row was copied.
    pub fn next(&mut self) -> Option<(u32, &[u32])> {
        let begin = (self.next - self.first) * self.width;
        let row = self.rows.get(begin..begin + self.width)?;
        let state = self.states[self.next];
        self.next += 1;
        Some((state, row))
    }

    /// Whether all were taken.
    pub fn is_done(&self) -> bool {
        self.next == self.states.len()
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        (self.states.capacity() + self.rows.capacity()) * size_of::<u32>()
    }
}
