//! Names after a dot: fields, coordinates, flags, variants, and declarations of libraries.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::body::Where;
use super::name::robot_member;
use super::report::{broken, did_you_mean, listed, made, something};
use super::resolution::Symbol;
use super::scope::Entity;
use super::state::Checker;
use super::surroundings::Surroundings;
use super::tables::{Builtin, Member, Method, Primitive, Signature};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BindingId, EnumId, Expression, ExpressionKind, RobotMember, Type};
use crate::syntax::ast::{self, AstNode};

/// A part of a value that has a name.
pub(super) enum Part {
    /// A field of a record, by its number.
    Field(u32),
    /// A coordinate of a point, by its axis.
    Coordinate(u8),
}

/// The coordinates of a point.
const AXES: [&str; 3] = ["x", "y", "z"];

impl Checker {
    /// The library, primitive or enum that the expression names; `None` for a value.
    pub fn namespace(&mut self, base: &ast::Expression) -> Option<Entity> {
        match base {
            ast::Expression::Name(node) => {
                let name = node.text();
                if self.body.find(&name).is_some() {
                    return None;
                }
                let entity = (self.declared(self.file, &name))
                    .or_else(|| self.declared(super::prelude::FILE, &name))?;
                if let Entity::Library(file) = entity {
                    self.usage.imports.insert((self.file, file));
                }
                self.usage.used.insert(entity);
                let has_parts = matches!(
                    entity,
                    Entity::Library(_) | Entity::Binding(_) | Entity::Enum(_) | Entity::Broken
                );
                if has_parts {
                    self.resolve_entity(node.span(), entity);
                }
                has_parts.then_some(entity)
            }
            ast::Expression::Field(node) => {
                let Entity::Library(file) = self.namespace(&node.base()?)? else {
                    return None;
                };
                let name = node.field()?;
                let entity = self.declared(file, name.text())?;
                let is_enum = matches!(entity, Entity::Enum(_));
                if is_enum {
                    self.resolve_entity(name.text_range().into(), entity);
                }
                is_enum.then_some(entity)
            }
            _ => None,
        }
    }

    /// `base.name`
    pub fn member(&mut self, node: &ast::FieldExpression, span: Span) -> Expression {
        let Some(word) = node.field() else {
            self.infer(node.base(), None);
            return broken(span);
        };
        let (name, at) = (word.text(), Span::from(word.text_range()));
        match node.base().and_then(|base| self.namespace(&base)) {
            Some(Entity::Library(file)) => match self.library_entity(file, name, at) {
                Some(entity) => self.entity_value(entity, name, span),
                None => broken(span),
            },
            Some(Entity::Binding(id)) => self.flag(id, name, at, span),
            Some(Entity::Enum(id)) => self.qualified_variant(id, name, span),
            Some(_) => broken(span),
            None => {
                let base = self.infer(node.base(), None);
                self.field(base, name, at, span)
            }
        }
    }

    /// The public declaration of this name in a library.
    pub fn library_entity(&mut self, file: u32, name: &str, at: Span) -> Option<Entity> {
        if self.is_probe(at) {
            self.note_probe(Surroundings::Part(Symbol::File(file)));
        }
        let library = &self.files[file as usize];
        let entity = library.scope.get(name).map(|declared| declared.entity);
        match entity {
            Some(Entity::Library(_)) | None => {
                if library.unread.contains(name) {
                    return None;
                }
                let message = format!("the library `{}` has no `{name}`", library.checked.name);
                let problem = Diagnostic::new(Code::UnknownName, at, message);
                let names = library.scope.keys().map(String::as_str);
                let problem = did_you_mean(problem, at, name, names);
                self.report(problem);
                None
            }
            Some(entity) => {
                self.resolve_entity(at, entity);
                Some(entity)
            }
        }
    }

    /// `Enum.variant`
    pub fn qualified_variant(&mut self, id: EnumId, name: &str, span: Span) -> Expression {
        let at = Span::new(span.end.saturating_sub(name.len() as u32), span.end);
        let variants = &self.program[id].variants;
        match variants.iter().position(|variant| variant.name == name) {
            Some(number) => {
                self.resolve(at, Symbol::Variant(id, number as u16));
                let kind = ExpressionKind::Variant(number as u16);
                made(kind, Type::Enum(id), span)
            }
            None => self.unknown_variant(id, name, at),
        }
    }

