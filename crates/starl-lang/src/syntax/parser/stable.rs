//! `stable name: Type`: a variable that survives a crash if the robot has storage.

use super::form::{Form, by_meaning};
use super::item::Place;
use super::{Code, Diagnostic, Parser, SyntaxKind::*};

impl<'a> Parser<'a> {
    /// The form of a declaration that begins with `stable`; none if the word names something here.
    pub(super) fn stable_form(&self) -> Option<Form<'a>> {
        let keyword = self.nth(1).is_keyword() && self.nth(2) == Colon;
        if self.nth(1) != Identifier && !keyword {
            return None;
        }
        let word = self.nth_span(1).of(self.text);
        let (kind, parse): Form<'a> = match (self.nth(2), by_meaning(word)) {
            (Equal, _) => (BindingDeclaration, Self::stable_without_type),
            (Identifier | LeftBracket, Some((kind, _))) => (kind, Self::not_stable),
            _ => (VariableDeclaration, Self::stable_variable),
        };
        Some((kind, parse))
    }

    /// `stable name: Type`, and a value if it has one.
    pub(super) fn stable_variable(&mut self) {
        self.bump();
        if self.nth(1) == Identifier {
            self.foreign_variable();
        } else {
            self.variable();
        }
    }

    /// `stable name = Primitive()`, or a variable whose type is missing.
    fn stable_without_type(&mut self) {
        if self.nth(3) == Identifier && self.nth(4) == LeftParen {
            return self.not_stable();
        }
        self.bump_error();
        self.binding();
    }

    /// `stable` before the declaration of something else.
    fn not_stable(&mut self) {
        let what = match self.nth_span(1).of(self.text) {
            _ if self.nth(2) == Equal => "a primitive",
            "allread" | "allwrite" => "a shared variable",
            "param" => "a parameter",
            "const" => "a constant",
            _ => "this",
        };
        let message = alloc::format!("{what} cannot be stable");
        let problem = Diagnostic::new(Code::Misplaced, self.span(), message);
        self.report(problem.note("only a variable can, as in `stable left: Int = 3`"));
        self.bump_error();
        if let Some((_, parse)) = self.form() {
            parse(self);
        }
    }

    /// Reports `stable` at a variable of a role.
    pub(super) fn check_stable_place(&mut self, place: Place) {
        let is_stable =
            self.at(Identifier) && self.word() == "stable" && self.stable_form().is_some();
        if place == Place::Role && is_stable {
            let message = "a variable of a role cannot be stable";
            let problem = Diagnostic::new(Code::Misplaced, self.span(), message);
            self.report(problem.note(
                "it gets its initial value whenever the robot enters the role; declare it outside",
            ));
        }
    }
}
