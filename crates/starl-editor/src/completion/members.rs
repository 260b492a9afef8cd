//! Completions after a dot, and where a name other than a value is expected.

use super::candidates::{COMMON, Candidates, OWN};
use super::{Call, Completion};
use crate::analysis::PRELUDE_FILE;
use crate::built_in::TYPES;
use crate::words;
use starl_lang::check::{Libraries, Method, PRIMITIVES, Symbol};
use starl_lang::ir::{BindingId, ParameterId, RecordId, SharedId, Type, VariableId};

impl Candidates<'_> {
    /// The completions after the dot of a value.
    pub fn members(&mut self, of: &Type, in_property: bool) {
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
                for number in 0..program.shared.len() {
                    self.symbol(Symbol::Shared(SharedId(number as u32)), OWN);
                }
                self.robot_members();
            }
            _ => {}
        }
    }

    /// The completions after the dot of a library, primitive or enum.
    pub fn parts(&mut self, symbol: Symbol) {
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

    pub fn types(&mut self) {
        for ty in TYPES {
            self.symbol(Symbol::Type(ty.word), COMMON);
        }
        self.types_of_file(0, OWN);
        self.types_of_file(PRELUDE_FILE, COMMON);
        self.imported();
        // A call makes a value; a type has no brackets.
        for item in &mut self.items {
            item.call = Call::No;
        }
    }

    pub fn events(&mut self) {
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
        self.words(words::HANDLERS);
    }

    pub fn events_of(&mut self, symbol: Symbol) {
        let Symbol::Binding(id) = symbol else { return };
        let Some(primitive) = self.kind_of(id) else {
            return;
        };
        for number in 0..PRIMITIVES[primitive].events.len() {
            self.symbol(Symbol::Event(primitive, number), OWN);
        }
    }

    /// All libraries except the text itself.
    pub fn libraries(&mut self, libraries: &dyn Libraries) {
        for name in libraries.names() {
            if name != self.checked.files[0].name {
                let detail = format!("library {name}");
                self.items.push(Completion::plain(name, detail, OWN));
            }
        }
    }
}
