//! Which declaration is next, by its first words.

use super::declaration::{self as declare, contextual};
use super::{Parser, SyntaxKind, SyntaxKind::*};
use super::{action, handler, koord, property, record, shared, slips, stable};

/// The kind of declaration, and the function that parses it from its first word.
pub(super) type Form = (SyntaxKind, fn(&mut Parser<'_>));

/// The form of the declaration that is next, if it is one.
pub(super) fn form(parser: &Parser<'_>) -> Option<Form> {
    let next = parser.nth(1);
    match parser.current() {
        OnKeyword if next != Colon && next != Equal => {
            return Some((HandlerDeclaration, handler::handler));
        }
        LetKeyword => return Some((VariableDeclaration, declare::let_variable)),
        // A keyword as the name of a variable or an action; `name` reports it.
        kind if kind.is_keyword() && next == Colon && parser.nth(2) == Identifier => {
            return Some((VariableDeclaration, declare::variable));
        }
        Identifier => {}
        _ => return None,
    }
    let word = parser.word();
    if let Some(form) = by_word(parser, word) {
        return Some(form);
    }
    match next {
        Colon if koord::is_variable(parser) => Some((VariableDeclaration, koord::variable)),
        Identifier if word == "using" => Some((BindingDeclaration, koord::using)),
        LeftParen if declare::is_function_without_word(parser) => {
            Some((FunctionDeclaration, declare::function_without_word))
        }
        Colon if parser.nth(2) == Newline && parser.nth(3) == Indent => {
            Some((ActionDeclaration, action::action))
        }
        Colon => Some((VariableDeclaration, declare::variable)),
        Equal => Some((BindingDeclaration, declare::binding)),
        LeftParen if action::is_header(parser) => Some((ActionDeclaration, action::action)),
        LeftBracket if shared::is_array(parser) => Some((SharedDeclaration, shared::without_word)),
        Identifier => by_two_words(parser, word),
        Newline if parser.nth(2) == Indent && matches!(parser.nth(3), PreKeyword | EffKeyword) => {
            Some((ActionDeclaration, action::action))
        }
        _ => None,
    }
}

/// A declaration that begins with a word of its own.
fn by_word(parser: &Parser<'_>, word: &str) -> Option<Form> {
    match word {
        "invariant" | "always" | "eventually" => {
            property::is_next(parser).then_some((PropertyDeclaration, property::property))
        }
        "check" => property::is_check(parser).then_some((CheckDeclaration, property::check)),
        "stable" => stable::form(parser),
        "init" => declare::is_init(parser).then_some((InitDeclaration, declare::init)),
        _ => by_meaning(word).filter(|_| contextual(parser)),
    }
}

/// A declaration as other languages begin it, with two words.
fn by_two_words(parser: &Parser<'_>, word: &str) -> Option<Form> {
    if parser.nth(2) == LeftParen && action::is_header_at(parser, 2) && word == "action" {
        return Some((ActionDeclaration, declare::foreign_action));
    }
    match word {
        "never" => return Some((PropertyDeclaration, property::property)),
        "forall" | "exists" => return Some((PropertyDeclaration, property::without_word)),
        "from" => return Some((Import, declare::import_from)),
        "when" | "receive" | "upon" if parser.nth(2) == LeftParen => {
            return Some((HandlerDeclaration, handler::without_word));
        }
        _ => {}
    }
    let meant = slips::foreign_declaration(word);
    let variable = slips::is_variable_word(word) && parser.nth(2) != LeftParen;
    match meant {
        Some(meant) if !variable => {
            let (kind, _) = by_meaning(meant)?;
            Some((kind, declare::foreign_word))
        }
        _ if variable => Some((VariableDeclaration, declare::foreign_variable)),
        _ => None,
    }
}

/// The form that begins with the word.
pub(super) fn by_meaning(word: &str) -> Option<Form> {
    Some(match word {
        "program" => (ProgramHeader, declare::header),
        "library" => (LibraryHeader, declare::header),
        "import" => (Import, declare::import),
        "enum" => (EnumDeclaration, record::enumeration),
        "record" => (RecordDeclaration, record::record),
        "message" => (MessageDeclaration, record::message),
        "param" => (ParameterDeclaration, declare::parameter),
        "const" => (ConstantDeclaration, declare::constant),
        "stable" => (VariableDeclaration, stable::variable),
        "function" => (FunctionDeclaration, declare::function),
        "role" => (RoleDeclaration, declare::role),
        "allread" => (SharedDeclaration, shared::all_read),
        "allwrite" => (SharedDeclaration, shared::all_write),
        "invariant" | "always" | "eventually" => (PropertyDeclaration, property::property),
        "check" => (CheckDeclaration, property::check),
        _ => return None,
    })
}
