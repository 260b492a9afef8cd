//! Arguments: sorted by parameters, and checked against the types of those.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::fit::{is_whole, whole};
use super::report::{broken, counted, did_you_mean};
use super::resolution::Symbol;
use super::shape::Letters;
use super::state::Checker;
use super::tables::{Shape, Signature};
use crate::diagnostic::{Code, Diagnostic, Edit, Span};
use crate::ir::{Expression, Type};
use crate::syntax::ast::{self, AstNode};

/// Arguments sorted by parameters.
pub(super) struct Arranged {
    pub values: Vec<Option<ast::Expression>>,
    /// Those beyond the parameters, with their names.
    pub rest: Vec<(Option<String>, ast::Expression)>,
}

/// The parameters of a function, method, record or message.
pub(super) struct Parameters<'a> {
    /// Its name in messages.
    pub callee: &'a str,
    /// Names, and whether each may be left out.
    pub names: Vec<(&'a str, bool)>,
    pub takes_values: bool,
    pub takes_fields: bool,
}

impl<'a> Parameters<'a> {
    pub fn of(signature: &'a Signature) -> Self {
        Self {
            callee: signature.name,
            names: (signature.parameters.iter())
                .map(|parameter| (parameter.name, parameter.is_optional))
                .collect(),
            takes_values: signature.takes_values,
            takes_fields: signature.takes_fields,
        }
    }
}

impl Checker {
    /// An argument for each parameter, all of which must be given.
    pub fn typed_arguments(
        &mut self,
        callee: &str,
        parameters: &[(String, Type)],
        arguments: &[ast::Argument],
        span: Span,
    ) -> Vec<Expression> {
        let names = Parameters {
            callee,
            names: parameters
                .iter()
                .map(|(name, _)| (name.as_str(), false))
                .collect(),
            takes_values: false,
            takes_fields: false,
        };
        let arranged = self.arrange(&names, arguments, span);
        (arranged.values.into_iter().zip(parameters))
            .map(|(value, (name, ty))| match value {
                Some(value) => self.expect(Some(value), ty, &format!("the argument `{name}`")),
                None => broken(span),
            })
            .collect()
    }

    /// Arguments by the shapes of a signature's parameters; omitted ones are none.
    pub fn shaped_arguments(
        &mut self,
        signature: &Signature,
        values: Vec<Option<ast::Expression>>,
        letters: &mut Letters,
        span: Span,
    ) -> Vec<Option<Expression>> {
        let mut checked = Vec::with_capacity(values.len());
        // While the arguments are whole numbers, a Float may follow, as in `max(0, speed)`: then they are Floats too.
        let mut are_whole = letters.is_empty();
        for (value, parameter) in values.into_iter().zip(&signature.parameters) {
            let (shape, is_first) = (&parameter.shape, checked.is_empty());
            let role = format!("the argument `{}`", parameter.name);
            let value = match (value, shape) {
                (Some(value), Shape::Letter(letter))
                    if are_whole && !is_first && *shape == signature.parameters[0].shape =>
                {
                    let value = self.infer(Some(value), Some(&Type::Int));
                    let is_float = value.ty == Type::Float;
                    let expected = if is_float { Type::Float } else { Type::Int };
                    letters.insert(*letter, expected.clone());
                    Some(self.fit(value, &expected, &role))
                }
                (Some(value), _) => Some(self.shaped(value, shape, letters, &role)),
                (None, _) if parameter.is_optional => None,
                (None, _) => Some(broken(span)),
            };
            are_whole &=
                *shape == signature.parameters[0].shape && value.as_ref().is_some_and(is_whole);
            checked.push(value);
        }
        for (value, parameter) in checked.iter_mut().zip(&signature.parameters) {
            if self.shape_type(&parameter.shape, letters) == Some(Type::Float) {
                *value = value.take().map(whole);
            }
        }
        if let [Some(first), Some(second)] = &checked[..] {
            self.join_swapped(first.span, second.span);
        }
        checked
    }

    /// Makes one message of the two about arguments at these places, if each is where the other belongs.
    fn join_swapped(&mut self, first: Span, second: Span) {
        let diagnostics = &mut self.files[self.file as usize].checked.diagnostics;
        let [.., a, b] = &diagnostics[..] else {
            return;
        };
        let wrong = [(a, first), (b, second)].iter().all(|(problem, span)| {
            problem.code == Code::WrongType && problem.span == *span && problem.fix.is_none()
        });
        let swapped = a.found == b.expected || b.found == a.expected;
        if !wrong || !swapped {
            return;
        }
        diagnostics.truncate(diagnostics.len() - 2);
        let texts = [first, second].map(|span| self.text(span).to_string());
        let message = "these arguments are in the wrong order";
        let problem = Diagnostic::new(Code::WrongType, first, message);
        let [one, other] = texts;
        let edits = [Edit::new(first, other), Edit::new(second, one)];
        self.report(
            problem
                .label(second, "this is the first")
                .edits("swap them", edits),
        );
    }

    pub fn shaped(
        &mut self,
        value: ast::Expression,
        shape: &Shape,
        letters: &mut Letters,
        role: &str,
    ) -> Expression {
        if let Some(expected) = self.shape_type(shape, letters) {
            return self.expect(Some(value), &expected, role);
        }
        let hint = matches!(shape, Shape::Letter(b'F')).then_some(&Type::Float);
        let value = self.value(Some(value), hint, role);
        let before = letters.clone();
        if self.shape_matches(shape, &value.ty, letters) {
            return value;
        }
        *letters = before;
        let code = if matches!(value.ty, Type::Optional(_)) {
            Code::MayBeNone
        } else {
            Code::WrongType
        };
        let message = match code {
            Code::MayBeNone => format!("{role} may be none"),
            _ => format!("{role} has the wrong type"),
        };
        let problem = Diagnostic::new(code, value.span, message);
        let expected = self.shape_name(shape, letters);
        let found = self.name_of(&value.ty);
        self.report(problem.expected(expected).found(found));
        broken(value.span)
    }

