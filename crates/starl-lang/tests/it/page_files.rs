//! The files around the programs of a page: its libraries, and a model that all pages share.

use std::collections::BTreeMap;

use starl_core::FileError;
use starl_lang::check::Libraries;

/// The libraries of a page by name. Each page has the model `navigation.onnx`, which takes four numbers and gives two.
#[derive(Default)]
pub struct PageFiles(pub BTreeMap<String, String>);

impl Libraries for PageFiles {
    fn source(&self, name: &str) -> Option<String> {
        self.0.get(name).cloned()
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let model = include_bytes!("../../../starl-policy/tests/models/dense.onnx");
        match path {
            "navigation.onnx" => Ok(model.to_vec()),
            _ => Err(FileError::Missing),
        }
    }
}
