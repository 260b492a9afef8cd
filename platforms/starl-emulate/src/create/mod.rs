//! An emulated Create: the model `create` behind the Open Interface on a pseudo-terminal.
//!
//! It answers as a Create 2 does, and knows the packets of the older Create, which are a part of those. It differs from
//! hardware in this: distances and angles keep their remainders from one packet to the next, mode changes take no time,
//! and the robot has no lights, sound, docking or cleaning; their commands are taken and do nothing.

mod interface;
mod terminal;

use crate::BodyHandle;
use crate::service::Service;
use interface::Interface;
use starl_create::Generation;
use starl_create::command::CommandDecoder;
use starl_create::sensor::Mode;
use starl_motion::{Model, models};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use terminal::Terminal;

/// The model of this robot.
pub fn model(generation: Generation) -> Arc<dyn Model> {
    let distance = generation.wheel_distance();
    models::with_parameters("create", &[("wheel_distance".into(), distance)])
        .expect("the distance between the wheels is in its range")
}

/// Disturbances of a robot besides motion. A cliff or a dropped wheel ends safe mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hazards {
    /// The robot stands at the top of a staircase.
    pub cliff: bool,
    /// The robot is lifted.
    pub wheel_drop: bool,
}

/// A Create on a pseudo-terminal. Dropping it stops the body and closes the terminal.
#[derive(Debug)]
pub struct EmulatedCreate {
    terminal: Arc<Terminal>,
    link: Option<PathBuf>,
    interface: Arc<Mutex<Interface>>,
    service: Service,
}

/// How often the stream is sent.
const STREAM_PERIOD: Duration = Duration::from_millis(15);

impl EmulatedCreate {
    /// Puts `body` behind a new pseudo-terminal, in mode off. A symbolic link `link` to the terminal, if given, is made
    /// and removed at the end, so that a fleet file can name it; one that is left from a run that was killed is replaced.
    ///
    /// # Errors
    /// If the system has no pseudo-terminal left, or the link cannot be made.
    pub fn start(body: BodyHandle, link: Option<&Path>) -> io::Result<EmulatedCreate> {
        let terminal = Arc::new(Terminal::open()?);
        if let Some(link) = link {
            if link.is_symlink() {
                std::fs::remove_file(link)?;
            }
            std::os::unix::fs::symlink(terminal.path(), link)?;
        }
        let interface = Arc::new(Mutex::new(Interface::new(body)));
        let service = {
            let (terminal, interface) = (terminal.clone(), interface.clone());
            let mut decoder = CommandDecoder::default();
            let mut due = Instant::now();
            Service::start(move || turn(&terminal, &interface, &mut decoder, &mut due))
        };
        Ok(EmulatedCreate {
            terminal,
            link: link.map(Path::to_path_buf),
            interface,
            service,
        })
    }

    /// The terminal that emulates the robot's serial line: the link if there is one.
    pub fn path(&self) -> &Path {
        self.link.as_deref().unwrap_or(self.terminal.path())
    }

    /// Lets something happen to the robot, or ends it.
    pub fn set_hazards(&self, hazards: Hazards) {
        lock(&self.interface).set_hazards(hazards);
    }

    /// Puts bytes on the line to the computer, between those of the robot, as a bad cable does.
    pub fn interfere(&self, bytes: &[u8]) {
        self.terminal.send(bytes);
    }

    /// The mode of the robot's interface.
    pub fn mode(&self) -> Mode {
        lock(&self.interface).mode()
    }
}

impl Drop for EmulatedCreate {
    fn drop(&mut self) {
        self.service.end();
        lock(&self.interface).halt();
        if let Some(link) = &self.link {
            let _ = std::fs::remove_file(link);
        }
    }
}

fn turn(
    terminal: &Terminal,
    interface: &Mutex<Interface>,
    decoder: &mut CommandDecoder,
    due: &mut Instant,
) -> io::Result<()> {
    let mut buffer = [0; 256];
    let mut answer = Vec::new();
    let wait = due.saturating_duration_since(Instant::now());
    decoder.push(terminal.receive(&mut buffer, wait)?);
    let mut interface = lock(interface);
    while let Some(command) = decoder.pop() {
        interface.take(&command, &mut answer);
    }
    if Instant::now() >= *due {
        *due = Instant::now() + STREAM_PERIOD;
        interface.tick(&mut answer);
    }
    terminal.send(&answer);
    Ok(())
}

fn lock(interface: &Mutex<Interface>) -> MutexGuard<'_, Interface> {
    interface.lock().unwrap_or_else(PoisonError::into_inner)
}
