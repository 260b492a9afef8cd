//! While arguments are typed, the editor shows what the call takes and which argument it is.

use crate::support::{analysis, cursor};

/// The signature with the argument that is being typed between `«»`.
fn help(text: &str) -> Option<String> {
    let (text, at) = cursor(text);
    let found = analysis(&text).call_help(at)?;
    let Some(active) = found.active else {
        return Some(found.signature);
    };
    let span = found.parameters[active];
    let (start, end) = (span.start as usize, span.end as usize);
    let signature = &found.signature;
    Some(format!(
        "{}«{}»{}",
        &signature[..start],
        &signature[start..end],
        &signature[end..]
    ))
}

/// A program with this in an effect.
fn effect(statement: &str) -> String {
    format!(
        "program P\nrecord Pair {{left: Int, right: Map[Int, Int]}}\nmessage Ping(index: Int)\nmotion = ReachAvoid()\npairs: List[Pair]\nfunction twice(x: Int, y: Int) -> Int = x + y\ngo()\n    eff\n        {statement}\n"
    )
}

fn shows(statement: &str, expected: &str) {
    assert_eq!(
        help(&effect(statement)).as_deref(),
        Some(expected),
        "{statement}"
    );
}

#[test]
fn of_the_called_function() {
    shows(
        "let z = twice($0",
        "function twice(«x: Int», y: Int) -> Int",
    );
    shows(
        "let z = twice(1, $0)",
        "function twice(x: Int, «y: Int») -> Int",
    );
    shows(
        "let z = twice(1, 2$0, 3)",
        "function twice(x: Int, «y: Int») -> Int",
    );
    shows(
        "motion.reach_avoid($0)",
        "ReachAvoid.reach_avoid(«target: Point», unsafe: Obstacles)",
    );
    shows("pairs.add($0)", "List[T].add(«element: T»)");
    shows(
        "pairs.add(Pair(1, $0))",
        "record Pair {left: Int, «right: Map[Int, Int]»}",
    );
    shows("let p = Ping($0)", "message Ping(«index: Int»)");
    shows("motion.stop($0)", "ReachAvoid.stop()");
}

#[test]
fn a_named_argument_is_the_one_that_is_named() {
    shows(
        "let z = twice(y = 1$0)",
        "function twice(x: Int, «y: Int») -> Int",
    );
    shows(
        "let z = twice(y = 1, x = $0)",
        "function twice(«x: Int», y: Int) -> Int",
    );
}

#[test]
fn any_number_of_values_are_the_last() {
    shows("log(\"{} {}\", 1, 2$0)", "log(format: String, «...»)");
}

#[test]
fn the_innermost_call_counts() {
    shows("let z = twice(abs(1$0), 2)", "abs(«x: N») -> N");
    shows(
        "let z = twice(abs(1)$0, 2)",
        "function twice(«x: Int», y: Int) -> Int",
    );
}

#[test]
fn nothing_outside_of_brackets() {
    assert_eq!(help(&effect("let z = twice(1, 2)$0")), None);
    assert_eq!(help(&effect("let z = twice$0(1, 2)")), None);
    assert_eq!(help(&effect("let z = unknown($0)")), None);
    assert_eq!(help(&effect("let z = (1$0)")), None);
}
