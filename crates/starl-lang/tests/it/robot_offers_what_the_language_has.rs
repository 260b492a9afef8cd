//! The tables of the robot's functions and the language's tables of built-in names and primitives agree: names, types
//! of arguments and results, effects and queries.

use starl_lang::check::{BUILTINS, Builtin, PRIMITIVES, Purity, Shape, Signature};
use starl_lang::machine::{
    Binding, Bytecode, Enum, Function, FunctionKind, Handler, Import, Instruction, LoadError,
    ObjectType, Origin, Type, operand::Count,
};
use starl_lang::robot::{Code, functions};
use std::collections::BTreeSet;

/// Types of the language as those of some bytecode.
#[derive(Default)]
struct Types(Bytecode);

impl Types {
    fn object(&mut self, object: ObjectType) -> Type {
        let known = self.0.types.iter().position(|known| *known == object);
        let index = known.unwrap_or_else(|| {
            self.0.types.push(object);
            self.0.types.len() - 1
        });
        Type::Object(index as u16)
    }

    /// An enum of the prelude; no function takes more than one.
    fn variants(&mut self, name: &str, variants: &[&str]) -> Type {
        self.0.enums = vec![Enum {
            name: name.into(),
            variants: variants.iter().map(ToString::to_string).collect(),
        }];
        Type::Enum(0)
    }

    fn of(&mut self, shape: &Shape) -> Type {
        match shape {
            Shape::Named("Bool") => Type::Bool,
            Shape::Named("Int") => Type::Int,
            Shape::Named("Float") => Type::Float,
            Shape::Named("Time") => Type::Time,
            Shape::Named("Duration") => Type::Duration,
            Shape::Named("RobotId") => Type::Robot,
            Shape::Named("Point") => Type::Point,
            Shape::Model | Shape::Named("String") => self.object(ObjectType::Text),
            Shape::Named("Area") => self.object(ObjectType::Area),
            Shape::Named("Obstacles") => self.object(ObjectType::Obstacles),
            Shape::Named("Side") => self.variants("Side", &["left", "right", "both"]),
            Shape::Named("MotionTrouble") => self.variants(
                "MotionTrouble",
                &[
                    "in_unsafe_set",
                    "wind",
                    "stuck",
                    "obstacle",
                    "off_path",
                    "no_path",
                    "no_points",
                    "not_finite",
                ],
            ),
            Shape::Named("Planner") => {
                self.variants("Planner", &["auto", "rrt", "rrt_connect", "rrt_star"])
            }
            Shape::Named("ElectionAlgorithm") => {
                self.variants("ElectionAlgorithm", &["leases", "ballots", "bully"])
            }
            Shape::Named("MutexAlgorithm") => {
                self.variants("MutexAlgorithm", &["permission", "quorum", "lease"])
            }
            Shape::Named("Order") => {
                self.variants("Order", &["unordered", "fifo", "causal", "total"])
            }
            Shape::Named("Detection") => {
                let optional = |kind| Type::Optional(Box::new(kind));
                let fields = [
                    ("robot", optional(Type::Robot)),
                    ("thing", optional(Type::Int)),
                    ("position", Type::Point),
                ];
                Type::Record(fields.map(|(name, kind)| (name.into(), kind)).to_vec())
            }
            Shape::Named("Thing") => {
                let fields = [
                    ("number", Type::Int),
                    ("name", self.object(ObjectType::Text)),
                    ("position", Type::Point),
                ];
                Type::Record(fields.map(|(name, kind)| (name.into(), kind)).to_vec())
            }
            Shape::Message => Type::Record(vec![("index".into(), Type::Int)]),
            Shape::List(part) => {
                let part = self.of(part);
                self.object(ObjectType::List(part))
            }
            Shape::Set(part) => {
                let part = self.of(part);
                self.object(ObjectType::Set(part))
            }
            Shape::Map(key, value) => {
                let (key, value) = (self.of(key), self.of(value));
                self.object(ObjectType::Map(key, value))
            }
            Shape::Optional(part) => Type::Optional(Box::new(self.of(part))),
            other => panic!("robots know no {other:?}"),
        }
    }

    /// The import of a function with this signature.
    fn import(
        &mut self,
        name: String,
        signature: &Signature,
        query: bool,
        first: &[Type],
    ) -> Import {
        let mut arguments = first.to_vec();
        for parameter in &signature.parameters {
            let kind = self.of(&parameter.shape);
            arguments.push(match parameter.is_optional {
                true => Type::Optional(Box::new(kind)),
                false => kind,
            });
        }
        let takes_message = signature
            .parameters
            .iter()
            .any(|p| p.shape == Shape::Message);
        let results = match &signature.result {
            Shape::Nothing => Vec::new(),
            result => vec![self.of(result)],
        };
        Import {
            name,
            query,
            labels: Vec::from_iter(takes_message.then(|| "Reached".into())),
            arguments,
            results,
        }
    }

    /// Whether robots offer a function.
    fn load(&self, import: &Import) -> Result<(), LoadError> {
        let bytecode = Bytecode {
            imports: vec![import.clone()],
            ..self.0.clone()
        };
        Code::load(bytecode).map(|_| ())
    }

