//! The candidates in a context.

use super::context::Context;
use super::{Call, Completion};
use crate::built_in::ROBOT_MEMBERS;
use crate::describe::describe;
use crate::index::role_enum;
use crate::words::{self, Word};
use starl_lang::check::{
    BUILTINS, Checked, Libraries, PRIMITIVES, Purity, Reach, Surroundings, Symbol,
};
use starl_lang::ir::{
    BindingId, ConstantId, EnumId, FunctionId, ParameterId, RecordId, SharedId, Site, Type,
    VariableId,
};

/// How likely something is to be meant: the variants of what is expected, what fits, what is near, what the
/// program declares, names of parameters, what every program has, and words of the language.
const EXPECTED: u8 = 0;
const FITTING: u8 = 1;
const LOCAL: u8 = 2;
pub(super) const OWN: u8 = 3;
const ARGUMENT: u8 = 4;
pub(super) const COMMON: u8 = 5;
const WORD: u8 = 6;

/// Collects the candidates in a context of a checked text.
pub(super) struct Candidates<'a> {
    pub checked: &'a Checked,
    pub items: Vec<Completion>,
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

    pub fn words(&mut self, words: &[Word]) {
        for word in words {
            self.items.push(Completion {
                documentation: word.meaning.to_string(),
                ..Completion::plain(word.word, word.form, WORD)
            });
        }
    }

    /// Adds the meaning of a name.
    pub fn symbol(&mut self, symbol: Symbol, rank: u8) {
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

    fn values(&mut self, reach: &Reach) {
        for name in &reach.parameters {
            self.items.push(Completion {
                call: Call::Given,
                ..Completion::plain(name, format!("{name} = ..."), ARGUMENT)
            });
        }
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
            let detail = format!("{}: {ty}", local.name);
            self.items.push(Completion {
                symbol: Some(Symbol::Local(site)),
                ..Completion::plain(&local.name, detail, LOCAL)
            });
        }
        self.declared(reach);
        self.common(reach);
        self.prefer(reach.expected.as_ref());
        if reach.in_property {
            self.words(words::QUANTIFIERS);
            self.robot_members();
        }
    }

    /// Ranks values of the expected type before others of their kind.
    fn prefer(&mut self, expected: Option<&Type>) {
        let Some(expected) = expected else { return };
        let program = &self.checked.program;
        let fits = |ty: &Type| {
            ty == expected || matches!(expected, Type::Optional(inner) if **inner == *ty)
        };
        let locals = &self.checked.resolutions.locals;
        for item in &mut self.items {
            let is_meant = item.symbol.is_some_and(|symbol| match symbol {
                Symbol::Parameter(id) => fits(&program[id].ty),
                Symbol::Constant(id) => fits(&program[id].ty),
                Symbol::Variable(id) => fits(&program[id].ty),
                Symbol::Function(id) => fits(&program[id].result),
                Symbol::Local(site) => {
                    let mut own = locals.iter().filter(|(other, _)| *other == site);
                    own.any(|(_, ty)| fits(ty))
                }
                _ => false,
            });
            if is_meant && item.rank > EXPECTED {
                item.rank = FITTING;
            }
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

    pub fn variants(&mut self, id: EnumId, rank: u8) {
        for number in 0..self.checked.program[id].variants.len() {
            self.symbol(Symbol::Variant(id, number as u16), rank);
        }
    }

    /// The declarations of the file.
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
    pub fn imported(&mut self) {
        for (site, symbol) in &self.checked.resolutions.uses {
            if site.file == 0 && matches!(symbol, Symbol::File(_)) {
                self.symbol(*symbol, OWN);
            }
        }
    }

    /// The constants, functions, records and enums that a file declares.
    pub fn of_file(&mut self, file: u32, rank: u8) {
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

    pub fn types_of_file(&mut self, file: u32, rank: u8) {
        let program = &self.checked.program;
        for (id, record) in (0..).map(RecordId).zip(&program.records) {
            if record.site.file == file && !record.is_tuple() {
                self.symbol(Symbol::Record(id), rank);
            }
        }
        let role_enum = role_enum(program);
        for (id, declared) in (0..).map(EnumId).zip(&program.enums) {
            if declared.site.file == file && role_enum != Some(id) {
                self.symbol(Symbol::Enum(id), rank);
            }
        }
    }

    /// The built-in names that may be used here.
    fn common(&mut self, reach: &Reach) {
        for builtin in BUILTINS {
            let of_property = reach.in_property && builtin.purity() == Purity::Property;
            if builtin.purity() <= reach.purity || of_property {
                self.symbol(Symbol::Builtin(*builtin), COMMON);
            }
        }
        self.of_file(crate::analysis::PRELUDE_FILE, COMMON);
    }

    pub fn robot_members(&mut self) {
        for member in ROBOT_MEMBERS {
            self.symbol(Symbol::RobotMember(member.word), COMMON);
        }
    }
}
