//! The thesis's four listings are correct programs.

use crate::common;
use starl_lang::check::{NoLibraries, check};
use starl_lang::diagnostic::{Colour, render};

#[test]
fn the_four_listings_check_without_a_complaint() {
    for (name, text) in common::LISTINGS {
        let checked = check(text, &NoLibraries);
        let said = render(name, text, checked.diagnostics(), Colour::Off);
        assert_eq!(said, "", "{name}");
        assert!(checked.correct().is_some(), "{name}");
    }
}

#[test]
fn the_prelude_has_no_errors() {
    let checked = check("program Empty\n", &NoLibraries);
    let prelude = &checked.files[1];
    let said = render(
        "prelude",
        &prelude.source,
        &prelude.diagnostics,
        Colour::Off,
    );
    assert_eq!(said, "");
}
