//! Runs a workload and measures its time and memory.

use super::workload::Workload;
use crate::console::{grouped, rounded};
use crate::failure::Failure;
use crate::target::refused;
use crate::threads;
use cpu_time::ProcessTime;
use serde::Serialize;
use starl_catalog::examples::EXAMPLES;
use starl_catalog::programs::Registry;
use starl_core::{FileError, Time};
use starl_sim::Simulation;
use starl_sim::read::{Loader, Request, Source};
use std::fmt::Write;
use std::fs;
use std::time::Instant;

/// The measurements. A robot-tick is one robot advanced by one tick of 100 ms.
#[derive(Debug, Serialize)]
pub struct Figures {
    pub workload: &'static str,
    pub robots: u64,
    pub threads: usize,
    pub sim_seconds: f64,
    /// Reading the scenario and placing the robots.
    pub setup_seconds: f64,
    pub wall_seconds: f64,
    /// Of all threads, user and system, while stepping.
    pub cpu_seconds: f64,
    pub robot_ticks: u64,
    pub robot_ticks_per_second: f64,
    pub robot_ticks_per_cpu_second: f64,
    pub speed_factor: f64,
    pub messages_delivered: u64,
    pub messages_delivered_per_cpu_second: f64,
    /// Growth of the process's memory, at its peak, from after a rehearsal with few robots; none if the system does not
    /// report it.
    pub bytes_per_robot: Option<f64>,
    pub peak_memory_bytes: Option<u64>,
    pub collisions: u64,
    pub digest: String,
}

/// Ticks of a rehearsal.
const REHEARSED_TICKS: u32 = 10;

/// Runs a workload to its end.
pub fn measure(workload: &Workload, threads: usize) -> Result<Figures, Failure> {
    let mut rehearsal = start(workload.name, &workload.rehearsal)?;
    (0..REHEARSED_TICKS).for_each(|_| rehearsal.step());
    drop(rehearsal);
    let before = memory("VmRSS");
    let begun = Instant::now();
    let mut simulation = start(workload.name, &workload.scenario)?;
    simulation.set_parallel(threads > 1);
    let setup_seconds = begun.elapsed().as_secs_f64();
    let (begun, cpu) = (Instant::now(), ProcessTime::now());
    let ticks = threads::with(threads, || {
        let end = Time::ZERO + simulation.scenario().duration;
        let mut ticks = 0_u64;
        while simulation.now() < end {
            simulation.step();
            ticks += 1;
        }
        ticks
    })?;
    let (wall_seconds, cpu_seconds) = (begun.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
    let peak = memory("VmHWM");
    let robots = simulation.robots().len() as u64;
    let robot_ticks = ticks * robots;
    let tally = simulation.tally();
    let sim_seconds = simulation.now().seconds();
    Ok(Figures {
        workload: workload.name,
        robots,
        threads,
        sim_seconds,
        setup_seconds,
        wall_seconds,
        cpu_seconds,
        robot_ticks,
        robot_ticks_per_second: robot_ticks as f64 / wall_seconds,
        robot_ticks_per_cpu_second: robot_ticks as f64 / cpu_seconds,
        speed_factor: sim_seconds / wall_seconds,
        messages_delivered: tally.delivered,
        messages_delivered_per_cpu_second: tally.delivered as f64 / cpu_seconds,
        bytes_per_robot: before
            .zip(peak)
            .map(|(before, peak)| peak.saturating_sub(before) as f64 / robots as f64),
        peak_memory_bytes: peak,
        collisions: tally.collisions,
        digest: simulation.digest().to_string(),
    })
}

fn start(name: &str, scenario: &str) -> Result<Simulation, Failure> {
    let source = Source::new(format!("the scenario of `{name}`"), scenario);
    let application = starl_catalog::read(&Request::new(source), &Examples, &Registry::default())
        .map_err(refused)?;
    application
        .simulation()
        .map_err(|error| Failure(error.complaint.message))
}

/// The figures for people.
pub fn text(figures: &Figures) -> String {
    let mut text = String::new();
    let mut line = |label: &str, value: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{label:28}{value}");
    };
    line("workload", figures.workload.to_string());
    line("robots", grouped(figures.robots));
    line("threads", figures.threads.to_string());
    line(
        "time",
        format!(
            "{} s simulated in {} s, {} s of them CPU",
            rounded(figures.sim_seconds),
            rounded(figures.wall_seconds),
            rounded(figures.cpu_seconds)
        ),
    );
    line("set-up", format!("{} s", rounded(figures.setup_seconds)));
    line("speed factor", rounded(figures.speed_factor));
    line(
        "robot-ticks per second",
        rounded(figures.robot_ticks_per_second),
    );
    line(
        "robot-ticks per CPU second",
        rounded(figures.robot_ticks_per_cpu_second),
    );
    if figures.messages_delivered > 0 {
        let rate = rounded(figures.messages_delivered_per_cpu_second);
        line("messages per CPU second", rate);
    }
    line(
        "bytes per robot",
        figures
            .bytes_per_robot
            .map_or("unknown".to_string(), rounded),
    );
    line("collisions", grouped(figures.collisions));
    line("digest", figures.digest.clone());
    text
}

/// Brings the programs of the examples.
struct Examples;

impl Loader for Examples {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let mut files = EXAMPLES.iter().map(|example| example.load(path));
        files.find(Result::is_ok).unwrap_or(Err(FileError::Missing))
    }
}

/// A figure of the process's memory in bytes, on Linux.
fn memory(name: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
