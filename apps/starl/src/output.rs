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
            let file = File::options()
                .write(true)
                .open(path)
                .map_err(|error| cannot(path, &error))?;
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
    let is_special = is_special(path)?;
    let mut options = File::options();
    options
        .write(true)
        .create(!is_special)
        .truncate(!is_special);
    options.open(path).map_err(|error| cannot(path, &error))
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
