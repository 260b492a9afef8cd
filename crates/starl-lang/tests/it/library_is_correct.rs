//! The standard library has no problems, and documents each of its
//! declarations.

use starl_lang::check::{NoLibraries, STANDARD, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::{Colour, render};

#[test]
fn nothing_is_wrong_with_it() {
    for (name, text) in STANDARD {
        let checked = check(text, &NoLibraries);
        let said = render(name, text, checked.diagnostics(), Colour::Off);
        assert_eq!(said, "", "{name}");
        assert_eq!(checked.program.name, *name);
        assert!(checked.program.is_library);
        let problems = compile(&checked).err();
        assert_eq!(problems, None, "{name}");
    }
}

#[test]
fn its_lines_are_short() {
    for (name, text) in STANDARD {
        for line in text.lines() {
            assert!(line.chars().count() <= 110, "{name}: {line}");
        }
    }
}

#[test]
fn every_declaration_is_documented() {
    for (name, text) in STANDARD {
        let program = check(text, &NoLibraries).program;
        let functions = program.functions.iter();
        let functions = functions.map(|it| (&it.name, &it.documentation, it.site));
        let constants = program.constants.iter();
        let constants = constants.map(|it| (&it.name, &it.documentation, it.site));
        for (declared, documentation, site) in functions.chain(constants) {
            let is_own = site.file == 0;
            assert!(!is_own || documentation.ends_with('.'), "{name}.{declared}");
        }
    }
}
