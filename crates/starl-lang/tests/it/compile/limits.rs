//! The compiler reports, with the position, programs that exceed the machine's limits.

use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::Code;

use super::support::shown;

/// The codes and the marked texts of the errors in a program that the checker accepts.
fn problems(source: &str) -> Vec<(Code, String)> {
    let checked = check(source, &NoLibraries);
    assert!(
        !checked.has_errors(),
        "{}",
        shown(&checked, checked.diagnostics())
    );
    let problems = match compile(&checked) {
        Ok(_) => Vec::new(),
        Err(problems) => problems,
    };
    let text = |span: starl_lang::diagnostic::Span| span.of(source).to_string();
    problems
        .iter()
        .map(|problem| (problem.code, text(problem.span)))
        .collect()
}

#[test]
fn too_many_locals() {
    let lets: String = (0..300)
        .map(|k| format!("        let v{k} = n + {k}\n"))
        .collect();
    let sum: Vec<String> = (0..300).map(|k| format!("v{k}")).collect();
    let total = sum
        .chunks(100)
        .map(|part| format!("({})", part.join(" + ")));
    let total = total.collect::<Vec<_>>().join(" + ");
    let source = format!("program Test\nn: Int\ngo()\n    eff\n{lets}        n = {total}\n");
    let found = problems(&source);
    assert_eq!(
        found,
        [(Code::TooManyRegisters, "let v255 = n + 255".to_string())]
    );
}

#[test]
fn locals_of_blocks_that_are_over_do_not_count() {
    let blocks: String = (0..300)
        .map(|k| {
            format!("        if n > {k}\n            let v = [n]\n            n += v.size()\n")
        })
        .collect();
    assert_eq!(
        problems(&format!("program Test\nn: Int\ngo()\n    eff\n{blocks}")),
        []
    );
}

#[test]
fn types_nested_too_deeply() {
    let nested = |depth: usize| format!("{}Int{}", "List[".repeat(depth), "]".repeat(depth));
    let source = |depth| {
        format!(
            "program Test\nx: {}\ngo()\n    eff log(\"{{}}\", x.size())\n",
            nested(depth)
        )
    };
    assert_eq!(problems(&source(32)), []);
    let found = problems(&source(33));
    assert!(
        found.iter().all(|(code, _)| *code == Code::NestedTooDeep) && !found.is_empty(),
        "{found:?}"
    );
}

#[test]
fn records_nested_too_deeply() {
    let records: String = (0..25)
        .map(|k| format!("record R{k} {{x: R{}?}}\n", k + 1))
        .collect();
    let source =
        format!("program Test\n{records}record R25 {{x: Int}}\nr: R0\ngo()\n    eff r.x = r.x\n");
    let found = problems(&source);
    assert!(
        found.iter().all(|(code, _)| *code == Code::NestedTooDeep) && !found.is_empty(),
        "{found:?}"
    );
}

#[test]
fn messages_with_too_many_parts() {
    let points: Vec<String> = (0..90).map(|k| format!("p{k}: Point")).collect();
    let source = format!(
        "program Test\nmessage Big({})\nradio = Broadcast()\nn: Int\non Big(from{})\n    n += 1\n    log(\"{{}}\", from)\n",
        points.join(", "),
        ", _".repeat(90),
    );
    let checked = check(&source, &NoLibraries);
    if checked.has_errors() {
        return; // the checker says it already
    }
    let found = problems(&source);
    assert!(
        found
            .iter()
            .all(|(code, _)| *code == Code::TooManyRegisters)
            && !found.is_empty(),
        "{found:?}"
    );
}

#[test]
fn a_problem_of_a_library_says_where_it_is() {
    let lets: String = (0..300)
        .map(|k| format!("    let v{k} = n + {k}\n"))
        .collect();
    let sum: Vec<String> = (0..300).map(|k| format!("v{k}")).collect();
    let total = sum
        .chunks(100)
        .map(|part| format!("({})", part.join(" + ")));
    let total = total.collect::<Vec<_>>().join(" + ");
    let library = format!("library wide\nfunction f(n: Int) -> Int\n{lets}    return {total}\n");
    let libraries = |name: &str| (name == "wide").then(|| library.clone());
    let checked = check(
        "program Test\nimport wide\nn: Int = wide.f(1)\ngo()\n    eff n += 1\n",
        &libraries,
    );
    let problems = compile(&checked).expect_err("there are too many");
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].code, Code::TooManyRegisters);
    let last = problems[0].notes.last().unwrap();
    assert_eq!(last, "it is in the library `wide`, line 257");
}

#[test]
fn a_program_with_errors_is_not_compiled() {
    let checked = check("program Test\nn: Int = true\n", &NoLibraries);
    let problems = compile(&checked).expect_err("the checker found an error");
    assert_eq!(
        problems.iter().map(|p| p.code).collect::<Vec<_>>(),
        [Code::WrongType]
    );
}
