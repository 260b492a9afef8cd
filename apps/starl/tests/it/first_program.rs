//! The tutorial of the language is true: its steps are executed in an empty folder, and the output of the command is
//! that of the page, except for wall times.
//!
//! A block of `starl` is written to the page's program, one of `toml` to its faults; a block of `text`
//! contains commands, each with its output. `BLESS=1 cargo test -p starl --test it first_program`
//! rewrites the outputs, and the plots of the page.

use crate::support::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/tutorial/first-program.md")
}

/// The output of a command, as a terminal shows it: first the error stream, then the result.
fn shown(output: &Output) -> String {
    let text = stderr(output) + &stdout(output);
    let lines = text
        .lines()
        .map(|line| match line.split_once(" simulated in ") {
            // How long it took is different each time.
            Some((before, _)) => format!("{before} simulated in 0.05 s, 1,000 times real time\n"),
            None => format!("{line}\n"),
        });
    lines.collect()
}

/// A block of commands with what they print now; as the page shows it, if that is true.
fn run(folder: &Path, block: &str) -> String {
    let mut printed = String::new();
    for part in block.split("$ starl ").skip(1) {
        let (command, on_page) = part.split_once('\n').expect("a command ends its line");
        let arguments: Vec<&str> = command.split(' ').collect();
        let shown = shown(&starl(folder, &arguments));
        let on_page_lines: Vec<&str> = on_page.lines().collect();
        let shown_lines: Vec<&str> = shown.lines().collect();
        let kept = fits(&on_page_lines, &shown_lines);
        let output = if kept { on_page } else { &shown };
        printed += &format!("$ starl {command}\n{output}");
    }
    printed
}

/// Whether the page shows what is printed; `...` on the page stands for any lines.
fn fits(page: &[&str], printed: &[&str]) -> bool {
    match (page.split_first(), printed.split_first()) {
        (None, _) => printed.is_empty(),
        (Some((&"...", rest)), _) => (0..=printed.len()).any(|from| fits(rest, &printed[from..])),
        (Some((shown, page)), Some((line, printed))) => shown == line && fits(page, printed),
        (Some(_), None) => false,
    }
}

#[test]
fn every_step_matches_the_page() {
    let bless = std::env::var_os("BLESS").is_some();
    let folder = folder("first_program");
    let before = fs::read_to_string(page()).expect("the tutorial");
    let mut now = String::new();
    let mut lines = before.lines();
    while let Some(line) = lines.next() {
        now += &format!("{line}\n");
        let Some(kind) = line.strip_prefix("```") else {
            continue;
        };
        let inside = lines.by_ref().take_while(|line| *line != "```");
        let block: String = inside.map(|line| format!("{line}\n")).collect();
        now += &match kind {
            "text" => run(&folder, &block),
            _ => {
                let name = if kind == "starl" {
                    "hunt.starl"
                } else {
                    "faults.toml"
                };
                file(&folder, name, &block);
                block
            }
        };
        now += "```\n";
    }
    for plot in ["hunt-1.svg", "hunt-3.svg"] {
        let made = fs::read_to_string(folder.join(plot)).expect("a plot");
        let shown = page().with_file_name(plot);
        if bless {
            fs::write(&shown, &made).expect("a plot that can be written");
        }
        let kept = fs::read_to_string(&shown).expect("the plot of the page");
        assert!(kept == made, "BLESS=1 writes {plot} anew");
    }
    if bless {
        fs::write(page(), &now).expect("a page that can be written");
    }
    assert!(bless || now == before, "BLESS=1 writes it anew:\n{now}");
}
