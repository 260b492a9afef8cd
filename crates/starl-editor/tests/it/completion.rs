//! The completions are the names that are allowed at the cursor.

use crate::support::{Beside, complete, complete_with, labels};
use starl_editor::Call;
use starl_lang::check::{Libraries, StandardLibraries};

/// A program with the line or lines in an effect.
fn effect(lines: &str) -> String {
    format!(
        "program P
enum Location {{init, pick}}
record Pair {{left: Int, right: Point?}}
message Ping(index: Int)
param size: Float = 1.0
motion = ReachAvoid()
radio = Broadcast()
loc: Location = init
pairs: List[Pair]
names: Map[String, Int]
allread pos[RobotId]: Point
go()
    pre loc == init
    eff
        let near = 3
{lines}
"
    )
}

fn has(labels: &[String], wanted: &[&str]) {
    for label in wanted {
        assert!(
            labels.iter().any(|own| own == label),
            "no {label} in {labels:?}"
        );
    }
}

fn lacks(labels: &[String], unwanted: &[&str]) {
    for label in unwanted {
        assert!(
            labels.iter().all(|own| own != label),
            "{label} in {labels:?}"
        );
    }
}

#[test]
fn after_the_dot_of_a_primitive_its_members() {
    let mut found = labels(&effect("        motion.$0"));
    found.sort();
    assert_eq!(
        found,
        [
            "active",
            "along",
            "done",
            "drive_lane",
            "failed",
            "follow",
            "free",
            "reach_avoid",
            "reason",
            "stood",
            "stop",
            "target"
        ]
    );
}

#[test]
fn after_the_dot_of_a_value_its_fields_and_methods() {
    let found = labels(&effect("        let x = pairs[0].le$0"));
    assert_eq!(found, ["left", "right"]);
    let found = labels(&effect("        pairs.$0"));
    has(&found, &["add", "size", "first"]);
    lacks(&found, &["get", "left", "loc"]);
    let found = labels(&effect("        let x = position.$0\n        loc = pick"));
    assert_eq!(found, ["x", "y", "z"]);
    let found = labels(&effect("        let x = names.$0 + 1"));
    has(&found, &["get", "keys"]);
}

#[test]
fn after_the_dot_of_an_enum_its_variants() {
    assert_eq!(
        labels(&effect("        loc = Location.$0")),
        ["init", "pick"]
    );
}

#[test]
fn after_the_dot_of_a_library_its_declarations() {
    let found = labels("program P\nimport geometry\nconst c = geometry.$0\n");
    has(&found, &["midpoint"]);
    lacks(&found, &["distance", "c"]);
}

#[test]
fn where_an_enum_is_expected_its_variants_come_first() {
    let found = labels(&effect("        loc = $0"));
    assert_eq!(found[..2], ["init", "pick"]);
    let found = labels(&effect("        if loc == $0\n            finish()"));
    assert_eq!(found[..2], ["init", "pick"]);
}

#[test]
fn a_statement_may_be_a_word_or_begin_with_a_name() {
    let found = labels(&effect("        $0"));
    has(
        &found,
        &[
            "let", "if", "for", "atomic", "near", "loc", "motion", "pos", "emit", "random", "Ping",
        ],
    );
    assert_eq!(found[0], "near", "locals come first");
    lacks(&found, &["program", "pre", "Location2"]);
}

#[test]
fn in_a_guard_nothing_that_does_something() {
    let text = effect("").replace("loc == init", "l$0");
    let found = labels(&text);
    has(&found, &["loc", "position", "abs", "not", "size"]);
    lacks(&found, &["emit", "random", "near", "let"]);
}

#[test]
fn in_a_function_its_parameters_and_nothing_of_the_state() {
    let found = labels(
        "program P\nloc: Int = 0\nconst limit = 3\nfunction f(count: Int) -> Int\n    return c$0\n",
    );
    has(&found, &["count", "limit", "f", "abs"]);
    lacks(&found, &["loc", "position", "me"]);
}

#[test]
fn where_a_type_stands_types() {
    let found = labels("program P\nimport geometry\nenum E {a}\nrecord R {x: Int}\nx: $0\n");
    has(
        &found,
        &["Int", "List", "Point", "E", "R", "Side", "geometry"],
    );
    lacks(&found, &["a", "abs", "x"]);
    let inner = labels("program P\nenum E {a}\nx: List[E$0]\n");
    has(&inner, &["E", "Int"]);
}

#[test]
fn where_a_declaration_begins_the_words_that_begin_one() {
    let found = labels("program P\n\n$0\n");
    has(
        &found,
        &["param", "message", "on", "invariant", "import", "enum"],
    );
    lacks(&found, &["let", "abs"]);
    let found = labels("program P\nx: Int = 0\nmes$0\n");
    has(&found, &["message"]);
}

