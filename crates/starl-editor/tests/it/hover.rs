//! Hovering over a name shows its declaration and its documentation.

use crate::support::{Beside, cursor, hover};
use starl_editor::Analysis;

const PROGRAM: &str = "/// A race.
program Race
import geometry

/// Where it is.
enum Location {init, pick}
/// Two of them.
record Pair {
    /// The first.
    left: Int,
    right: Point?
}
/// Who came where.
message Reached(index: Int)
/// How near.
param vicinity: Float = 75mm
const limit = 3 * (2 + 1)
/// Goes.
motion = ReachAvoid(vicinity = vicinity)
radio = Broadcast()
loc: Location = init
allread pos[RobotId]: Point
allwrite sum: Int = 0

/// Twice.
function twice(
    /// What.
    x: Int, y: Int) -> Int = 2 * x + y

/// Picks.
pick_one()
    pre loc == init and not motion.done and sum < limit
    eff
        let near = twice(x = 1, 2)
        pos[me] = geometry.midpoint(position, position)
        loc = pick
        if some p = pos[me] and p.x > 1.0
            radio.broadcast(Reached(near))
        let pairs: List[Pair] = []
        let lefts = [pair.left for pair in pairs]
        log(\"{}\", lefts.size())
on Reached(from, index)
    sum = index
on radio.failed(number)
    sum = number
/// Comes home.
on input go_home(
    /// The door.
    to: Point, fast: Bool)
    if fast then log(\"{}\", to)
/// Never less.
invariant rising: sum_of >= 0 and forall r: r.up
stable sum_of: Int = 2
";

/// The text shown for the first `word` after `context`.
fn shown(context: &str, word: &str) -> (String, String) {
    let start = PROGRAM.find(context).expect("the context is there");
    let at = start + PROGRAM[start..].find(word).expect("the word is there") + word.len();
    let text = [&PROGRAM[..at], "$0", &PROGRAM[at..]].concat();
    let found = hover(&text);
    (found.signature, found.documentation)
}

fn shows(context: &str, word: &str, signature: &str, documentation: &str) {
    let expected = (signature.to_string(), documentation.to_string());
    assert_eq!(shown(context, word), expected, "{word} in {context}");
}

#[test]
fn of_the_programs_declarations() {
    shows("program", "Race", "program Race", "A race.");
    shows(
        "loc: Loc",
        "Location",
        "enum Location {init, pick}",
        "Where it is.",
    );
    shows(
        "pre loc",
        "init",
        "Location.init",
        "`enum Location {init, pick}`",
    );
    shows(
        "List[",
        "Pair",
        "record Pair {left: Int, right: Point?}",
        "Two of them.",
    );
    shows("pair.left", "left", "Pair.left: Int", "The first.");
    shows(
        "broadcast(",
        "Reached",
        "message Reached(index: Int)",
        "Who came where.",
    );
    shows(
        "= vicinity",
        "vicinity",
        "param vicinity: Float = 75mm",
        "How near.",
    );
    shows("< limit", "limit", "const limit: Int = 3 * (2 + 1)", "");
    shows("pre loc", "loc", "loc: Location = init", "");
    shows("rising:", "sum_of", "stable sum_of: Int = 2", "");
    shows(
        "stable sum_of",
        "stable",
        "stable name: Type = value",
        "A variable that survives a crash if the robot has storage.",
    );
    shows("pos[me] =", "pos", "allread pos[RobotId]: Point", "");
    shows("sum = index", "sum", "allwrite sum: Int = 0", "");
    shows(
        "= twice",
        "twice",
        "function twice(x: Int, y: Int) -> Int",
        "Twice.",
    );
    shows("pick_one", "pick_one", "pick_one()", "Picks.");
    shows("rising", "rising", "rising", "Never less.");
}

#[test]
fn of_a_bound_primitive_its_kind() {
    let (signature, documentation) = shown("not motion", "motion");
    assert_eq!(signature, "motion = ReachAvoid(vicinity = vicinity)");
    assert!(
        documentation.starts_with("Goes.\n\nDrives to targets"),
        "{documentation}"
    );
}

#[test]
fn of_inputs_their_fields() {
    let declared = "on input go_home(to: Point, fast: Bool)";
    shows("input go_home", "go_home", declared, "Comes home.");
    shows("Point, fast", "fast", "fast: Bool", "");
    shows("\"{}\", to)\n///", "to", "to: Point", "The door.");
    let (form, meaning) = shown("on input go_home", "input");
    assert_eq!(form, "on input name(field: Type)");
    assert!(meaning.contains("operator"), "{meaning}");
}

#[test]
fn of_locals_their_types() {
    shows("Reached(near", "near", "let near: Int", "");
    shows("2 * x", "x", "x: Int", "What.");
    shows("(x = 1", "x", "x: Int", "What.");
    shows("and p.x", "p", "p: Point", "");
    shows("[pair", "pair", "pair: Pair", "");
    shows("sum = index", "index", "index: Int", "");
    shows("(from", "from", "from: RobotId", "");
    shows("sum = number", "number", "number: Int", "");
    shows("forall r: r.up", "l r", "r: RobotId", "");
}

#[test]
fn of_built_in_names_the_tables_text() {
    let told = |context, word| {
        let (signature, documentation) = shown(context, word);
        assert!(!documentation.is_empty(), "nothing is said of {word}");
        signature
    };
    assert_eq!(told("motion.done", "done"), "ReachAvoid.done: Bool");
    assert_eq!(
        told("= ReachAvoid", "ReachAvoid").split('(').next(),
        Some("ReachAvoid")
    );
    assert_eq!(
        told("radio.broadcast", "broadcast"),
        "Broadcast.broadcast(message: Message) -> Int"
    );
    assert_eq!(
        told("on radio.failed", "failed"),
        "on Broadcast.failed(number: Int, unreached: List[RobotId])"
    );
    assert_eq!(told("pos[me]", "me"), "me: RobotId");
    assert_eq!(told("lefts.size", "size"), "List[T].size() -> Int");
    assert_eq!(told("log(", "log"), "log(format: String, ...)");
    assert_eq!(told("mm\nconst", "const"), "const name = value");
    assert_eq!(told("sum_of: Int", "Int"), "Int");
    assert_eq!(told("p.x", ".x"), "Point.x: Float");
    assert_eq!(told("r.up", "up"), "up: Bool");
    assert_eq!(told("pre loc", "pre"), "pre condition for 2s");
    assert_eq!(told("forall", "forall"), "forall x in xs: condition");
}

#[test]
fn of_declarations_in_a_library() {
    let (signature, documentation) = shown("geometry.midpoint", "midpoint");
    assert_eq!(signature, "function midpoint(a: Point, b: Point) -> Point");
    assert!(documentation.contains("half-way"), "{documentation}");
    assert!(
        shown("geometry.midpoint", "geometry")
            .0
            .starts_with("library geometry")
    );
}

#[test]
fn of_a_library_beside_the_program() {
    let tools = "/// Tools.\nlibrary tools\n/// One.\nconst one = 1\n";
    let (text, at) = cursor("program P\nimport tools\nx: Int = tools.o$0ne\n");
    let beside = [("tools", tools)];
    let analysis = Analysis::new(&text, &Beside(&beside));
    let (_, shown) = analysis.hover(at).expect("something is shown");
    assert_eq!(
        (&*shown.signature, &*shown.documentation),
        ("const one: Int = 1", "One.")
    );
}

#[test]
fn of_a_part_of_a_tuple() {
    let text = "program P\nbid: (Float, RobotId)? = none\ngo()\n    pre some (a, b) = bid\n    eff let pair = (a, b); log(\"{}\", pair.1$0)\n";
    assert_eq!(hover(text).signature, "(Float, RobotId).1: RobotId");
}

#[test]
fn nothing_without_a_meaning() {
    let analysis = Analysis::new("program P\nx: Int = unknown\n", &Beside(&[]));
    assert!(analysis.hover(21).is_none());
    assert!(analysis.hover(1_000).is_none());
}
