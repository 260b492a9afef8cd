//! Files that are written at the end of a run, or while it continues.
//!
//! Invariant, but for traces: under the name that was asked for there is a whole file or what was there before, never
//! half a file: what is written goes to a temporary file beside it, which takes the name at the end.
//! That the place can be written to is found out before the run starts.

use crate::failure::Failure;
use starl_catalog::disk::reason;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Lets a write beyond the limit of file sizes (`ulimit -f`) fail like one to a full disk. By default its signal ends the
/// process, without a message and without the end of a trace.
pub fn fail_beyond_size_limit() {
    #[cfg(unix)]
    {
        let is_over = std::sync::Arc::default();
        // Where the signal cannot be caught, the process still ends.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, is_over);
    }
}

/// A file in the making. It is thrown away unless [`Output::commit`] is called.
#[derive(Debug)]
pub struct Output {
    /// As it was given.
    path: PathBuf,
    /// Where it leads if it is a link, so that the link stays.
    target: PathBuf,
    /// None where there is nothing to rename, such as a pipe or a device.
    temporary: Option<PathBuf>,
}

impl Output {
    /// Opens a file that is to be called `path`.
    pub fn create(path: &Path) -> Result<(Output, File), Failure> {
        let target = identity(path);
        if is_special(path)? {
            let file = open_special(path)?;
            return Ok((
                Output {
                    path: path.to_path_buf(),
                    target,
                    temporary: None,
                },
                file,
            ));
        }
        let Some(name) = target.file_name() else {
            return Err(Failure::file(path, "is not the name of a file; name one"));
        };
        let mut name = name.to_os_string();
        name.push(format!(".partial-{}", std::process::id()));
        let temporary = target.with_file_name(name);
        let file = File::create(&temporary).map_err(|error| cannot(path, &error))?;
        Ok((
            Output {
                path: path.to_path_buf(),
                target,
                temporary: Some(temporary),
            },
            file,
        ))
    }

    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the finished file its name.
    pub fn commit(mut self) -> Result<(), Failure> {
        let Some(temporary) = self.temporary.take() else {
            return Ok(());
        };
        fs::rename(&temporary, &self.target).map_err(|error| {
            let _ = fs::remove_file(&temporary);
            Failure::file(&self.path, format!("cannot be written: {}", reason(&error)))
        })
    }

    /// Writes all of a file at once and gives it its name.
    pub fn write(self, mut file: File, content: &[u8]) -> Result<(), Failure> {
        file.write_all(content)
            .and_then(|()| file.flush())
            .map_err(|error| {
                Failure::file(&self.path, format!("cannot be written: {}", reason(&error)))
            })?;
        self.commit()
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            let _ = fs::remove_file(temporary);
        }
    }
}

/// Opens a file under its own name and discards its old content. It is a regular file unless the name is that of a
/// pipe, a device or the like.
pub fn create_now(path: &Path) -> Result<File, Failure> {
    if is_special(path)? {
        return open_special(path);
    }
    File::create(path).map_err(|error| cannot(path, &error))
}

/// Opens a pipe, a device or the like. A pipe needs a reader: opening one without would wait for it, perhaps for ever.
fn open_special(path: &Path) -> Result<File, Failure> {
    #[cfg(unix)]
    if is_pipe(path) {
        return open_pipe(path);
    }
    let opened = File::options().write(true).open(path);
    opened.map_err(|error| cannot(path, &error))
}

#[cfg(unix)]
fn is_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    fs::metadata(path).is_ok_and(|found| found.file_type().is_fifo())
}

/// How long the reader of a pipe, which a shell may start at the same moment, has to open it.
#[cfg(unix)]
const READER_AFTER: std::time::Duration = std::time::Duration::from_secs(1);

#[cfg(unix)]
fn open_pipe(path: &Path) -> Result<File, Failure> {
    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
    use rustix::io::Errno;
    use std::os::unix::fs::OpenOptionsExt;
    let start = std::time::Instant::now();
    let mut options = File::options();
    options
        .write(true)
        .custom_flags(OFlags::NONBLOCK.bits() as i32);
    let file = loop {
        match options.open(path) {
            Ok(file) => break file,
            Err(error) if Errno::from_io_error(&error) == Some(Errno::NXIO) => {
                if start.elapsed() >= READER_AFTER {
                    let problem =
                        "is a pipe that no program reads; start its reader first, or name a file";
                    return Err(Failure::file(path, problem));
                }
                std::thread::sleep(std::time::Duration::from_millis(10));
            }
            Err(error) => return Err(cannot(path, &error)),
        }
    };
    // A slow reader makes writing wait.
    fcntl_getfl(&file)
        .and_then(|flags| fcntl_setfl(&file, flags.difference(OFlags::NONBLOCK)))
        .map_err(|error| cannot(path, &error.into()))?;
    Ok(file)
}

/// Whether a path that is to be written to is that of a pipe, a device or the like.
fn is_special(path: &Path) -> Result<bool, Failure> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(Failure::file(path, "is a folder; name a file in it")),
        Ok(found) if found.permissions().readonly() => {
            Err(cannot(path, &io::ErrorKind::PermissionDenied.into()))
        }
        Ok(found) => Ok(!found.is_file()),
        Err(_) => Ok(false),
    }
}

fn cannot(path: &Path, error: &io::Error) -> Failure {
    Failure::file(
        path,
        format!("cannot be written: {}; choose another path", reason(error)),
    )
}

/// The file that a path means, however it is written: two paths that mean the same file give the same.
pub fn identity(path: &Path) -> PathBuf {
    if let Ok(found) = fs::canonicalize(path) {
        return found;
    }
    // It is still to be made, in a folder that may be there.
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    match (fs::canonicalize(folder), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_path_buf(),
    }
}
