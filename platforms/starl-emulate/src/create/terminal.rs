//! A pseudo-terminal, as the robot's end of a serial line.

use rustix::event::{PollFd, PollFlags, poll};
use rustix::fs::{Mode, OFlags};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{self, OptionalActions};
use std::ffi::OsStr;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

#[derive(Debug)]
pub(super) struct Terminal {
    master: OwnedFd,
    /// The computer's end, held open so that the line stays up while no driver has it open.
    _slave: OwnedFd,
    path: PathBuf,
}

impl Terminal {
    pub fn open() -> io::Result<Terminal> {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let path = ptsname(&master, Vec::new())?;
        let path = PathBuf::from(OsStr::from_bytes(path.to_bytes()));
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC;
        let slave = rustix::fs::open(&path, flags, Mode::empty())?;
        // A terminal echoes and edits lines unless told otherwise; a serial line does neither.
        let mut settings = termios::tcgetattr(&slave)?;
        settings.make_raw();
        termios::tcsetattr(&slave, OptionalActions::Now, &settings)?;
        let flags = rustix::fs::fcntl_getfl(&master)?;
        rustix::fs::fcntl_setfl(&master, flags | OFlags::NONBLOCK)?;
        Ok(Terminal {
            master,
            _slave: slave,
            path,
        })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The bytes that have arrived; none if nothing arrives within `wait`.
    pub fn receive<'a>(&self, buffer: &'a mut [u8], wait: Duration) -> io::Result<&'a [u8]> {
        let mut waiting = [PollFd::new(&self.master, PollFlags::IN)];
        let wait = wait.try_into().expect("a few milliseconds");
        match poll(&mut waiting, Some(&wait)) {
            Ok(0) | Err(rustix::io::Errno::INTR) => return Ok(&[]),
            Ok(_) => {}
            Err(error) => return Err(error.into()),
        }
        match rustix::io::read(&self.master, &mut *buffer) {
            Ok(length) => Ok(&buffer[..length]),
            Err(rustix::io::Errno::AGAIN | rustix::io::Errno::INTR) => Ok(&[]),
            Err(error) => Err(error.into()),
        }
    }

    /// Sends bytes. Like a serial line, it loses bytes that are not read in time.
    pub fn send(&self, bytes: &[u8]) {
        if !bytes.is_empty() {
            let _ = rustix::io::write(&self.master, bytes);
        }
    }
}
