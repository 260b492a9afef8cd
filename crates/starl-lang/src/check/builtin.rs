//! Calls of built-in functions.

use alloc::format;
use alloc::vec::Vec;

use super::arguments::Parameters;
use super::report::{counted, made, something};
use super::shape::Letters;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Type};
use crate::syntax::ast;

impl Checker {
    pub fn call_builtin(
        &mut self,
        builtin: Builtin,
        at: Span,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        let signature = builtin.signature();
        if !signature.is_call {
            let message = format!("`{}` is not called", signature.name);
            let problem = Diagnostic::new(Code::NotCallable, at, message);
            let brackets = Span::new(at.end, span.end);
            self.report(problem.replace("remove the brackets", brackets, ""));
            return self.name(signature.name, at, None);
        }
        if self.is_of_sensors(signature.name, at)
            || !self.allowed(builtin.purity(), signature.name, at)
        {
            self.check_anyway(arguments);
            let ty = self.shape_type(&signature.result, &Letters::new());
            return made(ExpressionKind::Error, something(ty), span);
        }
        self.resolve_arguments(arguments, builtin.text(), &signature);
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let mut letters = Letters::new();
        let values = self.shaped_arguments(&signature, arranged.values, &mut letters, span);
        let rest: Vec<_> = (arranged.rest.into_iter())
            .map(|(name, value)| (name, self.value(Some(value), None, "this")))
            .collect();
        if let Builtin::Min | Builtin::Max | Builtin::Clamp | Builtin::Random = builtin
            && let [Some(first), others @ ..] = &values[..]
        {
            for other in others.iter().flatten() {
                self.check_dimensions(signature.name, first, other, span);
            }
        }
        if builtin == Builtin::Log {
            self.check_format(&values, rest.len());
        }
        let ty = self.shape_type(&signature.result, &letters);
        let kind = ExpressionKind::Builtin {
            builtin,
            arguments: values,
            rest,
        };
        made(kind, ty.unwrap_or(Type::Error), span)
    }

    /// Warns if the `{}` of a text do not match the values after it.
    pub fn check_format(&mut self, arguments: &[Option<Expression>], values: usize) {
        let Some(Some(format)) = arguments.first() else {
            return;
        };
        let ExpressionKind::String(text) = &format.kind else {
            return;
        };
        let places = text.matches("{}").count();
        if places != values {
            let message = format!(
                "the text has {places} `{{}}`, for {}",
                counted(values, "value")
            );
            self.error(Code::FormatValues, format.span, message);
        }
    }
}
