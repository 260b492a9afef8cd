//! The declarations of generated programs: types, parameters, constants, functions, primitives and variables.

use super::Generator;
use super::expression::Context;
use super::model::{Binding, Enum, Function, Named, Place, Record, Shared, Type};

const KINDS: &[(&str, &[&str])] = &[
    (
        "ReachAvoid",
        &["", "vicinity = 0.5", "0.25, pass_radius = 0.5"],
    ),
    ("Broadcast", &["", "\"all\"", "name = \"b\""]),
    ("Unicast", &["", "\"one\""]),
    ("Geocast", &[""]),
];

/// Words with a meaning at the start of a declaration only, which are names elsewhere.
const WORDS: &[&str] = &[
    "within", "record", "message", "program", "library", "import", "param", "const", "function",
    "exists", "forall", "atomic", "init", "leads_to", "enum", "allread", "allwrite",
];

impl Generator<'_> {
    pub(super) fn enums(&mut self) {
        for number in 0..self.choices.below(3) {
            let name = format!("Mode{number}");
            let count = 1 + self.choices.below(4);
            let mut variants: Vec<String> = (0..count)
                .map(|variant| format!("m{number}_{variant}"))
                .collect();
            // A name that several enums have.
            if self.choices.below(3) == 2 {
                variants.push("common".into());
            }
            self.line(&format!("enum {name} {{{}}}", variants.join(", ")));
            self.model.enums.push(Enum {
                name: Some(name),
                variants,
            });
        }
    }

    pub(super) fn records(&mut self) {
        for number in 0..self.choices.below(4) {
            let is_message = self.choices.below(2) == 1;
            let least = usize::from(!is_message);
            let fields: Vec<Named> = (0..least + self.choices.below(4))
                .map(|field| Named {
                    name: format!("part{field}"),
                    ty: self.any_type(2),
                })
                .collect();
            let written: Vec<String> = (fields.iter())
                .map(|field| format!("{}: {}", field.name, self.model.written(&field.ty)))
                .collect();
            let written = written.join(", ");
            let name = if is_message {
                format!("Message{number}")
            } else {
                format!("Thing{number}")
            };
            if is_message {
                self.line(&format!("message {name}({written})"));
            } else {
                self.line(&format!("record {name} {{{written}}}"));
            }
            self.model.records.push(Record {
                name,
                fields,
                is_message,
            });
        }
    }

    pub(super) fn parameters(&mut self) {
        self.place = Place::Constant;
        for number in 0..self.choices.below(3) {
            let ty = self.made_type(1);
            let name = format!("setting{number}");
            let written = self.model.written(&ty);
            let value = self.expression(&ty, Context::Fit, 2).text;
            self.line(&format!("param {name}: {written} = {value}"));
            self.model.parameters.push(Named { name, ty });
        }
    }

    /// Constants; those after the functions may call them.
    pub(super) fn constants(&mut self, prefix: &str) {
        self.place = Place::Constant;
        for number in 0..self.choices.below(3) {
            let ty = self.made_type(2);
            let name = format!("{prefix}{number}");
            let line = if self.choices.below(2) == 0 {
                let value = self.expression(&ty, Context::Unknown, 3).text;
                format!("const {name} = {value}")
            } else {
                let value = self.expression(&ty, Context::Fit, 3).text;
                format!("const {name}: {} = {value}", self.model.written(&ty))
            };
            self.line(&line);
            self.model.constants.push(Named { name, ty });
        }
    }

    pub(super) fn functions(&mut self) {
        for number in 0..self.choices.below(4) {
            self.function(number);
        }
    }

    fn function(&mut self, number: usize) {
        self.place = Place::Function;
        let is_recursive = self.choices.below(3) == 2;
        let name = format!("work{number}");
        let mut parameters = Vec::new();
        for parameter in 0..usize::from(is_recursive) + self.choices.below(4) {
            let first = is_recursive && parameter == 0;
            let ty = if first { Type::Int } else { self.any_type(2) };
            parameters.push(Named {
                name: self.add_local(ty.clone(), false),
                ty,
            });
        }
        let result = self.made_type(2);
        let written: Vec<String> = (parameters.iter())
            .map(|one| format!("{}: {}", one.name, self.model.written(&one.ty)))
            .collect();
        let result_written = self.model.written(&result);
        let header = format!(
            "function {name}({}) -> {result_written}",
            written.join(", ")
        );
        let function = Function {
            name,
            parameters,
            result,
            is_recursive,
        };
        self.result = Some(function.result.clone());
        if !is_recursive && self.choices.below(2) == 0 {
            let value = self.expression(&function.result, Context::Fit, 4).text;
            self.line(&format!("{header} = {value}"));
        } else {
            self.line(&header);
            self.function_body(&function);
        }
        self.result = None;
        self.locals.clear();
        self.model.functions.push(function);
    }

    /// Statements, and `return` at the end; one that calls itself ends when it counted to zero.
    fn function_body(&mut self, function: &Function) {
        self.level += 1;
        if function.is_recursive {
            let end = self.return_statement();
            let count = &function.parameters[0].name;
            self.line(&format!("if {count} <= 0 then {end}"));
            let arguments: Vec<String> = (function.parameters.iter().enumerate())
                .map(|(number, one)| match number {
                    0 => format!("{count} - 1"),
                    _ => self.expression(&one.ty, Context::Fit, 2).text,
                })
                .collect();
            let before = self.add_local(function.result.clone(), true);
            let arguments = arguments.join(", ");
            self.line(&format!("let {before} = {}({arguments})", function.name));
        }
        if function.is_recursive || self.choices.below(2) == 1 {
            self.statements(2);
        }
        let end = self.return_statement();
        self.line(&end);
        self.level -= 1;
    }

    pub(super) fn bindings(&mut self) {
        for number in 0..self.choices.below(3) {
            let (kind, arguments) = KINDS[self.choices.below(KINDS.len())];
            let name = format!("primitive{number}");
            let arguments = self.choices.pick(arguments);
            self.line(&format!("{name} = {kind}({arguments})"));
            self.model.bindings.push(Binding { name, kind });
        }
    }

    pub(super) fn variables(&mut self) {
        for _ in 0..self.choices.below(6) {
            self.variable();
        }
    }

    pub(super) fn variable(&mut self) {
        self.place = Place::Initial;
        let number = self.model.variables.len();
        let name = match self.choices.below(6) {
            5 => WORDS[number % WORDS.len()].into(),
            _ => format!("state{number}"),
        };
        if self.choices.below(8) == 7 {
            return self.unnamed_enum(name);
        }
        let ty = self.made_type(2);
        let written = self.model.written(&ty);
        let needs_value = !self.model.has_default(&ty);
        if needs_value || self.choices.below(2) == 1 {
            let value = self.expression(&ty, Context::Fit, 4).text;
            self.line(&format!("{name}: {written} = {value}"));
        } else {
            self.line(&format!("{name}: {written}"));
        }
        self.model.variables.push(Named { name, ty });
    }

    /// `state: enum {a, b} = a`.
    fn unnamed_enum(&mut self, name: String) {
        let variants: Vec<String> = (0..3).map(|variant| format!("{name}_{variant}")).collect();
        let first = &variants[self.choices.below(3)];
        self.line(&format!(
            "{name}: enum {{{}}} = {first}",
            variants.join(", ")
        ));
        let ty = Type::Enum(self.model.enums.len());
        self.model.enums.push(Enum {
            name: None,
            variants,
        });
        self.model.variables.push(Named { name, ty });
    }

    pub(super) fn shared(&mut self) {
        self.place = Place::Constant;
        if self.has_atomic {
            self.line("allwrite[linearizable] counted: Int = 0");
        }
        for number in 0..self.choices.below(3) {
            let name = format!("shared{number}");
            let is_single_writer = self.choices.below(2) == 1;
            let ty = self.shared_type();
            let written = self.model.written(&ty);
            let has_initial = !is_single_writer && self.can_make(&ty) && self.choices.below(2) == 1;
            let consistency = ["", "[causal]", "[eventual]"][self.choices.below(3)];
            let line = if is_single_writer {
                format!("allread{consistency} {name}[RobotId]: {written}")
            } else if has_initial {
                let value = self.expression(&ty, Context::Fit, 2).text;
                format!("allwrite{consistency} {name}: {written} = {value}")
            } else {
                format!("allwrite{consistency} {name}: {written}")
            };
            self.line(&line);
            self.model.shared.push(Shared {
                name,
                ty,
                is_single_writer,
                has_initial,
            });
        }
    }

    /// A type that is sent to others; reading one gives an optional, so it is none itself.
    fn shared_type(&mut self) -> Type {
        match self.any_type(2) {
            Type::Optional(inner) => *inner,
            ty => ty,
        }
    }
}