    /// The function is offered as it is, and not with any one type or with the purity changed.
    fn is_offered_exactly(&self, import: &Import) {
        assert_eq!(self.load(import), Ok(()), "{import:?}");
        let unknown = Err(LoadError::UnknownImport(import.name.clone()));
        let mut other = import.clone();
        other.query = !other.query;
        assert_eq!(self.load(&other), unknown, "{other:?}");
        for index in 0..import.arguments.len() {
            let mut other = import.clone();
            let wrong = Type::Optional(Box::new(Type::Optional(Box::new(Type::Bool))));
            other.arguments[index] = wrong;
            assert_eq!(self.load(&other), unknown, "{other:?}");
        }
        let mut other = import.clone();
        other.results = match other.results.is_empty() {
            true => vec![Type::Bool],
            false => Vec::new(),
        };
        assert_eq!(self.load(&other), unknown, "{other:?}");
    }
}

/// Built-in names that become instructions, or others of them.
fn is_compiled(builtin: Builtin) -> bool {
    builtin.purity() == Purity::Pure || builtin == Builtin::Choose
}

#[test]
fn built_in_names_are_offered_as_the_language_has_them() {
    for &builtin in BUILTINS.iter().filter(|builtin| !is_compiled(**builtin)) {
        let mut types = Types::default();
        let query = builtin.purity() != Purity::Effect;
        let import = types.import(builtin.name().into(), &builtin.signature(), query, &[]);
        types.is_offered_exactly(&import);
    }
}

#[test]
fn an_event_has_any_fields() {
    let mut types = Types::default();
    let signature = Builtin::Emit.signature();
    let mut import = types.import("emit".into(), &signature, false, &[]);
    import.arguments.extend([Type::Int, Type::Point]);
    import.labels = vec!["index".into(), "at".into()];
    assert_eq!(types.load(&import), Ok(()));
}

#[test]
fn primitives_are_offered_as_the_language_has_them() {
    for primitive in PRIMITIVES {
        let mut types = Types::default();
        let constructor = Signature::read(primitive.constructor);
        let name = format!("{}.bind", primitive.name());
        let bind = types.import(name, &constructor, false, &[Type::Int]);
        let bind = Import {
            results: Vec::new(),
            ..bind
        };
        types.is_offered_exactly(&bind);
        for member in primitive.members {
            let name = format!("{}.{}", primitive.name(), member.name());
            let query = member.purity == Purity::Query;
            let import = types.import(name, &member.signature(), query, &[Type::Int]);
            types.is_offered_exactly(&import);
        }
    }
}

#[test]
fn events_of_primitives_have_the_fields_of_the_language() {
    for primitive in PRIMITIVES {
        for event in primitive.events {
            let mut types = Types::default();
            let parameters = event.signature().parameters;
            let arguments = parameters
                .iter()
                .map(|parameter| types.of(&parameter.shape));
            let arguments: Vec<Type> = arguments.collect();
            let mut handles = |arguments: Vec<Type>| {
                let objects = 1;
                types.0.code = vec![Instruction::Return {
                    keep: Count(0),
                    until: Count(objects),
                }];
                types.0.functions = vec![Function {
                    name: event.name().into(),
                    kind: FunctionKind::Procedure,
                    entry: 0,
                    end: 1,
                    registers: 8,
                    object_registers: objects,
                    arguments,
                    results: Vec::new(),
                }];
                types.0.primitives = vec![Binding {
                    name: "it".into(),
                    kind: primitive.name().into(),
                }];
                types.0.handlers = vec![Handler {
                    event: event.name().into(),
                    origin: Origin::Primitive(0),
                    function: 0,
                }];
                Code::load(types.0.clone()).map(|_| ())
            };
            assert_eq!(handles(arguments.clone()), Ok(()));
            let name = format!("{}.{}", primitive.name(), event.name());
            let fewer = arguments[1..].to_vec();
            assert_eq!(handles(fewer), Err(LoadError::UnknownImport(name)));
        }
    }
}

#[test]
fn nothing_else_is_offered() {
    let mut known = BTreeSet::new();
    let builtins = BUILTINS.iter().filter(|builtin| !is_compiled(**builtin));
    known.extend(builtins.map(|builtin| builtin.name().to_string()));
    for primitive in PRIMITIVES {
        let members = primitive.members.iter().map(|member| member.name());
        let names = ["bind"].into_iter().chain(members);
        known.extend(names.map(|name| format!("{}.{name}", primitive.name())));
    }
    // Shared variables and what properties ask have no entries in the language's tables.
    let shared = ["bind", "initialize", "write", "element", "all"];
    known.extend(shared.map(|name| format!("SingleWriter.{name}")));
    let shared = ["bind", "initialize", "write", "read"];
    known.extend(shared.map(|name| format!("MultiWriter.{name}")));
    known.extend(shared.map(|name| format!("Linearizable.{name}")));
    let asked = ["all", "position", "heading", "velocity", "finished", "up"];
    known.extend(asked.map(|name| format!("robot.{name}")));
    let copies = ["read", "element", "all"];
    known.extend(copies.map(|name| format!("shared.{name}")));
    // Nor has what the start of a program asks for stable variables.
    known.extend(["saved".into(), "reset".into()]);
    assert_eq!(functions().collect::<BTreeSet<_>>(), known);
}
