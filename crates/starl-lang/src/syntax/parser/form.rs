//! Which declaration is next, by its first words.

use super::slips::{foreign_declaration, is_variable_word};
use super::{Parser, SyntaxKind, SyntaxKind::*};

/// The kind of declaration, and the function that parses it from its first word.
pub(super) type Form<'a> = (SyntaxKind, fn(&mut Parser<'a>));

impl<'a> Parser<'a> {
    /// The form of the declaration that is next, if it is one.
    pub(super) fn form(&self) -> Option<Form<'a>> {
        let next = self.nth(1);
        match self.current() {
            OnKeyword if next != Colon && next != Equal => {
                return Some((HandlerDeclaration, Self::handler));
            }
            LetKeyword => return Some((VariableDeclaration, Self::let_variable)),
            // A keyword as the name of a variable or an action; `name` reports it.
            kind if kind.is_keyword() && next == Colon && self.nth(2) == Identifier => {
                return Some((VariableDeclaration, Self::variable));
            }
            Identifier => {}
            _ => return None,
        }
        let word = self.word();
        if let Some(form) = self.form_by_word(word) {
            return Some(form);
        }
        match next {
            Colon if self.is_koord_variable() => Some((VariableDeclaration, Self::koord_variable)),
            Identifier if word == "using" => Some((BindingDeclaration, Self::koord_using)),
            LeftParen if self.is_function_without_word() => {
                Some((FunctionDeclaration, Self::function_without_word))
            }
            Colon if self.nth(2) == Newline && self.nth(3) == Indent => {
                Some((ActionDeclaration, Self::action))
            }
            Colon => Some((VariableDeclaration, Self::variable)),
            Equal => Some((BindingDeclaration, Self::binding)),
            LeftParen if self.is_action_header(1) => Some((ActionDeclaration, Self::action)),
            LeftBracket if self.is_array() => Some((SharedDeclaration, Self::shared_without_word)),
            Identifier => self.form_by_two_words(word),
            Newline if self.nth(2) == Indent && matches!(self.nth(3), PreKeyword | EffKeyword) => {
                Some((ActionDeclaration, Self::action))
            }
            _ => None,
        }
    }

    /// A declaration that begins with a word of its own.
    fn form_by_word(&self, word: &str) -> Option<Form<'a>> {
        match word {
            "invariant" | "always" | "eventually" => self
                .is_property()
                .then_some((PropertyDeclaration, Self::property)),
            "check" => self.is_check().then_some((CheckDeclaration, Self::check)),
            "stable" => self.stable_form(),
            "init" => self.is_init().then_some((InitDeclaration, Self::init)),
            _ => by_meaning(word).filter(|_| self.is_contextual()),
        }
    }

    /// A declaration as other languages begin it, with two words.
    fn form_by_two_words(&self, word: &str) -> Option<Form<'a>> {
        if self.nth(2) == LeftParen && self.is_action_header(2) && word == "action" {
            return Some((ActionDeclaration, Self::foreign_action));
        }
        match word {
            "never" => return Some((PropertyDeclaration, Self::property)),
            "forall" | "exists" => return Some((PropertyDeclaration, Self::property_without_word)),
            "from" => return Some((Import, Self::import_from)),
            "when" | "receive" | "upon" if self.nth(2) == LeftParen => {
                return Some((HandlerDeclaration, Self::handler_without_word));
            }
            _ => {}
        }
        let meant = foreign_declaration(word);
        let variable = is_variable_word(word) && self.nth(2) != LeftParen;
        match meant {
            Some(meant) if !variable => {
                let (kind, _) = by_meaning(meant)?;
                Some((kind, Self::foreign_word))
            }
            _ if variable => Some((VariableDeclaration, Self::foreign_variable)),
            _ => None,
        }
    }
}

/// The form that begins with the word.
pub(super) fn by_meaning<'a>(word: &str) -> Option<Form<'a>> {
    Some(match word {
        "program" => (ProgramHeader, Parser::header),
        "library" => (LibraryHeader, Parser::header),
        "import" => (Import, Parser::import),
        "enum" => (EnumDeclaration, Parser::enumeration),
        "record" => (RecordDeclaration, Parser::record),
        "message" => (MessageDeclaration, Parser::message),
        "param" => (ParameterDeclaration, Parser::parameter),
        "const" => (ConstantDeclaration, Parser::constant),
        "stable" => (VariableDeclaration, Parser::stable_variable),
        "function" => (FunctionDeclaration, Parser::function),
        "role" => (RoleDeclaration, Parser::role),
        "allread" => (SharedDeclaration, Parser::all_read),
        "allwrite" => (SharedDeclaration, Parser::all_write),
        "invariant" | "always" | "eventually" => (PropertyDeclaration, Parser::property),
        "check" => (CheckDeclaration, Parser::check),
        _ => return None,
    })
}
