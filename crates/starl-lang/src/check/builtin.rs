//! Calls of built-in functions.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::arguments::Parameters;
use super::report::{article, counted, made, something};
use super::shape::Letters;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Type};
use crate::syntax::ast::{self, AstNode};

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
            self.broken_call(arguments, at);
            let ty = self.shape_type(&signature.result, &Letters::new());
            return made(ExpressionKind::Error, something(ty), span);
        }
        self.resolve_arguments(arguments, builtin.text(), &signature);
        if let (Builtin::Min | Builtin::Max, [only]) = (builtin, arguments)
            && let Some(value) = only.value()
            && self.probe.is_none()
        {
            return self.extreme_of_one(signature.name, value, span);
        }
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let mut letters = Letters::new();
        let reported = self.files[self.file as usize].checked.diagnostics.len();
        let values = self.shaped_arguments(&signature, arranged.values, &mut letters, span);
        if let [Some(first)] = &values[..] {
            self.explain_argument(builtin, reported, first.span, span);
        }
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

    /// Reports `max(xs)`.
    fn extreme_of_one(&mut self, name: &str, value: ast::Expression, span: Span) -> Expression {
        let at = value.span();
        let value = self.infer(Some(value), None);
        let message = format!("`{name}` needs two values, or the elements of a collection");
        let problem = Diagnostic::new(Code::ArgumentCount, at, message);
        let form = format!("x for x in {}", self.text(at));
        match value.ty {
            Type::Error => {}
            Type::List(_) | Type::Set(_) => {
                self.report(problem.replace(format!("write `{name}({form})`"), at, form));
            }
            _ => self.report(problem.expected("2 arguments").found("1")),
        }
        super::report::broken(span)
    }

    /// Adds the fix to a report, the one with this number, that the first argument has the wrong type.
    fn explain_argument(&mut self, builtin: Builtin, number: usize, at: Span, call: Span) {
        let text = self.text(at).to_string();
        let diagnostics = &mut self.files[self.file as usize].checked.diagnostics;
        let is_meant = |problem: &&mut Diagnostic| {
            let is_open = problem.fix.is_none() || builtin == Builtin::Log;
            problem.code == Code::WrongType && problem.span == at && is_open
        };
        let Some(problem) = diagnostics.get_mut(number).filter(is_meant) else {
            return;
        };
        let found = problem.found.clone().unwrap_or_default();
        let (message, span, form) = match (builtin, found.as_str()) {
            (Builtin::Log, _) => {
                let form = "\"{}\", ".to_string() + &text;
                (format!("write `{form}`"), at, form)
            }
            (Builtin::ToFloat, "Duration") => {
                let form = format!("{text} / 1s");
                (format!("write `{form}`, the number of seconds"), call, form)
            }
            (Builtin::ToInt, "Duration") => {
                let form = format!("{text} / 1s");
                (
                    format!("write `Int({form})`, the number of seconds"),
                    at,
                    form,
                )
            }
            (Builtin::ToInt | Builtin::ToFloat, found) if found == builtin.name() => {
                (format!("it is {} already", article(found)), call, text)
            }
            (Builtin::ToInt | Builtin::ToFloat, "String") => {
                let method = match builtin {
                    Builtin::ToInt => "to_int",
                    _ => "to_float",
                };
                let form = format!("{text}.{method}()");
                (format!("write `{form}`, an optional"), call, form)
            }
            (Builtin::ToInt | Builtin::ToFloat, "Bool") => {
                let form = format!("if {text} then 1 else 0");
                (format!("write `{form}`"), call, form)
            }
            _ => return,
        };
        *problem = problem.clone().replace(message, span, form);
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
