//! The thesis's listings compile and load.

use crate::common::LISTINGS;
use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::Code;
use starl_lang::machine::{Bytecode, Import, Program, assemble, disassemble};

fn listing(name: &str) -> Result<Bytecode, Vec<Code>> {
    let (_, source) = LISTINGS.iter().find(|(known, _)| *known == name).unwrap();
    let compiled = compile(&check(source, &NoLibraries));
    compiled.map_err(|problems| problems.iter().map(|problem| problem.code).collect())
}

#[test]
fn they_compile_and_load() {
    for (name, actions) in [("race", 3), ("formation", 3), ("intersection", 5)] {
        let bytecode = listing(name).expect(name);
        assert_eq!(bytecode.actions.len(), actions);
        Program::load(bytecode, &|_: &Import| Some(0)).expect(name);
    }
}

#[test]
fn their_text_form_reads_back_the_same() {
    for name in ["race", "formation", "mutex_usage", "intersection"] {
        let bytecode = listing(name).expect(name);
        let again = assemble(&disassemble(&bytecode)).expect(name);
        assert_eq!(again, bytecode);
    }
}
