//! Every text that the checker accepts is compiled, or refused with a reason. A compiled program
//! can be loaded, is unchanged after it was written as text and read again, and never fails
//! internally as it runs. Seeds: `fuzz/seeds/language`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::machine::{Parameter, assemble, disassemble};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../crates/starl-lang/tests/it/support/mod.rs"]
mod support;

fuzz_target!(|text: &str| {
    let checked = check(text, &NoLibraries);
    if checked.has_errors() || checked.program.is_library {
        return;
    }
    let bytecode = match compile(&checked) {
        Ok(bytecode) => bytecode,
        Err(problems) => {
            assert!(!problems.is_empty());
            let limits = |number: &str| number.starts_with("E03");
            assert!(
                problems.iter().all(|problem| limits(problem.code.number())),
                "{problems:?}"
            );
            return;
        }
    };
    assert_eq!(assemble(&disassemble(&bytecode)).as_ref(), Ok(&bytecode));
    let program = support::run::load(&bytecode);
    let is_required = |parameter| parameter == Parameter::Required;
    if !bytecode
        .variables
        .iter()
        .any(|variable| is_required(variable.parameter))
    {
        support::run::never_goes_wrong(&program);
    }
});
