//! The thesis's listings compile and load as far as robots have what they need; of the others it is
//! said what is missing.

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
fn race_and_formation_compile_and_load() {
    for name in ["race", "formation"] {
        let bytecode = listing(name).expect(name);
        assert_eq!(bytecode.actions.len(), 3);
        Program::load(bytecode, &|_: &Import| Some(0)).expect(name);
    }
}

#[test]
fn their_text_form_reads_back_the_same() {
    for name in ["race", "formation", "mutex_usage"] {
        let bytecode = listing(name).expect(name);
        let again = assemble(&disassemble(&bytecode)).expect(name);
        assert_eq!(again, bytecode);
    }
}

#[test]
fn what_robots_do_not_have_yet_is_said() {
    let problems = listing("intersection").expect_err("it uses Registration");
    assert_eq!(problems, [Code::UnavailablePrimitive]);
}
