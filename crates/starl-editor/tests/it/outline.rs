//! The outline has every declaration with its parts, in the order of the text.

use starl_editor::{OutlineEntry, outline};
use starl_lang::syntax::parse;

/// An entry a line: what it is, its name and its detail, parts indented.
fn shown(text: &str) -> String {
    let mut lines = String::new();
    for entry in outline(&parse(text)) {
        show(&entry, 0, text, &mut lines);
    }
    lines
}

fn show(entry: &OutlineEntry, depth: usize, text: &str, lines: &mut String) {
    let detail = if entry.detail.is_empty() { "" } else { " " };
    *lines += &format!(
        "{}{:?} {}{detail}{}\n",
        "  ".repeat(depth),
        entry.kind,
        entry.name,
        entry.detail
    );
    let (whole, name) = (entry.span, entry.name_span);
    assert!(
        whole.start <= name.start && name.end <= whole.end,
        "{entry:?}"
    );
    assert!(entry.name.ends_with(name.of(text)), "{entry:?}");
    for part in &entry.parts {
        assert!(
            whole.start <= part.span.start && part.span.end <= whole.end,
            "{part:?}"
        );
        show(part, depth + 1, text, lines);
    }
}

#[test]
fn of_every_declaration() {
    let text = "program P
import geometry
enum E {a, b}
record R {
    /// one
    x: Int,
    y: List[Point]
}
message M(n: Int)
param size: Float = 1.0
const limit = 3
motion = ReachAvoid()
e: E = a
allread pos[RobotId]: Point
function f(n: Int) -> Int = n
init
    e = b
go()
    pre e == a
    eff e = b
on M(from, n)
    e = a
on radio.failed(n)
    e = a
on input go_home(to: Point)
    e = a
role leader
    term: Int = 0
    init
        term = 1
    lead()
        eff term += 1
invariant fine: e == a
always: e == a
";
    assert_eq!(
        shown(text),
        "Enum E
  Variant a
  Variant b
Record R
  Field x Int
  Field y List[Point]
Message M
  Field n Int
Parameter size Float
Constant limit
Primitive motion ReachAvoid
Variable e E
Variable pos Point
Function f Int
Action init
Action go
Handler on M
Handler on radio.failed
Handler on input go_home
Role leader
  Variable term Int
  Action init
  Action lead
Property fine invariant
Property always
"
    );
}

#[test]
fn of_a_text_with_errors_its_valid_parts() {
    let text = "program P\nx: Int = = 3\ngo(\n    eff x = 1\n\nback()\n    eff x = 2\nrecord\nenum E {a,\n";
    let found = shown(text);
    assert!(found.contains("Variable x Int\n"), "{found}");
    assert!(found.contains("Action back\n"), "{found}");
}

#[test]
fn a_declaration_reaches_to_its_last_word() {
    let text = "program P\n\n/// Goes.\ngo()\n    eff\n        finish()\n\n// end\nx: Int\n";
    let entries = outline(&parse(text));
    assert_eq!(entries[0].span.of(text), "go()\n    eff\n        finish()");
}
