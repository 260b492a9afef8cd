//! `starl fleet up`: runs all robots of a fleet on this machine, each in its own process, and judges the run.

use super::connect::connect;
use super::file::Fleet;
use super::folder::Folder;
use super::merge::merge;
use super::{key, link, stop};
use crate::args::{FleetUpArguments, VerifyArguments};
use crate::failure::Failure;
use crate::replay::open;
use crate::run::{quoted, stop_on_interrupt};
use crate::{console, verify};
use starl_catalog::disk::reason;
use starl_catalog::programs::Registry;
use starl_node::{Operator, WallClock};
use starl_sim::Scenario;
use starl_sim::scenario::{FaultRates, Goal};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Robots are asked how they are this often.
const PERIOD: Duration = Duration::from_millis(500);

/// A robot that has died is restarted after this.
const PAUSE: Duration = Duration::from_secs(1);

/// The time that a robot has to end after the order to stop.
const PATIENCE: Duration = Duration::from_secs(15);

/// Starts a fleet, waits for its end, and judges it; whether its goal was reached and no property violated.
pub fn up(arguments: &FleetUpArguments, registry: &Registry) -> Result<bool, Failure> {
    let program = arguments.program.as_deref();
    let fleet = Fleet::read(&arguments.fleet, program, arguments.quiet, registry)?;
    if arguments.print {
        return print(arguments, &fleet);
    }
    if !fleet.is_local() {
        return Err(Failure::file(
            &arguments.fleet,
            "some robots are on other machines; --print says what to start where",
        ));
    }
    for robot in &fleet.robots {
        link::check(&fleet, Some(robot))?;
    }
    if let Some(path) = &fleet.key {
        key::make_if_missing(path)?;
    }
    let folder = Folder::of(&arguments.fleet, !arguments.resume)?;
    check_resumed(&fleet, &folder)?;
    let epoch = folder.epoch()?;
    if let Some(future) = epoch.checked_sub(WallClock::system()) {
        console::complain(&format!(
            "warning: {}: began {:.0} s in the future, as this computer's clock was set back; time begins at 0 again\n",
            folder.0.display(),
            future.as_secs_f64()
        ));
    }
    let scenario = fleet.application.scenario();
    let limit = match &arguments.duration {
        Some(text) => starl_sim::read::duration(text)
            .ok_or_else(|| Failure(format!("--duration {text}: give a time, such as 60s")))?,
        None => scenario.duration,
    };
    warn(&fleet, scenario);
    let stop = stop_on_interrupt();
    if !link::await_router(&fleet, &fleet.name, || stop.load(Ordering::Relaxed)) {
        return Ok(false);
    }
    let emulator = arguments
        .emulate
        .then(|| emulator(&arguments.fleet))
        .transpose()?;
    let mut robots = Robots::start(arguments, &fleet, &folder)?;
    let mut operator = connect(&fleet)?;
    console::complain(&format!(
        "{}: {} in {}\n",
        fleet.name,
        console::counted(fleet.robots.len(), "robot"),
        folder.0.display()
    ));
    let ends_when_finished = scenario.goal == Goal::AllFinished && !arguments.keep;
    let is_reached = robots.watch(&mut operator, limit.into(), ends_when_finished, &stop)?;
    if !robots.are_stopped() {
        stop::halt(&fleet, &mut operator);
    }
    robots.end();
    let touches = emulator.map_or(0, Emulator::end);
    let out = folder.0.join("merged.mcap");
    let merged = merge(&fleet, &folder, &out)?;
    console::print(&merged.text(&fleet, &out))?;
    let judged = verify::verify(
        &VerifyArguments {
            trace: out,
            json: false,
        },
        registry,
    )?;
    // The emulator knows the true poses, which are not on record.
    let is_clear = touches == 0 || !scenario.properties.no_collision;
    if !is_clear {
        let times = console::counted(touches, "time");
        console::complain(&format!("emulated robots ran into something {times}\n"));
    }
    Ok(judged && is_clear && (is_reached || !ends_when_finished))
}

/// Refuses to continue a run of another scenario, whose traces could not be joined with the new ones.
fn check_resumed(fleet: &Fleet, folder: &Folder) -> Result<(), Failure> {
    let scenario = &fleet.application.resolved().inputs.request.source.text;
    for robot in &fleet.robots {
        let Some(first) = folder.traces_of(&robot.name).into_iter().next() else {
            continue;
        };
        // One that was cut short before its header says nothing.
        if open(&first).is_ok_and(|trace| trace.header().scenario != *scenario) {
            let what = "is a run of another scenario; begin a new run without --resume";
            return Err(Failure::file(&folder.0, what));
        }
    }
    Ok(())
}

