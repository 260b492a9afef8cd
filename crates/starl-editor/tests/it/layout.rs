//! Laying a text out for an editor changes white space where it differs, and nothing else.

use crate::common;
use crate::support::edited;
use starl_editor::format::format;
use starl_editor::layout;

#[test]
fn the_edits_give_the_formatted_text() {
    let untidy = "program   P\nx:Int=3   // three\n\n\n\n\ngo( )\n  pre x==3\n  eff   x=4;x=5\n";
    assert_eq!(edited(untidy, &layout(untidy)), format(untidy));
    for (name, text) in common::written() {
        let squeezed = text.replace(" = ", "=").replace(", ", ",");
        assert_eq!(
            edited(&squeezed, &layout(&squeezed)),
            format(&squeezed),
            "{name}"
        );
    }
}

#[test]
fn each_edit_is_of_white_space() {
    let untidy = "program P\nx:   Int =3\ngo()\n  pre x==3\n  eff x=4\n";
    let edits = layout(untidy);
    assert!(edits.len() >= 4, "{edits:?}");
    for edit in edits {
        assert!(edit.span.of(untidy).trim().is_empty(), "{edit:?}");
        assert!(edit.text.trim().is_empty(), "{edit:?}");
    }
}

#[test]
fn formatted_text_does_not_change() {
    for (name, text) in common::LISTINGS {
        let tidy = format(text);
        assert_eq!(layout(&tidy), [], "{name}");
    }
}

#[test]
fn unusual_white_space_is_kept_apart_from_words() {
    for text in [
        "program P\u{a0}\n",
        "program P\r\nx: Int\r\n",
        "\u{feff}program P\n",
        "// a \u{3000}\n",
    ] {
        assert_eq!(edited(text, &layout(text)), format(text), "{text:?}");
    }
}
