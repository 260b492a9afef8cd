//! The state of the checker.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::String;
use alloc::vec::Vec;

use super::body::{Body, Dimension};
use super::resolution::Resolutions;
use super::scope::{Entity, Scope};
use super::surroundings::Surroundings;
use super::{Checked, CheckedFile};
use crate::diagnostic::{Code, Diagnostic, LineIndex, Severity, Span, has_errors};
use crate::ir::{BindingId, ConstantId, EnumId, FunctionId, Program, RecordId, Site, Type};
use crate::syntax::ast;

/// A file with its declarations.
pub(super) struct File {
    pub checked: CheckedFile,
    pub scope: Scope,
    /// Words of parts that could not be read: they may have been declarations.
    pub unread: BTreeSet<String>,
    /// The imports that were found, by name, with the numbers of their files.
    pub imports: BTreeMap<String, u32>,
}

/// The declarations as they are written, with their files, each list in the order of the program's
/// table of the same name.
#[derive(Default)]
pub(super) struct Nodes {
    pub enums: Vec<Option<ast::EnumDeclaration>>,
    pub records: Vec<RecordNode>,
    pub parameters: Vec<ast::ParameterDeclaration>,
    pub constants: Vec<(u32, ast::ConstantDeclaration)>,
    /// The variable `role` has none.
    pub variables: Vec<Option<ast::VariableDeclaration>>,
    pub shared: Vec<ast::SharedDeclaration>,
    pub bindings: Vec<ast::BindingDeclaration>,
    pub functions: Vec<(u32, ast::FunctionDeclaration)>,
    /// Declarations that nothing refers to by name, in the order of the text.
    pub behaviour: Vec<Behaviour>,
    pub roles: Vec<ast::RoleDeclaration>,
}

pub(super) enum RecordNode {
    Record(ast::RecordDeclaration),
    Message(ast::MessageDeclaration),
}

/// A part of a program's behaviour, with its role.
pub(super) enum Behaviour {
    Init(Option<u16>, ast::InitDeclaration),
    Action(Option<u16>, ast::ActionDeclaration),
    Handler(Option<u16>, ast::HandlerDeclaration),
    Check(ast::CheckDeclaration),
    Property(ast::PropertyDeclaration),
}

/// How far a constant was checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    Untouched,
    UnderWay,
    Done,
}

/// A constant or function on which another may depend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Needed {
    Constant(ConstantId),
    Function(FunctionId),
}

/// The uses of declarations, for warnings.
#[derive(Default)]
pub(super) struct Usage {
    /// Declarations that are read, called or named.
    pub used: BTreeSet<Entity>,
    /// Variables that are written.
    pub written: BTreeSet<Entity>,
    /// Messages that are made.
    pub sent: BTreeSet<u32>,
    /// Messages that are handled.
    pub handled: BTreeSet<u32>,
    /// Libraries that are used, by the file that imports and the file of the library.
    pub imports: BTreeSet<(u32, u32)>,
}

/// An evaluation of a model with a list of known length.
pub(super) struct Evaluation {
    pub binding: BindingId,
    pub numbers: usize,
    pub span: Span,
}

/// The checker.
#[derive(Default)]
pub(super) struct Checker {
    pub program: Program,
    pub files: Vec<File>,
    pub nodes: Nodes,
    /// The file that is being checked.
    pub file: u32,
    /// The body that is being checked.
    pub body: Body,
    pub usage: Usage,
    pub constants: Vec<Progress>,
    /// The dependencies: the user first.
    pub needs: BTreeSet<(Needed, Needed)>,
    /// The constant or function that is being checked.
    pub user: Option<Needed>,
    /// Types whose keys must be checked when all types are known, with their positions.
    pub keys: Vec<(Site, Type)>,
    /// The dimensions of declared names, where their values have one.
    pub dimensions: BTreeMap<Entity, Dimension>,
    /// Which enums have a variant with this name.
    pub variants: BTreeMap<String, Vec<(EnumId, u16)>>,
    /// The tuples, by the types of their parts.
    pub tuples: BTreeMap<Vec<Type>, RecordId>,
    /// Of how many parts the records are made.
    pub sizes: BTreeMap<RecordId, u32>,
    /// The evaluations of models with lists of known length.
    pub evaluations: Vec<Evaluation>,
    /// The names of the actions.
    pub actions: BTreeSet<String>,
    /// Locals that are declared to be read and are not, in the program itself.
    pub unused_locals: Vec<(Code, Span, String)>,
    pub resolutions: Resolutions,
    /// The position of the name that an editor wants to complete.
    pub probe: Option<u32>,
    /// The result: the context of that name.
    pub surroundings: Option<Surroundings>,
    /// The parameters that it may be the name of.
    pub probed_parameters: Vec<String>,
    /// The type of values that replace properties, each of one robot.
    pub value: Option<Type>,
}

impl Checker {
    pub fn new(files: Vec<File>) -> Self {
        let names = files.iter().map(|file| file.checked.name.clone());
        let program = Program {
            files: names.collect(),
            ..Program::default()
        };
        Self {
            program,
            files,
            ..Self::default()
        }
    }

    /// Whether the program's own text could be read.
    pub fn is_readable(&self) -> bool {
        let checked = &self.files[0].checked;
        !has_errors(checked.parse.diagnostics())
    }

    /// The result.
    pub fn finish(mut self) -> Checked {
        self.report_broken_libraries();
        for file in &mut self.files {
            forget_consequences(&mut file.checked);
            let diagnostics = &mut file.checked.diagnostics;
            diagnostics.extend(file.checked.parse.diagnostics().iter().cloned());
            diagnostics.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
            diagnostics.dedup();
        }
        Checked {
            program: self.program,
            files: self.files.into_iter().map(|file| file.checked).collect(),
            resolutions: self.resolutions,
        }
    }

    /// At each import of a library that has errors.
    fn report_broken_libraries(&mut self) {
        // Libraries come after what imports them, except in circles.
        for number in (0..self.files.len()).rev() {
            let broken: Vec<(Span, String)> = (self.files[number].scope.iter())
                .filter_map(|(name, declared)| match declared.entity {
                    Entity::Library(file) => Some((declared.span, name.clone(), file)),
                    _ => None,
                })
                .filter(|(_, _, file)| {
                    let library = &self.files[*file as usize].checked;
                    has_errors(&library.diagnostics) || has_errors(library.parse.diagnostics())
                })
                .map(|(span, name, _)| (span, name))
                .collect();
            self.file = number as u32;
            for (span, name) in broken {
                self.report(crate::diagnostic::Diagnostic::new(
                    Code::BrokenLibrary,
                    span,
                    alloc::format!("the library `{name}` has errors"),
                ));
            }
        }
    }
}

/// Drops problems in lines with syntax errors: they may disappear with them. A statement without effect has no syntax
/// error.
fn forget_consequences(file: &mut CheckedFile) {
    let index = LineIndex::new(&file.source);
    let lines =
        |problem: &Diagnostic| index.line(problem.span.start)..=index.line(problem.span.end);
    let errors = file.parse.diagnostics().iter();
    let unread: BTreeSet<u32> = errors
        .filter(|problem| problem.severity() == Severity::Error)
        .filter(|problem| problem.code != Code::NoEffect)
        .flat_map(lines)
        .collect();
    (file.diagnostics).retain(|problem| !lines(problem).any(|line| unread.contains(&line)));
}
