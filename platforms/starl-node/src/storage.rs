//! Storage of a robot that survives restarts: a log in a file that survives `kill -9` and power loss.
//!
//! Each write is appended as one record with its length and checksum, and is on the disk before the robot continues. An
//! incomplete record, cut short by a crash, is ignored when the file is read. When the log has grown to a multiple of
//! its content, a new file with the values alone replaces it by a rename.

use starl_core::{Save, Saved};
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The first bytes of a file.
const MAGIC: [u8; 8] = *b"starl\0s1";

/// A log is not made smaller below this size, bytes.
const SMALL: u64 = 64 << 10;

/// The storage of one robot. Only one process at a time can open it.
#[derive(Debug)]
pub struct Storage {
    path: PathBuf,
    file: File,
    saved: Saved,
    size: u64,
    /// At this size the log is made smaller.
    limit: u64,
}

impl Storage {
    /// Opens or creates the storage in a file. A file that is damaged in the middle counts as lost: what follows the
    /// damage is not used, and [`Saved::is_whole`] says so.
    ///
    /// # Errors
    /// If the file cannot be read or written, is not a storage file, or is open in another process.
    pub fn open(path: &Path) -> io::Result<Storage> {
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)?;
        file.try_lock().map_err(|error| match error {
            std::fs::TryLockError::WouldBlock => io::Error::new(
                io::ErrorKind::ResourceBusy,
                "another process uses it; does this robot run already?",
            ),
            std::fs::TryLockError::Error(error) => error,
        })?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let (saved, mut size) = match bytes.is_empty() {
            true => (Saved::default(), 0),
            false => recover(&bytes)?,
        };
        let is_whole = saved.is_whole();
        if is_whole {
            // The next record overwrites an incomplete record.
            file.set_len(size)?;
            file.seek(SeekFrom::Start(size))?;
        }
        if is_whole && size == 0 {
            file.write_all(&MAGIC)?;
            file.sync_all()?;
            sync_folder(path)?;
            size = MAGIC.len() as u64;
        }
        let mut storage = Storage {
            path: path.to_path_buf(),
            file,
            saved,
            size,
            limit: 0,
        };
        storage.limit = SMALL.max(storage.size * 4);
        if !is_whole {
            // The next life must know of the loss too, so the damaged file stays until one that tells it takes its place.
            storage.compact()?;
        }
        Ok(storage)
    }

    /// The stored values.
    pub fn saved(&self) -> &Saved {
        &self.saved
    }

    /// Writes all of `saves`, or none if the process or the machine dies meanwhile. When this returns they are on the
    /// disk.
    ///
    /// # Errors
    /// If the disk is full or fails.
    pub fn write(&mut self, saves: Vec<Save>) -> io::Result<()> {
        let content = postcard::to_allocvec(&saves).map_err(io::Error::other)?;
        let record = framed(WRITE, &content);
        let written = self
            .file
            .write_all(&record)
            .and_then(|()| self.file.sync_data());
        if let Err(error) = written {
            // Half a record must not stand before the next one.
            let _ = self.file.set_len(self.size);
            let _ = self.file.seek(SeekFrom::Start(self.size));
            return Err(error);
        }
        self.size += record.len() as u64;
        for save in saves {
            self.saved.apply(save);
        }
        if self.size > self.limit {
            self.compact()?;
        }
        Ok(())
    }

    /// Puts a file in place of the log that holds no value twice.
    fn compact(&mut self) -> io::Result<()> {
        let mut path = self.path.clone().into_os_string();
        path.push(".new");
        let path = PathBuf::from(path);
        let mut file = File::create(&path)?;
        file.try_lock().map_err(io::Error::from)?;
        let snapshot = postcard::to_allocvec(&self.saved).map_err(io::Error::other)?;
        file.write_all(&MAGIC)?;
        let bytes = framed(SNAPSHOT, &snapshot);
        file.write_all(&bytes)?;
        file.sync_all()?;
        std::fs::rename(&path, &self.path)?;
        sync_folder(&self.path)?;
        self.size = (MAGIC.len() + bytes.len()) as u64;
        self.limit = SMALL.max(self.size * 4);
        self.file = file;
        Ok(())
    }
}

/// Kinds of records.
const WRITE: u8 = 1;
const SNAPSHOT: u8 = 2;

/// Length of kind, length and checksum before a record's content.
const HEAD: usize = 1 + 4 + 4;

fn framed(kind: u8, content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![kind];
    bytes.extend((content.len() as u32).to_le_bytes());
    bytes.extend(checksum(kind, content).to_le_bytes());
    bytes.extend(content);
    bytes
}

fn checksum(kind: u8, content: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&[kind]);
    hasher.update(&(content.len() as u32).to_le_bytes());
    hasher.update(content);
    hasher.finalize()
}

/// The content of a file, and the number of bytes in complete records.
fn recover(bytes: &[u8]) -> io::Result<(Saved, u64)> {
    if bytes.len() < MAGIC.len() && MAGIC.starts_with(bytes) {
        // The first start was cut short before anything was saved.
        return Ok((Saved::lost(), 0));
    }
    let Some(mut rest) = bytes.strip_prefix(&MAGIC) else {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "this is not a robot's storage",
        ));
    };
    let mut saved = Saved::default();
    while let Some((kind, content, behind)) = next(rest) {
        match kind {
            SNAPSHOT => saved = postcard::from_bytes(content).map_err(io::Error::other)?,
            _ => {
                let saves: Vec<Save> = postcard::from_bytes(content).map_err(io::Error::other)?;
                saves.into_iter().for_each(|save| saved.apply(save));
            }
        }
        rest = behind;
    }
    let size = (bytes.len() - rest.len()) as u64;
    if !is_torn_end(rest) {
        return Ok((Saved::lost(), size));
    }
    Ok((saved, size))
}

