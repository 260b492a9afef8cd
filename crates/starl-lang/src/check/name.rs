//! The meaning of a bare name, as a value.
//!
//! A local hides everything. Then, where an enum is expected, its variants come first; then the declarations of the
//! file, the variant of the only enum that has it, and the built-in names.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::body::Where;
use super::prelude;
use super::report::{broken, did_you_mean, made};
use super::resolution::Symbol;
use super::scope::Entity;
use super::state::Checker;
use super::surroundings::Surroundings;
use super::tables::{BUILTINS, Builtin, Primitive, Purity};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{EnumId, Expression, ExpressionKind, RobotMember, Type};

/// The meaning of a name.
pub(super) enum Meaning {
    Local(crate::ir::LocalId),
    Entity(Entity),
    Variant(EnumId, u16),
    Builtin(Builtin),
    Primitive(&'static Primitive),
    /// The variable of the roles.
    Role,
    /// Variants of several enums.
    Variants(Vec<(EnumId, u16)>),
    Unknown,
}

impl Checker {
    /// The meaning of the name where the type `expected` is expected.
    pub fn meaning(&self, name: &str, expected: Option<&Type>) -> Meaning {
        if let Some(local) = self.body.find(name) {
            return Meaning::Local(local);
        }
        if let Some((id, variant)) = self.expected_variant(name, expected) {
            return Meaning::Variant(id, variant);
        }
        if name == "role" && self.program.roles.is_some() && self.file == 0 {
            return Meaning::Role;
        }
        if let Some(entity) = self.declared(self.file, name) {
            return Meaning::Entity(entity);
        }
        let mut visible: Vec<(EnumId, u16)> = self.visible_variants(name).collect();
        // Those of the file itself hide those that every program has.
        let is_own = |(id, _): &(EnumId, u16)| self.program[*id].site.file == self.file;
        if visible.iter().any(is_own) {
            visible.retain(is_own);
        }
        match visible[..] {
            [] => {}
            [(id, variant)] => return Meaning::Variant(id, variant),
            _ => return Meaning::Variants(visible),
        }
        if let Some(builtin) = Builtin::named(name) {
            return Meaning::Builtin(builtin);
        }
        if let Some(entity) = self.declared(prelude::FILE, name) {
            return Meaning::Entity(entity);
        }
        Primitive::named(name).map_or(Meaning::Unknown, Meaning::Primitive)
    }

    /// The variant with this name of the enum that is expected.
    fn expected_variant(&self, name: &str, expected: Option<&Type>) -> Option<(EnumId, u16)> {
        let id = match expected? {
            Type::Enum(id) => *id,
            Type::Optional(inner) => match **inner {
                Type::Enum(id) => id,
                _ => return None,
            },
            _ => return None,
        };
        let those = self.variants.get(name)?;
        those.iter().copied().find(|(of, _)| *of == id)
    }

    /// The variants with this name of the enums that the present file can name.
    fn visible_variants(&self, name: &str) -> impl Iterator<Item = (EnumId, u16)> {
        let those = self.variants.get(name).into_iter().flatten().copied();
        let role = self.program.roles.as_ref().map(|roles| roles.variable);
        let roles = role.map(|variable| &self.program[variable].ty);
        those.filter(move |(id, _)| {
            let file = self.program[*id].site.file;
            (file == self.file || file == prelude::FILE)
                && (self.file == 0 || Some(&Type::Enum(*id)) != roles)
        })
    }

    /// Whether the name means something only where a type is expected.
    pub fn needs_context(&self, name: &str) -> bool {
        matches!(
            self.meaning(name, None),
            Meaning::Variant(..) | Meaning::Variants(_) | Meaning::Unknown | Meaning::Builtin(_)
        )
    }

    /// A name as a value.
    pub fn name(&mut self, name: &str, span: Span, expected: Option<&Type>) -> Expression {
        match self.meaning(name, expected) {
            Meaning::Local(local) => {
                self.resolve_local(span, local);
                self.local_value(local, span)
            }
            Meaning::Entity(entity) => {
                self.resolve_entity(span, entity);
                self.entity_value(entity, name, span)
            }
            Meaning::Variant(id, variant) => {
                self.resolve(span, Symbol::Variant(id, variant));
                self.usage.used.insert(Entity::Enum(id));
                made(ExpressionKind::Variant(variant), Type::Enum(id), span)
            }
            Meaning::Builtin(builtin) => {
                self.resolve(span, Symbol::Builtin(builtin));
                self.builtin_name(builtin, span)
            }
            Meaning::Primitive(primitive) => {
                if let Some(symbol) = Symbol::primitive(primitive) {
                    self.resolve(span, symbol);
                }
                let message = format!("`{}` is a kind of primitive, not a value", primitive.name());
                let problem = Diagnostic::new(Code::NoValue, span, message);
                let form = format!("bind one to a name: `name = {}`", primitive.constructor);
                self.refuse(problem.note(form))
            }
            Meaning::Role => {
                let Some(variable) = self.program.roles.as_ref().map(|roles| roles.variable) else {
                    return broken(span);
                };
                self.resolve(span, Symbol::Variable(variable));
                self.entity_value(Entity::Variable(variable), name, span)
            }
            Meaning::Variants(those) => self.ambiguous(name, &those, span),
            Meaning::Unknown => {
                // Of a robot that a property is about, these are known too.
                if self.body.place == Where::Property
                    && let Some(member) = robot_member(name)
                    && let Some(robot) = self.robot_of_property(span)
                {
                    self.resolve_robot_member(span, member);
                    return self.of_robot(robot, member, span);
                }
                self.unknown(name, span, expected)
            }
        }
    }

