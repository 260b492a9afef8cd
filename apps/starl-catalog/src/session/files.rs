//! Files that are held in memory, and how scenarios and programs find each other among them.
//!
//! Paths are relative, with `/` between their parts; `.` and `..` are resolved.

use crate::examples::Example;
use crate::language::SUFFIX;
use starl_lang::check::{Libraries, StandardLibraries};
use starl_lang::editor::is_library;
use starl_sim::read::Loader;
use std::collections::BTreeMap;

/// Files by path.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Files(BTreeMap<String, Vec<u8>>);

impl FromIterator<(String, Vec<u8>)> for Files {
    fn from_iter<T: IntoIterator<Item = (String, Vec<u8>)>>(files: T) -> Files {
        let files = files.into_iter();
        Files(
            files
                .map(|(path, content)| (resolve("", &path), content))
                .collect(),
        )
    }
}

impl Files {
    /// The paths of the files that end with `suffix`, in order.
    pub fn ending_with(&self, suffix: &str) -> impl Iterator<Item = &str> {
        let paths = self.0.keys().map(String::as_str);
        paths.filter(move |path| path.ends_with(suffix))
    }

    /// Whether there is a file at this path.
    pub fn has(&self, path: &str) -> bool {
        self.0.contains_key(&resolve("", path))
    }

    /// The text of a file.
    ///
    /// # Errors
    /// Where there is no such file, or it is not text in UTF-8.
    pub fn text(&self, path: &str) -> Result<&str, String> {
        let bytes = self.0.get(&resolve("", path));
        let bytes = bytes.ok_or_else(|| "there is no such file".to_string())?;
        str::from_utf8(bytes).map_err(|error| {
            let before = &bytes[..error.valid_up_to()];
            let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
            format!("it is not text in UTF-8, in line {line}")
        })
    }
}

/// The files as those at `path` name them; an example's own files stand behind them.
pub struct Beside<'a> {
    files: &'a Files,
    /// The file whose folder paths start from.
    path: &'a str,
    example: Option<&'static Example>,
}

impl<'a> Beside<'a> {
    /// The files as the one at `path` names them.
    pub fn new(files: &'a Files, path: &'a str) -> Beside<'a> {
        Beside {
            files,
            path,
            example: None,
        }
    }

    /// The files as an example's scenario names them: those of the example, unless `files` has others in their
    /// place.
    pub fn example(files: &'a Files, example: &'static Example) -> Beside<'a> {
        Beside {
            files,
            path: "",
            example: Some(example),
        }
    }

    /// The path among all files of one that is named from here.
    pub fn resolve(&self, named: &str) -> String {
        resolve(folder(self.path), named)
    }

    /// The name from here of a file.
    pub fn name(&self, path: &str) -> String {
        let path = resolve("", path);
        let (mut from, mut to) = (folder(self.path), path.as_str());
        while let (Some((above, rest)), Some((first, below))) =
            (from.split_once('/'), to.split_once('/'))
            && above == first
        {
            (from, to) = (rest, below);
        }
        "../".repeat(from.matches('/').count()) + to
    }
}

impl Loader for Beside<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, String> {
        match (self.files.0.get(&self.resolve(path)), self.example) {
            (Some(content), _) => Ok(content.clone()),
            (None, Some(example)) => example.load(path),
            (None, None) => Err("there is no such file".to_string()),
        }
    }
}

/// Libraries beside the program go before those of the standard library.
impl Libraries for Beside<'_> {
    fn source(&self, name: &str) -> Option<String> {
        let path = self.resolve(&format!("{name}{}", SUFFIX));
        match self.files.text(&path) {
            Ok(text) => Some(text.to_string()),
            Err(_) => StandardLibraries.source(name),
        }
    }

    fn names(&self) -> Vec<String> {
        let mut names = StandardLibraries.names();
        for path in self.files.ending_with(SUFFIX) {
            let name = self.name(path);
            let name = name.strip_suffix(SUFFIX).filter(|name| !name.contains('/'));
            let is_library = self.files.text(path).is_ok_and(is_library);
            names.extend(name.filter(|_| is_library).map(str::to_string));
        }
        names.sort();
        names.dedup();
        names
    }
}

/// The folder of a file, with a `/` at its end; empty for the outermost.
fn folder(path: &str) -> &str {
    path.rfind('/').map_or("", |end| &path[..=end])
}

/// The path of a file that is named from a folder. Beyond the outermost folder there is nothing.
fn resolve(folder: &str, named: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(named.split('/')) {
        match part {
            "" | "." => {}
            ".." => {
                if parts.last().is_none_or(|&last| last == "..") {
                    parts.push(part);
                } else {
                    parts.pop();
                }
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_from_one_folder_to_another() {
        let files = Files::default();
        let cases = [
            ("s.toml", "p.starl", "p.starl"),
            ("a/s.toml", "a/p.starl", "p.starl"),
            ("a/s.toml", "p.starl", "../p.starl"),
            ("a/b/s.toml", "a/c/p.starl", "../c/p.starl"),
            ("s.toml", "./a/../p.starl", "p.starl"),
        ];
        for (from, path, name) in cases {
            let beside = Beside::new(&files, from);
            assert_eq!(beside.name(path), name);
            assert_eq!(beside.resolve(name), resolve("", path));
        }
    }
}
