//! The changed texts, and whether they mean what the texts meant.

use super::{FileEdits, RenameError};
use crate::index::{Index, Occurrence};
use crate::{Analysis, Utf16Lines};
use starl_lang::check::{Checked, Libraries, Symbol, check};
use starl_lang::diagnostic::{Diagnostic, Edit, Fix, Severity, Span};
use starl_lang::ir::Site;
use std::collections::BTreeMap;

/// The places that change, by file.
pub(super) struct Changes<'a> {
    name: &'a str,
    by_file: BTreeMap<u32, Vec<Span>>,
}

impl<'a> Changes<'a> {
    pub fn new(names: &[Occurrence], name: &'a str) -> Self {
        let mut by_file: BTreeMap<u32, Vec<Span>> = BTreeMap::new();
        for found in names {
            by_file
                .entry(found.site.file)
                .or_default()
                .push(found.site.span);
        }
        Self { name, by_file }
    }

    pub fn edits(&self) -> Vec<FileEdits> {
        let files = self.by_file.iter();
        files
            .map(|(file, spans)| FileEdits {
                file: *file,
                edits: (spans.iter())
                    .map(|span| Edit::new(*span, self.name))
                    .collect(),
            })
            .collect()
    }

    /// The changed texts, checked.
    pub fn check(&self, analysis: &Analysis, libraries: &dyn Libraries) -> Checked {
        let files = &analysis.checked.files;
        let mut texts: BTreeMap<u32, String> = BTreeMap::new();
        for edits in self.edits() {
            let fix = Fix {
                message: String::new(),
                edits: edits.edits,
            };
            let text = fix.apply(&files[edits.file as usize].source);
            texts.insert(edits.file, text);
        }
        let library = |name: &str| {
            let mut numbers = texts.keys();
            let changed = numbers.find(|file| **file > 0 && files[**file as usize].name == name);
            match changed {
                Some(file) => texts.get(file).cloned(),
                None => libraries.source(name),
            }
        };
        let own = texts.get(&0).unwrap_or(&files[0].source);
        check(own, &library)
    }

    /// Where a place of a text is after the change.
    fn moved(&self, site: Site) -> Site {
        let Some(spans) = self.by_file.get(&site.file) else {
            return site;
        };
        let moved = |at: u32, inclusive: bool| {
            let before = spans
                .iter()
                .filter(|span| span.end < at || span.end == at && (inclusive || span.start < at));
            let grown: i64 = before
                .map(|span| self.name.len() as i64 - i64::from(span.end - span.start))
                .sum();
            (i64::from(at) + grown) as u32
        };
        let start = moved(site.span.start, false);
        let end = moved(site.span.end, true);
        Site {
            span: Span::new(start, end),
            ..site
        }
    }

    /// Refuses if anything means something else after the change.
    pub fn compare(
        &self,
        before: &Analysis,
        changed: &Checked,
        old: &str,
    ) -> Result<(), RenameError> {
        let conflict = |reason| RenameError::Conflict {
            old: old.into(),
            name: self.name.into(),
            reason,
        };
        if let Some((file, problem)) = self.new_error(&before.checked, changed) {
            let site = Site {
                file,
                span: problem.span,
            };
            let place = line(changed, site);
            let message = &problem.message;
            return Err(conflict(format!("{message} ({place})")));
        }
        let index = Index::new(changed);
        for own in before.index.all() {
            let site = self.moved(own.site);
            let symbol = match own.symbol {
                Symbol::Local(site) => Symbol::Local(self.moved(site)),
                other => other,
            };
            if index.exactly(site).map(|now| now.symbol) != Some(symbol) {
                let place = line(&before.checked, own.site);
                let word = before.name_at(own.site);
                return Err(conflict(format!(
                    "`{word}` in {place} would mean something else"
                )));
            }
        }
        if index.all().len() != before.index.all().len() {
            return Err(conflict("that would mean something else elsewhere".into()));
        }
        Ok(())
    }

    /// An error that was not there before.
    fn new_error<'c>(
        &self,
        before: &Checked,
        changed: &'c Checked,
    ) -> Option<(u32, &'c Diagnostic)> {
        let is_error = |problem: &&Diagnostic| problem.severity() == Severity::Error;
        // A library's own error says more than the import that leads to it.
        for (number, file) in changed.files.iter().enumerate().rev() {
            let number = number as u32;
            let old = before.files.get(number as usize);
            let old = old.map_or(&[][..], |file| &file.diagnostics[..]);
            let known: Vec<_> = (old.iter().filter(is_error))
                .map(|problem| {
                    let site = Site {
                        file: number,
                        span: problem.span,
                    };
                    (self.moved(site).span.start, problem.code)
                })
                .collect();
            let mut errors = file.diagnostics.iter().filter(is_error);
            let new = errors.find(|new| !known.contains(&(new.span.start, new.code)));
            if let Some(problem) = new {
                return Some((number, problem));
            }
        }
        None
    }
}

/// `line 12`, with the library's name if it is in one.
pub(super) fn line(checked: &Checked, site: Site) -> String {
    let file = &checked.files[site.file as usize];
    let lines = Utf16Lines::new(&file.source);
    let number = lines.position(&file.source, site.span.start).line + 1;
    match site.file {
        0 => format!("line {number}"),
        _ => format!("line {number} of `{}`", file.name),
    }
}
