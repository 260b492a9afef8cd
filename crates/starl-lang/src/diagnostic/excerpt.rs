//! The source around one diagnostic, with lines that are too long for a screen cut around the place.

use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

use codespan_reporting::files::{Error, Files, SimpleFile};

/// Longer lines are cut, bytes.
const LONGEST: usize = 240;
/// The bytes of a cut line that are left before the place.
const BEFORE: usize = 60;
/// Stands for what is left out.
const CUT: &str = "\u{2026}";

/// A source whose long lines are cut.
pub(super) struct Excerpt<'a> {
    file: SimpleFile<&'a str, String>,
    /// The lines that were cut. For each: its range in the source, the part that was kept, and where that part begins
    /// here.
    cuts: Vec<(Range<usize>, Range<usize>, usize)>,
    /// Where the diagnostic's place is here, and its column in the source.
    place: Option<(usize, usize)>,
}

/// Whether the source has a line that would be cut.
pub(super) fn is_needed(source: &str) -> bool {
    source.split('\n').any(|line| line.len() > LONGEST)
}

impl<'a> Excerpt<'a> {
    /// The source as a diagnostic at byte `at` shows it.
    pub(super) fn around(name: &'a str, source: &str, at: usize) -> Excerpt<'a> {
        let mut text = String::with_capacity(source.len());
        let (mut cuts, mut column, mut start) = (Vec::new(), None, 0);
        for line in source.split_inclusive('\n') {
            let end = start + line.trim_end_matches('\n').len();
            if line.len() <= LONGEST {
                text.push_str(line);
            } else {
                let is_here = (start..=end).contains(&at);
                if is_here {
                    column = Some(1 + source[start..at].chars().count());
                }
                let from = if is_here {
                    at.saturating_sub(BEFORE)
                } else {
                    0
                };
                let from = source.floor_char_boundary(from.max(start));
                let to = source.floor_char_boundary((from + LONGEST - BEFORE).min(end));
                text.push_str(if from > start { CUT } else { "" });
                cuts.push((start..end, from..to, text.len()));
                text.push_str(&source[from..to]);
                text.push_str(if to < end { CUT } else { "" });
                text.push_str(&source[end..start + line.len()]);
            }
            start += line.len();
        }
        let mut excerpt = Excerpt {
            file: SimpleFile::new(name, text),
            cuts,
            place: None,
        };
        excerpt.place = column.map(|column| (excerpt.offset(at), column));
        excerpt
    }

    /// Where a byte of the source is here, or the nearest one that is left.
    fn offset(&self, at: usize) -> usize {
        let before = self.cuts.partition_point(|(line, ..)| line.start <= at);
        let Some((line, left, begin)) = before.checked_sub(1).map(|last| &self.cuts[last]) else {
            return at;
        };
        match at <= line.end {
            true => begin + at.clamp(left.start, left.end) - left.start,
            false => {
                let cut = if left.end < line.end { CUT.len() } else { 0 };
                begin + left.len() + cut + at - line.end
            }
        }
    }

    /// The same for a range.
    pub(super) fn range(&self, range: &Range<usize>) -> Range<usize> {
        self.offset(range.start)..self.offset(range.end)
    }
}

impl<'a> Files<'a> for Excerpt<'_> {
    type FileId = ();
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(self.file.name())
    }

    fn source(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(self.file.source())
    }

    fn line_index(&'a self, (): (), byte: usize) -> Result<usize, Error> {
        self.file.line_index((), byte)
    }

    fn line_range(&'a self, (): (), line: usize) -> Result<Range<usize>, Error> {
        self.file.line_range((), line)
    }

    fn column_number(&'a self, (): (), line: usize, byte: usize) -> Result<usize, Error> {
        match self.place {
            Some((place, column)) if place == byte => Ok(column),
            _ => self.file.column_number((), line, byte),
        }
    }
}
