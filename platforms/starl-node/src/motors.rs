//! The thread that has the device: it drives what the program wants, reads what the device measures, and stops the
//! motors when the program does not answer any more.

use crate::{Device, DeviceError, Reading, WallClock};
use starl_core::{Command, Estimate, Pose, RobotId, Time};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Time between two readings.
const PERIOD: Duration = Duration::from_millis(10);

/// How often the command is sent to the device, even if it has not changed.
const REPEAT: Duration = Duration::from_millis(50);

/// How often the command to stop is sent to a stopped device.
const REPEAT_STOP: Duration = Duration::from_millis(200);

/// The motors stop when the program's thread has been silent for this time.
pub const PATIENCE: Duration = Duration::from_millis(500);

/// An external source of the robot's position.
pub trait PositionSource: Send {
    /// The newest pose since the last call with the time of its measurement; none if there is none. Does not block.
    ///
    /// # Errors
    /// The source cannot be reached, or does not know the robot. It is called again.
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError>;

    /// Where other robots were seen since the last call, if the source sees them too. Called after [`Self::poll`].
    fn others(&mut self) -> Vec<(RobotId, Instant, Pose)> {
        Vec::new()
    }
}

/// A report from the device's thread to the program's.
#[derive(Debug)]
pub enum Report {
    /// The device has measured something.
    Measured(Time, Reading),
    /// The robot was seen somewhere.
    Seen(Time, Pose),
    /// Another robot was seen somewhere.
    SawOther(RobotId, Time, Pose),
    /// The device cannot be used, or can be used again.
    Trouble(Option<String>),
}

/// The program's request to the motors.
#[derive(Clone, Debug)]
struct Wish {
    command: Command,
    estimate: Estimate,
    is_stopped: bool,
    said: Instant,
    is_over: bool,
}

/// The program's end of the thread.
#[derive(Debug)]
pub struct Motors {
    wish: Arc<Mutex<Wish>>,
    thread: Option<JoinHandle<()>>,
}

impl Motors {
    /// Starts the thread, which passes its reports to `tell`, with the times of `clock`.
    ///
    /// # Errors
    /// The system cannot start a thread.
    pub fn start(
        device: Box<dyn Device>,
        positions: Option<Box<dyn PositionSource>>,
        clock: WallClock,
        tell: impl FnMut(Report) + Send + 'static,
    ) -> std::io::Result<Motors> {
        let wish = Arc::new(Mutex::new(Wish {
            command: Command::Stop,
            estimate: Estimate::default(),
            is_stopped: true,
            said: Instant::now(),
            is_over: false,
        }));
        let shared = wish.clone();
        let thread = thread::Builder::new()
            .name("motors".to_string())
            .spawn(move || drive(device, positions, clock, tell, &shared))?;
        Ok(Motors {
            wish,
            thread: Some(thread),
        })
    }

    /// The program is alive and wants this.
    pub fn drive(&self, command: Command, estimate: &Estimate) {
        let mut wish = lock(&self.wish);
        *wish = Wish {
            command,
            estimate: *estimate,
            is_stopped: false,
            said: Instant::now(),
            is_over: wish.is_over,
        };
    }

    /// Nothing moves until the next [`Motors::drive`].
    pub fn stop(&self) {
        let mut wish = lock(&self.wish);
        wish.is_stopped = true;
        wish.said = Instant::now();
    }

    /// Stops the device and ends the thread.
    pub fn end(&mut self) {
        lock(&self.wish).is_over = true;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Drop for Motors {
    fn drop(&mut self) {
        self.end();
    }
}

/// A thread that has panicked leaves a wish that is as good as any.
fn lock(wish: &Mutex<Wish>) -> MutexGuard<'_, Wish> {
    wish.lock().unwrap_or_else(PoisonError::into_inner)
}

fn drive(
    mut device: Box<dyn Device>,
    mut positions: Option<Box<dyn PositionSource>>,
    clock: WallClock,
    mut tell: impl FnMut(Report),
    wish: &Mutex<Wish>,
) {
    let mut told: Option<(Option<Command>, Instant)> = None;
    let mut trouble: Option<String> = None;
    loop {
        let now = Instant::now();
        let Wish {
            command,
            estimate,
            is_stopped,
            said,
            is_over,
        } = lock(wish).clone();
        if is_over {
            let _ = device.stop();
            return;
        }
        let is_stopped = is_stopped || now.saturating_duration_since(said) > PATIENCE;
        let wanted = (!is_stopped).then_some(command);
        let repeat = if is_stopped { REPEAT_STOP } else { REPEAT };
        let is_due = told.is_none_or(|(last, at)| last != wanted || now - at >= repeat);
        let mut problem = None;
        if is_due {
            told = Some((wanted, now));
            let done = match wanted {
                Some(command) => device.drive(&command, &estimate),
                None => device.stop(),
            };
            problem = done.err();
        }
        match device.read() {
            Ok(Some(reading)) => tell(Report::Measured(clock.now(), reading)),
            Ok(None) => {}
            Err(error) => problem = Some(error),
        }
        match positions.as_mut().map(|source| source.poll()) {
            Some(Ok(Some((at, pose)))) => tell(Report::Seen(clock.at(at), pose)),
            Some(Err(error)) => problem = Some(error),
            Some(Ok(None)) | None => {}
        }
        for (robot, at, pose) in positions.iter_mut().flat_map(|source| source.others()) {
            tell(Report::SawOther(robot, clock.at(at), pose));
        }
        report(&mut trouble, problem, is_due, &mut tell);
        thread::sleep(PERIOD.saturating_sub(now.elapsed()));
    }
}

/// Reports trouble when it begins, changes or ends. Only a call that drives shows that the device can be used again.
fn report(
    trouble: &mut Option<String>,
    problem: Option<DeviceError>,
    has_driven: bool,
    tell: &mut impl FnMut(Report),
) {
    let text = problem.map(|problem| problem.to_string());
    if text.is_none() && !has_driven {
        return;
    }
    if *trouble != text {
        trouble.clone_from(&text);
        tell(Report::Trouble(text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    /// Counts its commands.
    struct Counter(mpsc::Sender<bool>);

    impl Device for Counter {
        fn drive(&mut self, _: &Command, _: &Estimate) -> Result<(), DeviceError> {
            let _ = self.0.send(true);
            Ok(())
        }

        fn stop(&mut self) -> Result<(), DeviceError> {
            let _ = self.0.send(false);
            Ok(())
        }

        fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
            Ok(None)
        }
    }

    fn clock() -> WallClock {
        WallClock::since(WallClock::system())
    }

    #[test]
    fn a_program_that_hangs_stops_the_motors() {
        let (sender, receiver) = mpsc::channel();
        let motors = Motors::start(Box::new(Counter(sender)), None, clock(), |_| {}).unwrap();
        motors.drive(Command::Straight { speed: 0.2 }, &Estimate::default());
        let begun = Instant::now();
        while !receiver.recv().unwrap() {}
        // From now on the program says nothing.
        let patience = PATIENCE + Duration::from_secs(5);
        while begun.elapsed() < patience && receiver.recv().unwrap() {}
        assert!(begun.elapsed() < patience, "the motors still run");
    }

    #[test]
    fn the_device_is_stopped_when_the_robot_ends() {
        let (sender, receiver) = mpsc::channel();
        let motors = Motors::start(Box::new(Counter(sender)), None, clock(), |_| {}).unwrap();
        motors.drive(Command::Straight { speed: 0.2 }, &Estimate::default());
        while !receiver.recv().unwrap() {}
        drop(motors);
        assert_eq!(receiver.iter().last(), Some(false));
    }
}