/// Says which parts of the scenario have no effect on real robots.
fn warn(fleet: &Fleet, scenario: &Scenario) {
    let faults = &scenario.faults;
    let has_faults = !faults.schedule.is_empty() || faults.rates != FaultRates::default();
    let parts = [
        (
            !scenario.events.is_empty(),
            "events do not happen on real robots",
        ),
        (has_faults, "faults do not happen on real robots"),
        (
            matches!(scenario.goal, Goal::Condition(_)),
            "goal is not judged on real robots; the fleet runs for the duration",
        ),
    ];
    for (_, what) in parts.iter().filter(|(is_given, _)| *is_given) {
        console::complain(&format!("warning: {}: the scenario's {what}\n", fleet.name));
    }
}

/// Prints the processes to start, with their machines.
fn print(arguments: &FleetUpArguments, fleet: &Fleet) -> Result<bool, Failure> {
    let file = quoted(&arguments.fleet.display().to_string());
    let mut text = String::new();
    if let Some(router) = &fleet.network.router {
        text += &format!("{router}: starl fleet router {file}, or another Zenoh router\n");
    }
    for robot in &fleet.robots {
        let program = arguments
            .program
            .as_ref()
            .map_or(String::new(), |program| format!(" {}", quoted(program)));
        let ip = robot.address.ip();
        text += &format!(
            "{ip}: starl robot{program} --id {} --fleet {file}\n",
            quoted(&robot.name)
        );
    }
    console::print(&text)?;
    Ok(true)
}

/// A process that emulates the fleet's devices until this is dropped.
struct Emulator {
    process: Child,
    /// Passes on what it says, which is what has run into what; gives the number of lines at its end.
    listener: Option<JoinHandle<usize>>,
}

impl Emulator {
    /// Ends the process; how often its robots ran into something.
    fn end(mut self) -> usize {
        let listener = self.listener.take();
        drop(self);
        listener.and_then(|it| it.join().ok()).unwrap_or(0)
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Starts to emulate devices, and waits until they are there.
fn emulator(fleet: &Path) -> Result<Emulator, Failure> {
    let cannot = |error: &std::io::Error| {
        Failure(format!("the devices cannot be emulated: {}", reason(error)))
    };
    let mut command = this_command().map_err(|error| cannot(&error))?;
    command
        .args(["emulate", "fleet", "--supervised"])
        .arg(fleet);
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut emulator = Emulator {
        process: command.spawn().map_err(|error| cannot(&error))?,
        listener: None,
    };
    let output = emulator.process.stdout.take().into_iter();
    let mut lines = output.flat_map(|output| BufReader::new(output).lines());
    // It has said why, if it ends before.
    if !lines.any(|line| line.is_ok_and(|line| line == "ready")) {
        return Err(Failure("the devices cannot be emulated".to_string()));
    }
    let listen = move || {
        let touches = lines.map_while(Result::ok);
        touches
            .inspect(|touch| console::complain(&format!("{touch}\n")))
            .count()
    };
    emulator.listener = Some(std::thread::spawn(listen));
    Ok(emulator)
}

/// This command, to be started again.
fn this_command() -> std::io::Result<Command> {
    let mut command = Command::new(std::env::current_exe()?);
    // Ctrl-C is for this process, which ends the others in good order.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    Ok(command)
}

/// One thread for the network of each robot, since they share a machine: Zenoh's own variable and its syntax. Its usual six
/// threads hand each packet on to each other.
const ZENOH_THREADS: (&str, &str) = (
    "ZENOH_RUNTIME",
    "(rx: (handover: net), acc: (handover: net), tx: (handover: net), app: (handover: net), net: (worker_threads: 1))",
);

/// The processes of a fleet.
struct Robots<'a> {
    arguments: &'a FleetUpArguments,
    folder: &'a Path,
    robots: Vec<Process>,
}

struct Process {
    name: String,
    child: Option<Child>,
    /// When it died, if it is to be started again.
    died: Option<Instant>,
}

impl<'a> Robots<'a> {
    fn start(
        arguments: &'a FleetUpArguments,
        fleet: &Fleet,
        folder: &'a Folder,
    ) -> Result<Robots<'a>, Failure> {
        let mut robots = Robots {
            arguments,
            folder: &folder.0,
            robots: Vec::new(),
        };
        for robot in &fleet.robots {
            let child = robots.spawn(&robot.name)?;
            robots.robots.push(Process {
                name: robot.name.clone(),
                child: Some(child),
                died: None,
            });
        }
        Ok(robots)
    }

