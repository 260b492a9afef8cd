//! The serial line, and a guard that stops the robot if this process dies.

use rustix::fs::{Mode, OFlags};
use rustix::termios::{self, OptionalActions, QueueSelector};
use std::io;
use std::os::fd::OwnedFd;
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A serial line at 115200 baud, 8 bits, no parity, without flow control. Reads and writes do not block.
#[derive(Debug)]
pub struct SerialLine {
    file: OwnedFd,
}

impl SerialLine {
    /// Opens the device at `path`, e.g. `/dev/ttyUSB0`, at `baud` bits per second, and discards the bytes received so
    /// far.
    ///
    /// # Errors
    /// It is missing, not permitted, or not a terminal.
    pub fn open(path: &Path, baud: u32) -> io::Result<SerialLine> {
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let file = rustix::fs::open(path, flags, Mode::empty())?;
        let mut settings = termios::tcgetattr(&file)?;
        settings.make_raw();
        settings.set_speed(baud)?;
        settings.control_modes |= termios::ControlModes::CLOCAL | termios::ControlModes::CREAD;
        termios::tcsetattr(&file, OptionalActions::Now, &settings)?;
        termios::tcflush(&file, QueueSelector::IFlush)?;
        Ok(SerialLine { file })
    }

    /// Sends all bytes or fails; the next command would complete a command that is sent in part.
    ///
    /// # Errors
    /// The line is closed or accepts no more bytes.
    pub fn send(&self, bytes: &[u8]) -> io::Result<()> {
        let sent = rustix::io::write(&self.file, bytes)?;
        if sent < bytes.len() {
            return Err(io::Error::new(
                io::ErrorKind::WouldBlock,
                "the serial line accepts no more bytes; check that the robot is connected",
            ));
        }
        Ok(())
    }

    /// The bytes that have arrived; none if nothing has.
    ///
    /// # Errors
    /// The line is closed.
    pub fn receive<'a>(&self, buffer: &'a mut [u8]) -> io::Result<&'a [u8]> {
        match rustix::io::read(&self.file, &mut *buffer) {
            Ok(length) => Ok(&buffer[..length]),
            Err(rustix::io::Errno::AGAIN | rustix::io::Errno::INTR) => Ok(&[]),
            Err(error) => Err(error.into()),
        }
    }
}

/// A small process that stops the robot when this process ends in any way, `kill -9` included.
///
/// The Open Interface has no watchdog: a robot whose computer stops sending drives on. The guard waits at the other end
/// of a pipe, which the kernel closes with this process, and then sends the stop command twice, so that one gets
/// through even if the last command was cut short.
#[derive(Debug)]
pub struct Guard {
    child: Child,
}

/// Both wheels at speed 0, as `printf` of the shell writes it.
const STOP: &str = r"\221\000\000\000\000";

impl Guard {
    /// Starts a guard over the line at `path`.
    ///
    /// # Errors
    /// If `sh` cannot be started.
    pub fn start(path: &Path) -> io::Result<Guard> {
        let script = format!(
            "trap '' INT TERM HUP QUIT; [ -c \"$1\" ] && exec 3>\"$1\" || exit; cat; printf '{STOP}{STOP}' >&3"
        );
        let child = Command::new("sh")
            .args(["-c", &script, "starl-create-guard"])
            .arg(path)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()?;
        Ok(Guard { child })
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
    }
}
