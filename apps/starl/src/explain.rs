//! `starl explain`: the state machine of a program, drawn; or what an error means.

use crate::args::{Drawing, ExplainArguments};
use crate::check::examine;
use crate::console;
use crate::failure::Failure;
use crate::output::Output;
use crate::outputs::refuse_to_overwrite;
use crate::sources::{self, Source};
use crate::target::no_example;
use starl_catalog::examples;
use starl_editor::explain::StateMachine;
use starl_lang::diagnostic::Code;
use std::path::{Path, PathBuf};

/// Draws a program, or shows the page of a code. False if the program has errors, which are printed.
pub fn run(arguments: &ExplainArguments) -> Result<bool, Failure> {
    let mut codes = Code::ALL.iter();
    let asked = |code: &&Code| code.number().eq_ignore_ascii_case(&arguments.program);
    if let Some(code) = codes.find(asked) {
        console::print(code.page())?;
        return Ok(true);
    }
    let source = find(&arguments.program)?;
    let examined = examine(&source, |_| Vec::new())?;
    let read = examined.paths();
    sources::fail(examined.failures)?;
    if examined.files.iter().any(|file| file.has_errors()) {
        for file in &examined.files {
            console::complain(&file.render(console::colour_of_errors()));
        }
        let name = source.name();
        console::error(&format!("{name}: has errors, and is not drawn"));
        return Ok(false);
    }
    let variable = arguments.variable.as_deref();
    let machine = StateMachine::of(&examined.program, variable)
        .map_err(|refusal| Failure(format!("{}: {refusal}", source.name())))?;
    let drawing = (arguments.format)
        .or_else(|| by_suffix(arguments.output.as_deref()?))
        .unwrap_or(Drawing::Mermaid);
    let text = match drawing {
        Drawing::Mermaid => machine.mermaid(),
        Drawing::Dot => machine.dot(),
    };
    match &arguments.output {
        Some(path) => {
            refuse_to_overwrite(&[("--output", Some(path))], &read)?;
            let (output, file) = Output::create(path)?;
            output.write(file, text.as_bytes())?;
        }
        None => console::print(&text)?,
    }
    Ok(true)
}

fn by_suffix(path: &Path) -> Option<Drawing> {
    match path.extension()?.to_str()? {
        "dot" | "gv" => Some(Drawing::Dot),
        _ => None,
    }
}

/// Whether the argument has the form of a code: `E0201`.
fn is_code(word: &str) -> bool {
    let digits = word.strip_prefix(['E', 'e', 'W', 'w']);
    digits.is_some_and(|digits| digits.len() == 4 && digits.parse::<u16>().is_ok())
}

/// Resolves the argument; an example takes precedence over a file.
fn find(program: &str) -> Result<Source, Failure> {
    if let Some(example) = examples::find(program) {
        return sources::of(example).ok_or_else(|| {
            Failure(format!(
                "{program}: this example is not written in the language"
            ))
        });
    }
    let path = PathBuf::from(program);
    match program {
        "-" => Ok(Source::Input),
        _ if path.is_dir() => Err(Failure::file(&path, "is a folder; name the program in it")),
        _ if sources::is_scenario(&path) => Err(Failure::file(&path, sources::SCENARIO)),
        _ if path.exists() => Ok(Source::File(path)),
        _ if is_code(program) => Err(Failure(format!(
            "{program}: there is no error or warning with this code; `starl check` prints the code of each problem"
        ))),
        _ => Err(no_example(program, "program")),
    }
}