    fn spawn(&self, robot: &str) -> Result<Child, Failure> {
        let cannot = |error: &std::io::Error| {
            Failure(format!("{robot}: cannot be started: {}", reason(error)))
        };
        let mut command = this_command().map_err(|error| cannot(&error))?;
        command.arg("robot").args(&self.arguments.program);
        command
            .arg("--id")
            .arg(robot)
            .arg("--fleet")
            .arg(&self.arguments.fleet);
        command
            .arg("--folder")
            .arg(self.folder)
            .arg("--supervised")
            .stdin(Stdio::piped());
        if self.arguments.quiet {
            command.arg("--quiet");
        }
        if std::env::var_os(ZENOH_THREADS.0).is_none() {
            command.env(ZENOH_THREADS.0, ZENOH_THREADS.1);
        }
        command.spawn().map_err(|error| cannot(&error))
    }

    /// Waits for the end; whether all robots have finished.
    fn watch(
        &mut self,
        operator: &mut Operator,
        limit: Duration,
        ends_when_finished: bool,
        stop: &AtomicBool,
    ) -> Result<bool, Failure> {
        let begun = Instant::now();
        while !stop.load(Ordering::Relaxed) && begun.elapsed() < limit {
            self.revive()?;
            if self.are_stopped() {
                console::complain("all robots have been stopped\n");
                return Ok(false);
            }
            let asked = Instant::now();
            let statuses = operator.statuses(PERIOD);
            let finished = statuses
                .values()
                .filter(|status| status.finished || status.failed.is_some());
            if ends_when_finished && finished.count() == self.robots.len() {
                console::complain(&format!(
                    "all robots have finished after {:.1} s\n",
                    begun.elapsed().as_secs_f64()
                ));
                return Ok(statuses.values().all(|status| status.finished));
            }
            std::thread::sleep(PERIOD.saturating_sub(asked.elapsed()));
        }
        Ok(false)
    }

    /// Starts robots again that have died.
    fn revive(&mut self) -> Result<(), Failure> {
        for index in 0..self.robots.len() {
            let robot = &mut self.robots[index];
            let ended = robot
                .child
                .as_mut()
                .and_then(|child| child.try_wait().ok().flatten());
            if let Some(status) = ended {
                if status.code() == Some(2) {
                    // It has said why.
                    self.end();
                    return Err(Failure(format!(
                        "{}: could not start",
                        self.robots[index].name
                    )));
                }
                robot.child = None;
                if status.success() {
                    // An operator has stopped it.
                    continue;
                }
                console::complain(&format!(
                    "{} has died ({}), and is restarted\n",
                    robot.name,
                    how(status)
                ));
                robot.died = Some(Instant::now());
            }
            if robot.died.is_some_and(|died| died.elapsed() >= PAUSE) {
                robot.died = None;
                let name = robot.name.clone();
                self.robots[index].child = Some(self.spawn(&name)?);
            }
        }
        Ok(())
    }

    /// Whether no robot runs, nor is to be started again.
    fn are_stopped(&self) -> bool {
        let mut robots = self.robots.iter();
        robots.all(|robot| robot.child.is_none() && robot.died.is_none())
    }

    /// Ends all processes; robots that were ordered to stop have some time to do so.
    fn end(&mut self) {
        let begun = Instant::now();
        // A robot whose supervisor has gone stops by itself, also if no order reaches it.
        let children = self
            .robots
            .iter_mut()
            .filter_map(|robot| robot.child.as_mut());
        children.for_each(|child| drop(child.stdin.take()));
        for robot in &mut self.robots {
            let Some(child) = &mut robot.child else {
                continue;
            };
            while begun.elapsed() < PATIENCE && child.try_wait().is_ok_and(|ended| ended.is_none())
            {
                std::thread::sleep(Duration::from_millis(10));
            }
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

impl Drop for Robots<'_> {
    fn drop(&mut self) {
        self.end();
    }
}

fn how(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("signal {signal}");
    }
    status
        .code()
        .map_or("unknown".to_string(), |code| format!("exit status {code}"))
}
