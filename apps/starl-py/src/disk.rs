//! Files of the disk, for scenarios and programs.

use std::fs::{self, File};
use std::io::{self, Read};

/// Larger files are no scenarios, programs or world files.
const LARGEST: u64 = 256 << 20;

/// The content of a file, or why it cannot be read.
pub fn read(path: &str) -> Result<Vec<u8>, String> {
    let read = || {
        // Opening a pipe would wait for its writer.
        if !fs::metadata(path)?.is_file() {
            return Err(io::Error::other("it is not an ordinary file"));
        }
        let mut bytes = Vec::new();
        File::open(path)?
            .take(LARGEST + 1)
            .read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    match read() {
        Ok(bytes) if bytes.len() as u64 > LARGEST => Err("it is larger than 256 MiB".to_string()),
        Ok(bytes) => Ok(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err("there is no such file".to_string())
        }
        Err(error) => Err(error.to_string()),
    }
}
