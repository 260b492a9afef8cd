//! Messages about syntax errors: each case of `tests/diagnostics/syntax_*.md` is a source and the message it gets.
//!
//! A case is a heading, the source in a block of `starl`, and the message in a block of `text`. Where the messages
//! suggest fixes, the fixed source follows in another block of `starl`, and the page says whether it is correct.
//! `BLESS=1 cargo test -p starl-lang --test syntax_diagnostics` rewrites the messages.
#![allow(clippy::disallowed_methods, reason = "a test reads its cases")]

use crate::common::{is_wrong, parsed};
use starl_lang::diagnostic::{Code, Colour, Diagnostic, render};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// A page: what is between the cases, and the cases.
struct Case {
    heading: String,
    prose: String,
    source: String,
}

fn pages() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics");
    let entries = fs::read_dir(folder)
        .expect("the folder of cases")
        .map(|entry| entry.expect("a case").path());
    let is_of_syntax = |path: &PathBuf| {
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .unwrap_or_default();
        name.starts_with("syntax_") && name.ends_with(".md")
    };
    let mut pages: Vec<PathBuf> = entries.filter(is_of_syntax).collect();
    pages.sort();
    pages
}

/// The text before the first case, and the cases.
fn read(page: &str) -> (String, Vec<Case>) {
    let mut parts = page.split("\n## ");
    let introduction = parts.next().unwrap_or_default().to_string();
    let case = |part: &str| {
        let (heading, rest) = part.split_once('\n').unwrap_or((part, ""));
        let (prose, rest) = rest
            .split_once("```starl\n")
            .unwrap_or_else(|| panic!("{heading}: no source"));
        let (source, _) = rest
            .split_once("```")
            .unwrap_or_else(|| panic!("{heading}: the source does not end"));
        Case {
            heading: heading.into(),
            prose: prose.into(),
            source: source.into(),
        }
    };
    (introduction, parts.map(case).collect())
}

/// The source after all fixes that do not overlap.
fn fixed(source: &str, diagnostics: &[Diagnostic]) -> String {
    let mut text = source.to_string();
    let mut end = usize::MAX;
    let mut fixes: Vec<_> = diagnostics
        .iter()
        .filter_map(|diagnostic| diagnostic.fix.as_ref())
        .collect();
    fixes.sort_by_key(|fix| fix.edits.first().map(|edit| edit.span));
    for fix in fixes.iter().rev() {
        let last = fix.edits.last().map_or(0, |edit| edit.span.end as usize);
        if last <= end {
            text = fix.apply(&text);
            end = fix.edits.first().map_or(0, |edit| edit.span.start as usize);
        }
    }
    text
}

fn written(introduction: &str, cases: &[Case]) -> String {
    let mut page = introduction.trim_end().to_string() + "\n";
    for Case {
        heading,
        prose,
        source,
    } in cases
    {
        let parse = parsed(source);
        let diagnostics = parse.diagnostics();
        assert!(!diagnostics.is_empty(), "{heading}: nothing is wrong");
        let message = render("example.starl", source, diagnostics, Colour::Off);
        let message: Vec<&str> = message.trim_end().lines().map(str::trim_end).collect();
        let prose = if prose.trim().is_empty() {
            "\n".into()
        } else {
            format!("\n{}\n\n", prose.trim())
        };
        page += &format!(
            "\n## {heading}\n{prose}```starl\n{source}```\n\n```text\n{}\n```\n",
            message.join("\n")
        );
        let after = fixed(source, diagnostics);
        if after != *source {
            let wrong = is_wrong(&parsed(&after));
            let label = if wrong {
                "With the fixes done, something is still wrong"
            } else {
                "Fixed"
            };
            page += &format!("\n{label}:\n\n```starl\n{after}```\n");
        }
    }
    page
}

#[test]
fn every_case_has_the_messages_of_its_page() {
    let mut differing = Vec::new();
    for path in pages() {
        let page = fs::read_to_string(&path).expect("a case that can be read");
        let (introduction, cases) = read(&page);
        let now = written(&introduction, &cases);
        if std::env::var_os("BLESS").is_some() {
            fs::write(&path, now).expect("a case that can be written");
        } else if now != page {
            let lines = page
                .lines()
                .zip(now.lines())
                .find(|(before, now)| before != now);
            differing.push(format!("{}: {lines:?}", path.display()));
        }
    }
    assert!(
        differing.is_empty(),
        "BLESS=1 writes these anew:\n{}",
        differing.join("\n")
    );
}

#[test]
fn every_code_has_a_case() {
    let mut seen = BTreeSet::new();
    let mut count = 0;
    for path in pages() {
        let (_, cases) = read(&fs::read_to_string(&path).expect("a case that can be read"));
        for case in cases {
            seen.extend(
                parsed(&case.source)
                    .diagnostics()
                    .iter()
                    .map(|diagnostic| diagnostic.code),
            );
            count += 1;
        }
    }
    // A file of 16 MiB is too long for a page.
    let of_syntax = |code: &&Code| code.number()[1..].starts_with("01") && **code != Code::TooLong;
    let missing: Vec<&Code> = Code::ALL
        .iter()
        .filter(of_syntax)
        .filter(|code| !seen.contains(code))
        .collect();
    assert!(missing.is_empty(), "{missing:?} have no case");
    assert!(count >= 100, "there are only {count} cases");
}
