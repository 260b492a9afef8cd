//! Texts that nest deeply.

/// Programs of `count` nested parts, or of `count` parts in a row.
pub fn deep(count: usize) -> Vec<String> {
    let head = "program P\n\n";
    let blocks = |line: &str| -> String {
        let lines = (0..count).map(|depth| " ".repeat(depth) + line);
        lines.collect::<Vec<_>>().join("\n")
    };
    vec![
        format!(
            "{head}const x = {}1{}\n",
            "(".repeat(count),
            ")".repeat(count)
        ),
        format!("{head}const x = {}\n", "(".repeat(count)),
        format!(
            "{head}const x = {}1{}\n",
            "[".repeat(count),
            "]".repeat(count)
        ),
        format!(
            "{head}const x = {}1{}\n",
            "{a: ".repeat(count),
            "}".repeat(count)
        ),
        format!(
            "{head}const x = {}1{}\n",
            "f(".repeat(count),
            ")".repeat(count)
        ),
        format!("{head}const x = {}a\n", "- ".repeat(count)),
        format!("{head}const x = {}a\n", "not ".repeat(count)),
        format!("{head}const x = a{}\n", " + a".repeat(count)),
        format!("{head}const x = a{}\n", " ?? a".repeat(count)),
        format!("{head}const x = a{}\n", " < a".repeat(count)),
        format!("{head}const x = a{}\n", ".b".repeat(count)),
        format!("{head}const x = a{}\n", "(1)".repeat(count)),
        format!("{head}const x = a{}\n", "[1]".repeat(count)),
        format!("{head}const x = a{}\n", "!".repeat(count)),
        format!("{head}const x = {}b\n", "if a then ".repeat(count)),
        format!("{head}const x = {}b\n", "if a then b else ".repeat(count)),
        format!("{head}invariant {}b\n", "forall r: ".repeat(count)),
        format!(
            "{head}on M(x)\n    if some x = {}a then f()\n",
            "some x = ".repeat(count)
        ),
        format!("{head}on M(x)\n    {}f()\n", "if a then ".repeat(count)),
        format!(
            "{head}on M(x)\n    {}f()\n",
            "if a then f() else ".repeat(count)
        ),
        format!(
            "{head}x: {}Int{}\n",
            "List[".repeat(count),
            "]".repeat(count)
        ),
        format!("{head}x: Int{}\n", "?".repeat(count)),
        format!("{head}x: Int{}\n", " ?".repeat(count)),
        format!("{head}init\n{}", blocks(" if a")),
        format!("{head}init\n{}", blocks(" f()")),
        format!("{head}{}", blocks("role r")),
        format!("{head}{}", blocks("x: Int")),
        format!("{head}{}", blocks("what is this")),
        format!("{head}x()\n{}", blocks(" pre a")),
    ]
}
