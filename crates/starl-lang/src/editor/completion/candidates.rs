//! What may stand in a context.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::super::describe::{ROBOT_MEMBERS, TYPES, describe};
use super::super::index::headers;
use super::super::words::{self, Word};
use super::context::Context;
use super::{Call, Completion};
use crate::check::{BUILTINS, Checked, Libraries, Method, PRIMITIVES, Reach, Surroundings, Symbol};
use crate::ir::{
    BindingId, ConstantId, EnumId, FunctionId, ParameterId, RecordId, SharedId, Site, Type,
    VariableId,
};

/// How likely something is to be meant: what is expected, what is near, what the program declares, what
/// every program has, and words of the language.
const EXPECTED: u8 = 0;
const LOCAL: u8 = 1;
const OWN: u8 = 2;
const COMMON: u8 = 3;
const WORD: u8 = 4;

/// Collects what may stand in a context of a checked text.
pub(super) struct Candidates<'a> {
    checked: &'a Checked,
    items: Vec<Completion>,
}

impl<'a> Candidates<'a> {
    pub fn new(checked: &'a Checked) -> Self {
        Self {
            checked,
            items: Vec::new(),
        }
    }

    pub fn of(mut self, context: &Context, libraries: &dyn Libraries) -> Vec<Completion> {
        match context {
            Context::Import => self.libraries(libraries),
            Context::Declaration => self.words(words::DECLARATIONS),
            Context::Clause => {
                self.words(words::CLAUSES);
                self.words(words::DECLARATIONS);
            }
            Context::Known {
                surroundings,
                begins_statement,
            } => self.surrounded(surroundings, *begins_statement),
        }
        self.items
    }

    fn surrounded(&mut self, surroundings: &Surroundings, begins_statement: bool) {
        match surroundings {
            Surroundings::Value(reach) => {
                self.values(reach);
                if begins_statement {
                    self.words(words::STATEMENTS);
                } else {
                    self.words(words::EXPRESSIONS);
                }
            }
            Surroundings::Member { of, in_property } => self.members(of, *in_property),
            Surroundings::Part(symbol) => self.parts(*symbol),
            Surroundings::Type => self.types(),
            Surroundings::Primitive => {
                for number in 0..PRIMITIVES.len() {
                    self.symbol(Symbol::Primitive(number), COMMON);
                }
            }
            Surroundings::Event => self.events(),
            Surroundings::EventOf(symbol) => self.events_of(*symbol),
        }
    }

    fn words(&mut self, words: &[Word]) {
        for word in words {
            self.items.push(Completion {
                label: word.word.to_string(),
                symbol: None,
                detail: word.form.to_string(),
                documentation: word.meaning.to_string(),
                call: Call::No,
                rank: WORD,
            });
        }
    }

    /// Adds what a name stands for.
    fn symbol(&mut self, symbol: Symbol, rank: u8) {
        let Some((label, call)) = self.named(symbol) else {
            return;
        };
        let description = describe(self.checked, symbol);
        self.items.push(Completion {
            label,
            symbol: Some(symbol),
            detail: description.signature,
            documentation: description.documentation,
            call,
            rank,
        });
    }

    /// The name of something and how it is called; none of what has none.
    fn named(&self, symbol: Symbol) -> Option<(String, Call)> {
        let program = &self.checked.program;
        let calls = |parameters: usize| match parameters {
            0 => Call::Empty,
            _ => Call::Arguments,
        };
        let signed = |signature: crate::check::Signature| match signature.is_call {
            true if signature.takes_values || signature.takes_fields => Call::Arguments,
            true => calls(signature.parameters.len()),
            false => Call::No,
        };
        Some(match symbol {
            Symbol::Enum(id) => (program[id].name.clone()?, Call::No),
            Symbol::Variant(id, number) => {
                let variant = program[id].variants.get(number as usize)?;
                (variant.name.clone(), Call::No)
            }
            Symbol::Record(id) => {
                let record = &program[id];
                (record.name.clone(), calls(record.fields.len()))
            }
            Symbol::Field(id, number) => {
                let field = program[id].fields.get(number as usize)?;
                (field.name.clone(), Call::No)
            }
            Symbol::Parameter(id) => (program[id].name.clone(), Call::No),
            Symbol::Constant(id) => (program[id].name.clone(), Call::No),
            Symbol::Variable(id) => (program[id].name.clone(), Call::No),
            Symbol::Shared(id) => (program[id].name.clone(), Call::No),
            Symbol::Binding(id) => (program[id].name.clone(), Call::No),
            Symbol::Function(id) => {
                let function = &program[id];
                (function.name.clone(), calls(function.parameters as usize))
            }
            Symbol::File(file) => (
                self.checked.files.get(file as usize)?.name.clone(),
                Call::No,
            ),
            Symbol::Builtin(builtin) => (builtin.name().into(), signed(builtin.signature())),
            Symbol::Type(name) | Symbol::Coordinate(name) | Symbol::RobotMember(name) => {
                (name.into(), Call::No)
            }
            Symbol::Method(method) => (method.name().into(), signed(method.signature())),
            Symbol::Primitive(number) => (PRIMITIVES.get(number)?.name().into(), Call::Arguments),
            Symbol::Member(primitive, number) => {
                let member = PRIMITIVES.get(primitive)?.members.get(number)?;
                (member.name().into(), signed(member.signature()))
            }
            Symbol::Event(primitive, number) => {
                let event = PRIMITIVES.get(primitive)?.events.get(number)?;
                (event.name().into(), Call::Arguments)
            }
            Symbol::Argument(..) | Symbol::Local(_) | Symbol::Action(_) | Symbol::Property(_) => {
                return None;
            }
        })
    }

