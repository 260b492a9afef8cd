//! The file of a trace during its run. It is never discarded.
//!
//! Invariant: from the start of the run there is a readable file under the requested name. It contains all full chunks,
//! followed by the messages of the current chunk, which are rewritten once a second. So a killed process loses at most
//! a second, or the chunk that it was writing. A finished trace contains no sign of this, so the wall time of a run
//! does not change it.

use crate::failure::Failure;
use crate::output::create_now;
use starl_catalog::recording;
use starl_core::{Record, Time};
use starl_host::journal::{self, Batch, Packer};
use starl_properties::Setting;
use starl_sim::read::Resolved;
use starl_trace::{Outcome, ViewOptions, WriteError, Writer};
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// How long messages stay in memory at the longest.
const PERIOD: Duration = Duration::from_secs(1);

/// A trace in the making.
pub struct TraceOutput {
    path: PathBuf,
    writer: Writer<Chunks>,
    ending: Ending,
    packer: Packer,
    /// Up to where everything that happened was given to the writer.
    now: Time,
}

/// The destination of the writer's bytes.
struct Chunks {
    file: File,
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    /// How many bytes were written.
    written: AtomicU64,
    /// How many of them belong to chunks that are whole.
    complete: AtomicU64,
    /// Whether nothing more may be written.
    is_closed: AtomicBool,
}

/// The end of the file, where the messages of the unfinished chunk go.
struct Ending {
    /// Another handle of the file, which has its place in common with the writer's.
    file: File,
    state: Arc<State>,
    /// Whether one can go back in the file.
    is_regular: bool,
    /// Where the full chunks end.
    start: u64,
    /// How many bytes behind that are in the file.
    saved: usize,
    /// When the last were saved.
    at: Instant,
}

impl TraceOutput {
    /// Opens the file and writes what stands before the records.
    pub fn create(
        path: &Path,
        resolved: &Resolved,
        setting: &Setting,
        inputs: bool,
    ) -> Result<TraceOutput, Failure> {
        let cannot = |error: &dyn std::fmt::Display| {
            Failure::file(path, format!("the trace cannot be written: {error}"))
        };
        let file = create_now(path)?;
        let is_regular = file.metadata().is_ok_and(|found| found.is_file());
        let state = Arc::new(State::default());
        let mut ending = Ending {
            file: file.try_clone().map_err(|error| cannot(&error))?,
            state: state.clone(),
            is_regular,
            start: 0,
            saved: 0,
            at: Instant::now(),
        };
        let chunks = Chunks { file, state };
        let header = recording::header(resolved, setting);
        let begin = || {
            let mut writer = Writer::new(chunks, &header, &ViewOptions::default())?;
            if inputs {
                writer.expect_inputs(journal::VERSION)?;
            }
            Ok(writer)
        };
        let writer = begin().map_err(|error: WriteError| Failure::file(path, error))?;
        ending.follow();
        Ok(TraceOutput {
            path: path.to_path_buf(),
            writer,
            ending,
            packer: Packer::default(),
            now: Time::ZERO,
        })
    }

    /// Writes the next record.
    pub fn write(&mut self, record: &Record) -> Result<(), Failure> {
        let written = self.writer.write(record);
        self.check(written)
    }

    /// Advances to `now`, when all records until then are written, with the calls of robots' software since the last
    /// time.
    pub fn advance(&mut self, journal: &Batch, now: Time) -> Result<(), Failure> {
        if let Some((at, inputs)) = self.packer.pack(journal) {
            let written = self.writer.inputs(at, &inputs);
            self.check(written)?;
        }
        self.now = now;
        match self.ending.at.elapsed() >= PERIOD {
            true => self.save(),
            false => Ok(()),
        }
    }

    /// Flushes all records to the file, so that they are there even if the process is killed.
    pub fn save(&mut self) -> Result<(), Failure> {
        let saved = self.ending.save(self.writer.unfinished());
        self.check(saved.map_err(|error| output_error(&error)))
    }

