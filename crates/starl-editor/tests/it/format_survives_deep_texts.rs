//! No text nests so deeply, or is so long, that formatting it overflows the stack or takes for ever.

use crate::common::deep::deep;
use starl_editor::format::format;

#[test]
fn deep_nesting() {
    for text in deep(3000) {
        let _ = format(&text);
    }
}

#[test]
fn many_problems_on_a_line() {
    for piece in [
        "(", ")", "[", "{", "x ", "1 ", "+ ", ", ", "$", "\n", ";", " \n", "//\n", "if ", "a,\n",
        "\u{e9}", "x:",
    ] {
        let body = piece.repeat(20_000);
        let _ = format(&format!("program P\n\nrun()\n    eff\n        {body}"));
    }
}
