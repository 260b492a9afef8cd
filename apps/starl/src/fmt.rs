//! `starl fmt`: formats programs in the standard layout.
//!
//! Invariant: a file is replaced atomically, and a file with syntax errors is not changed.

use crate::args::FormatArguments;
use crate::console;
use crate::failure::Failure;
use crate::output::Output;
use crate::sources::{self, Source};
use starl_catalog::disk::reason;
use starl_editor::format::format_parse;
use starl_lang::diagnostic::{has_errors, render};
use starl_lang::syntax;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

/// The result for a source.
enum Outcome {
    /// It is formatted.
    Same,
    /// It was formatted, or would be.
    Changed,
    /// Its text has errors.
    Broken,
}

/// Formats what the arguments name. True if there is nothing left to do.
pub fn run(arguments: &FormatArguments) -> Result<bool, Failure> {
    let (sources, mut failures) = sources::find(&arguments.files);
    let mut changed = 0;
    let mut broken = 0;
    for source in &sources {
        match one(source, arguments.check) {
            Ok(Outcome::Same) => {}
            Ok(Outcome::Changed) => changed += 1,
            Ok(Outcome::Broken) => broken += 1,
            Err(failure) => failures.push(failure),
        }
    }
    sources::fail(failures)?;
    Ok(broken == 0 && !(arguments.check && changed > 0))
}

fn one(source: &Source, only_check: bool) -> Result<Outcome, Failure> {
    let text = source.read()?;
    let name = source.name();
    let parse = syntax::parse(&text);
    if has_errors(parse.diagnostics()) {
        let colour = console::colour_of_errors();
        console::complain(&render(&name, &text, parse.diagnostics(), colour));
        console::error(&format!("{name}: has errors, and is left as it is"));
        return Ok(Outcome::Broken);
    }
    let formatted = format_parse(&parse);
    let is_same = formatted == text;
    match source {
        Source::Input if !only_check => console::print(&formatted)?,
        Source::File(path) if !only_check && !is_same => {
            replace(path, formatted.as_bytes())?;
            console::print(&format!("formatted {name}\n"))?;
        }
        _ if only_check && !is_same => console::print(&format!("{name}\n"))?,
        _ => {}
    }
    Ok(match is_same {
        true => Outcome::Same,
        false => Outcome::Changed,
    })
}

/// Puts new content in place of a file's old one; its permissions stay.
fn replace(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let (output, mut file) = Output::create(path)?;
    let write = |file: &mut File| {
        file.set_permissions(fs::metadata(path)?.permissions())?;
        file.write_all(content)?;
        // The renamed file must not be empty after a power failure.
        file.sync_all()
    };
    write(&mut file)
        .map_err(|error| Failure::file(path, format!("cannot be written: {}", reason(&error))))?;
    output.commit()
}