    /// Sorts arguments by parameters and reports what does not fit.
    pub fn arrange(
        &mut self,
        parameters: &Parameters<'_>,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Arranged {
        if self.probe.is_some() {
            self.note_probed_arguments(&parameters.names, arguments);
        }
        let mut values: Vec<Option<ast::Expression>> =
            parameters.names.iter().map(|_| None).collect();
        let mut rest = Vec::new();
        let mut position = 0;
        let mut surplus = None;
        let mut is_doubled = false;
        for argument in arguments {
            if argument.comprehension().is_some() {
                self.misplaced_comprehension(argument);
                return Arranged { values, rest };
            }
            let Some(value) = argument.value() else {
                continue;
            };
            let Some(name) = argument.name() else {
                match values.get_mut(position) {
                    Some(place @ None) => *place = Some(value),
                    Some(_) => {
                        let message = format!("`{}` is given twice", parameters.names[position].0);
                        self.error(Code::ArgumentCount, argument.span(), message);
                        self.infer_alone(Some(value));
                        is_doubled = true;
                    }
                    None if parameters.takes_values => rest.push((None, value)),
                    None => surplus = surplus.or(Some((argument.span(), value))),
                }
                position += 1;
                continue;
            };
            let (text, at) = (name.text(), name.span());
            match parameters.names.iter().position(|(own, _)| *own == text) {
                Some(number) if values[number].is_none() => values[number] = Some(value),
                Some(_) => {
                    let message = format!("`{text}` is given twice");
                    self.error(Code::ArgumentCount, at, message);
                }
                None if parameters.takes_fields => rest.push((Some(text), value)),
                None => {
                    let message = format!("`{}` has no parameter `{text}`", parameters.callee);
                    let problem = Diagnostic::new(Code::ArgumentName, at, message);
                    let names = parameters.names.iter().map(|(name, _)| *name);
                    let problem = did_you_mean(problem, at, &text, names);
                    self.report(problem);
                    // The unknown argument may be meant for a missing parameter, so missing ones are not reported.
                    return Arranged { values, rest };
                }
            }
        }
        if is_doubled {
            // The extra argument may be meant for a missing parameter, so missing ones are not reported.
            return Arranged { values, rest };
        }
        let given = arguments.len();
        if let Some((at, _)) = surplus {
            self.wrong_count(parameters, given, at);
        } else if let Some((name, _)) = (parameters.names.iter().zip(&values))
            .find(|((_, optional), value)| !optional && value.is_none())
            .map(|(parameter, _)| *parameter)
        {
            let message = format!("`{}` needs `{name}`", parameters.callee);
            let at = Span::new(span.end.saturating_sub(1), span.end);
            let problem = Diagnostic::new(Code::ArgumentCount, at, message);
            let problem = self.with_count(problem, parameters, given);
            let before = if given > 0 { ", " } else { "" };
            self.report(match name {
                "unsafe" => {
                    let place = Span::empty(at.start);
                    let form = format!("{before}obstacles()");
                    problem.replace("write `obstacles()` for those that are known", place, form)
                }
                _ => problem,
            });
        }
        Arranged { values, rest }
    }

    pub fn wrong_count(&mut self, parameters: &Parameters<'_>, given: usize, at: Span) {
        let message = format!("`{}` takes no such argument", parameters.callee);
        let problem = Diagnostic::new(Code::ArgumentCount, at, message);
        let problem = self.with_count(problem, parameters, given);
        self.report(problem);
    }

    pub fn with_count(
        &self,
        problem: Diagnostic,
        parameters: &Parameters<'_>,
        given: usize,
    ) -> Diagnostic {
        let most = parameters.names.len();
        let least = parameters
            .names
            .iter()
            .filter(|(_, optional)| !optional)
            .count();
        let expected = if least == most {
            counted(most, "argument")
        } else {
            format!("{least} to {}", counted(most, "argument"))
        };
        let names: Vec<String> = (parameters.names.iter())
            .map(|(name, optional)| format!("{name}{}", if *optional { "?" } else { "" }))
            .collect();
        let form = format!("{}({})", parameters.callee, names.join(", "));
        problem
            .expected(expected)
            .found(given.to_string())
            .note(form)
    }

    /// Resolves the names of arguments.
    pub fn resolve_names(
        &mut self,
        arguments: &[ast::Argument],
        symbol: impl Fn(&Self, &str) -> Option<Symbol>,
    ) {
        for name in arguments.iter().filter_map(ast::Argument::name) {
            if let Some(symbol) = symbol(self, &name.text()) {
                self.resolve(name.span(), symbol);
            }
        }
    }

    /// The same for something that is built in.
    pub fn resolve_arguments(
        &mut self,
        arguments: &[ast::Argument],
        text: &'static str,
        signature: &Signature,
    ) {
        self.resolve_names(arguments, |_, name| {
            let mut parameters = signature.parameters.iter();
            let found = parameters.find(|parameter| parameter.name == name)?;
            Some(Symbol::Argument(text, found.name))
        });
    }

    /// Checks the arguments of something that cannot be called, which is reported.
    pub fn broken_call(&mut self, arguments: &[ast::Argument], span: Span) -> Expression {
        for argument in arguments {
            self.infer_alone(argument.value());
        }
        broken(span)
    }
}
