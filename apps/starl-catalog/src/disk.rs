//! Files of the disk, for front ends that have one.

use starl_core::FileError;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Larger files are not scenarios, programs, world files or images.
const LARGEST: u64 = 256 << 20;

/// The content of a file.
///
/// # Errors
/// If there is no such file, it is a folder or a device, is larger than 256 MiB, or cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    let read = || {
        let mut bytes = Vec::new();
        open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let bytes = read().map_err(|error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => FileError::Missing,
        _ => FileError::Unreadable(reason(&error)),
    })?;
    match bytes.len() as u64 > LARGEST {
        true => Err(FileError::Unreadable("it is larger than 256 MiB".into())),
        false => Ok(bytes),
    }
}

/// Opens a file for reading. Refuses pipes and devices: opening a pipe would wait for its writer.
///
/// # Errors
/// If there is no such file, it is a pipe or a device, or it cannot be read.
#[allow(
    clippy::disallowed_methods,
    reason = "only front ends that have a disk hand this in"
)]
pub fn open(path: &Path) -> io::Result<File> {
    let kind = std::fs::metadata(path)?;
    if !kind.is_file() && !kind.is_dir() {
        return Err(io::Error::other("it is not an ordinary file"));
    }
    File::open(path)
}

/// The reason of a failure with a file, in words.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file or folder".to_string(),
        io::ErrorKind::PermissionDenied => "permission denied".to_string(),
        io::ErrorKind::StorageFull => "the disk is full".to_string(),
        io::ErrorKind::IsADirectory => "it is a folder".to_string(),
        io::ErrorKind::NotADirectory => "a part of the path is not a folder".to_string(),
        _ => error.to_string(),
    }
}