    pub fn local_value(&mut self, local: crate::ir::LocalId, span: Span) -> Expression {
        self.body.read(local);
        let ty = self.body.locals[local.index()].ty.clone();
        let Some((whole, field)) = self.body.part(local) else {
            return made(ExpressionKind::Local(local), ty, span);
        };
        let tuple = self.body.locals[whole.index()].ty.clone();
        let base = Box::new(made(ExpressionKind::Local(whole), tuple, span));
        made(ExpressionKind::Field { base, field }, ty, span)
    }

    fn builtin_name(&mut self, builtin: Builtin, span: Span) -> Expression {
        let name = builtin.name();
        let signature = builtin.signature();
        if signature.is_call {
            let message = format!("`{name}` is called");
            let problem = Diagnostic::new(Code::NotCallable, span, message);
            let problem = problem.note(builtin.text());
            let end = Span::empty(span.end);
            self.report(if signature.parameters.is_empty() {
                problem.replace(format!("write `{name}()`"), end, "()")
            } else {
                problem
            });
            return broken(span);
        }
        if self.body.place == Where::Property {
            match (robot_member(name), self.robot_of_property(span)) {
                (Some(member), Some(robot)) => return self.of_robot(robot, member, span),
                (Some(_), None) if name == "me" => return self.of_no_robot(name, "id", span),
                (Some(_), None) => return self.of_no_robot(name, name, span),
                (None, _) if self.is_of_sensors(name, span) => return broken(span),
                (None, _) => {}
            }
        }
        if !self.allowed(builtin.purity(), builtin.name(), span) {
            return broken(span);
        }
        let ty = self.shape_type(&signature.result, &super::shape::Letters::new());
        let kind = ExpressionKind::Builtin {
            builtin,
            arguments: Vec::new(),
            rest: Vec::new(),
        };
        made(kind, ty.unwrap_or(Type::Error), span)
    }

    /// Whether a property asks for what only the sensors tell; reports it if so.
    pub fn is_of_sensors(&mut self, name: &str, span: Span) -> bool {
        if self.body.place != Where::Property || !OF_SENSORS.contains(&name) {
            return false;
        }
        let message = format!("a property cannot use `{name}`");
        let problem = Diagnostic::new(Code::InvalidProperty, span, message);
        let note = "only the robot itself reads its sensors; store the reading in a variable";
        self.report(problem.note(note));
        true
    }

    /// Whether something of this purity may stand here; reports it if not.
    pub fn allowed(&mut self, purity: Purity, name: &str, span: Span) -> bool {
        let place = self.body.place;
        let fixed = place == Where::Binding && matches!(name, "me" | "peers");
        if place.allows(purity) || fixed {
            return true;
        }
        let what = place.what();
        if purity == Purity::Property {
            let message = format!("only a property can use `{name}`");
            let problem = Diagnostic::new(Code::StateOutOfReach, span, message);
            self.report(problem.note("no robot knows it"));
        } else if purity == Purity::Query {
            self.state_out_of_reach("use", name, span);
        } else {
            let message = format!("{what} cannot call `{name}`, which does something");
            let problem = Diagnostic::new(Code::Impure, span, message);
            let problem = problem.note("only `init`, effects and handlers do something");
            self.report(match (place, name) {
                (Where::Guard, "choose") => {
                    problem.note("call it in the `eff`: `if some x = choose(xs)`, and a block")
                }
                (Where::Guard, _) => problem.note("call it in the `eff`"),
                _ => problem,
            });
        }
        false
    }

    fn ambiguous(&mut self, name: &str, those: &[(EnumId, u16)], span: Span) -> Expression {
        let enums: Vec<String> = (those.iter())
            .map(|(id, _)| self.name_of(&Type::Enum(*id)))
            .collect();
        let message = format!("several enums have a variant `{name}`");
        let problem = Diagnostic::new(Code::AmbiguousVariant, span, message);
        let problem = problem.note(format!("it is one of {}", enums.join(" and of ")));
        let named = those
            .iter()
            .find_map(|(id, _)| self.program[*id].name.as_ref());
        self.report(match named {
            Some(of) => {
                let full = format!("{of}.{name}");
                problem.replace(format!("write `{full}` if that is meant"), span, full)
            }
            None => problem,
        });
        broken(span)
    }

