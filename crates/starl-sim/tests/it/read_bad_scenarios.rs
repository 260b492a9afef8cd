//! Each kind of bad input gets the right message: the cases are the Markdown files in `bad_scenarios/`. `BLESS=1`
//! rewrites them.

#![allow(clippy::disallowed_methods)] // the test reads files

use crate::reading;
use starl_sim::read;
use std::path::PathBuf;

#[test]
fn every_bad_input_gets_its_message() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/bad_scenarios");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let write = std::env::var_os("BLESS").is_some();
    let mut count = 0;
    let mut differences = String::new();
    for path in paths {
        let mut markdown = std::fs::read_to_string(&path).unwrap();
        for case in reading::cases(&markdown.clone()) {
            let (request, files) = case.request();
            let said = match read::scenario(&request, &files) {
                Ok(_) => "it is accepted\n".to_string(),
                Err(problems) => format!("{problems}\n"),
            };
            let expected = case.block("error").expect("a bad case has an error block");
            count += 1;
            if said == expected {
                continue;
            }
            let name = path.file_name().unwrap().to_string_lossy();
            differences += &format!(
                "{name}:{}: {}\nexpected:\n{expected}said:\n{said}\n",
                case.line, case.title
            );
            if write {
                let heading = markdown.find(&format!("## {}\n", case.title)).unwrap();
                let begin = heading + markdown[heading..].find("```error\n").unwrap() + 9;
                markdown.replace_range(begin..begin + expected.len(), &said);
            }
        }
        if write {
            std::fs::write(&path, markdown).unwrap();
        }
    }
    assert!(differences.is_empty(), "{differences}");
    assert!(count >= 60, "only {count} cases were found");
}
