//! Inputs: handlers of operators' orders, `on input go_home(to: Point)`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use starl_core::Order;

use super::collect::name_of;
use super::report::counted;
use super::resolution::Symbol;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Event, Site, Type};
use crate::syntax::ast::{self, AstNode};

/// The fields of an input with the places of their names.
type Fields = Vec<(String, Type, Span)>;

/// Whether the field of an input may be of this type: one of which an order can carry a value.
#[must_use]
pub fn is_input_field(ty: &Type) -> bool {
    match ty {
        Type::Bool | Type::Int | Type::Float | Type::String | Type::Point | Type::Robot => true,
        Type::List(element) => matches!(**element, Type::Point | Type::Robot),
        _ => false,
    }
}

impl Checker {
    /// `on input name(a: T)`
    pub(super) fn check_input(
        &mut self,
        role: Option<u16>,
        node: &ast::HandlerDeclaration,
        name: &ast::Name,
    ) {
        let (text, span) = (name.text(), name.span());
        let fields = self.input_fields(node);
        if text == Order::WAY_POINTS && !fields.is_empty() {
            let message = "the input `way_points` has no fields";
            let problem = Diagnostic::new(Code::HandlerParameters, span, message);
            let problem = problem.expected("`on input way_points()`");
            let problem = problem.found(counted(fields.len(), "field"));
            self.report(
                problem.note("the event has no values; read the new waypoints with `way_points()`"),
            );
        }
        self.compare_with_others(role, &text, &fields, span);
        let parameters = (node.fields().zip(&fields))
            .map(|(parameter, (_, ty, _))| (ast::Named::name(&parameter), ty.clone()))
            .collect();
        let fields = fields.into_iter().map(|(name, ty, _)| (name, ty));
        let event = Event::Input {
            name: text,
            fields: fields.collect(),
        };
        self.add_handler(
            (event, span),
            role,
            node,
            parameters,
            Some(Code::UnusedLocal),
        );
    }

    /// The fields that are named, with their types; reports types that no order carries.
    fn input_fields(&mut self, node: &ast::HandlerDeclaration) -> Fields {
        let mut fields = Fields::new();
        for parameter in node.fields() {
            let ty = self.written_or_error(parameter.ty());
            let name = name_of(&parameter);
            let (name, span) = name.map_or((String::new(), parameter.span()), |name| {
                (name.text, name.span)
            });
            if name == "_" {
                let message = "a field of an input needs a name";
                let problem = Diagnostic::new(Code::HandlerParameters, span, message);
                self.report(problem.note("omit unused fields"));
            }
            let is_known = ty == Type::Error || is_input_field(&ty);
            if let Some(written) = parameter.ty().filter(|_| !is_known) {
                let message = format!("an order carries no {}", self.name_of(&ty));
                let problem = Diagnostic::new(Code::InputField, written.span(), message);
                let problem = problem.note(
                    "it carries Bool, Int, Float, String, Point, RobotId, List[Point] and List[RobotId]",
                );
                let is_record = match &ty {
                    Type::Record(_) => true,
                    Type::List(element) => matches!(**element, Type::Record(_)),
                    _ => false,
                };
                let note = "give each part a field of its own, such as `at: Point, count: Int`";
                self.report(problem.note_if(is_record.then_some(note)));
            }
            let ty = if is_known { ty } else { Type::Error };
            fields.push((name, ty, span));
        }
        fields
    }

    /// Reports a second handler of an input in one role, and one that has other fields than the first.
    fn compare_with_others(&mut self, role: Option<u16>, name: &str, fields: &Fields, span: Span) {
        let others: Vec<_> = (self.program.handlers.iter().enumerate())
            .filter_map(|(number, handler)| match &handler.event {
                Event::Input {
                    name: other,
                    fields,
                } if other == name => Some((number, handler.role, handler.site, fields.clone())),
                _ => None,
            })
            .collect();
        let Some((first, _, site, expected)) = others.first() else {
            return;
        };
        self.resolve(span, Symbol::Input(*first as u32));
        if let Some((_, _, Site { span: first, .. }, _)) =
            others.iter().find(|(_, other, ..)| *other == role)
        {
            let message = format!("there are two handlers of the input `{name}`");
            let problem = Diagnostic::new(Code::DuplicateName, span, message);
            let problem = problem.label(*first, "the first one");
            self.report(problem.note("put the statements together"));
            return;
        }
        let is_same = expected.len() == fields.len()
            && expected.iter().zip(fields).all(|(expected, field)| {
                let is_error = expected.1 == Type::Error || field.1 == Type::Error;
                expected.0 == field.0 && (is_error || expected.1 == field.1)
            });
        if !is_same {
            let message = format!("handlers of the input `{name}` have different fields");
            let fields = expected.iter();
            let fields: Vec<String> = fields
                .map(|(name, ty)| format!("{name}: {}", self.name_of(ty)))
                .collect();
            let form = format!("`on input {name}({})`", fields.join(", "));
            let problem = Diagnostic::new(Code::HandlerParameters, span, message);
            let problem = problem.label(site.span, "the first one").expected(form);
            self.report(problem);
        }
    }
}