    fn unknown(&mut self, name: &str, span: Span, expected: Option<&Type>) -> Expression {
        if self.is_probe(span) {
            self.note_probed_value(expected);
        }
        if self.may_be_unread(name) {
            return broken(span);
        }
        if let Some(Type::Enum(id)) = expected {
            return self.unknown_variant(*id, name, span);
        }
        let message = format!("there is no `{name}`");
        let problem = Diagnostic::new(Code::UnknownName, span, message);
        let problem = self.suggest(problem, name, span);
        self.refuse(problem)
    }

    /// Reports a variant that an enum does not have.
    pub fn unknown_variant(&mut self, id: EnumId, name: &str, span: Span) -> Expression {
        if self.is_probe(span) {
            self.note_probe(Surroundings::Part(Symbol::Enum(id)));
        }
        let message = format!("{} has no variant `{name}`", self.name_of(&Type::Enum(id)));
        let problem = Diagnostic::new(Code::UnknownVariant, span, message);
        let names = || {
            self.program[id]
                .variants
                .iter()
                .map(|variant| variant.name.as_str())
        };
        let problem = did_you_mean(problem, span, name, names());
        let list = format!("it has {}", super::report::listed(names()));
        self.refuse(problem.note(list))
    }

    /// Suggests the name that was probably meant, among all visible names.
    pub fn suggest(&self, problem: Diagnostic, name: &str, span: Span) -> Diagnostic {
        if let Some(problem) = self.without_self(&problem, name, span) {
            return problem;
        }
        if let Some(problem) = self.quotient_of_units(&problem, name, span) {
            return problem;
        }
        if let Some(meant) = foreign_name(name) {
            let is_value = Builtin::named(meant).is_some_and(|own| !own.signature().is_call);
            let brackets = self
                .arguments_after(span)
                .filter(|inner| is_value && inner.start == inner.end);
            let span = brackets.map_or(span, |inner| Span::new(span.start, inner.end + 1));
            return problem.replace(format!("did you mean `{meant}`?"), span, meant);
        }
        let locals = self.body.names.iter().map(|(name, _)| name.as_str());
        let declared = self.files[self.file as usize].scope.keys();
        let variants = self.variants.keys();
        let builtins = BUILTINS.iter().map(|builtin| builtin.name());
        let candidates = locals
            .chain(declared.clone().map(String::as_str))
            .chain(builtins)
            .chain(variants.map(String::as_str));
        if super::hints::habit(name).is_some() {
            return self.hint(problem, name, span);
        }
        let problem = if self.is_of_primitive(span) {
            did_you_mean(problem, span, name, declared.map(String::as_str))
        } else {
            did_you_mean(problem, span, name, candidates)
        };
        match problem.fix {
            Some(_) => problem,
            None => self.hint(problem, name, span),
        }
    }
}

/// StarL's name of something from the thesis, Koord or another language.
fn foreign_name(name: &str) -> Option<&'static str> {
    Some(match name {
        "pid" | "self" | "my_id" | "id" | "myId" | "robot_id" | "getId" => "me",
        "time" | "clock" => "now",
        "pos" | "my_position" | "pose" | "getPos" | "getpos" => "position",
        "undefined" | "NULL" | "null" | "nil" | "None" => "none",
        "TRUE" | "True" => "true",
        "FALSE" | "False" => "false",
        "exit" | "quit" => "finish",
        "robots" | "others" | "neighbors" | "neighbours" => "peers",
        "getObstacles" => "obstacles",
        "getInput" => "way_points",
        "print" | "println" | "printf" => "log",
        "str" => "String",
        "numAgents" => "peers.size()",
        "raise" | "throw" | "panic" => "fail",
        "rand" | "uniform" => "random",
        "randint" => "random_int",
        "choice" => "choose",
        _ => return None,
    })
}

/// Readings of a robot's sensors.
const OF_SENSORS: [&str; 6] = [
    "bumped",
    "ranges",
    "detected",
    "things",
    "holding",
    "thing_name",
];

/// The attributes of a robot that a property may read besides its variables.
pub(super) fn robot_member(name: &str) -> Option<RobotMember> {
    Some(match name {
        "position" => RobotMember::Position,
        "heading" => RobotMember::Heading,
        "velocity" => RobotMember::Velocity,
        "finished" => RobotMember::Finished,
        "up" => RobotMember::Up,
        "id" | "me" => RobotMember::Id,
        _ => return None,
    })
}
