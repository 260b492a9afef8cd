//! Loading: the program, the prelude and their imports, each read once.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::report::did_you_mean;
use super::standard::STANDARD;
use super::state::{Checker, File};
use super::{CheckedFile, Libraries, prelude};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::ast::{AstNode, Item, Named};
use crate::syntax::{Parse, SyntaxKind, parse};

/// How many libraries may stand in a row of which each imports the next.
const DEEPEST: usize = 50;

/// Reads everything that the program needs.
pub(super) fn load(source: &str, parsed: Parse, libraries: &dyn Libraries) -> Checker {
    let name = header_name(&parsed).unwrap_or_else(|| "program".into());
    let mut loader = Loader {
        files: Vec::new(),
        by_name: BTreeMap::new(),
        libraries,
    };
    loader.add(name.clone(), source.to_string(), parsed);
    loader.add(
        "prelude".into(),
        prelude::PRELUDE.into(),
        parse(prelude::PRELUDE),
    );
    let is_library = loader.is_library(0);
    let mut way = Vec::new();
    if is_library {
        // A library that imports itself through others is in a cycle too.
        loader.by_name.insert(name.clone(), 0);
        way.push(name);
    }
    loader.imports(0, &mut way);
    Checker::new(loader.files)
}

struct Loader<'a> {
    files: Vec<File>,
    by_name: BTreeMap<String, u32>,
    libraries: &'a dyn Libraries,
}

impl Loader<'_> {
    fn add(&mut self, name: String, source: String, parsed: Parse) -> u32 {
        let unread = unread_words(&parsed);
        self.files.push(File {
            checked: CheckedFile {
                name,
                source,
                parse: parsed,
                diagnostics: Vec::new(),
            },
            scope: BTreeMap::new(),
            unread,
            imports: BTreeMap::new(),
        });
        self.files.len() as u32 - 1
    }

    fn is_library(&self, file: u32) -> bool {
        let tree = self.files[file as usize].checked.parse.tree();
        tree.items().any(|item| matches!(item, Item::Library(_)))
    }

    /// Loads what a file imports. `way` are the libraries that led there, itself last.
    fn imports(&mut self, file: u32, way: &mut Vec<String>) {
        let tree = self.files[file as usize].checked.parse.tree();
        let imports: Vec<_> = tree
            .items()
            .filter_map(|item| match item {
                Item::Import(import) => import.name(),
                _ => None,
            })
            .map(|name| (name.text(), name.span()))
            .collect();
        for (name, span) in imports {
            if let Some(at) = way.iter().position(|passed| *passed == name) {
                let mut circle = way[at..].to_vec();
                circle.push(name.clone());
                let message = format!("`{name}` imports itself");
                let problem = Diagnostic::new(Code::ImportCycle, span, message);
                self.report(file, problem.note(circle.join(" imports ")));
                continue;
            }
            if let Some(number) = self.library(file, &name, span, way) {
                self.files[file as usize].imports.insert(name, number);
            }
        }
    }

    /// The number of a library's file.
    fn library(&mut self, file: u32, name: &str, span: Span, way: &mut Vec<String>) -> Option<u32> {
        if let Some(number) = self.by_name.get(name) {
            return Some(*number);
        }
        if way.len() > DEEPEST {
            let message = "libraries import each other too deeply here";
            let problem = Diagnostic::new(Code::ImportCycle, span, message);
            self.report(
                file,
                problem.note(format!("at most {DEEPEST} may be in a row")),
            );
            return None;
        }
        let Some(source) = self.libraries.source(name) else {
            let message = format!("there is no library `{name}`");
            let problem = Diagnostic::new(Code::UnknownLibrary, span, message);
            let names = self.libraries.names();
            let standard = STANDARD.iter().map(|(name, _)| *name);
            let names = names.iter().map(String::as_str).chain(standard);
            let problem = did_you_mean(problem, span, name, names);
            let note = match name {
                "math" | "random" | "time" | "numpy" | "sys" | "os" | "typing" => {
                    "functions such as `sqrt`, `sin`, `random` and `now` need no import: remove the line".into()
                }
                _ => format!("the file `{name}.starl` must be beside this file"),
            };
            self.report(file, problem.note(note));
            return None;
        };
        let parsed = parse(&source);
        let number = self.add(name.into(), source, parsed);
        if !self.is_library(number) {
            let message = format!("`{name}` is a program, not a library");
            let problem = Diagnostic::new(Code::UnknownLibrary, span, message);
            self.report(file, problem.note("an imported file begins with `library`"));
        }
        self.by_name.insert(name.into(), number);
        way.push(name.into());
        self.imports(number, way);
        way.pop();
        Some(number)
    }

    fn report(&mut self, file: u32, problem: Diagnostic) {
        self.files[file as usize].checked.diagnostics.push(problem);
    }
}

fn header_name(parsed: &Parse) -> Option<String> {
    parsed.tree().items().find_map(|item| match item {
        Item::Program(header) => Some(header.name()?.text()),
        Item::Library(header) => Some(header.name()?.text()),
        _ => None,
    })
}

/// The words of what could not be read.
fn unread_words(parsed: &Parse) -> BTreeSet<String> {
    if parsed.diagnostics().is_empty() {
        return BTreeSet::new();
    }
    let errors = (parsed.syntax().descendants()).filter(|node| node.kind() == SyntaxKind::Error);
    errors
        .flat_map(|node| node.descendants_with_tokens())
        .filter_map(rowan::NodeOrToken::into_token)
        .filter(|token| token.kind() == SyntaxKind::Identifier)
        .map(|token| token.text().to_string())
        .collect()
}
