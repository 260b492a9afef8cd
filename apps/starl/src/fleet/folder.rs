//! The folder of one life of a fleet: its epoch, each robot's storage, and the robots' traces.

use crate::failure::Failure;
use starl_catalog::disk::reason;
use starl_node::WallClock;
use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A folder.
pub struct Folder(pub PathBuf);

impl Folder {
    /// The folder of the next run of a fleet, or of the last one.
    pub fn of(fleet: &Path, is_new: bool) -> Result<Folder, Failure> {
        let runs = fleet.with_extension("runs");
        let number = match is_new {
            true => numbers(&runs).max().unwrap_or(0) + 1,
            false => last_run(&runs).unwrap_or(1),
        };
        Folder::open(&runs.join(name(number)))
    }

    /// The folder of the last run of a fleet.
    pub fn last(fleet: &Path) -> Result<Folder, Failure> {
        let runs = fleet.with_extension("runs");
        let last =
            last_run(&runs).ok_or_else(|| Failure::file(&runs, "the fleet has not run yet"))?;
        Ok(Folder(runs.join(name(last))))
    }

    /// Opens or makes this folder.
    pub fn open(path: &Path) -> Result<Folder, Failure> {
        fs::create_dir_all(path).map_err(|error| {
            Failure::file(
                path,
                format!("the folder cannot be made: {}", reason(&error)),
            )
        })?;
        Ok(Folder(path.to_path_buf()))
    }

    /// When the time of this run began, since 1970: what the first robot that starts says.
    pub fn epoch(&self) -> Result<Duration, Failure> {
        let path = self.0.join("epoch");
        let now = WallClock::system();
        let made = OpenOptions::new().write(true).create_new(true).open(&path);
        let made = made.and_then(|mut file| {
            file.write_all(format!("{}\n", now.as_nanos()).as_bytes())?;
            file.sync_all()
        });
        match made {
            Ok(()) => Ok(now),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => read_epoch(&path),
            Err(error) => Err(Failure::file(&path, reason(&error))),
        }
    }

    /// Where a robot keeps its storage.
    pub fn storage(&self, robot: &str) -> PathBuf {
        self.0.join(format!("{robot}.storage"))
    }

    /// The trace of a robot's next life.
    pub fn next_trace(&self, robot: &str) -> PathBuf {
        let lives = self.traces_of(robot).len();
        self.0.join(format!("{robot}.{}.mcap", lives + 1))
    }

    /// The traces of a robot's lives, in their order.
    pub fn traces_of(&self, robot: &str) -> Vec<PathBuf> {
        let path = |life: usize| self.0.join(format!("{robot}.{life}.mcap"));
        (1..).map(path).take_while(|path| path.exists()).collect()
    }
}

/// Another robot may be about to write it.
fn read_epoch(path: &Path) -> Result<Duration, Failure> {
    for _ in 0..50 {
        let text = fs::read_to_string(path).map_err(|error| Failure::file(path, reason(&error)))?;
        if let Some(Ok(nanoseconds)) = text.strip_suffix('\n').map(str::parse) {
            return Ok(Duration::from_nanos(nanoseconds));
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Err(Failure::file(
        path,
        "holds no number of nanoseconds since 1970",
    ))
}

/// The last run with a trace: a fleet that could not start has left none. Otherwise the last one.
fn last_run(runs: &Path) -> Option<u32> {
    let has_trace = |number: &u32| {
        let entries = fs::read_dir(runs.join(name(*number))).into_iter().flatten();
        let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        paths.any(|path| path.extension().is_some_and(|suffix| suffix == "mcap"))
    };
    let begun = numbers(runs).filter(has_trace).max();
    begun.or_else(|| numbers(runs).max())
}

fn numbers(runs: &Path) -> impl Iterator<Item = u32> + use<> {
    let entries = fs::read_dir(runs).into_iter().flatten();
    entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
}

fn name(number: u32) -> String {
    format!("{number:04}")
}
