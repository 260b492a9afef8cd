//! The kinds of words in a text, for syntax highlighting.

use crate::Analysis;
use crate::describe::{local_kind, node_at};
use crate::index::Occurrence;
use crate::words::is_word;
use starl_lang::check::{Builtin, Symbol};
use starl_lang::diagnostic::Span;
use starl_lang::syntax::{SyntaxKind, SyntaxToken};

/// The kind of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TokenKind {
    /// A reserved word, or one that begins a declaration.
    Keyword,
    /// A comment.
    Comment,
    /// A number, with or without a unit.
    Number,
    /// A text.
    String,
    /// A program or a library.
    Namespace,
    /// An enum.
    Enum,
    /// A variant of an enum, or a role.
    EnumMember,
    /// A record or a message.
    Struct,
    /// A built-in type.
    Type,
    /// A kind of primitive.
    Class,
    /// A field, a coordinate or a flag.
    Property,
    /// A variable, a parameter of the program, a constant or a bound primitive.
    Variable,
    /// A parameter of a function or a handler.
    Parameter,
    /// A function, or the name of a property of the program.
    Function,
    /// A method.
    Method,
    /// An action, or what a primitive reports.
    Event,
}

/// More about a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TokenModifiers {
    /// It is declared here.
    pub declaration: bool,
    /// It never changes, or not by assignment.
    pub readonly: bool,
    /// Every program has it.
    pub default_library: bool,
    /// It is a comment that documents what is below it.
    pub documentation: bool,
}

/// A word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Where it is.
    pub span: Span,
    /// Its kind.
    pub kind: TokenKind,
    /// More about it.
    pub modifiers: TokenModifiers,
}

/// The words of a text, sorted by position, without unknown words and without signs.
#[must_use]
pub fn tokens(analysis: &Analysis) -> Vec<Token> {
    let mut names = analysis.occurrences().iter().copied().peekable();
    let root = analysis.checked.files[0].parse.syntax();
    let all = root.descendants_with_tokens();
    let words = all.filter_map(rowan::NodeOrToken::into_token);
    let mut tokens = Vec::new();
    for word in words {
        let span = Span::from(word.text_range());
        while names
            .next_if(|name| name.site.span.start < span.start)
            .is_some()
        {}
        let name = names.next_if(|name| name.site.span == span);
        let found = match name {
            Some(name) => Some(name_token(analysis, name)),
            None => plain_token(&word),
        };
        tokens.extend(found.filter(|_| span.start < span.end));
    }
    tokens
}

fn plain_token(word: &SyntaxToken) -> Option<Token> {
    let kind = match word.kind() {
        SyntaxKind::Comment | SyntaxKind::DocComment => TokenKind::Comment,
        kind if kind.is_number() => TokenKind::Number,
        SyntaxKind::StringLiteral | SyntaxKind::MalformedString => TokenKind::String,
        _ if is_word(word) => TokenKind::Keyword,
        _ => return None,
    };
    Some(Token {
        span: word.text_range().into(),
        kind,
        modifiers: TokenModifiers {
            documentation: word.kind() == SyntaxKind::DocComment,
            ..TokenModifiers::default()
        },
    })
}

fn name_token(analysis: &Analysis, name: Occurrence) -> Token {
    let mut modifiers = TokenModifiers {
        declaration: name.is_definition,
        ..TokenModifiers::default()
    };
    let program = &analysis.checked.program;
    let kind = match name.symbol {
        Symbol::Enum(_) => TokenKind::Enum,
        Symbol::Variant(..) => TokenKind::EnumMember,
        Symbol::Record(_) => TokenKind::Struct,
        Symbol::Field(..) => TokenKind::Property,
        Symbol::Parameter(_) | Symbol::Constant(_) | Symbol::Binding(_) => {
            modifiers.readonly = true;
            TokenKind::Variable
        }
        Symbol::Variable(_) | Symbol::Shared(_) => TokenKind::Variable,
        Symbol::Function(_) | Symbol::Property(_) => TokenKind::Function,
        Symbol::Local(site) => {
            let node = node_at(&analysis.checked, site);
            match node.as_ref().map(local_kind) {
                Some("a parameter" | "a parameter of the handler") => TokenKind::Parameter,
                _ => TokenKind::Variable,
            }
        }
        Symbol::Action(_) | Symbol::Event(..) | Symbol::Input(_) => TokenKind::Event,
        Symbol::File(_) => TokenKind::Namespace,
        Symbol::Builtin(builtin) => builtin_kind(builtin, &mut modifiers),
        Symbol::Type(_) => TokenKind::Type,
        Symbol::Method(_) => TokenKind::Method,
        Symbol::Primitive(_) => TokenKind::Class,
        Symbol::Member(primitive, member) => {
            let member = &starl_lang::check::PRIMITIVES[primitive].members[member];
            match member.signature().is_call {
                true => TokenKind::Method,
                false => TokenKind::Property,
            }
        }
        Symbol::Argument(..) => TokenKind::Parameter,
        Symbol::Coordinate(_) | Symbol::RobotMember(_) => TokenKind::Property,
    };
    modifiers.default_library = analysis
        .definition(name.symbol)
        .is_none_or(|site| site.file == crate::analysis::PRELUDE_FILE);
    // The variable of the roles has no declaration in the text.
    let roles = program.roles.as_ref().map(|roles| roles.variable);
    modifiers.default_library |= matches!(name.symbol, Symbol::Variable(id) if Some(id) == roles);
    Token {
        span: name.site.span,
        kind,
        modifiers,
    }
}

fn builtin_kind(builtin: Builtin, modifiers: &mut TokenModifiers) -> TokenKind {
    if builtin.signature().is_call {
        return TokenKind::Function;
    }
    modifiers.readonly = true;
    TokenKind::Variable
}
