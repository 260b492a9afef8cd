//! Every name of the files, in order, with its meaning.

use starl_lang::check::{Checked, Symbol};
use starl_lang::diagnostic::Span;
use starl_lang::ir::{
    BindingId, ConstantId, EnumId, Event, FunctionId, ParameterId, Program, RecordId, SharedId,
    Site, Type, VariableId,
};
use std::collections::BTreeSet;

/// A name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// Where it is.
    pub site: Site,
    /// Its meaning.
    pub symbol: Symbol,
    /// Whether it is where that is declared.
    pub is_definition: bool,
}

/// The names of all files, sorted by position, each once.
#[derive(Clone, Debug)]
pub(crate) struct Index {
    occurrences: Vec<Occurrence>,
}

impl Index {
    pub fn new(checked: &Checked) -> Self {
        let mut occurrences = Vec::new();
        definitions(checked, &mut |site, symbol| {
            occurrences.push(Occurrence {
                site,
                symbol,
                is_definition: true,
            });
        });
        for (site, symbol) in &checked.resolutions.uses {
            occurrences.push(Occurrence {
                site: *site,
                symbol: *symbol,
                is_definition: false,
            });
        }
        // The sort keeps the order of equals: a definition counts, then what was noted first.
        occurrences.sort_by_key(|occurrence| occurrence.site);
        occurrences.dedup_by_key(|occurrence| occurrence.site);
        Self { occurrences }
    }

    /// All names.
    pub fn all(&self) -> &[Occurrence] {
        &self.occurrences
    }

    /// Those of a file.
    pub fn of_file(&self, file: u32) -> &[Occurrence] {
        let start = self.occurrences.partition_point(|one| one.site.file < file);
        let end = self
            .occurrences
            .partition_point(|one| one.site.file <= file);
        &self.occurrences[start..end]
    }

    /// The name that a place is in, or at the end of.
    pub fn at(&self, file: u32, offset: u32) -> Option<Occurrence> {
        let names = self.of_file(file);
        let after = names.partition_point(|one| one.site.span.start <= offset);
        let found = names[..after].last()?;
        (offset <= found.site.span.end).then_some(*found)
    }

    /// The meaning of the name at exactly this position.
    pub fn exactly(&self, site: Site) -> Option<Occurrence> {
        let at = (self.occurrences)
            .binary_search_by_key(&site, |one| one.site)
            .ok()?;
        Some(self.occurrences[at])
    }
}

/// Everything that has a name where it is declared.
fn definitions(checked: &Checked, define: &mut dyn FnMut(Site, Symbol)) {
    let program = &checked.program;
    for (number, name) in headers(checked) {
        define(name, Symbol::File(number));
    }
    let roles = program.roles.as_ref().map(|roles| roles.variable);
    let role_enum = roles.map(|variable| &program[variable].ty);
    for (number, declared) in program.enums.iter().enumerate() {
        let id = EnumId(number as u32);
        // The enum of the roles is declared by each of them.
        if declared.name.is_some() && role_enum != Some(&Type::Enum(id)) {
            define(declared.site, Symbol::Enum(id));
        }
        for (number, variant) in declared.variants.iter().enumerate() {
            define(variant.site, Symbol::Variant(id, number as u16));
        }
    }
    for (number, record) in program.records.iter().enumerate() {
        let id = RecordId(number as u32);
        if record.is_tuple() {
            continue;
        }
        define(record.site, Symbol::Record(id));
        for (number, field) in record.fields.iter().enumerate() {
            define(field.site, Symbol::Field(id, number as u32));
        }
    }
    for (number, variable) in program.variables.iter().enumerate() {
        let id = VariableId(number as u32);
        if roles != Some(id) {
            define(variable.site, Symbol::Variable(id));
        }
    }
    others(program, define);
    for (site, _) in &checked.resolutions.locals {
        define(*site, Symbol::Local(*site));
    }
}

fn others(program: &Program, define: &mut dyn FnMut(Site, Symbol)) {
    for (number, parameter) in program.parameters.iter().enumerate() {
        define(
            parameter.site,
            Symbol::Parameter(ParameterId(number as u32)),
        );
    }
    for (number, constant) in program.constants.iter().enumerate() {
        define(constant.site, Symbol::Constant(ConstantId(number as u32)));
    }
    for (number, shared) in program.shared.iter().enumerate() {
        define(shared.site, Symbol::Shared(SharedId(number as u32)));
    }
    for (number, binding) in program.bindings.iter().enumerate() {
        define(binding.site, Symbol::Binding(BindingId(number as u32)));
    }
    for (number, function) in program.functions.iter().enumerate() {
        define(function.site, Symbol::Function(FunctionId(number as u32)));
    }
    for (number, action) in program.actions.iter().enumerate() {
        define(action.site, Symbol::Action(number as u32));
    }
    let mut inputs = BTreeSet::new();
    for (number, handler) in program.handlers.iter().enumerate() {
        if let Event::Input { name, .. } = &handler.event
            && inputs.insert(name)
        {
            define(handler.site, Symbol::Input(number as u32));
        }
    }
    for (number, property) in program.properties.iter().enumerate() {
        if property.name.is_some() {
            define(property.site, Symbol::Property(number as u32));
        }
    }
}

/// The names that the files give themselves.
pub(crate) fn headers(checked: &Checked) -> impl Iterator<Item = (u32, Site)> {
    use starl_lang::syntax::ast::{Item, Named};
    (checked.files.iter().enumerate()).filter_map(|(number, file)| {
        let mut items = file.parse.tree().items();
        let name = items.find_map(|item| match item {
            Item::Program(header) => header.name(),
            Item::Library(header) => header.name(),
            _ => None,
        })?;
        let span = Span::from(name.token()?.text_range());
        let file = number as u32;
        Some((file, Site { file, span }))
    })
}
