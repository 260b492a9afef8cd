//! The static checker: from a tree to a resolved, typed program and its problems.
//!
//! [`check`] never fails: it returns a program, which may contain errors, and the diagnostics of each file. A part with
//! an error gets the type [`Type::Error`], which fits everywhere, so that a mistake is reported once.
//!
//! The steps are: load the files (`load`), collect the declarations (`collect`), resolve their types (`types`), check
//! their contents (`declaration`, `statement`, `expression`, `property`), then look for probable mistakes in the whole
//! program (`usage`, `control`). Types flow down and up: an expression is checked with the expected type, if known, and
//! returns its own type.

mod arguments;
mod arithmetic;
mod asked;
mod behaviour;
mod body;
mod braces;
mod builtin;
mod call;
mod collect;
mod collection;
mod comparison;
mod condition;
mod constants;
mod control;
mod declaration;
mod dimension;
mod event;
mod expression;
pub mod feasible;
mod fit;
mod hints;
mod input;
mod libraries;
mod load;
mod member;
mod model;
mod name;
mod operator;
mod place;
mod prelude;
mod probe;
mod property;
mod records;
mod report;
mod resolution;
mod resolving;
mod returns;
mod scope;
mod shape;
mod standard;
mod state;
mod statement;
mod surroundings;
mod tables;
pub mod transitions;
mod types;
mod usage;
mod value;

use alloc::string::String;
use alloc::vec::Vec;

use crate::diagnostic::{Diagnostic, has_errors};
use crate::ir::{Program, Type};
use crate::syntax::{Parse, parse};

pub use input::is_input_field;
pub use libraries::{Libraries, NoLibraries};
pub use prelude::PRELUDE;
pub use resolution::{Resolutions, Symbol};
pub use standard::{STANDARD, StandardLibraries};
pub use surroundings::{Reach, Surroundings};
pub use tables::{
    BUILTINS, Builtin, Event, METHODS, Member, Method, PRIMITIVES, Parameter, Primitive, Purity,
    Shape, Signature,
};

/// A file that was checked.
#[derive(Clone, Debug)]
pub struct CheckedFile {
    /// Its name: that of the library; of the program the name that it gives itself.
    pub name: String,
    /// Its text.
    pub source: String,
    /// Its tree.
    pub parse: Parse,
    /// All problems, syntax errors included, sorted by position.
    pub diagnostics: Vec<Diagnostic>,
}

/// A program that was checked.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The program, with errors in it if there are any.
    pub program: Program,
    /// The files, by the numbers that [`crate::ir::Site`] uses: 0 is the program, 1 the prelude.
    pub files: Vec<CheckedFile>,
    /// The meanings of all names in the files.
    pub resolutions: Resolutions,
}

impl Checked {
    /// The problems of the program itself, sorted by position.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.files[0].diagnostics
    }

    /// Whether errors, of any file, keep the program from running.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.files.iter().any(|file| has_errors(&file.diagnostics))
    }

    /// The program, if it has no errors.
    #[must_use]
    pub fn correct(&self) -> Option<&Program> {
        (!self.has_errors()).then_some(&self.program)
    }
}

/// Reads and checks a program or a library.
#[must_use]
pub fn check(source: &str, libraries: &dyn Libraries) -> Checked {
    check_parsed(source, parse(source), libraries)
}

/// Checks a program or a library that was read from `source`.
#[must_use]
pub fn check_parsed(source: &str, parse: Parse, libraries: &dyn Libraries) -> Checked {
    let mut checker = load::load(source, parse, libraries);
    checker.check();
    checker.check_models(libraries);
    checker.finish()
}

/// The syntactic context of the name that begins at byte `at` of a program or a library, as far as the checker
/// determines it. No declaration may have this name.
#[must_use]
pub fn surroundings(
    source: &str,
    at: u32,
    libraries: &dyn Libraries,
) -> (Checked, Option<Surroundings>) {
    let mut checker = load::load(source, parse(source), libraries);
    checker.probe = Some(at);
    checker.check();
    checker.check_models(libraries);
    let surroundings = checker.surroundings.take();
    (checker.finish(), surroundings)
}

/// Checks a program in which each property is a value of this type of each robot.
#[must_use]
pub(crate) fn check_values(source: &str, ty: Type, libraries: &dyn Libraries) -> Checked {
    let mut checker = load::load(source, parse(source), libraries);
    checker.value = Some(ty);
    checker.check();
    checker.finish()
}

impl state::Checker {
    fn check(&mut self) {
        self.collect();
        self.resolve_types();
        self.check_declarations();
        self.order_constants();
        self.warn_of_use();
        self.warn_of_control();
    }
}
