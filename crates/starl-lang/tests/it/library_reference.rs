//! The reference of the standard library is generated from its sources. `BLESS=1 cargo test -p starl-lang --test it
//! library_reference` rewrites it.
#![allow(clippy::disallowed_methods, reason = "a test reads its page")]

use std::fs;
use std::path::PathBuf;

use starl_lang::check::{NoLibraries, STANDARD, check};
use starl_lang::ir::{Function, Program};
use starl_lang::syntax::ast::{Documented, Item};

/// Before the first library.
const BEGINNING: &str = "# The standard library

Every program can import these libraries, wherever it runs. They are written in the language, in
`crates/starl-lang/library/`, and import nothing. If a library of the same name lies beside the program, that one is
used.

```starl
program Gather

import fleet

motion = ReachAvoid()
allread pos[RobotId]: Point

tell()
    pre pos[me] == none
    eff pos[me] = position

gather()
    pre not motion.active and not motion.done and some middle = fleet.center(pos)
    eff motion.reach_avoid(middle, obstacles())
```
";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/standard-library.md")
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn signature(program: &Program, function: &Function) -> String {
    let parameters = &function.locals[..function.parameters as usize];
    let parameters = parameters.iter();
    let parameters: Vec<String> = parameters
        .map(|local| format!("{}: {}", local.name, program.type_name(&local.ty)))
        .collect();
    let result = program.type_name(&function.result);
    format!("{}({}) -> {result}", function.name, parameters.join(", "))
}

/// The rows of a library's table, in the order of its text.
fn rows(program: &Program) -> Vec<String> {
    let mut rows = Vec::new();
    for it in program.constants.iter().filter(|it| it.site.file == 0) {
        let name = format!("{}: {}", it.name, program.type_name(&it.ty));
        rows.push((it.site.span, name, &it.documentation));
    }
    for it in program.records.iter().filter(|it| it.site.file == 0) {
        let fields = it.fields.iter();
        let fields: Vec<String> = fields
            .map(|field| format!("{}: {}", field.name, program.type_name(&field.ty)))
            .collect();
        let name = format!("record {} {{{}}}", it.name, fields.join(", "));
        rows.push((it.site.span, name, &it.documentation));
    }
    for it in program.functions.iter().filter(|it| it.site.file == 0) {
        rows.push((it.site.span, signature(program, it), &it.documentation));
    }
    rows.sort_by_key(|row| row.0);
    let row =
        |(_, name, words): &(_, String, &String)| format!("| `{name}` | {} |", one_line(words));
    rows.iter().map(row).collect()
}

fn page() -> String {
    let mut page = BEGINNING.to_string();
    for (name, text) in STANDARD {
        let checked = check(text, &NoLibraries);
        let mut items = checked.files[0].parse.tree().items();
        let header = items.find(|item| matches!(item, Item::Library(_)));
        let words = header.map(|item| item.documentation()).unwrap_or_default();
        page += &format!("\n## `{name}`\n\n{words}\n\n| what | what it is |\n| --- | --- |\n");
        for row in rows(&checked.program) {
            page += &row;
            page.push('\n');
        }
    }
    page
}

#[test]
fn it_is_complete() {
    let page = page();
    if std::env::var_os("BLESS").is_some() {
        fs::write(path(), &page).expect("the page can be written");
    }
    let written = fs::read_to_string(path()).unwrap_or_default();
    assert_eq!(written, page, "BLESS=1 writes it anew");
}

#[test]
fn its_example_has_nothing_wrong_with_it() {
    let example = BEGINNING.split("```").nth(1).expect("there is one");
    let example = example.strip_prefix("starl\n").expect("it is a program");
    let checked = check(example, &starl_lang::check::StandardLibraries);
    assert_eq!(checked.diagnostics(), []);
}