    fn values(&mut self, reach: &Reach) {
        self.expected_variants(reach.expected.as_ref());
        for local in &reach.locals {
            let site = Site {
                file: 0,
                span: local.span,
            };
            if local.name.contains(' ') {
                continue;
            }
            let ty = self.checked.program.type_name(&local.ty);
            self.items.push(Completion {
                label: local.name.clone(),
                symbol: Some(Symbol::Local(site)),
                detail: alloc::format!("{}: {ty}", local.name),
                documentation: String::new(),
                call: Call::No,
                rank: LOCAL,
            });
        }
        self.declared(reach);
        self.common(reach);
        if reach.in_property {
            self.words(words::QUANTIFIERS);
            self.robot_members();
        }
    }

    /// The variants of the enum that is expected.
    fn expected_variants(&mut self, expected: Option<&Type>) {
        let ty = match expected {
            Some(Type::Optional(inner)) => Some(&**inner),
            other => other,
        };
        if let Some(Type::Enum(id)) = ty {
            self.variants(*id, EXPECTED);
        }
    }

    fn variants(&mut self, id: EnumId, rank: u8) {
        for number in 0..self.checked.program[id].variants.len() {
            self.symbol(Symbol::Variant(id, number as u16), rank);
        }
    }

    /// What the file itself declares.
    fn declared(&mut self, reach: &Reach) {
        let program = &self.checked.program;
        if reach.sees_parameters {
            for number in 0..program.parameters.len() {
                self.symbol(Symbol::Parameter(ParameterId(number as u32)), OWN);
            }
        }
        if reach.sees_state {
            for number in 0..program.variables.len() {
                self.symbol(Symbol::Variable(VariableId(number as u32)), OWN);
            }
        }
        if reach.sees_primitives {
            for number in 0..program.bindings.len() {
                self.symbol(Symbol::Binding(BindingId(number as u32)), OWN);
            }
            for number in 0..program.shared.len() {
                self.symbol(Symbol::Shared(SharedId(number as u32)), OWN);
            }
        }
        self.of_file(0, OWN);
        self.imported();
        for number in 0..program.enums.len() {
            if program.enums[number].site.file == 0 {
                self.variants(EnumId(number as u32), OWN);
            }
        }
    }

    /// The libraries that the file imports.
    fn imported(&mut self) {
        for (site, symbol) in &self.checked.resolutions.uses {
            if site.file == 0 && matches!(symbol, Symbol::File(_)) {
                self.symbol(*symbol, OWN);
            }
        }
    }

    /// The constants, functions, records and enums that a file declares.
    fn of_file(&mut self, file: u32, rank: u8) {
        let program = &self.checked.program;
        for (number, constant) in program.constants.iter().enumerate() {
            if constant.site.file == file {
                self.symbol(Symbol::Constant(ConstantId(number as u32)), rank);
            }
        }
        for (number, function) in program.functions.iter().enumerate() {
            if function.site.file == file {
                self.symbol(Symbol::Function(FunctionId(number as u32)), rank);
            }
        }
        self.types_of_file(file, rank);
    }

    fn types_of_file(&mut self, file: u32, rank: u8) {
        let program = &self.checked.program;
        let roles = program.roles.as_ref();
        let role_enum = roles.map(|roles| &program[roles.variable].ty);
        for (number, record) in program.records.iter().enumerate() {
            if record.site.file == file {
                self.symbol(Symbol::Record(RecordId(number as u32)), rank);
            }
        }
        for (number, declared) in program.enums.iter().enumerate() {
            let id = EnumId(number as u32);
            if declared.site.file == file && role_enum != Some(&Type::Enum(id)) {
                self.symbol(Symbol::Enum(id), rank);
            }
        }
    }

