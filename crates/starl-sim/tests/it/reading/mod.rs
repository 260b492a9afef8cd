//! Shared code of the tests of the scenario reader: a loader in memory, and cases written in
//! Markdown.

pub mod fields;

use starl_core::FileError;
use starl_sim::read::{self, Loader, Override, Problems, Request, Resolved, Source};
use std::collections::BTreeMap;

/// Files in memory.
#[derive(Default)]
pub struct Files(pub BTreeMap<String, Vec<u8>>);

impl Loader for Files {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.0.get(path).cloned().ok_or(FileError::Missing)
    }
}

/// A request for a scenario called `run.toml`, with the given `path=value` overrides.
pub fn request(text: &str, overrides: &[&str]) -> Request {
    let overrides = overrides
        .iter()
        .map(|set| Override::set(set).unwrap())
        .collect();
    Request {
        overrides,
        ..Request::new(Source::new("run.toml", text))
    }
}

/// Reads a scenario that names no files.
pub fn read(text: &str, overrides: &[&str]) -> Result<Resolved, Problems> {
    read::scenario(&request(text, overrides), &Files::default())
}

/// One robot in an empty world, the least there can be.
pub const LEAST: &str =
    "program = \"race\"\n[[robots]]\nmodel = \"create\"\nstart = [{ position = [0, 0] }]\n";

/// A case of a Markdown file: the input and its messages.
pub struct Case {
    /// The heading.
    pub title: String,
    /// The line of the heading.
    pub line: usize,
    /// The fenced blocks: what follows the fence, and the text.
    pub blocks: Vec<(String, String)>,
}

/// The cases of a Markdown file: a heading of the second level begins each.
pub fn cases(markdown: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let mut block: Option<(String, String)> = None;
    for (index, line) in markdown.lines().enumerate() {
        match (&mut block, line.strip_prefix("```")) {
            (None, None) => {
                if let Some(title) = line.strip_prefix("## ") {
                    let title = title.to_string();
                    cases.push(Case {
                        title,
                        line: index + 1,
                        blocks: Vec::new(),
                    });
                }
            }
            (None, Some(info)) => block = Some((info.trim().to_string(), String::new())),
            (Some((_, text)), None) => {
                text.push_str(line);
                text.push('\n');
            }
            (Some(_), Some(_)) => {
                let case = cases.last_mut().expect("a block follows a heading");
                case.blocks.push(block.take().unwrap());
            }
        }
    }
    assert!(block.is_none(), "the last block is not closed");
    cases
}

impl Case {
    /// The text of the block with this word behind its fence.
    pub fn block(&self, info: &str) -> Option<&str> {
        self.blocks
            .iter()
            .find(|(found, _)| found == info)
            .map(|(_, text)| text.as_str())
    }

    /// The scenario, the files and the options that the blocks describe: `toml`, `set` with an
    /// option a line, `robots`, `faults`, `file NAME` and `hex NAME`.
    pub fn request(&self) -> (Request, Files) {
        let mut request = request(self.block("toml").unwrap_or_default(), &[]);
        let sets = self.block("set").unwrap_or_default().lines();
        request.overrides = sets.map(|line| Override::set(line).unwrap()).collect();
        request.robots = self.block("robots").map(|text| text.trim_end().to_string());
        request.faults = self
            .block("faults")
            .map(|text| Source::new("faults.toml", text));
        let mut files = Files::default();
        for (info, text) in &self.blocks {
            if let Some(name) = info.strip_prefix("file ") {
                files.0.insert(name.to_string(), text.clone().into_bytes());
            }
            if let Some(name) = info.strip_prefix("hex ") {
                let digits: Vec<u32> = text.chars().filter_map(|c| c.to_digit(16)).collect();
                let bytes = digits
                    .chunks(2)
                    .map(|pair| (pair[0] * 16 + pair[1]) as u8)
                    .collect();
                files.0.insert(name.to_string(), bytes);
            }
        }
        (request, files)
    }
}
