//! The values of a line and where each of them is.

use crate::read::report::Origin;

/// A value of a line, without blanks around it, and where it is.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    pub text: &'a str,
    pub origin: Origin,
}

/// The values between separators.
pub(super) fn words(line: &str, begin: Origin, separator: char) -> Vec<Word<'_>> {
    let mut offset = begin.offset;
    line.split(separator)
        .map(|part| {
            let blank = (part.len() - part.trim_start().len()) as u32;
            let word = Word {
                text: part.trim(),
                origin: Origin {
                    offset: offset + blank,
                    ..begin
                },
            };
            offset += part.len() as u32 + 1;
            word
        })
        .collect()
}
