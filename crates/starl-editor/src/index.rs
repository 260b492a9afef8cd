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
        let mut add = |site, symbol, is_definition| {
            occurrences.push(Occurrence {
                site,
                symbol,
                is_definition,
            });
        };
        definitions(checked, &mut |site, symbol| add(site, symbol, true));
        for (site, symbol) in &checked.resolutions.uses {
            add(*site, *symbol, false);
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
    let role_enum = role_enum(program);
    for (id, declared) in (0..).map(EnumId).zip(&program.enums) {
        // The enum of the roles is declared by each of them.
        if declared.name.is_some() && role_enum != Some(id) {
            define(declared.site, Symbol::Enum(id));
        }
        for (number, variant) in (0..=u16::MAX).zip(&declared.variants) {
            define(variant.site, Symbol::Variant(id, number));
        }
    }
    for (id, record) in (0..).map(RecordId).zip(&program.records) {
        if record.is_tuple() {
            continue;
        }
        define(record.site, Symbol::Record(id));
        for (number, field) in (0..).zip(&record.fields) {
            define(field.site, Symbol::Field(id, number));
        }
    }
    let role = program.roles.as_ref().map(|roles| roles.variable);
    for (id, variable) in (0..).map(VariableId).zip(&program.variables) {
        if role != Some(id) {
            define(variable.site, Symbol::Variable(id));
        }
    }
    others(program, define);
    for (site, _) in &checked.resolutions.locals {
        define(*site, Symbol::Local(*site));
    }
}

fn others(program: &Program, define: &mut dyn FnMut(Site, Symbol)) {
    for (number, parameter) in (0..).zip(&program.parameters) {
        define(parameter.site, Symbol::Parameter(ParameterId(number)));
    }
    for (number, constant) in (0..).zip(&program.constants) {
        define(constant.site, Symbol::Constant(ConstantId(number)));
    }
    for (number, shared) in (0..).zip(&program.shared) {
        define(shared.site, Symbol::Shared(SharedId(number)));
    }
    for (number, binding) in (0..).zip(&program.bindings) {
        define(binding.site, Symbol::Binding(BindingId(number)));
    }
    for (number, function) in (0..).zip(&program.functions) {
        define(function.site, Symbol::Function(FunctionId(number)));
    }
    for (number, action) in (0..).zip(&program.actions) {
        define(action.site, Symbol::Action(number));
    }
    let mut inputs = BTreeSet::new();
    for (number, handler) in (0..).zip(&program.handlers) {
        if let Event::Input { name, .. } = &handler.event
            && inputs.insert(name)
        {
            define(handler.site, Symbol::Input(number));
        }
    }
    for (number, property) in (0..).zip(&program.properties) {
        if property.name.is_some() {
            define(property.site, Symbol::Property(number));
        }
    }
}

/// The enum of the roles, which no declaration names.
pub(crate) fn role_enum(program: &Program) -> Option<EnumId> {
    match program[program.roles.as_ref()?.variable].ty {
        Type::Enum(id) => Some(id),
        _ => None,
    }
}

/// The names that the files give themselves.
pub(crate) fn headers(checked: &Checked) -> impl Iterator<Item = (u32, Site)> {
    use starl_lang::syntax::ast::{Item, Named};
    (0..).zip(&checked.files).filter_map(|(file, checked)| {
        let mut items = checked.parse.tree().items();
        let name = items.find_map(|item| match item {
            Item::Program(header) => header.name(),
            Item::Library(header) => header.name(),
            _ => None,
        })?;
        let span = Span::from(name.token()?.text_range());
        Some((file, Site { file, span }))
    })
}
