//! Comparisons of every type, as values and as conditions.

use super::support::{effect, values};

const DECLARATIONS: &str = "
enum Colour {red, green, blue}
record Pair {a: Int, b: Float}
record Named {name: String, at: Point?, pairs: List[Pair]}
i: Int = 3
x: Float = 1.5
nan: Float = 0.0 / 0.0
s: String = \"abc\"
t: Bool = true
c: Colour = green
o: Int? = 3
n: Int?
pair: Pair = Pair(1, 2.0)
named: Named = Named(\"a\", Point(1.0, 0.0), [Pair(1, 2.0)])
list: List[Int] = [1, 2]
set: Set[String] = {\"b\", \"a\"}
map: Map[Int, String] = {1: \"x\"}
far: Int = 1_000_000";

/// Each comparison and its value.
const ROWS: &[(&str, bool)] = &[
    ("i == 3", true),
    ("3 == i", true),
    ("i != 3", false),
    ("i == 4", false),
    ("i < 3", false),
    ("i < 4", true),
    ("i <= 3", true),
    ("i <= 2", false),
    ("i > 3", false),
    ("i > 2", true),
    ("i >= 3", true),
    ("i >= 4", false),
    ("3 < i", false),
    ("2 < i", true),
    ("3 <= i", true),
    ("4 <= i", false),
    ("3 > i", false),
    ("4 > i", true),
    ("3 >= i", true),
    ("2 >= i", false),
    ("i < far", true),
    ("far <= i", false),
    ("i > far", false),
    ("far >= i", true),
    ("far == 1000000", true),
    ("far != 1000001", true),
    ("far > 999999", true),
    ("i < 32767", true),
    ("i <= 32767", true),
    ("i > 32767", false),
    ("i > -32768", true),
    ("i < -32768", false),
    ("i <= -32769", false),
    ("x == 1.5", true),
    ("x != 1.5", false),
    ("x < 1.5", false),
    ("x <= 1.5", true),
    ("x > 1.5", false),
    ("x >= 1.5", true),
    ("x < 2.0", true),
    ("1.0 < x", true),
    ("nan == nan", false),
    ("nan != nan", true),
    ("nan < 1.0", false),
    ("nan <= 1.0", false),
    ("nan > 1.0", false),
    ("nan >= 1.0", false),
    ("not (nan < 1.0)", true),
    ("not (nan >= 1.0)", true),
    ("-0.0 == 0.0", true),
    ("s == \"abc\"", true),
    ("s != \"abx\"", true),
    ("s < \"abx\"", true),
    ("s < \"abc\"", false),
    ("s <= \"abc\"", true),
    ("s > \"ab\"", true),
    ("s >= \"abx\"", false),
    ("t == true", true),
    ("t != (i == 3)", false),
    ("c == green", true),
    ("c != green", false),
    ("red == c", false),
    ("Colour.blue != c", true),
    ("o == 3", true),
    ("o == 4", false),
    ("o != 4", true),
    ("n == 3", false),
    ("n == none", true),
    ("n != none", false),
    ("o == none", false),
    ("none != o", true),
    ("n == o", false),
    ("pair == Pair(1, 2.0)", true),
    ("pair == Pair(2, 2.0)", false),
    ("pair != Pair(1, 2.5)", true),
    ("named == named", true),
    ("named == Named(\"a\", none, [Pair(1, 2.0)])", false),
    ("named == Named(\"a\", Point(1.0, 0.0), [])", false),
    (
        "named != Named(\"b\", Point(1.0, 0.0), [Pair(1, 2.0)])",
        true,
    ),
    ("list == [1, 2]", true),
    ("list != [2, 1]", true),
    ("list == []", false),
    ("set == {\"a\", \"b\"}", true),
    ("set != {\"a\"}", true),
    ("map == {1: \"x\"}", true),
    ("map == {1: \"y\"}", false),
    ("i in 0..4", true),
    ("i in 0..3", false),
    ("i not in 3..5", false),
    ("far in i..far", false),
    ("i in list", false),
    ("2 in list", true),
    ("2 not in list", false),
    ("\"a\" in set", true),
    ("\"c\" in set", false),
    ("1 in map", true),
    ("2 not in map", true),
    ("\"bc\" in s", true),
    ("\"cb\" in s", false),
    ("c in [red, blue]", false),
    ("c in {red, green}", true),
    ("me == me", true),
    ("me < me", false),
    ("now >= now", true),
];

#[test]
fn as_values() {
    let words = |holds: &bool| if *holds { "true" } else { "false" };
    let rows: Vec<_> = ROWS
        .iter()
        .map(|(text, holds)| (*text, words(holds)))
        .collect();
    values(DECLARATIONS, &rows);
}

#[test]
fn as_conditions() {
    held(DECLARATIONS, |text, _| {
        format!("if {text} then yes() else no()")
    });
}

#[test]
fn negated() {
    held(DECLARATIONS, |text, _| {
        format!("if not ({text}) then no() else yes()")
    });
}

#[test]
fn joined_to_others() {
    held(DECLARATIONS, |text, _| {
        format!("if i == 3 and ({text}) then yes() else no()")
    });
    held(DECLARATIONS, |text, _| {
        format!("if i == 4 or ({text}) then yes() else no()")
    });
    held(DECLARATIONS, |text, _| {
        format!("if not (i == 4 or ({text}) and t) then no() else yes()")
    });
}

#[test]
fn of_locals() {
    let names = [
        "i", "x", "nan", "s", "t", "c", "o", "n", "pair", "named", "list", "set", "map", "far",
    ];
    let copies: String = names
        .iter()
        .map(|name| format!("let {name}_ = {name}\n"))
        .collect();
    let lines: Vec<String> = ROWS
        .iter()
        .map(|(text, _)| {
            let mut text = text.to_string();
            for name in names {
                text = renamed(&text, name);
            }
            format!("log(\"{{}}\", {text})")
        })
        .collect();
    let told = effect(DECLARATIONS, &(copies + &lines.join("\n"))).unwrap();
    for ((text, holds), told) in ROWS.iter().zip(&told) {
        assert_eq!(*told, format!("log(\"{holds}\")"), "{text}");
    }
}

/// The text with a variable's name replaced by that of its copy.
fn renamed(text: &str, name: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '"';
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(name) {
        let before = rest[..at].chars().next_back().or(out.chars().next_back());
        let after = rest[at + name.len()..].chars().next();
        out += &rest[..at + name.len()];
        if !before.is_some_and(is_part) && !after.is_some_and(is_part) {
            out.push('_');
        }
        rest = &rest[at + name.len()..];
    }
    out + rest
}

fn held(declarations: &str, line: impl Fn(&str, bool) -> String) {
    let lines: Vec<String> = ROWS
        .iter()
        .map(|(text, holds)| {
            let line = line(text, *holds);
            line.replace("yes()", "log(\"yes\")")
                .replace("no()", "log(\"no\")")
        })
        .collect();
    let told = effect(declarations, &lines.join("\n")).expect("no errors");
    for ((text, holds), told) in ROWS.iter().zip(&told) {
        let expected = if *holds {
            "log(\"yes\")"
        } else {
            "log(\"no\")"
        };
        assert_eq!(told, expected, "{text}");
    }
}
