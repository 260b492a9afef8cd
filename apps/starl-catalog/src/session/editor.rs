//! An editor's view of programs among files in memory. The information comes from [`starl_editor`],
//! like that of the language server.

use super::Refused;
use super::files::{Beside, Files};
use crate::language::SUFFIX;
use serde::Serialize;
use starl_editor::{
    Analysis, BUILT_IN, CompletionKind, Insertion, OutlineEntry, OutlineKind, Utf16Lines,
    Utf16Position, Utf16Range,
};
use starl_lang::diagnostic::Span;

/// The information at a position.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Hover {
    /// The name that it is about.
    pub range: Utf16Range,
    /// The text.
    pub markdown: String,
}

/// Something that may be typed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Completion {
    /// The word.
    pub label: String,
    /// The kind of completion.
    pub kind: CompletionKind,
    /// How it is declared.
    pub detail: Option<String>,
    /// Its documentation, in Markdown.
    pub documentation: Option<String>,
    /// The text that replaces the range.
    pub insert: String,
    /// The cursor's position in the text, in UTF-16 units.
    pub cursor: usize,
    /// The range that it replaces: the word being typed.
    pub range: Utf16Range,
}

/// Where something is declared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Definition {
    /// The path of the file.
    pub path: String,
    /// Its name there.
    pub range: Utf16Range,
    /// The text of the file, if it is part of the language and not one of the files.
    pub text: Option<String>,
}

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: OutlineKind,
    /// More that is worth seeing, such as its type.
    pub detail: Option<String>,
    /// All of it, without the comments above.
    pub range: Utf16Range,
    /// Its name.
    pub name_range: Utf16Range,
    /// Its parts.
    pub parts: Vec<Part>,
}

/// A program or library among the files.
pub struct Document<'a> {
    files: &'a Files,
    path: &'a str,
    text: &'a str,
    lines: Utf16Lines,
}

impl<'a> Document<'a> {
    /// The program or library at `path`.
    ///
    /// # Errors
    /// If there is none.
    pub fn open(files: &'a Files, path: &'a str) -> Result<Document<'a>, Refused> {
        if !path.ends_with(SUFFIX) {
            let message = format!("{path}: give a program or library, which end in {SUFFIX}");
            return Err(message.into());
        }
        let text = files.text(path);
        let text = text.map_err(|reason| format!("{path}: {reason}"))?;
        Ok(Document {
            files,
            path,
            text,
            lines: Utf16Lines::new(text),
        })
    }

    /// The information at a position; none where there is no name.
    pub fn hover(&self, at: Utf16Position) -> Option<Hover> {
        let (span, description) = self.analysis().hover(self.offset(at))?;
        Some(Hover {
            range: self.range(span),
            markdown: description.markdown(),
        })
    }

    /// The completions at a position, the likeliest first.
    pub fn complete(&self, at: Utf16Position) -> Vec<Completion> {
        let found = starl_editor::completions(self.text, self.offset(at), &self.beside());
        let range = self.range(found.span);
        let items = found.items.into_iter().map(|item| {
            let Insertion { text, cursor } = item.insertion(found.has_brackets);
            Completion {
                kind: item.kind(),
                label: item.label,
                detail: given(item.detail),
                documentation: given(item.documentation),
                cursor: text[..cursor].encode_utf16().count(),
                insert: text,
                range,
            }
        });
        items.collect()
    }

    /// The declaration of the name at a position; none for a built-in name.
    pub fn definition(&self, at: Utf16Position) -> Option<Definition> {
        let analysis = self.analysis();
        let found = analysis.occurrence(self.offset(at))?;
        let site = analysis.definition(found.symbol)?;
        let file = analysis.checked.files.get(site.file as usize)?;
        let beside = self.beside().resolve(&format!("{}{SUFFIX}", file.name));
        let (path, text) = match site.file {
            0 => (self.path.to_string(), None),
            // A library among the files goes before one of the standard library.
            _ if self.files.has(&beside) => (beside, None),
            _ => (
                format!("{BUILT_IN}{}{SUFFIX}", file.name),
                Some(file.source.clone()),
            ),
        };
        let range = Utf16Lines::new(&file.source).range(&file.source, site.span);
        Some(Definition { path, range, text })
    }

    /// The parts of the text, in its order.
    pub fn outline(&self) -> Vec<Part> {
        let entries = starl_editor::outline(&starl_lang::syntax::parse(self.text));
        entries.into_iter().map(|entry| self.part(entry)).collect()
    }

    fn part(&self, entry: OutlineEntry) -> Part {
        Part {
            name: entry.name,
            kind: entry.kind,
            detail: given(entry.detail),
            range: self.range(entry.span),
            name_range: self.range(entry.name_span),
            parts: entry
                .parts
                .into_iter()
                .map(|part| self.part(part))
                .collect(),
        }
    }

    fn analysis(&self) -> Analysis {
        Analysis::new(self.text, &self.beside())
    }

    fn beside(&self) -> Beside<'a> {
        Beside::new(self.files, self.path)
    }

    fn offset(&self, at: Utf16Position) -> u32 {
        self.lines.offset(self.text, at)
    }

    fn range(&self, span: Span) -> Utf16Range {
        self.lines.range(self.text, span)
    }
}

fn given(text: String) -> Option<String> {
    (!text.is_empty()).then_some(text)
}
