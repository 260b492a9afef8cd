//! Properties that must hold for every generated program, whatever its bytes.

use super::compare::{Compared, compare};
use super::generate::{layout, program, program_with_parentheses};
use super::run;
use starl_lang::check::{Checked, StandardLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::{Colour, Diagnostic, has_errors, render};
use starl_lang::machine::{Bytecode, assemble, disassemble};

/// Everything.
#[allow(dead_code, reason = "the fuzz targets use it")]
pub fn all(bytes: &[u8]) {
    let text = program(bytes);
    let Some((checked, bytecode)) = compiled(&text) else {
        return;
    };
    can_be_written(&bytecode);
    means(&checked, &bytecode);
    needs_no_parentheses(bytes, &bytecode);
    has_any_layout(bytes, &text, &bytecode);
}

/// The checker takes the program.
pub fn checks(text: &str) -> Checked {
    let checked = check(text, &StandardLibraries);
    let errors: Vec<Diagnostic> = (checked.diagnostics().iter())
        .filter(|one| has_errors(std::slice::from_ref(one)))
        .cloned()
        .collect();
    let said = || render("generated.starl", text, &errors, Colour::Off);
    assert!(
        !checked.has_errors(),
        "it is well typed, but is told\n{}\n{text}",
        said()
    );
    checked
}

/// The program as it was checked and its bytecode; none if it goes beyond what robots can do.
pub fn compiled(text: &str) -> Option<(Checked, Bytecode)> {
    let checked = checks(text);
    match compile(&checked) {
        Ok(bytecode) => Some((checked, bytecode)),
        Err(problems) => {
            let is_limit = |problem: &Diagnostic| problem.code.number().starts_with("E03");
            let said = render("generated.starl", text, &problems, Colour::Off);
            assert!(
                !problems.is_empty() && problems.iter().all(is_limit),
                "{said}"
            );
            None
        }
    }
}

/// Bytecode is the same when it was written as text and read.
pub fn can_be_written(bytecode: &Bytecode) {
    let written = disassemble(bytecode);
    assert_eq!(assemble(&written).as_ref(), Ok(bytecode), "{written}");
}

/// Its behaviour on the machine is that of the reference interpreter, without internal errors.
pub fn means(checked: &Checked, bytecode: &Bytecode) -> Compared {
    let loaded = run::load(bytecode);
    let compared = compare(&checked.program, bytecode, &loaded);
    run::never_goes_wrong(&loaded);
    compared
}

/// Parentheses that say what holds anyway change nothing.
pub fn needs_no_parentheses(bytes: &[u8], bytecode: &Bytecode) {
    let text = program_with_parentheses(bytes);
    let (_, other) = compiled(&text).expect("it was compiled without parentheses");
    same(bytecode, &other, &text);
}

/// Layout changes nothing.
pub fn has_any_layout(bytes: &[u8], text: &str, bytecode: &Bytecode) {
    let other = layout::other(text, bytes);
    let (_, made) = compiled(&other).expect("it was compiled in another layout");
    same(bytecode, &made, &other);
}

/// Whether the code is the same, wherever in the text it comes from.
fn same(left: &Bytecode, right: &Bytecode, text: &str) {
    let without_places = |bytecode: &Bytecode| {
        let mut bytecode = bytecode.clone();
        bytecode.spans.clear();
        bytecode.files.clear();
        bytecode
    };
    let (left, right) = (without_places(left), without_places(right));
    assert!(
        left == right,
        "{text}\nis compiled to\n{}\nrather than to\n{}",
        disassemble(&right),
        disassemble(&left)
    );
}
