//! Files that are held in memory, and how scenarios and programs find each other among them.
//!
//! Paths have `/` between their parts; `.` and `..` are resolved. They are relative, but on a host that has a disk.

use crate::examples::{self, Example};
use crate::language::SUFFIX;
use starl_core::{FileError, file};
use starl_editor::is_library;
use starl_lang::check::{Libraries, StandardLibraries};
use starl_sim::read::Loader;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

/// Files by path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Files {
    held: BTreeMap<String, Vec<u8>>,
    disk: Option<Disk>,
}

/// Reads a file of the disk.
#[derive(Clone, Copy, Debug)]
pub struct Disk(pub fn(&Path) -> Result<Vec<u8>, FileError>);

/// A file on disk may have changed since.
impl PartialEq for Disk {
    fn eq(&self, _: &Disk) -> bool {
        false
    }
}

impl FromIterator<(String, Vec<u8>)> for Files {
    fn from_iter<T: IntoIterator<Item = (String, Vec<u8>)>>(files: T) -> Files {
        let files = files.into_iter();
        Files {
            held: files
                .map(|(path, content)| (resolve("", &path), content))
                .collect(),
            disk: None,
        }
    }
}

impl Files {
    /// The same; scenarios and programs also find the files on a disk. A file that is opened by its name must be held.
    #[must_use]
    pub fn with_disk(self, disk: Option<Disk>) -> Files {
        Files { disk, ..self }
    }

    /// The content of a file that is held or, if there is a disk, on it.
    fn content(&self, path: &str) -> Result<Cow<'_, [u8]>, FileError> {
        match (self.held.get(path), self.disk) {
            (Some(held), _) => Ok(Cow::Borrowed(held)),
            (None, Some(Disk(read))) => read(Path::new(path)).map(Cow::Owned),
            (None, None) => examples::model(path)
                .map(Cow::Borrowed)
                .ok_or(FileError::Missing),
        }
    }

    /// The paths of the files that end with `suffix`, in order.
    pub fn ending_with(&self, suffix: &str) -> impl Iterator<Item = &str> {
        let paths = self.held.keys().map(String::as_str);
        paths.filter(move |path| path.ends_with(suffix))
    }

    /// Whether there is a file at this path.
    pub fn has(&self, path: &str) -> bool {
        self.held.contains_key(&resolve("", path))
    }

    /// The text of a file.
    ///
    /// # Errors
    /// If there is no such file, or it is not text in UTF-8.
    pub fn text(&self, path: &str) -> Result<&str, FileError> {
        let bytes = self.held.get(&resolve("", path));
        file::text(bytes.ok_or(FileError::Missing)?)
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
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match (self.files.content(&self.resolve(path)), self.example) {
            (Ok(content), _) => Ok(content.into_owned()),
            (Err(_), Some(example)) => example.load(path),
            (Err(reason), None) => Err(reason),
        }
    }
}

/// Libraries beside the program go before those of the standard library.
impl Libraries for Beside<'_> {
    fn source(&self, name: &str) -> Option<String> {
        let path = self.resolve(&format!("{name}{}", SUFFIX));
        let beside = self.files.content(&path).ok();
        match beside.and_then(|content| String::from_utf8(content.into_owned()).ok()) {
            Some(text) => Some(text),
            None => StandardLibraries.source(name),
        }
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.load(path)
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

/// The path of a file that is named from a folder.
fn resolve(folder: &str, named: &str) -> String {
    let folder = if named.starts_with('/') { "" } else { folder };
    let root = match named.starts_with('/') || folder.starts_with('/') {
        true => "/",
        false => "",
    };
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(named.split('/')) {
        match part {
            "" | "." => {}
            ".." => match parts.last() {
                Some(&last) if last != ".." => _ = parts.pop(),
                None if !root.is_empty() => {}
                _ => parts.push(part),
            },
            part => parts.push(part),
        }
    }
    root.to_string() + &parts.join("/")
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
