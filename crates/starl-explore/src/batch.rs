//! Steps and the states that they lead to, which are entered together.

use crate::code::Code;
use crate::table::hash;
use starl_properties::Violation;

/// How many parts the states are in ([`crate::known`]): more than one for each core, since they are not equally large.
pub(crate) const PARTS: usize = 32;

/// A state that was expanded.
#[derive(Clone, Debug)]
pub(crate) struct Site {
    pub state: u32,
    /// The end of its steps in the batch.
    pub end: usize,
    /// Whether a bound kept a timer from firing, or a clock from ticking.
    pub is_held: bool,
    /// The step that violates something; the steps after it are not in the batch.
    pub violation: Option<(Code, Violation)>,
}

/// The steps of some states of a level.
#[derive(Clone, Default)]
pub(crate) struct Batch {
    /// The expanded states, in order.
    pub sites: Vec<Site>,
    /// How two robots of one state behaved in two ways, in the last one.
    pub contradiction: Option<String>,
    /// How many words a row has.
    width: usize,
    /// By step: the row of the state that it leads to, and then the row of its group.
    rows: Vec<u32>,
    /// By step: the state before it.
    before: Vec<u32>,
    codes: Vec<Code>,
    /// By step: the part of the state that it leads to.
    parts: Vec<u8>,
}

impl Batch {
    pub fn new(width: usize) -> Batch {
        Batch {
            width,
            ..Batch::default()
        }
    }

    pub fn clear(&mut self) {
        self.sites.clear();
        self.contradiction = None;
        self.rows.clear();
        self.before.clear();
        self.codes.clear();
        self.parts.clear();
    }

    /// Takes away the steps from one on.
    pub fn truncate(&mut self, len: usize) {
        self.before.truncate(len);
        self.codes.truncate(len);
        self.rows.truncate(2 * len * self.width);
        self.parts.truncate(len);
    }

    /// How many steps it has.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Adds a step: the state before it, and the row and the group of the state after it.
    pub fn push(&mut self, before: u32, code: Code, row: &[u32], group: &[u32]) {
        self.before.push(before);
        self.codes.push(code);
        self.rows.extend_from_slice(row);
        self.rows.extend_from_slice(group);
        self.parts.push((hash(group) >> 40) as u8 % PARTS as u8);
    }

    /// The row that a step leads to.
    pub fn row(&self, step: usize) -> &[u32] {
        let begin = 2 * step * self.width;
        &self.rows[begin..begin + self.width]
    }

    /// The group of the state that a step leads to.
    pub fn group(&self, step: usize) -> &[u32] {
        let begin = (2 * step + 1) * self.width;
        &self.rows[begin..begin + self.width]
    }

    /// The state before a step.
    pub fn before(&self, step: usize) -> u32 {
        self.before[step]
    }

    /// The first step that leads to a row.
    pub fn code_to(&self, row: &[u32]) -> Option<Code> {
        let step = (0..self.len()).find(|&step| self.row(step) == row);
        step.map(|step| self.codes[step])
    }

    /// By step: the part of the state that it leads to.
    pub fn parts(&self) -> &[u8] {
        &self.parts
    }
}
