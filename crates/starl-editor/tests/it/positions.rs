//! Places are counted as the Language Server Protocol counts them: lines, and units of UTF-16 in them.

use starl_editor::{Utf16Lines, Utf16Position, replaced};

fn at(line: u32, column: u32) -> Utf16Position {
    Utf16Position { line, column }
}

/// `ä` has two bytes and one unit, `€` three and one, `😀` four and two.
const TEXT: &str = "aä€😀b\r\nx\ry\n\nend";

#[test]
fn each_place_has_its_line_and_column() {
    let lines = Utf16Lines::new(TEXT);
    let expected = [
        ('a', at(0, 0)),
        ('ä', at(0, 1)),
        ('€', at(0, 2)),
        ('😀', at(0, 3)),
        ('b', at(0, 5)),
        ('x', at(1, 0)),
        ('y', at(2, 0)),
        ('e', at(4, 0)),
        ('d', at(4, 2)),
    ];
    for (letter, place) in expected {
        let offset = TEXT.find(letter).expect("the letter is there") as u32;
        assert_eq!(lines.position(TEXT, offset), place, "{letter}");
        assert_eq!(lines.offset(TEXT, place), offset, "{letter}");
    }
    assert_eq!(lines.position(TEXT, TEXT.len() as u32), at(4, 3));
}

#[test]
fn a_place_within_a_character_is_its_start() {
    let lines = Utf16Lines::new(TEXT);
    assert_eq!(lines.offset(TEXT, at(0, 4)), 6, "half of the emoji");
    for inside in 7..10 {
        assert_eq!(lines.position(TEXT, inside), at(0, 3));
    }
}

#[test]
fn a_place_beyond_the_end_is_the_end() {
    let lines = Utf16Lines::new(TEXT);
    assert_eq!(
        lines.offset(TEXT, at(0, 1_000)),
        11,
        "before the line's ending"
    );
    assert_eq!(lines.offset(TEXT, at(9, 0)), TEXT.len() as u32);
    assert_eq!(lines.position(TEXT, 1_000), at(4, 3));
    assert_eq!(
        lines.position(TEXT, 12),
        at(0, 6),
        "within the line's ending"
    );
    let nothing = Utf16Lines::new("");
    assert_eq!(nothing.position("", 0), at(0, 0));
    assert_eq!(nothing.offset("", at(3, 3)), 0);
}

#[test]
fn a_change_replaces_its_range() {
    assert_eq!(replaced("aä€😀b", at(0, 3), at(0, 5), "-"), "aä€-b");
    assert_eq!(replaced("one\ntwo", at(0, 3), at(1, 0), " "), "one two");
    assert_eq!(replaced("one", at(0, 3), at(0, 3), "\n"), "one\n");
    assert_eq!(replaced("one", at(5, 5), at(9, 9), "!"), "one!");
    assert_eq!(replaced("one", at(0, 2), at(0, 1), "-"), "on-e");
}
