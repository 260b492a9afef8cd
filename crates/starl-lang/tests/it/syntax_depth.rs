//! No text nests so deeply, or is so long, that reading it overflows the stack or takes for ever.

use crate::common::{is_wrong, parsed};
use starl_lang::diagnostic::Code;
use starl_lang::format::format;
use starl_lang::syntax::{MAX_LENGTH, parse};

/// Programs of `count` nested parts, or of `count` parts in a row.
fn deep(count: usize) -> Vec<String> {
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

#[test]
fn too_deep_nesting_is_an_error() {
    for text in deep(3000) {
        let parse = parsed(&text);
        let line: String = text.chars().skip(11).take(60).collect();
        assert!(is_wrong(&parse), "{line}");
        assert!(
            parse.diagnostics().len() < 10_000,
            "{line}: {}",
            parse.diagnostics().len()
        );
        let _ = format(&text);
    }
}

#[test]
fn ordinary_programs_are_not_too_deep() {
    for text in deep(15) {
        let too_deep = parsed(&text)
            .diagnostics()
            .iter()
            .any(|diagnostic| diagnostic.code == Code::TooDeep);
        assert!(!too_deep, "{text}");
    }
}

#[test]
fn every_depth_around_the_limit_is_read_whole() {
    for count in 150..250 {
        for text in deep(count) {
            parsed(&text);
        }
    }
}

#[test]
fn many_problems_on_a_line_are_read_in_no_time() {
    let pieces = [
        "(", ")", "[", "{", "x ", "1 ", "+ ", ", ", "$", "\n", ";", " \n", "//\n", "if ", "a,\n",
        "\u{e9}", "x:",
    ];
    for piece in pieces {
        parsed(&piece.repeat(50_000));
        parsed(&format!("program P\n\nx: Int = f({}", piece.repeat(50_000)));
        let _ = format(&format!(
            "program P\n\nrun()\n    eff\n        {}",
            piece.repeat(20_000)
        ));
    }
}

#[test]
fn too_long_texts_are_not_read() {
    let text = "x".repeat(MAX_LENGTH + 1);
    let parse = parse(&text);
    assert_eq!(parse.diagnostics()[0].code, Code::TooLong);
    assert_eq!(
        parse.syntax().text().len(),
        u32::try_from(text.len()).unwrap().into()
    );
}
