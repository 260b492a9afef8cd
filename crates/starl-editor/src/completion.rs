//! Completions of a name that is being typed.
//!
//! The probe, a name that no declaration has, takes the place of the name, and the checker reports its context
//! ([`starl_lang::check::surroundings`]). If the checker does not reach the probe, the syntax tree gives the context.

mod candidates;
mod context;
mod kind;
mod label;
mod members;

use candidates::Candidates;
use context::Context;
use starl_lang::check::{Checked, Libraries, Symbol, surroundings};
use starl_lang::diagnostic::Span;
use starl_lang::syntax::{SyntaxKind, parse};
use std::collections::BTreeSet;

pub use kind::CompletionKind;

/// How something is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    /// Not at all.
    No,
    /// Without arguments.
    Empty,
    /// With arguments.
    Arguments,
    /// Not called; a value is given to it: `name = `.
    Given,
}

/// Something that may be typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The word.
    pub label: String,
    /// Its meaning; none for a keyword.
    pub symbol: Option<Symbol>,
    /// How it is declared.
    pub detail: String,
    /// Its documentation, in Markdown.
    pub documentation: String,
    /// How it is called.
    pub call: Call,
    /// Lower ranks are likelier and come first.
    pub rank: u8,
}

/// The text that replaces the word that is being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Insertion {
    /// The text.
    pub text: String,
    /// The byte of it that the cursor belongs before: its end, or between brackets.
    pub cursor: usize,
}

impl Completion {
    /// A word without meaning or documentation, which is not called.
    fn plain(label: impl Into<String>, detail: impl Into<String>, rank: u8) -> Self {
        Self {
            label: label.into(),
            symbol: None,
            detail: detail.into(),
            documentation: String::new(),
            call: Call::No,
            rank,
        }
    }

    /// The text to insert; without brackets if the text has them already.
    #[must_use]
    pub fn insertion(&self, has_brackets: bool) -> Insertion {
        let label = &self.label;
        let (text, behind) = match self.call {
            Call::Empty if !has_brackets => (format!("{label}()"), 0),
            Call::Arguments if !has_brackets => (format!("{label}()"), 1),
            Call::Given => (format!("{label} = "), 0),
            _ => (label.clone(), 0),
        };
        let cursor = text.len() - behind;
        Insertion { text, cursor }
    }
}

/// The completions at a position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completions {
    /// The word that is replaced, perhaps empty.
    pub span: Span,
    /// Sorted by rank, then by label.
    pub items: Vec<Completion>,
    /// Whether brackets stand behind the word already.
    pub has_brackets: bool,
}

/// The completions at a position of a text.
#[must_use]
pub fn completions(text: &str, offset: u32, libraries: &dyn Libraries) -> Completions {
    let span = word_at(text, offset);
    let mut items = match context_at(text, span, offset, libraries) {
        Some((context, checked)) => Candidates::new(&checked).of(&context, libraries),
        None => Vec::new(),
    };
    items.sort_by(|a, b| (a.rank, &a.label).cmp(&(b.rank, &b.label)));
    let mut seen = BTreeSet::new();
    items.retain(|item| seen.insert((item.label.clone(), item.symbol)));
    Completions {
        has_brackets: text[span.end as usize..].starts_with('('),
        span,
        items,
    }
}

/// The word that a place is in, or at an end of.
fn word_at(text: &str, offset: u32) -> Span {
    let is_part = |byte: &u8| *byte == b'_' || byte.is_ascii_alphanumeric();
    let at = (offset as usize).min(text.len());
    let bytes = text.as_bytes();
    let before = bytes[..at].iter().rev().take_while(|byte| is_part(byte));
    let after = bytes[at..].iter().take_while(|byte| is_part(byte));
    Span::new((at - before.count()) as u32, (at + after.count()) as u32)
}

/// The context of the word; none in comments, texts and numbers.
fn context_at(
    text: &str,
    span: Span,
    offset: u32,
    libraries: &dyn Libraries,
) -> Option<(Context, Checked)> {
    if is_inert(text, offset)
        || span
            .of(text)
            .starts_with(|first: char| first.is_ascii_digit())
    {
        return None;
    }
    let (before, after) = (&text[..span.start as usize], &text[span.end as usize..]);
    let mut probe = "probe_".to_string();
    while text.contains(&probe) {
        probe.push('_');
    }
    let probed = [before, &probe, after].concat();
    let (checked, found) = surroundings(&probed, span.start, libraries);
    let root = checked.files[0].parse.syntax();
    let token = root.token_at_offset(span.start.into()).right_biased()?;
    let context = context::of(&token, found)?;
    Some((context, checked))
}

/// Whether the place is in a comment or a literal.
fn is_inert(text: &str, offset: u32) -> bool {
    let root = parse(text).syntax();
    if offset > text.len() as u32 {
        return true;
    }
    let Some(token) = root.token_at_offset(offset.into()).left_biased() else {
        return false;
    };
    let span = Span::from(token.text_range());
    match token.kind() {
        SyntaxKind::Comment | SyntaxKind::DocComment | SyntaxKind::MalformedString => {
            span.start < offset
        }
        SyntaxKind::StringLiteral => span.start < offset && offset < span.end,
        kind => kind.is_number() && span.start < offset,
    }
}