    /// What every program has, as far as it may be used.
    fn common(&mut self, reach: &Reach) {
        for builtin in BUILTINS {
            if builtin.purity() <= reach.purity {
                self.symbol(Symbol::Builtin(*builtin), COMMON);
            }
        }
        self.of_file(super::super::analysis::PRELUDE_FILE, COMMON);
    }

    fn robot_members(&mut self) {
        for (name, ..) in ROBOT_MEMBERS {
            self.symbol(Symbol::RobotMember(name), COMMON);
        }
    }

    /// What stands after the dot of a value.
    fn members(&mut self, of: &Type, in_property: bool) {
        let receiver = match of {
            Type::List(_) => "List",
            Type::Set(_) => "Set",
            Type::Map(..) => "Map",
            Type::String => "String",
            Type::Area => "Area",
            _ => "",
        };
        for method in Method::of(receiver) {
            self.symbol(Symbol::Method(method), OWN);
        }
        match of {
            Type::Record(id) => {
                for number in 0..self.checked.program[*id].fields.len() {
                    self.symbol(Symbol::Field(*id, number as u32), OWN);
                }
            }
            Type::Point => {
                for axis in ["x", "y", "z"] {
                    self.symbol(Symbol::Coordinate(axis), OWN);
                }
            }
            Type::Robot if in_property => {
                let program = &self.checked.program;
                for number in 0..program.variables.len() {
                    self.symbol(Symbol::Variable(VariableId(number as u32)), OWN);
                }
                for number in 0..program.parameters.len() {
                    self.symbol(Symbol::Parameter(ParameterId(number as u32)), OWN);
                }
                self.robot_members();
            }
            _ => {}
        }
    }

    /// What stands after the dot of something that is no value.
    fn parts(&mut self, symbol: Symbol) {
        match symbol {
            Symbol::File(file) => self.of_file(file, OWN),
            Symbol::Enum(id) => self.variants(id, OWN),
            Symbol::Binding(id) => {
                let Some(primitive) = self.kind_of(id) else {
                    return;
                };
                for number in 0..PRIMITIVES[primitive].members.len() {
                    self.symbol(Symbol::Member(primitive, number), OWN);
                }
            }
            _ => {}
        }
    }

    /// The number of the kind of a bound primitive.
    fn kind_of(&self, id: BindingId) -> Option<usize> {
        let kind = self.checked.program[id].primitive?;
        let mut kinds = PRIMITIVES.iter();
        kinds.position(|other| other.name() == kind.name())
    }

    fn types(&mut self) {
        for (name, ..) in TYPES {
            self.symbol(Symbol::Type(name), COMMON);
        }
        self.types_of_file(0, OWN);
        self.types_of_file(super::super::analysis::PRELUDE_FILE, COMMON);
        self.imported();
        // A call makes a value; a type has no brackets.
        for item in &mut self.items {
            item.call = Call::No;
        }
    }

    fn events(&mut self) {
        let program = &self.checked.program;
        for (number, record) in program.records.iter().enumerate() {
            if record.is_message {
                self.symbol(Symbol::Record(RecordId(number as u32)), OWN);
            }
        }
        for (number, binding) in program.bindings.iter().enumerate() {
            let reports = binding
                .primitive
                .is_some_and(|kind| !kind.events.is_empty());
            if reports {
                self.symbol(Symbol::Binding(BindingId(number as u32)), OWN);
            }
        }
        for item in &mut self.items {
            // The sender comes before the fields.
            if matches!(item.symbol, Some(Symbol::Record(_))) {
                item.call = Call::Arguments;
            }
        }
    }

    fn events_of(&mut self, symbol: Symbol) {
        let Symbol::Binding(id) = symbol else { return };
        let Some(primitive) = self.kind_of(id) else {
            return;
        };
        for number in 0..PRIMITIVES[primitive].events.len() {
            self.symbol(Symbol::Event(primitive, number), OWN);
        }
    }

    /// The libraries that there are, but for the text itself.
    fn libraries(&mut self, libraries: &dyn Libraries) {
        let own = headers(self.checked).find(|(file, _)| *file == 0);
        let own = own.map_or(String::new(), |(_, site)| {
            site.span.of(&self.checked.files[0].source).into()
        });
        for name in libraries.names() {
            if name != own {
                self.items.push(Completion {
                    detail: alloc::format!("library {name}"),
                    label: name,
                    symbol: None,
                    documentation: String::new(),
                    call: Call::No,
                    rank: OWN,
                });
            }
        }
    }
}
