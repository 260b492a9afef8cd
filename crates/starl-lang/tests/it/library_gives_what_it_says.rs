//! The functions of the standard library, run on robots: each case of `library/*.starl` compares the result of its
//! function with the expected one, and each function has a case.

use crate::robot_support::World;
use starl_core::Value;
use starl_lang::check::{NoLibraries, STANDARD, StandardLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::{Colour, render};
use starl_lang::robot::Code;

const CASES: &[(&str, &str)] = &[
    ("fleet", include_str!("../library/fleet.starl")),
    ("geometry", include_str!("../library/geometry.starl")),
    ("lists", include_str!("../library/lists.starl")),
    ("tasks", include_str!("../library/tasks.starl")),
];

#[test]
fn every_case_is_as_expected() {
    for (name, text) in CASES {
        let checked = check(text, &StandardLibraries);
        let said = render(name, text, checked.diagnostics(), Colour::Off);
        assert_eq!(said, "", "{name}");
        let bytecode = compile(&checked).unwrap_or_else(|problems| panic!("{problems:?}"));
        let code = Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"));
        let world = World::of(&code, 5);
        assert_eq!(world.failure(0), None, "{name}");
        let emitted = world.emitted(0);
        assert_eq!(emitted.len(), text.matches("emit(").count(), "{name}");
        for (case, fields) in emitted {
            let expected = [("is".to_string(), Value::Bool(true))];
            assert_eq!(fields, expected, "{name}: {case}");
        }
    }
}

#[test]
fn every_function_has_a_case() {
    for (name, text) in STANDARD {
        let cases = CASES.iter().find(|(own, _)| own == name);
        let (_, cases) = cases.unwrap_or_else(|| panic!("{name} has no cases"));
        let program = check(text, &NoLibraries).program;
        let own = program.functions.iter().filter(|it| it.site.file == 0);
        for function in own {
            let call = format!("{name}.{}(", function.name);
            assert!(cases.contains(&call), "{call}");
        }
    }
}
