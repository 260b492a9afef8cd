//! The choices of a generator, from bytes: one for each choice.
//!
//! Invariant: equal bytes give equal choices, and after the last byte every choice is the first, which is the simplest.
//! So shorter or smaller bytes make a simpler program.

/// Choices that bytes decide.
pub struct Choices<'a> {
    rest: &'a [u8],
}

impl<'a> Choices<'a> {
    /// Choices by these bytes.
    pub fn new(bytes: &'a [u8]) -> Choices<'a> {
        Choices { rest: bytes }
    }

    /// A number below `count`, which is at least one and at most 256.
    pub fn below(&mut self, count: usize) -> usize {
        let Some((first, rest)) = self.rest.split_first() else {
            return 0;
        };
        self.rest = rest;
        usize::from(*first) % count
    }

    /// One of them.
    pub fn pick<'t, T: ?Sized>(&mut self, from: &[&'t T]) -> &'t T {
        from[self.below(from.len())]
    }
}
