//! The origin of the files of a run: the folder of its scenario, or the command itself for those of an example; and the
//! folder of a program that runs in another scenario.
//!
//! A scenario knows its files by their paths from its own folder. A program from elsewhere gets such a
//! path too, and with it the libraries beside it, so that a trace can hold all of them under their names.

use crate::output::identity;
use starl_catalog::disk;
use starl_catalog::examples::Example;
use starl_catalog::language::Findings;
use starl_core::FileError;
use starl_sim::read::Loader;
#[cfg(feature = "web")]
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// The origin of files.
pub struct Origin {
    scenario: Scenario,
    /// The folder of a program from elsewhere, for scenarios that have no folder themselves.
    program: Option<PathBuf>,
}

enum Scenario {
    /// Its files are part of the command.
    Example(&'static Example),
    /// A file.
    File(PathBuf),
    /// The default one, which names no files.
    Default,
}

/// Begins the paths of files beside a program whose scenario has no folder.
const BESIDE: &str = "./";

impl Origin {
    /// The files of an example.
    pub fn example(example: &'static Example) -> Origin {
        Origin::of(Scenario::Example(example))
    }

    /// The files around a scenario.
    pub fn file(scenario: &Path) -> Origin {
        Origin::of(Scenario::File(scenario.to_path_buf()))
    }

    /// No files.
    pub fn none() -> Origin {
        Origin::of(Scenario::Default)
    }

    fn of(scenario: Scenario) -> Origin {
        Origin {
            scenario,
            program: None,
        }
    }

    /// The same, and the files around a program.
    pub fn with_program(self, program: &Path) -> Origin {
        let folder = program.parent().unwrap_or(Path::new(""));
        Origin {
            program: Some(folder.to_path_buf()),
            ..self
        }
    }

    /// Whether this is the origin of the default scenario's files.
    pub fn is_default(&self) -> bool {
        matches!(self.scenario, Scenario::Default)
    }

    /// The scenario's file, if it is one.
    pub fn scenario(&self) -> Option<&Path> {
        match &self.scenario {
            Scenario::File(path) => Some(path),
            _ => None,
        }
    }

    /// By which path the scenario knows a program.
    pub fn key(&self, program: &Path) -> String {
        let name = program.file_name().unwrap_or_default();
        match &self.scenario {
            Scenario::File(scenario) => between(&identity(scenario), &identity(program)),
            _ => format!("{BESIDE}{}", name.display()),
        }
    }

    /// The displayed name of the file with the findings.
    pub fn name(&self, findings: &Findings) -> String {
        match self.path(&findings.path) {
            Some(path) => path.display().to_string(),
            None => findings.name.clone(),
        }
    }

    /// The name by which a scenario in the file `scenario` knows the program that this one knows as
    /// `key`: of a file on disk its path from there, of an example's the name that it has everywhere.
    pub fn key_from(&self, key: &str, scenario: &Path) -> String {
        match (self.path(key), &self.scenario) {
            (Some(path), _) if path.exists() => between(&identity(scenario), &identity(&path)),
            (_, Scenario::Example(example)) => example.global_name(key),
            _ => key.to_string(),
        }
    }

    /// The names that an example's programs have everywhere, by those that they have in its scenario.
    #[cfg(feature = "web")]
    pub fn global_names(&self) -> BTreeMap<String, String> {
        let Scenario::Example(example) = &self.scenario else {
            return BTreeMap::new();
        };
        let programs = example.programs();
        programs
            .map(|own| (own.to_string(), example.global_name(own)))
            .collect()
    }

    /// The file on disk that a path of the scenario means; none if it is part of the command.
    pub fn path(&self, key: &str) -> Option<PathBuf> {
        match (&self.scenario, &self.program, key.strip_prefix(BESIDE)) {
            (Scenario::File(scenario), ..) => Some(scenario.with_file_name(key)),
            (_, Some(folder), Some(name)) => Some(folder.join(name)),
            _ => None,
        }
    }
}

impl Loader for Origin {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match (self.path(path), &self.scenario) {
            (Some(path), _) => disk::read(&path),
            (None, Scenario::Example(example)) => example.load(path),
            (None, _) => Err(FileError::Missing),
        }
    }
}

/// The path that leads from the folder of one file to another file, both whole paths.
fn between(from: &Path, to: &Path) -> String {
    let parts = |path: &Path| -> Vec<String> {
        let named = path.components().map(Component::as_os_str);
        named.map(|part| part.display().to_string()).collect()
    };
    let (mut from, to) = (parts(from), parts(to));
    from.pop();
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from[common..].iter().map(|_| "..");
    let down = to[common..].iter().map(String::as_str);
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_known_by_its_path_from_the_scenario() {
        let between = |from: &str, to: &str| between(Path::new(from), Path::new(to));
        assert_eq!(between("/a/s.toml", "/a/p.starl"), "p.starl");
        assert_eq!(between("/a/s.toml", "/a/b/p.starl"), "b/p.starl");
        assert_eq!(between("/a/b/c/s.toml", "/a/d/p.starl"), "../../d/p.starl");
    }
}