    /// A method or flag of a primitive by its name.
    pub fn primitive_member(
        &mut self,
        id: BindingId,
        name: &str,
        at: Span,
    ) -> Option<&'static Member> {
        if self.is_probe(at) {
            self.note_probe(Surroundings::Part(Symbol::Binding(id)));
        }
        let primitive = self.program[id].primitive?;
        if let Some(member) = primitive.member(name) {
            if let Some(symbol) = Symbol::member(primitive, member) {
                self.resolve(at, symbol);
            }
            return Some(member);
        }
        let message = format!("{} has no `{name}`", primitive.name());
        let problem = Diagnostic::new(Code::UnknownMember, at, message);
        let names = || primitive.members.iter().map(Member::name);
        let foreign = foreign_member(name).filter(|meant| names().any(|own| own == *meant));
        let problem = match foreign {
            Some(meant) => problem.replace(format!("did you mean `{meant}`?"), at, meant),
            None => did_you_mean(problem, at, name, names()),
        };
        let problem = problem.note(format!("it has {}", listed(names())));
        let others: Vec<&str> = Primitive::with_member(name).map(Primitive::name).collect();
        let note = format!("`{name}` belongs to {}", listed(others.iter().copied()));
        self.report(problem.note_if((!others.is_empty()).then_some(note)));
        None
    }

    fn flag(&mut self, id: BindingId, name: &str, at: Span, span: Span) -> Expression {
        let Some(member) = self.primitive_member(id, name, at) else {
            return broken(span);
        };
        let signature = member.signature();
        if signature.is_call {
            let message = format!("`{name}` is called");
            let problem = Diagnostic::new(Code::NotCallable, at, message).note(member.text);
            let needs_none = signature.parameters.iter().all(|one| one.is_optional);
            self.report(match needs_none {
                true => problem.replace(format!("write `{name}()`"), Span::empty(at.end), "()"),
                false => problem,
            });
            return broken(span);
        }
        self.primitive_value(id, member, Vec::new(), &signature, at, span)
    }

    /// A method or flag of a primitive, with its arguments.
    pub fn primitive_value(
        &mut self,
        id: BindingId,
        member: &'static Member,
        arguments: Vec<Option<Expression>>,
        signature: &Signature,
        at: Span,
        span: Span,
    ) -> Expression {
        let ty = self.shape_type(&signature.result, &super::shape::Letters::new());
        let ty = ty.unwrap_or(Type::Error);
        let place = self.body.place;
        if matches!(place, Where::Initial(_) | Where::Property) {
            let what = place.what();
            let message = format!(
                "{what} cannot ask the primitive `{}`",
                self.program[id].name
            );
            self.error(Code::StateOutOfReach, at, message);
            return made(ExpressionKind::Error, something(Some(ty)), span);
        }
        if !self.allowed(member.purity, member.name(), at) {
            return made(ExpressionKind::Error, something(Some(ty)), span);
        }
        let kind = ExpressionKind::Primitive {
            binding: id,
            member,
            arguments,
        };
        made(kind, ty, span)
    }

    /// A field of a value.
    fn field(&mut self, base: Expression, name: &str, at: Span, span: Span) -> Expression {
        self.note_probed_member(at, &base.ty);
        match &base.ty {
            Type::Error => return broken(span),
            Type::Robot => return self.robot_field(base, name, at, span),
            _ => {}
        }
        if let Some((part, ty)) = self.part_named(&base.ty, name, at) {
            let base = Box::new(base);
            let kind = match part {
                Part::Field(field) => ExpressionKind::Field { base, field },
                Part::Coordinate(axis) => ExpressionKind::Coordinate { base, axis },
            };
            return made(kind, ty, span);
        }
        if let Some(method) = Method::of(self.receiver_name(&base.ty)).find(|m| m.name() == name) {
            self.resolve(at, Symbol::Method(method));
            let message = format!("`{name}` is called");
            let problem = Diagnostic::new(Code::NotCallable, at, message);
            let no_arguments = method.signature().parameters.is_empty();
            self.report(if no_arguments {
                problem.replace(format!("write `{name}()`"), Span::empty(at.end), "()")
            } else {
                problem.note(method.text())
            });
            return broken(span);
        }
        self.unknown_member(&base, name, at);
        broken(span)
    }

    /// The field of a record or the coordinate of a point with this name, at the place `at`, and its type.
    pub fn part_named(&mut self, of: &Type, name: &str, at: Span) -> Option<(Part, Type)> {
        let (part, ty, symbol) = match of {
            Type::Record(id) => {
                let fields = &self.program[*id].fields;
                let number = fields.iter().position(|field| field.name == name)?;
                let (ty, number) = (fields[number].ty.clone(), number as u32);
                (Part::Field(number), ty, Symbol::Field(*id, number))
            }
            Type::Point => {
                let axis = AXES.iter().position(|axis| *axis == name)?;
                let symbol = Symbol::Coordinate(AXES[axis]);
                (Part::Coordinate(axis as u8), Type::Float, symbol)
            }
            _ => return None,
        };
        self.resolve(at, symbol);
        Some((part, ty))
    }

    /// `r.variable` in a property.
    fn robot_field(&mut self, robot: Expression, name: &str, at: Span, span: Span) -> Expression {
        let entity = self.declared(self.file, name);
        let role = (self.program.roles.as_ref()).filter(|_| name == "role");
        let member = match (entity, role) {
            (_, Some(roles)) => Some(RobotMember::Variable(roles.variable)),
            (Some(Entity::Variable(id)), _) => Some(RobotMember::Variable(id)),
            (Some(Entity::Parameter(id)), _) => Some(RobotMember::Parameter(id)),
            (Some(Entity::Shared(id)), _) => Some(RobotMember::Shared(id)),
            _ => robot_member(name),
        };
        if self.body.place != Where::Property {
            let message = format!("`{name}` of another robot is not known here");
            let problem = Diagnostic::new(Code::ForeignVariable, at, message);
            let note = "robots learn about each other by messages, or by `allread` variables";
            self.report(problem.note(note));
            return broken(span);
        }
        let Some(member) = member else {
            let message = format!("a robot has no `{name}`");
            let problem = Diagnostic::new(Code::UnknownMember, at, message);
            let known = ["position", "heading", "velocity", "finished", "up", "id"];
            let variables = self.program.variables.iter();
            let variables = variables.map(|variable| variable.name.as_str());
            let shared = self.program.shared.iter().map(|one| one.name.as_str());
            let names = variables.chain(shared).chain(known);
            let problem = did_you_mean(problem, at, name, names);
            let list = format!("it has the variables of the program, and {}", listed(known));
            self.report(problem.note(list));
            return broken(span);
        };
        self.resolve_robot_member(at, member);
        if let RobotMember::Shared(id) = member
            && self.is_linearizable(id, name, at)
        {
            return broken(span);
        }
        match member {
            RobotMember::Variable(id) => self.usage.used.insert(Entity::Variable(id)),
            RobotMember::Parameter(id) => self.usage.used.insert(Entity::Parameter(id)),
            RobotMember::Shared(id) => self.usage.used.insert(Entity::Shared(id)),
            _ => false,
        };
        self.of_robot(robot, member, span)
    }

    /// A method of a value by its name.
    pub fn method(&mut self, receiver: &Expression, name: &str, at: Span) -> Option<Method> {
        self.note_probed_member(at, &receiver.ty);
        if receiver.ty == Type::Error {
            return None;
        }
        let of = self.receiver_name(&receiver.ty);
        let found = Method::of(of).find(|method| method.name() == name);
        match found {
            Some(method) => self.resolve(at, Symbol::Method(method)),
            None => self.unknown_member(receiver, name, at),
        }
        found
    }

    /// Records an attribute of a robot in a property.
    pub fn resolve_robot_member(&mut self, at: Span, member: RobotMember) {
        self.resolve(
            at,
            match member {
                RobotMember::Variable(id) => Symbol::Variable(id),
                RobotMember::Parameter(id) => Symbol::Parameter(id),
                RobotMember::Shared(id) => Symbol::Shared(id),
                RobotMember::Position => Symbol::RobotMember("position"),
                RobotMember::Heading => Symbol::RobotMember("heading"),
                RobotMember::Velocity => Symbol::RobotMember("velocity"),
                RobotMember::Finished => Symbol::RobotMember("finished"),
                RobotMember::Up => Symbol::RobotMember("up"),
                RobotMember::Id => Symbol::RobotMember("id"),
            },
        );
    }

    fn note_probed_member(&mut self, at: Span, of: &Type) {
        if self.is_probe(at) {
            let in_property = self.body.place == Where::Property;
            self.note_probe(Surroundings::Member {
                of: of.clone(),
                in_property,
            });
        }
    }

    fn unknown_member(&mut self, base: &Expression, name: &str, at: Span) {
        let found = self.name_of(&base.ty);
        if let Type::Optional(inner) = &base.ty {
            let message = format!("this may be none, and none has no `{name}`");
            let problem = Diagnostic::new(Code::MayBeNone, base.span, message);
            let inner = self.name_of(inner);
            let problem = problem.expected(inner).found(found);
            self.report(
                problem.note("test it with `if some x = ...`, or give a default with `?? ...`"),
            );
            return;
        }
        let message = format!("{found} has no `{name}`");
        let problem = Diagnostic::new(Code::UnknownMember, at, message);
        let reported = problem.clone();
        let mut names: Vec<&str> = Method::of(self.receiver_name(&base.ty))
            .map(Method::name)
            .collect();
        match &base.ty {
            Type::Record(id) => {
                names.extend(
                    self.program[*id]
                        .fields
                        .iter()
                        .map(|field| field.name.as_str()),
                );
            }
            Type::Point => names.extend(["x", "y", "z"]),
            _ => {}
        }
        if names.contains(&name) {
            let end = self
                .arguments_after(at)
                .map_or(at.end, |inner| inner.end + 1);
            let problem = Diagnostic::new(Code::NotCallable, at, format!("`{name}` is not called"));
            let brackets = Span::new(at.end, end);
            return self.report(problem.replace("remove the brackets", brackets, ""));
        }
        let foreign = foreign_member(name).filter(|meant| names.contains(meant));
        let hinted = self.member_hint(problem.clone(), base.span, name, at);
        if hinted != reported && foreign.is_none() {
            return self.report(hinted);
        }
        let problem = match foreign {
            Some(meant) => problem.replace(format!("did you mean `{meant}`?"), at, meant),
            None => did_you_mean(problem, at, name, names.iter().copied()),
        };
        let function = Builtin::named(name).filter(|builtin| {
            let signature = builtin.signature();
            signature.is_call && !signature.parameters.is_empty()
        });
        let problem = match function {
            Some(builtin) => {
                let problem = problem.note(format!("it is a function: `{}`", builtin.text()));
                match self.arguments_after(at) {
                    Some(inner) => {
                        let (value, rest) = (self.text(base.span), self.text(inner));
                        let comma = if rest.is_empty() { "" } else { ", " };
                        let form = format!("{name}({value}{comma}{rest})");
                        let whole = Span::new(base.span.start, inner.end + 1);
                        problem.write(whole, form)
                    }
                    None => problem,
                }
            }
            None => problem,
        };
        let has_members = !names.is_empty();
        let note = format!("it has {}", listed(names));
        self.report(problem.note_if(has_members.then_some(note)));
    }

    /// The name under which the methods of a type are listed.
    fn receiver_name(&self, ty: &Type) -> &'static str {
        match ty {
            Type::List(_) => "List",
            Type::Set(_) => "Set",
            Type::Map(..) => "Map",
            Type::String => "String",
            Type::Area => "Area",
            _ => "",
        }
    }
}

