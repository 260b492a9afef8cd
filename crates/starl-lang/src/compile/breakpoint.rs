//! A condition over the robots that run a program, or a value of each, written apart from the program.

use alloc::string::String;
use alloc::vec::Vec;

use super::compile;
use crate::check::{Checked, Libraries, check, check_values};
use crate::diagnostic::{Code, Diagnostic, Severity, Span};
use crate::ir::Type;
use crate::machine::{Bytecode, Claim};

/// Compiles a program without errors, with one property in place of its own: that the condition becomes true. The
/// property is judged for each robot if it has no quantifier, else for all robots that run the program.
///
/// # Errors
///
/// The problems of the condition; positions are bytes of it.
pub fn with_condition(
    program: &str,
    condition: &str,
    libraries: &dyn Libraries,
) -> Result<Bytecode, Vec<Diagnostic>> {
    let mut bytecode = compiled(program, condition, |text| check(text, libraries))?;
    let others = bytecode.properties.len().saturating_sub(1);
    bytecode.properties.drain(..others);
    Ok(bytecode)
}

/// Compiles a program, which has no errors and no properties, with a value of each robot: an expression that may read
/// everything that a property may, and whose value has the type. The function with the returned number takes a robot
/// and returns the value; positions of its instructions are bytes of the expression.
///
/// # Errors
/// The problems of the expression; positions are bytes of it.
pub fn with_value(
    program: &str,
    expression: &str,
    ty: &Type,
    libraries: &dyn Libraries,
) -> Result<(Bytecode, u32), Vec<Diagnostic>> {
    let mut bytecode = compiled(program, expression, |text| {
        check_values(text, ty.clone(), libraries)
    })?;
    let start = before(program).len() as u32;
    for (_, span) in &mut bytecode.spans {
        span.start = span.start.saturating_sub(start);
        span.end = span.end.saturating_sub(start);
    }
    // An expression of another type than Bool is not a property.
    match bytecode.properties.pop().map(|value| value.claim) {
        Some(Claim::Eventually { holds, .. }) => Ok((bytecode, holds)),
        _ => Err(Vec::from([no_room(expression)])),
    }
}

/// Everything that stands before the part. In brackets it ends where it ends.
fn before(program: &str) -> String {
    [program, "\n\neventually: ("].concat()
}

/// Compiles the program with the part as its last property.
fn compiled(
    program: &str,
    part: &str,
    check: impl FnOnce(&str) -> Checked,
) -> Result<Bytecode, Vec<Diagnostic>> {
    let before = before(program);
    // A line break would end it before.
    let text = [&before, &*part.replace(['\n', '\r'], " "), ")\n"].concat();
    let place = Span::new(before.len() as u32, (before.len() + part.len()) as u32);
    compile(&check(&text)).map_err(|problems| within(problems, place, part))
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
        found.push(no_room(condition));
    }
    found
}

fn no_room(part: &str) -> Diagnostic {
    let message = String::from("the program has no room for this condition");
    Diagnostic::new(Code::TooMuch, Span::new(0, part.len() as u32), message)
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
    // A change of the program cannot fix the condition.
    problem.fix = problem
        .fix
        .filter(|fix| fix.edits.iter().all(|edit| inside(&edit.span)));
    for edit in problem.fix.iter_mut().flat_map(|fix| &mut fix.edits) {
        edit.span = span(edit.span);
    }
    problem
}
