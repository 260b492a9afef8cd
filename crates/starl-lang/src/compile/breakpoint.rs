//! A condition over the robots that run a program, written apart from the program.

use alloc::string::String;
use alloc::vec::Vec;

use super::compile;
use crate::check::{Libraries, check};
use crate::diagnostic::{Code, Diagnostic, Severity, Span};
use crate::machine::Bytecode;

/// Compiles a program, which has no errors, with one property in the place of all of its own: that the condition
/// comes true. It is about each robot if it has no quantifier, else about all robots that run the program.
///
/// # Errors
/// What is wrong with the condition; places are bytes of it.
pub fn with_condition(
    program: &str,
    condition: &str,
    libraries: &dyn Libraries,
) -> Result<Bytecode, Vec<Diagnostic>> {
    // In brackets it ends where it ends. A line break would end it before.
    let before = [program, "\n\neventually: ("].concat();
    let text = [&before, &*condition.replace(['\n', '\r'], " "), ")\n"].concat();
    let part = Span::new(before.len() as u32, (before.len() + condition.len()) as u32);
    let checked = check(&text, libraries);
    match compile(&checked) {
        Ok(mut bytecode) => {
            let others = bytecode.properties.len().saturating_sub(1);
            bytecode.properties.drain(..others);
            Ok(bytecode)
        }
        Err(problems) => Err(within(problems, part, condition)),
    }
}

/// The errors of a part of a text, at their places in the part.
fn within(problems: Vec<Diagnostic>, part: Span, condition: &str) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = problems
        .into_iter()
        .filter(|problem| problem.severity() == Severity::Error)
        .filter(|problem| problem.span.end >= part.start)
        .map(|problem| moved(problem, part))
        .collect();
    if found.is_empty() {
        let message = String::from("the program has no room for this condition");
        let whole = Span::new(0, condition.len() as u32);
        found.push(Diagnostic::new(Code::TooMuch, whole, message));
    }
    found
}

fn moved(mut problem: Diagnostic, part: Span) -> Diagnostic {
    let place = |at: u32| at.clamp(part.start, part.end) - part.start;
    let inside = |span: &Span| part.start <= span.start && span.end <= part.end;
    let span = |span: Span| Span::new(place(span.start), place(span.end));
    problem.span = span(problem.span);
    problem.labels.retain(|label| inside(&label.span));
    for label in &mut problem.labels {
        label.span = span(label.span);
    }
    // A change of the program is no way to mend the condition.
    problem.mend = problem
        .mend
        .filter(|mend| mend.edits.iter().all(|edit| inside(&edit.span)));
    for edit in problem.mend.iter_mut().flat_map(|mend| &mut mend.edits) {
        edit.span = span(edit.span);
    }
    problem
}
