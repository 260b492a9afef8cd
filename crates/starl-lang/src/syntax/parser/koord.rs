//! Declarations as Koord writes them.

use alloc::format;
use alloc::string::String;

use super::slips::type_of;
use super::{Code, Diagnostic, Parser, SyntaxKind::*};

impl Parser<'_> {
    /// Whether `allwrite: int sum`, `allread: Point[] pos` or `local: bool added` is next.
    pub(super) fn is_koord_variable(&self) -> bool {
        matches!(self.word(), "allwrite" | "allread" | "local")
            && self.nth(1) == Colon
            && self.nth(2) == Identifier
            && match self.nth(3) {
                Identifier => true,
                LeftBracket => self.nth(4) == RightBracket && self.nth(5) == Identifier,
                _ => false,
            }
    }

    /// Reports the declaration in StarL, and skips the line.
    pub(super) fn koord_variable(&mut self) {
        let first = self.span();
        let word = self.word();
        let ty = self.nth_span(2).of(self.text);
        let ty = type_of(ty);
        let is_array = self.nth(3) == LeftBracket;
        let named = self.nth_span(if is_array { 5 } else { 3 });
        let name = named.of(self.text);
        let form: String = match (word, is_array) {
            ("allread", _) => format!("allread {name}[RobotId]: {ty}"),
            ("allwrite", false) => format!("allwrite {name}: {ty}"),
            ("allwrite", true) => format!("allwrite {name}: List[{ty}]"),
            (_, false) => format!("{name}: {ty}"),
            (_, true) => format!("{name}: List[{ty}]"),
        };
        let span = first.to(named);
        let message = "the name of a variable stands before its type";
        let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
        self.report(problem.write(span, form));
        self.skip_to_line_end();
    }

    /// Reports `using Motion`, and skips the line.
    pub(super) fn koord_using(&mut self) {
        let span = self.span().to(self.nth_span(1));
        let message = "`using` does not begin a declaration";
        let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
        let problem = problem.note("the ports of Koord are methods and flags of a primitive");
        let form = "motion = ReachAvoid()";
        self.report(problem.write(span, form));
        self.skip_to_line_end();
    }
}