#[test]
fn in_an_action_its_clauses() {
    let found = labels("program P\nloc: Int = 0\ngo()\n    $0\n    eff loc = 1\n");
    has(&found, &["pre", "eff"]);
    let found = labels("program P\nloc: Int = 0\ngo()\n    pre loc == 0\n    $0\n");
    has(&found, &["eff"]);
}

#[test]
fn after_on_messages_and_primitives_with_events() {
    let found = labels(&effect("\non $0(from, index)\n    loc = pick"));
    has(&found, &["Ping", "radio", "input"]);
    lacks(&found, &["motion", "Pair"]);
    assert_eq!(
        labels(&effect("\non radio.$0(number)\n    loc = pick")),
        ["failed", "gap"]
    );
}

#[test]
fn after_import_the_libraries() {
    let beside = [("tools", "library tools\n")];
    let found = complete_with("program P\nimport $0\n", &Beside(&beside));
    let found: Vec<_> = found.into_iter().map(|item| item.label).collect();
    let mut expected = StandardLibraries.names();
    expected.push("tools".to_string());
    expected.sort();
    assert_eq!(found, expected);
    assert!(expected.len() > 1, "there are standard libraries");
}

#[test]
fn bindings_complete_primitives() {
    let found = labels("program P\nmotion = R$0\n");
    has(&found, &["ReachAvoid", "Registration", "Broadcast"]);
    lacks(&found, &["abs"]);
    let found = labels("program P\nmotion = R$0()\n");
    has(&found, &["ReachAvoid"]);
}

#[test]
fn in_a_property_attributes_of_robots() {
    let found = labels("program P\nloc: Int = 0\ninvariant a: forall r: r.$0\n");
    has(&found, &["loc", "position", "finished", "up"]);
    let found = labels("program P\nloc: Int = 0\ninvariant a: $0\n");
    has(&found, &["loc", "forall", "exists", "finished"]);
}

#[test]
fn calls_are_marked() {
    let items = complete(&effect("        $0"));
    let call = |label: &str| {
        let found = items.iter().find(|item| item.label == label);
        found.map(|item| item.call)
    };
    assert_eq!(call("finish"), Some(Call::Empty));
    assert_eq!(call("emit"), Some(Call::Arguments));
    assert_eq!(call("Pair"), Some(Call::Arguments));
    assert_eq!(call("loc"), Some(Call::No));
}

#[test]
fn nothing_in_comments_texts_and_numbers() {
    assert!(labels(&effect("        // mo$0")).is_empty());
    assert!(labels(&effect("        emit(\"mo$0\")")).is_empty());
    assert!(labels(&effect("        let x = 12$0")).is_empty());
}

#[test]
fn nothing_where_a_new_name_is_made() {
    assert!(labels(&effect("        let ne$0 = 3")).is_empty());
    assert!(labels("program P\nparam na$0: Int\n").is_empty());
}

#[test]
fn in_a_text_with_errors_too() {
    let found = labels(&effect(
        "        let = = 3\n        motion.$0\n        loc = ",
    ));
    has(&found, &["active", "reach_avoid"]);
    let found = labels("program P\nmotion = ReachAvoid()\ngo()\n    eff motion.reach_avoid($0");
    has(&found, &["position", "motion"]);
    let found = labels("program P\nmotion = ReachAvoid()\ngo(\n    eff if motion.$0");
    has(&found, &["active"]);
}

#[test]
fn an_argument_may_be_given_by_its_name() {
    let items = complete(&effect("").replace("ReachAvoid()", "ReachAvoid(vicinity = size, $0)"));
    let given = items.iter().filter(|item| item.call == Call::Given);
    let given: Vec<String> = given.map(|item| item.label.clone()).collect();
    has(&given, &["off_path", "stuck_after"]);
    lacks(&given, &["vicinity"]);
    let items = complete(&effect("        pairs.add(Pair(1, $0))"));
    let given = items.iter().filter(|item| item.call == Call::Given);
    let given: Vec<&str> = given.map(|item| item.label.as_str()).collect();
    assert_eq!(given, ["right"]);
}

#[test]
fn values_of_the_expected_type_come_first() {
    let found = labels("program P\na: Point\nb: Int\nc: Int\ngo()\n    eff let d = 3; b = $0\n");
    assert_eq!(found[..4], ["b", "c", "d", "a"]);
}

#[test]
fn after_the_dot_of_a_tuple_its_parts() {
    let lines = "        let (a, pair) = (1, (2.5, near))\n        log(\"{}\", a)\n        pair.$0";
    assert_eq!(labels(&effect(lines)), ["0", "1"]);
    let lines = "        let (first, second) = (1, (2.5, near))\n        log(\"{}\", $0)";
    has(&labels(&effect(lines)), &["first", "second"]);
}
