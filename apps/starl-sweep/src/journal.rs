//! The journal of a sweep: its finished rows, so that a sweep that was stopped in any way continues where it was.
//!
//! The first line says which plan the journal belongs to; every other line is a row. Only complete lines count: the
//! incomplete last line of a killed process is removed. A journal has one writer at a time.

use crate::{Axis, Error, Measured, Plan, Seeds};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

/// The first line.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Header {
    format: String,
    version: u32,
    starl: String,
    plan: String,
    target: String,
    axes: Vec<Axis>,
    seeds: Seeds,
    profile: Option<String>,
}

const FORMAT: &str = "starl-sweep-journal";
const VERSION: u32 = 1;

impl Header {
    fn of(plan: &Plan) -> Header {
        Header {
            format: FORMAT.to_string(),
            version: VERSION,
            starl: env!("CARGO_PKG_VERSION").to_string(),
            plan: plan.identity(),
            target: plan.target().to_string(),
            axes: plan.axes().to_vec(),
            seeds: plan.seeds(),
            profile: plan.profile().map(str::to_string),
        }
    }

    /// In what another plan differs, for people.
    fn difference(&self, other: &Header) -> &'static str {
        match () {
            () if (&self.format, self.version) != (&other.format, other.version) => "the format",
            () if self.starl != other.starl => "the version of StarL",
            () if self.target != other.target => "the target",
            () if self.axes != other.axes => "the values of --set",
            () if self.seeds != other.seeds => "the seeds",
            () if self.profile != other.profile => "the profile",
            () => "the scenario, a program or a fixed value of --set",
        }
    }
}

impl Journal {
    /// The journal of a table: `results.parquet.journal`.
    pub fn path_of(out: &Path) -> PathBuf {
        let mut name = out.as_os_str().to_os_string();
        name.push(".journal");
        PathBuf::from(name)
    }

    /// Opens the journal at `path`, or begins one, and returns the rows that it has, by number.
    ///
    /// # Errors
    /// If the file belongs to another plan, is damaged, is in use by another process, or cannot be read or written.
    pub fn open(path: &Path, plan: &Plan) -> Result<(Journal, BTreeMap<u64, Measured>), Error> {
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        let opened = options.open(path);
        let mut file = opened.map_err(|error| Error::io(path, "opened", &error))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let message = "another sweep is writing this journal; wait for it, or name another file with --out";
                return Err(Error::file(path, message));
            }
            Err(TryLockError::Error(error)) => return Err(Error::io(path, "locked", &error)),
        }
        let mut text = Vec::new();
        let read = file.read_to_end(&mut text);
        read.map_err(|error| Error::io(path, "read", &error))?;
        let whole = text
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |at| at + 1);
        let rows = rows(path, &text[..whole], plan)?;
        let cut = file.set_len(whole as u64);
        let cut = cut.and_then(|()| file.seek(SeekFrom::End(0)));
        cut.map_err(|error| Error::io(path, "written", &error))?;
        let mut journal = Journal {
            path: path.to_path_buf(),
            file,
        };
        if whole == 0 {
            journal.line(&Header::of(plan))?;
        }
        Ok((journal, rows))
    }

    /// Adds a row. It is in the file when this returns.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&mut self, row: &Measured) -> Result<(), Error> {
        self.line(row)
    }

    fn line(&mut self, value: &impl Serialize) -> Result<(), Error> {
        let text = serde_json::to_vec(value);
        let mut text = text.unwrap_or_else(|error| unreachable!("only plain data: {error}"));
        text.push(b'\n');
        let written: io::Result<()> = self.file.write_all(&text);
        written.map_err(|error| Error::io(&self.path, "written", &error))
    }
}

/// The rows of the complete lines of a journal.
fn rows(path: &Path, text: &[u8], plan: &Plan) -> Result<BTreeMap<u64, Measured>, Error> {
    let mut rows = BTreeMap::new();
    let mut lines = (1_u64..).zip(text.split(|byte| *byte == b'\n'));
    let Some((_, first)) = lines.next().filter(|_| !text.is_empty()) else {
        return Ok(rows);
    };
    let expected = Header::of(plan);
    let Ok(header) = serde_json::from_slice::<Header>(first) else {
        let message = "this is not the journal of a sweep; name another file with --out";
        return Err(Error::file(path, message));
    };
    if header != expected {
        let difference = header.difference(&expected);
        let message = format!(
            "this journal belongs to a sweep that differs in {difference}; delete it to start over, or name another \
             file with --out"
        );
        return Err(Error::file(path, message));
    }
    for (number, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let row = serde_json::from_slice::<Measured>(line).ok();
        let row = row.filter(|Measured { row, .. }| {
            row.number < plan.len() && plan.seed(row.number) == row.seed
        });
        let Some(row) = row else {
            let message =
                format!("line {number} is damaged; delete that line to have its run repeated");
            return Err(Error::file(path, message));
        };
        // The same task has the same row, so a line that is there twice counts once.
        rows.insert(row.row.number, row);
    }
    Ok(rows)
}
