//! Scenarios and programs that tests hold in memory.

use starl_catalog::programs::Registry;
use starl_catalog::{Application, Refusal};
use starl_core::FileError;
use starl_sim::read::{Loader, Request, Source};
use std::collections::BTreeMap;

/// Files by the paths that the scenario `run.toml` has for them.
#[derive(Clone, Debug, Default)]
pub struct Memory(BTreeMap<String, Vec<u8>>);

impl Memory {
    pub fn of(files: &[(&str, &[u8])]) -> Memory {
        let files = files.iter();
        Memory(
            files
                .map(|(path, bytes)| (path.to_string(), bytes.to_vec()))
                .collect(),
        )
    }
}

impl Loader for Memory {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let bytes = self.0.get(path).cloned();
        bytes.ok_or(FileError::Missing)
    }
}

/// A scenario with its programs.
pub fn application(scenario: &str, files: &Memory) -> Result<Application, Refusal> {
    let request = Request::new(Source::new("run.toml", scenario));
    starl_catalog::read(&request, files, &Registry::default())
}