/// The first record with its kind and content, and what stands behind it; none if it is not whole.
fn next(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (head, rest) = bytes.split_at_checked(HEAD)?;
    let kind = head[0];
    let length = u32::from_le_bytes(head[1..5].try_into().ok()?) as usize;
    let sum = u32::from_le_bytes(head[5..9].try_into().ok()?);
    let (content, behind) = rest.split_at_checked(length)?;
    let is_known = kind == WRITE || kind == SNAPSHOT;
    (is_known && sum == checksum(kind, content)).then_some((kind, content, behind))
}

/// Whether what is behind the last whole record can be one write that a crash cut short. Only then is nothing lost that
/// the robot has told others of: whole records behind it were written later.
fn is_torn_end(rest: &[u8]) -> bool {
    (1..rest.len()).all(|skip| next(&rest[skip..]).is_none())
}

fn sync_folder(path: &Path) -> io::Result<()> {
    match path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
    {
        Some(folder) => File::open(folder)?.sync_all(),
        None => File::open(".")?.sync_all(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::{Port, message};

    fn save(key: &'static str, value: u64) -> Save {
        Save {
            port: Port(7),
            key: key.into(),
            value: Some(message::encode(&value)),
        }
    }

    /// A folder that is removed with its files at the end of the test.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Folder {
            let name = format!("starl-storage-{name}-{}", std::process::id());
            let folder = Folder(std::env::temp_dir().join(name));
            std::fs::create_dir_all(&folder.0).unwrap();
            folder
        }

        fn file(&self) -> PathBuf {
            self.0.join("r1.store")
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_value_is_there_after_reopening() {
        let folder = Folder::new("reopen");
        let path = folder.file();
        for round in 0..5 {
            let mut storage = Storage::open(&path).unwrap();
            assert_eq!(
                storage.saved().get::<u64>(Port(7), "a"),
                (round > 0).then(|| round - 1)
            );
            storage.write(vec![save("a", round), save("b", 3)]).unwrap();
        }
    }

    #[test]
    fn a_log_that_grows_is_made_smaller_and_keeps_its_values() {
        let folder = Folder::new("compact");
        let path = folder.file();
        let mut storage = Storage::open(&path).unwrap();
        for round in 0..4000 {
            storage.write(vec![save("a", round), save("b", 3)]).unwrap();
        }
        assert!(std::fs::metadata(&path).unwrap().len() < 80_000);
        drop(storage);
        let storage = Storage::open(&path).unwrap();
        assert_eq!(storage.saved().get::<u64>(Port(7), "a"), Some(3999));
        assert_eq!(storage.saved().get::<u64>(Port(7), "b"), Some(3));
    }

    #[test]
    fn a_file_cut_anywhere_holds_all_writes_that_are_whole() {
        let folder = Folder::new("cut");
        let path = folder.file();
        let mut storage = Storage::open(&path).unwrap();
        let mut ends = vec![storage.size];
        for round in 0..6 {
            storage
                .write(vec![save("a", round), save("b", 1000 * round)])
                .unwrap();
            ends.push(storage.size);
        }
        drop(storage);
        let bytes = std::fs::read(&path).unwrap();
        for cut in MAGIC.len()..=bytes.len() {
            std::fs::write(&path, &bytes[..cut]).unwrap();
            let storage = Storage::open(&path).unwrap();
            let whole = ends.iter().rposition(|&end| end as usize <= cut).unwrap();
            assert!(storage.saved().is_whole(), "cut at {cut}");
            let expected = whole.checked_sub(1).map(|round| round as u64);
            assert_eq!(
                storage.saved().get::<u64>(Port(7), "a"),
                expected,
                "cut at {cut}"
            );
        }
    }

    #[test]
    fn a_file_damaged_in_the_middle_counts_as_lost() {
        let folder = Folder::new("damage");
        let path = folder.file();
        let mut storage = Storage::open(&path).unwrap();
        for round in 0..6 {
            storage.write(vec![save("a", round)]).unwrap();
        }
        drop(storage);
        let mut bytes = std::fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 0x55;
        std::fs::write(&path, &bytes).unwrap();
        for life in 1..3 {
            let storage = Storage::open(&path).unwrap();
            assert!(!storage.saved().is_whole(), "life {life}");
        }
    }

    #[test]
    fn two_processes_cannot_share_a_file() {
        let folder = Folder::new("lock");
        let path = folder.file();
        let _storage = Storage::open(&path).unwrap();
        let error = Storage::open(&path).unwrap_err();
        assert!(error.to_string().contains("another process"), "{error}");
    }

    #[test]
    fn another_file_is_refused() {
        let folder = Folder::new("other");
        let path = folder.file();
        std::fs::write(&path, "a text that is not a storage file").unwrap();
        assert!(
            Storage::open(&path)
                .unwrap_err()
                .to_string()
                .contains("not a robot's storage")
        );
    }
}
