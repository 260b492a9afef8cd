//! Operators and punctuation, and how other languages and print write them.

use super::SyntaxKind::{self, *};

/// Spellings of more than one character, or of one that is not ASCII; of those that start alike the
/// longer first.
const SPELLINGS: &[(&str, SyntaxKind)] = &[
    ("...", Ellipsis),
    ("..", DotDot),
    ("===", EqualEqual),
    ("==", EqualEqual),
    ("=<", LessEqual),
    ("!==", NotEqual),
    ("!=", NotEqual),
    ("<>", NotEqual),
    ("<=", LessEqual),
    (">=", GreaterEqual),
    ("+=", PlusEqual),
    ("++", PlusPlus),
    ("->", Arrow),
    ("-=", MinusEqual),
    ("*=", StarEqual),
    ("/=", SlashEqual),
    ("%=", PercentEqual),
    (":=", Equal),
    ("??", QuestionQuestion),
    ("&&", AndKeyword),
    ("||", OrKeyword),
    ("&", AndKeyword),
    ("|", OrKeyword),
    ("~", NotKeyword),
    ("∧", AndKeyword),
    ("∨", OrKeyword),
    ("¬", NotKeyword),
    ("∈", InKeyword),
    ("≤", LessEqual),
    ("≥", GreaterEqual),
    ("≠", NotEqual),
    ("−", Minus),
    ("–", Minus),
    ("×", Star),
    ("·", Star),
    ("÷", Slash),
    ("→", Arrow),
    ("…", Ellipsis),
];

const SINGLE: &[SyntaxKind] = &[
    LeftParen,
    RightParen,
    LeftBracket,
    RightBracket,
    LeftBrace,
    RightBrace,
    Comma,
    Colon,
    Semicolon,
    Dot,
    Plus,
    Minus,
    Star,
    Slash,
    Percent,
    Equal,
    Less,
    Greater,
    Bang,
    Question,
];

/// The operator or punctuation at the start of the text, or a character without meaning.
pub(super) fn symbol(text: &str, first: char) -> (SyntaxKind, usize) {
    if let Some((spelling, kind)) = SPELLINGS
        .iter()
        .find(|(spelling, _)| text.starts_with(spelling))
    {
        return (*kind, spelling.len());
    }
    let single = SINGLE
        .iter()
        .find(|kind| kind.text().is_some_and(|symbol| text.starts_with(symbol)));
    (single.copied().unwrap_or(Unknown), first.len_utf8())
}