    /// The size of the file in bytes, without the records that are still in memory.
    pub fn size(&self) -> u64 {
        self.ending.start + self.ending.saved as u64
    }

    /// Completes the file.
    pub fn finish(self, outcome: &Outcome) -> Result<(), Failure> {
        let unfinished = self.writer.unfinished().to_vec();
        let mut ending = self.ending;
        match self.writer.finish(outcome) {
            Ok(_) => Ok(()),
            Err(error) => {
                let unfinished = match ending.follow() {
                    true => &[][..],
                    false => &unfinished,
                };
                Err(ending.rescue(unfinished, &self.path, &error, self.now))
            }
        }
    }

    /// Notes how far the file has come, or else saves what can be saved.
    fn check(&mut self, written: Result<(), WriteError>) -> Result<(), Failure> {
        match written {
            Ok(()) => {
                self.ending.follow();
                Ok(())
            }
            Err(error) => {
                self.ending.follow();
                let unfinished = self.writer.unfinished();
                Err((self.ending).rescue(unfinished, &self.path, &error, self.now))
            }
        }
    }
}

impl Ending {
    /// Notes where the full chunks end now; whether there are more than before.
    fn follow(&mut self) -> bool {
        let complete = self.state.complete.load(Ordering::Relaxed);
        let has_grown = complete != self.start;
        if has_grown {
            self.start = complete;
            self.saved = 0;
        }
        has_grown
    }

    /// Puts the messages of the unfinished chunk at the end of the file; the next chunk goes in their place.
    fn save(&mut self, unfinished: &[u8]) -> io::Result<()> {
        self.at = Instant::now();
        if !self.is_regular {
            return Ok(());
        }
        let saved = self.append(unfinished);
        self.file.seek(SeekFrom::Start(self.start))?;
        saved
    }

    /// Writes what is not in the file yet, as far as that is possible.
    fn append(&mut self, unfinished: &[u8]) -> io::Result<()> {
        let end = self.start + self.saved as u64;
        self.file.seek(SeekFrom::Start(end))?;
        while self.saved < unfinished.len() {
            match self.file.write(&unfinished[self.saved..]) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(written) => self.saved += written,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// After a failure keeps as much in the file as goes into it, and says so.
    fn rescue(&mut self, unfinished: &[u8], path: &Path, error: &WriteError, now: Time) -> Failure {
        if !self.is_regular {
            return Failure::file(path, error);
        }
        // A chunk of which only a part went into the file has overwritten what was saved.
        self.saved = 0;
        self.state.is_closed.store(true, Ordering::Relaxed);
        let whole = self.append(unfinished).is_ok();
        let end = self.start + self.saved as u64;
        let cut = self.file.set_len(end);
        let kept = match (whole, cut) {
            (_, Err(error)) => format!("the file may be damaged: {error}"),
            (true, Ok(())) => format!("all up to {now} is kept in it"),
            (false, Ok(())) => {
                format!(
                    "the run had come to {now}; its beginning, as far as it fits, is kept in it"
                )
            }
        };
        Failure::file(
            path,
            format!("{error}; {kept}, and `starl replay` takes it"),
        )
    }
}

impl Write for Chunks {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.state.is_closed.load(Ordering::Relaxed) {
            return Err(io::Error::other("the trace has ended"));
        }
        let written = self.file.write(bytes)?;
        (self.state.written).fetch_add(written as u64, Ordering::Relaxed);
        Ok(written)
    }

    /// The writer flushes when a chunk is whole.
    fn flush(&mut self) -> io::Result<()> {
        let written = self.state.written.load(Ordering::Relaxed);
        self.state.complete.store(written, Ordering::Relaxed);
        self.file.flush()
    }
}

fn output_error(error: &io::Error) -> WriteError {
    WriteError::Output {
        what: error.to_string(),
    }
}
