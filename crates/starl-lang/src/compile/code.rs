//! The code of one function while it is written: instructions, labels and source positions.

use alloc::vec::Vec;

use crate::diagnostic::Span;
use crate::machine::operand::Target;
use crate::machine::{self, Instruction};

/// A place in the code that may not be known yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Label(u32);

impl Label {
    /// The label as the target of a jump. It is replaced by the place when the code is complete.
    pub const fn target(self) -> Target {
        Target(self.0)
    }
}

/// Instructions whose jumps name labels.
#[derive(Debug, Default)]
pub(super) struct Code {
    instructions: Vec<Instruction>,
    spans: Vec<(u32, machine::Span)>,
    /// The places of the labels.
    labels: Vec<u32>,
}

impl Code {
    pub fn push(&mut self, instruction: Instruction, file: u32, span: Span) {
        let span = machine::Span {
            file,
            start: span.start,
            end: span.end,
        };
        if self.spans.last().is_none_or(|(_, last)| *last != span) {
            self.spans.push((self.instructions.len() as u32, span));
        }
        self.instructions.push(instruction);
    }

    /// A new label, to be placed later.
    pub fn label(&mut self) -> Label {
        self.labels.push(u32::MAX);
        Label((self.labels.len() - 1) as u32)
    }

    /// Places a label before the next instruction.
    pub fn place(&mut self, label: Label) {
        self.labels[label.0 as usize] = self.instructions.len() as u32;
    }

    /// A label before the next instruction.
    pub fn here(&mut self) -> Label {
        let label = self.label();
        self.place(label);
        label
    }

    /// Whether execution can continue from the last instruction to the next.
    pub fn is_reached(&self) -> bool {
        let next = self.instructions.len() as u32;
        self.labels.contains(&next) || !self.instructions.last().is_some_and(leaves)
    }

    /// Writes the code at the end of a program's, with its places in the stead of labels. `objects` is
    /// how many object registers the function uses: returns empty them.
    pub fn append_to(
        self,
        objects: u8,
        instructions: &mut Vec<Instruction>,
        spans: &mut Vec<(u32, machine::Span)>,
    ) {
        use machine::operand::Count;
        let start = instructions.len() as u32;
        let labels = self.labels;
        let place = |label: u32| start + labels.get(label as usize).copied().unwrap_or(0);
        instructions.extend(
            self.instructions
                .into_iter()
                .map(|instruction| match instruction {
                    Instruction::Return { keep, .. } => Instruction::Return {
                        keep,
                        until: Count(objects),
                    },
                    Instruction::ReturnScalar { from, .. } => Instruction::ReturnScalar {
                        from,
                        until: Count(objects),
                    },
                    Instruction::ReturnFalse { .. } => Instruction::ReturnFalse {
                        until: Count(objects),
                    },
                    other => other.with_targets(&place),
                }),
        );
        let moved = self.spans.into_iter().map(|(at, span)| (start + at, span));
        spans.extend(moved);
    }
}

fn leaves(instruction: &Instruction) -> bool {
    matches!(
        instruction,
        Instruction::Jump { .. }
            | Instruction::Return { .. }
            | Instruction::ReturnScalar { .. }
            | Instruction::ReturnFalse { .. }
    )
}
