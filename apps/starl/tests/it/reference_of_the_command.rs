//! `docs/reference/command.md` and, for real robots, `docs/reference/fleet.md` have every subcommand with every option, and
//! no others.

use crate::support::starl;
use std::collections::BTreeSet;
use std::path::Path;

const REFERENCE: &str = concat!(
    include_str!("../../../../docs/reference/command.md"),
    include_str!("../../../../docs/reference/fleet.md")
);

/// The output of the command.
fn printed(arguments: &[&str]) -> String {
    // Not a folder of the test's own: the tests of this file would remove it from under each other.
    let output = starl(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments);
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).expect("the help is text")
}

/// The subcommands that a help lists; none if it lists none.
fn subcommands(help: &str) -> Vec<String> {
    let (_, listed) = help.split_once("Commands:\n").unwrap_or_default();
    let listed = listed.lines().take_while(|line| !line.is_empty());
    let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names = names.filter(|name| !name.is_empty() && *name != "help");
    names.map(str::to_string).collect()
}

/// The help of a subcommand, and of its own.
fn helps(subcommand: &str) -> String {
    let help = printed(&[subcommand, "--help"]);
    let below = subcommands(&help);
    let below = below
        .iter()
        .map(|name| printed(&[subcommand, name, "--help"]));
    [help.clone()].into_iter().chain(below).collect()
}

/// The part of the reference about a subcommand; some have a section for each of two uses.
fn section(subcommand: &str) -> String {
    let begin = format!("## `starl {subcommand}");
    let sections = REFERENCE
        .split("\n## ")
        .skip(1)
        .map(|text| format!("## {text}"));
    let own = sections.filter(|text| {
        let rest = text.strip_prefix(&*begin);
        rest.is_some_and(|rest| rest.starts_with([' ', '`']))
    });
    own.collect()
}

/// The options that a text names: `--seed`.
fn options(text: &str) -> BTreeSet<String> {
    let is_part = |letter: char| letter.is_ascii_lowercase() || letter == '-';
    let words = text.split(|letter| !is_part(letter));
    let options = words.filter(|word| {
        let name = word.strip_prefix("--");
        name.is_some_and(|name| name.starts_with(|first: char| first.is_ascii_lowercase()))
    });
    options.map(str::to_string).collect()
}

/// The options in the table of a section: what its rows begin with.
fn tabled(section: &str) -> BTreeSet<String> {
    let rows = section
        .lines()
        .filter_map(|line| line.strip_prefix("| `--"));
    rows.flat_map(|row| options(&format!("--{}", row.split('|').next().unwrap_or_default())))
        .collect()
}

#[test]
fn the_reference_has_every_subcommand() {
    let subcommands = subcommands(&printed(&["--help"]));
    assert!(subcommands.len() > 10, "{subcommands:?}");
    let (_, overview) = REFERENCE.split_once("```\n").expect("an overview");
    let (overview, _) = overview.split_once("```").expect("its end");
    let named: BTreeSet<&str> = overview
        .lines()
        .filter_map(|line| line.strip_prefix("starl ")?.split(' ').next())
        .collect();
    assert_eq!(named, subcommands.iter().map(String::as_str).collect());
    for subcommand in &subcommands {
        assert!(
            !section(subcommand).is_empty(),
            "{subcommand} has no section"
        );
    }
}

#[test]
fn the_reference_has_every_option() {
    for subcommand in subcommands(&printed(&["--help"])) {
        let help = helps(&subcommand);
        let lines = help.lines().map(str::trim_start);
        let mut known: BTreeSet<String> = lines
            .filter(|line| line.starts_with('-'))
            .flat_map(|line| options(line.split("  ").next().unwrap_or_default()))
            .collect();
        known.remove("--help");
        let section = section(&subcommand);
        let named = options(&section);
        let missing: Vec<_> = known.difference(&named).collect();
        assert!(
            missing.is_empty(),
            "starl {subcommand}: the reference lacks {missing:?}"
        );
        let unknown: Vec<_> = tabled(&section).difference(&known).cloned().collect();
        assert!(unknown.is_empty(), "starl {subcommand} has no {unknown:?}");
    }
}
