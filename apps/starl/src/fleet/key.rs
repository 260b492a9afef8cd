//! The key of a fleet: 32 random bytes in a file that only its owner may read.

use crate::args::FleetKeyArguments;
use crate::console;
use crate::failure::Failure;
use starl_catalog::disk::reason;
use starl_node::link::Key;
use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::Path;

/// How many keys a file may hold: the present one, and the one before it while a fleet changes its key.
const MOST: usize = 2;

/// `starl fleet key`: makes a key, or the next one.
pub fn make(arguments: &FleetKeyArguments) -> Result<bool, Failure> {
    let path = arguments.fleet.with_extension("key");
    let mut keys = match (path.exists(), arguments.change) {
        (true, false) => {
            return Err(Failure::file(
                &path,
                "there is a key already; --change makes a new one, and keeps this one until all robots have the new one",
            ));
        }
        (true, true) => read(&path, &arguments.fleet)?,
        (false, _) => Vec::new(),
    };
    keys.insert(0, fresh()?);
    keys.truncate(MOST);
    write(&path, &keys)?;
    console::print(&format!(
        "{}: copy it to every robot of the fleet\n",
        path.display()
    ))?;
    Ok(true)
}

/// Makes a key if there is none, for a fleet on this machine.
pub fn make_if_missing(path: &Path) -> Result<(), Failure> {
    match path.exists() {
        true => Ok(()),
        false => write(path, &[fresh()?]),
    }
}

/// The keys in a file, the one to be used first.
pub fn read(path: &Path, fleet: &Path) -> Result<Vec<Key>, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        let help = format!(
            "`starl fleet key {}` makes a key; `link.protected = false` in the fleet file does without",
            fleet.display()
        );
        let error = reason(&error);
        Failure::file(path, format!("the fleet's key cannot be read: {error}; {help}"))
    })?;
    let lines = text.lines().map(str::trim);
    let lines: Vec<&str> = lines
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .collect();
    let keys: Option<Vec<Key>> = lines.iter().map(|line| key(line)).collect();
    match keys {
        Some(keys) if !keys.is_empty() => Ok(keys),
        _ => Err(Failure::file(
            path,
            format!(
                "a key is 64 hexadecimal digits on a line of their own; copy the file again, or remove it and make a new one with `starl fleet key {}`",
                fleet.display()
            ),
        )),
    }
}

fn key(line: &str) -> Option<Key> {
    let mut key = [0; 32];
    if line.len() != 64 || !line.is_ascii() {
        return None;
    }
    for (index, byte) in key.iter_mut().enumerate() {
        *byte = u8::from_str_radix(&line[2 * index..2 * index + 2], 16).ok()?;
    }
    Some(key)
}

fn fresh() -> Result<Key, Failure> {
    let mut key = [0; 32];
    getrandom::fill(&mut key)
        .map_err(|error| Failure(format!("the system gives no random numbers: {error}")))?;
    Ok(key)
}

fn write(path: &Path, keys: &[Key]) -> Result<(), Failure> {
    let digits = |key: &Key| {
        key.iter()
            .map(|byte| format!("{byte:02x}"))
            .collect::<String>()
    };
    let mut text =
        "# The first line is the key of the fleet, the second one its previous key. Anyone with a key can drive the robots.\n"
            .to_string();
    for key in keys {
        text.push_str(&digits(key));
        text.push('\n');
    }
    let write = || -> io::Result<()> {
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let mut file = options.open(path)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()
    };
    write().map_err(|error| {
        Failure::file(
            path,
            format!("the key cannot be written: {}", reason(&error)),
        )
    })
}
