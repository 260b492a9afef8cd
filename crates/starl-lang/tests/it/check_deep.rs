//! Texts that nest deeply or continue for long are checked, or said to be too deep; none ends the checker.

use starl_lang::check::{NoLibraries, check};

fn function(body: &str) -> String {
    format!("library L\nrecord R {{x: Int}}\nfunction f(a: Int, r: R?) -> Int\n{body}\n")
}

#[test]
fn long_chains() {
    let count = 20_000;
    for (start, link) in [
        ("1", " + 1"),
        ("true", " and true"),
        ("a", ".x"),
        ("a", "[0]"),
        ("a", "()"),
        ("r", "!"),
        ("r", " ?? r"),
        ("1", " == 1"),
    ] {
        let _ = check(
            &function(&format!("    return {start}{}", link.repeat(count))),
            &NoLibraries,
        );
    }
    for start in ["-", "not ", "(", "[", "{", "if true then 1 else "] {
        let _ = check(
            &function(&format!("    return {}1", start.repeat(count))),
            &NoLibraries,
        );
    }
}

#[test]
fn long_blocks() {
    let count = 5_000;
    let branches = "    elif a > 1\n        return 1\n".repeat(count);
    let _ = check(
        &function(&format!(
            "    if a > 2\n        return 2\n{branches}    return 3"
        )),
        &NoLibraries,
    );
    let lines = "    let b = a\n".repeat(count);
    let _ = check(&function(&format!("{lines}    return 3")), &NoLibraries);
    let nested: String = (0..500)
        .map(|depth| format!("{}if a > 1\n", "    ".repeat(depth + 1)))
        .collect();
    let _ = check(&function(&format!("{nested}    return 3")), &NoLibraries);
}

#[test]
fn long_chains_of_declarations() {
    let count = 2_000;
    let records: String = (0..count)
        .map(|number| format!("record R{number} {{x: R{}}}\n", number + 1))
        .collect();
    let _ = check(
        &format!("library L\n{records}record R{count} {{x: Int}}\n"),
        &NoLibraries,
    );
    let constants: String = (0..count)
        .map(|number| format!("const c{number} = c{} + 1\n", number + 1))
        .collect();
    let _ = check(
        &format!("library L\n{constants}const c{count} = 1\n"),
        &NoLibraries,
    );
    let library = |name: &str| {
        let number: usize = name.strip_prefix('l')?.parse().ok()?;
        Some(format!("library l{number}\nimport l{}\n", number + 1)).filter(|_| number < 300)
    };
    let _ = check("library L\nimport l0\n", &library);
    let _ = check(
        "library L\nenum Empty {}\nfunction f(e: Empty) -> Bool = e == e\n",
        &NoLibraries,
    );
    let _ = check(
        "program P\nenum Empty {}\ne: Empty\nstart()\n    pre e == e\n    eff e = if e == e then e else e\n",
        &NoLibraries,
    );
}
