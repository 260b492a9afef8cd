//! The files of a sweep: the journal while it runs, the table at its end.

use crate::failure::Failure;
use crate::output::Output;
use starl_sweep::{Error, Format, Journal, Measured, Plan, Table};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The table to write, and its journal.
pub struct Outputs {
    table: Option<(PathBuf, Format)>,
    journal: Option<Journal>,
}

impl Outputs {
    /// Opens the journal of a table, if one is requested, and returns its rows.
    pub fn open(
        out: Option<(&Path, Format)>,
        plan: &Plan,
    ) -> Result<(Outputs, BTreeMap<u64, Measured>), Failure> {
        let Some((path, format)) = out else {
            let none = Outputs {
                table: None,
                journal: None,
            };
            return Ok((none, BTreeMap::new()));
        };
        // Found out before hours of runs: the table's own file can be written.
        drop(Output::create(path)?);
        let (journal, rows) = Journal::open(&Journal::path_of(path), plan)?;
        let outputs = Outputs {
            table: Some((path.to_path_buf(), format)),
            journal: Some(journal),
        };
        Ok((outputs, rows))
    }

    /// Keeps a row.
    pub fn keep(&mut self, row: &Measured) -> Result<(), Error> {
        match &mut self.journal {
            Some(journal) => journal.write(row),
            None => Ok(()),
        }
    }

    /// Writes the table.
    pub fn finish(self, plan: &Plan, rows: &BTreeMap<u64, Measured>) -> Result<(), Failure> {
        let Some((path, format)) = self.table else {
            return Ok(());
        };
        let mut content = Vec::new();
        let written = Table::of(plan, rows).write(format, &mut content);
        written.map_err(|error| Failure::file(&path, format!("cannot be written: {error}")))?;
        save(&path, &content)
    }
}

/// Writes a file at once.
pub fn save(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let (output, file) = Output::create(path)?;
    output.write(file, content)
}
