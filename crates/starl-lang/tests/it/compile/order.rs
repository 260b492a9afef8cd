//! Parts are computed from left to right.

use super::support::effect;

/// Statements in which `#` stands for a draw of the next number.
const STATEMENTS: &[&str] = &[
    "log(\"{}\", # + # * #)",
    "log(\"{}\", # - #)",
    "log(\"{}\", [#, #, #])",
    "log(\"{}\", {#, #})",
    "log(\"{}\", {#: #, #: #})",
    "log(\"{}\", # == #)",
    "log(\"{}\", # > #)",
    "log(\"{}\", # <= #)",
    "log(\"{} {}\", #, #)",
    "emit(\"e\", a = #, b = #)",
    "log(\"{}\", f(#, #))",
    "log(\"{}\", f(f(#, #), f(#, #)))",
    "log(\"{}\", R(b = #, a = #))",
    "log(\"{}\", Point(Float(#), Float(#), Float(#)))",
    "log(\"{}\", max(#, #))",
    "log(\"{}\", clamp(#, #, #))",
    "log(\"{}\", # in #..#)",
    "log(\"{}\", # in [#, #])",
    "log(\"{}\", [#].slice(# * 0, # * 0))",
    "for i in #..#\n    log(\"{}\", i)",
    "if # < 0 or # > 0 then log(\"\")",
];

#[test]
fn from_left_to_right() {
    for statement in STATEMENTS {
        let mut numbers = 0;
        let mut text = String::new();
        for (index, piece) in statement.split('#').enumerate() {
            if index > 0 {
                text += &format!("random_int({numbers}, {})", numbers + 1);
                numbers += 1;
            }
            text += piece;
        }
        let declarations = "record R {b: Int, a: Int}\nfunction f(x: Int, y: Int) -> Int = x + y";
        let told = effect(declarations, &text).expect(statement);
        let draws: Vec<&String> = told
            .iter()
            .filter(|line| line.starts_with("random"))
            .collect();
        let expected: Vec<String> = (0..numbers)
            .map(|k| format!("random_int({k}, {})", k + 1))
            .collect();
        assert_eq!(draws, expected.iter().collect::<Vec<_>>(), "{statement}");
    }
}
