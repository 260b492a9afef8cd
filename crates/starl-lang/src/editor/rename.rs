//! Renaming, checked: the program means the same afterwards, or it is not renamed.
//!
//! The names are changed in copies of the texts, and these are checked: every name must stand for what it
//! stood for before, and there must be no new error. So whatever makes two names collide, one hide the
//! other or a word mean something else is found by the rules of the language itself. What that cannot show
//! are uses in parts that have errors; where the old name stands in one, nothing is renamed.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::analysis::PRELUDE_FILE;
use super::index::{Index, Occurrence};
use super::{Analysis, Utf16Lines};
use crate::check::{Checked, Libraries, Symbol, check};
use crate::diagnostic::{Diagnostic, Edit, Mend, Severity, Span};
use crate::ir::{Site, Type};
use crate::syntax::SyntaxKind;

/// The changes of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileEdits {
    /// The number of the file.
    pub file: u32,
    /// By rising place.
    pub edits: Vec<Edit>,
}

/// What renaming changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renamed {
    /// The changes by file.
    pub files: Vec<FileEdits>,
}

impl Analysis {
    /// The name at a place of the text, if it can be renamed; else why not.
    ///
    /// # Errors
    /// A sentence for the person who wants to rename it.
    pub fn renameable(&self, offset: u32) -> Result<Occurrence, String> {
        let Some(found) = self.occurrence(offset) else {
            return Err("there is no name here that is known".into());
        };
        self.may_rename(found.symbol)?;
        Ok(found)
    }

    /// Whether something can be renamed.
    ///
    /// # Errors
    /// A sentence that says why not.
    pub fn may_rename(&self, symbol: Symbol) -> Result<(), String> {
        let roles = self.checked.program.roles.as_ref();
        let roles = roles.map(|roles| roles.variable);
        let name = |site| self.name_at(site);
        match (symbol, self.definition(symbol)) {
            (Symbol::File(file), Some(site)) if file > 0 || self.checked.program.is_library => {
                let name = name(site);
                Err(format!("the library `{name}` has the name of its file"))
            }
            (Symbol::Variable(id), _) if Some(id) == roles => {
                Err("`role` is a name that every program has".into())
            }
            (Symbol::Enum(id), _) if self.is_of_roles(id) => {
                Err("`role` is a name that every program has".into())
            }
            (_, Some(site)) if site.file == PRELUDE_FILE => {
                let name = name(site);
                Err(format!("`{name}` is a name that every program has"))
            }
            (_, None) => Err("this is a name that every program has".into()),
            _ => Ok(()),
        }
    }

    fn is_of_roles(&self, id: crate::ir::EnumId) -> bool {
        let program = &self.checked.program;
        let roles = program.roles.as_ref();
        roles.is_some_and(|roles| program[roles.variable].ty == Type::Enum(id))
    }

    /// Gives something another name, in all files. `libraries` are those that the text was checked with.
    ///
    /// # Errors
    /// A sentence that says why it keeps its name.
    pub fn rename(
        &self,
        symbol: Symbol,
        name: &str,
        libraries: &dyn Libraries,
    ) -> Result<Renamed, String> {
        self.may_rename(symbol)?;
        valid(name)?;
        let names = self.references(symbol);
        let Some(first) = names.first() else {
            return Err("there is no name here that is known".into());
        };
        let old = self.name_at(first.site);
        if old == name {
            return Ok(Renamed { files: Vec::new() });
        }
        self.refuse_unclear(&old)?;
        let changes = Changes::new(&names, name);
        let changed = changes.check(self, libraries);
        changes.compare(self, &changed, &old)?;
        Ok(Renamed {
            files: changes.edits(),
        })
    }

    /// Refuses if the name stands where it is not known what it stands for.
    fn refuse_unclear(&self, old: &str) -> Result<(), String> {
        if !self.checked.has_errors() {
            return Ok(());
        }
        for (number, file) in self.checked.files.iter().enumerate() {
            let root = file.parse.syntax();
            let all = root.descendants_with_tokens();
            let words = all.filter_map(rowan::NodeOrToken::into_token);
            let same =
                words.filter(|word| word.kind() == SyntaxKind::Identifier && word.text() == old);
            for word in same {
                let span = Span::from(word.text_range());
                let file = number as u32;
                if self.index.exactly(Site { file, span }).is_none() {
                    let place = line(&self.checked, Site { file, span });
                    return Err(format!(
                        "it cannot be told what `{old}` means in {place}; mend the errors first"
                    ));
                }
            }
        }
        Ok(())
    }
}

/// Whether it can be a name.
fn valid(name: &str) -> Result<(), String> {
    let mut letters = name.chars();
    let is_word = letters
        .next()
        .is_some_and(|first| first == '_' || first.is_ascii_alphabetic())
        && letters.all(|letter| letter == '_' || letter.is_ascii_alphanumeric());
    if !is_word {
        return Err(format!(
            "`{name}` is no name: a name is made of letters, digits and `_`, and begins with no digit"
        ));
    }
    if name == "_" {
        return Err("`_` stands for what is not wanted".into());
    }
    if SyntaxKind::keyword(name).is_some() {
        return Err(format!("`{name}` is a word of the language"));
    }
    Ok(())
}

/// The places that change, by file.
struct Changes<'a> {
    name: &'a str,
    by_file: BTreeMap<u32, Vec<Span>>,
}

impl<'a> Changes<'a> {
    fn new(names: &[Occurrence], name: &'a str) -> Self {
        let mut by_file: BTreeMap<u32, Vec<Span>> = BTreeMap::new();
        for found in names {
            by_file
                .entry(found.site.file)
                .or_default()
                .push(found.site.span);
        }
        Self { name, by_file }
    }

    fn edits(&self) -> Vec<FileEdits> {
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
    fn check(&self, analysis: &Analysis, libraries: &dyn Libraries) -> Checked {
        let files = &analysis.checked.files;
        let mut texts: BTreeMap<u32, String> = BTreeMap::new();
        for edits in self.edits() {
            let mend = Mend {
                message: String::new(),
                edits: edits.edits,
            };
            let text = mend.apply(&files[edits.file as usize].source);
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
    fn compare(&self, before: &Analysis, changed: &Checked, old: &str) -> Result<(), String> {
        let name = self.name;
        if let Some((file, problem)) = self.new_error(&before.checked, changed) {
            let site = Site {
                file,
                span: problem.span,
            };
            let place = line(changed, site);
            let message = &problem.message;
            return Err(format!(
                "`{old}` cannot become `{name}`: {message} ({place})"
            ));
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
                return Err(format!(
                    "`{old}` cannot become `{name}`: `{word}` in {place} would mean something else"
                ));
            }
        }
        if index.all().len() != before.index.all().len() {
            return Err(format!(
                "`{old}` cannot become `{name}`: that would mean something else elsewhere"
            ));
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
fn line(checked: &Checked, site: Site) -> String {
    let file = &checked.files[site.file as usize];
    let lines = Utf16Lines::new(&file.source);
    let number = lines.position(&file.source, site.span.start).line + 1;
    match site.file {
        0 => format!("line {number}"),
        _ => format!("line {number} of `{}`", file.name),
    }
}
