//! One text, checked, with what can be asked about it.

use crate::describe::describe;
use crate::description::Description;
use crate::index::{Index, Occurrence, headers};
use starl_lang::check::{Checked, Libraries, Symbol, check};
use starl_lang::compile::problems;
use starl_lang::diagnostic::{Diagnostic, Span};
use starl_lang::ir::Site;

/// The number of the prelude's file.
pub(crate) const PRELUDE_FILE: u32 = 1;

/// A program or a library, checked together with its imports. Its own file has the number 0.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The result of the checker.
    pub checked: Checked,
    pub(crate) index: Index,
    diagnostics: Vec<Diagnostic>,
}

impl Analysis {
    /// Reads and checks a text.
    #[must_use]
    pub fn new(text: &str, libraries: &dyn Libraries) -> Self {
        let checked = check(text, libraries);
        let index = Index::new(&checked);
        let mut diagnostics = checked.diagnostics().to_vec();
        diagnostics.extend(problems(&checked));
        diagnostics.sort_by_key(|diagnostic| diagnostic.span);
        Self {
            checked,
            index,
            diagnostics,
        }
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.checked.files[0].source
    }

    /// All problems of the text, those of the compiler included, sorted by position.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// Every name of the text, sorted by position.
    #[must_use]
    pub fn occurrences(&self) -> &[Occurrence] {
        self.index.of_file(0)
    }

    /// The name that a place of the text is in, or at the end of.
    #[must_use]
    pub fn occurrence(&self, offset: u32) -> Option<Occurrence> {
        self.index.at(0, offset)
    }

    /// The same in another of its files.
    #[must_use]
    pub fn occurrence_in(&self, file: u32, offset: u32) -> Option<Occurrence> {
        self.index.at(file, offset)
    }

    /// The meaning, declaration and documentation of a symbol.
    #[must_use]
    pub fn describe(&self, symbol: Symbol) -> Description {
        describe(&self.checked, symbol)
    }

    /// The text to show at a position: the span of the name, and its description.
    #[must_use]
    pub fn hover(&self, offset: u32) -> Option<(Span, Description)> {
        if let Some(found) = self.occurrence(offset) {
            return Some((found.site.span, self.describe(found.symbol)));
        }
        crate::words::at(&self.checked.files[0].parse, offset)
    }

    /// The declaration of a symbol; none for a built-in one.
    #[must_use]
    pub fn definition(&self, symbol: Symbol) -> Option<Site> {
        let program = &self.checked.program;
        Some(match symbol {
            Symbol::Enum(id) => program[id].site,
            Symbol::Variant(id, number) => program[id].variants.get(number as usize)?.site,
            Symbol::Record(id) => program[id].site,
            Symbol::Field(id, number) if !program[id].is_tuple() => {
                program[id].fields.get(number as usize)?.site
            }
            Symbol::Parameter(id) => program[id].site,
            Symbol::Constant(id) => program[id].site,
            Symbol::Variable(id) => program[id].site,
            Symbol::Shared(id) => program[id].site,
            Symbol::Binding(id) => program[id].site,
            Symbol::Function(id) => program[id].site,
            Symbol::Local(site) => site,
            Symbol::Action(number) => program.actions.get(number as usize)?.site,
            Symbol::Input(number) => program.handlers.get(number as usize)?.site,
            Symbol::Property(number) => program.properties.get(number as usize)?.site,
            Symbol::File(file) => return Some(self.header(file)),
            Symbol::Field(..)
            | Symbol::Builtin(_)
            | Symbol::Type(_)
            | Symbol::Method(_)
            | Symbol::Primitive(_)
            | Symbol::Member(..)
            | Symbol::Event(..)
            | Symbol::Coordinate(_)
            | Symbol::RobotMember(_)
            | Symbol::Argument(..) => return None,
        })
    }

    /// The name that a file gives itself, else its start.
    fn header(&self, file: u32) -> Site {
        let found = headers(&self.checked).find(|(number, _)| *number == file);
        let start = Site {
            file,
            span: Span::empty(0),
        };
        found.map_or(start, |(_, site)| site)
    }

    /// The uses of a symbol in all files, sorted by position.
    #[must_use]
    pub fn references(&self, symbol: Symbol) -> Vec<Occurrence> {
        let names = self.index.all().iter();
        names.filter(|one| one.symbol == symbol).copied().collect()
    }

    /// The text of a file at a place.
    #[must_use]
    pub fn name_at(&self, site: Site) -> String {
        let file = self.checked.files.get(site.file as usize);
        file.map_or(String::new(), |file| site.span.of(&file.source).into())
    }
}