/// StarL's name of a member that other languages, Koord or the thesis have.
fn foreign_member(name: &str) -> Option<&'static str> {
    Some(match name {
        "length" | "len" | "count" => "size",
        "push" | "append" => "add",
        "insert_at" => "insert",
        "sort" => "sorted",
        "reverse" => "reversed",
        "find" | "indexOf" => "index_of",
        "delete" | "discard" | "erase" => "remove",
        "has_key" | "containsKey" | "includes" | "has" => "contains",
        "sublist" => "slice",
        "lowercase" | "toLowerCase" => "lower",
        "uppercase" | "toUpperCase" => "upper",
        "strip" => "trim",
        "startsWith" => "starts_with",
        "endsWith" => "ends_with",
        "parse" | "toInt" => "to_int",
        "toFloat" => "to_float",
        "goto" | "go_to" | "move_to" | "drive_to" | "doReachAvoid" | "do_reach_avoid" => {
            "reach_avoid"
        }
        "reached" | "arrived" | "doneFlag" => "done",
        "lock" | "do_mutex" => "acquire",
        "unlock" => "release",
        "locked" | "crit" => "held",
        "publish" => "broadcast",
        "activeFlag" => "active",
        "failFlag" => "failed",
        "do_register" => "register",
        "undo_register" => "unregister",
        "rList" => "members",
        "do_election" => "elect",
        _ => return None,
    })
}
