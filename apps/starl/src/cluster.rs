//! Runs on a cluster of Ray, for `--cluster`.
//!
//! The command plans, counts, shrinks and reports as without a cluster; only the single runs are made elsewhere. The
//! command does not contain Python: it starts an interpreter with the package `starl`, whose module `starl._cluster`
//! uses Ray, and sends it jobs on standard input. Both ends write JSON, one message per line.

use crate::args::ClusterArguments;
use crate::console;
use crate::failure::Failure;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use starl_catalog::disk::reason;
use std::ffi::{OsStr, OsString};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Names the interpreter where `--python` does not.
const VARIABLE: &str = "STARL_PYTHON";

/// A connection to a cluster; it ends when this is dropped.
pub struct Cluster {
    address: String,
    python: OsString,
    child: Child,
    /// None once no more jobs can be given.
    jobs: Option<ChildStdin>,
    answers: Receiver<String>,
    /// The last line of the interpreter's error stream.
    errors: Option<JoinHandle<Option<String>>>,
    processors: usize,
}

/// Work for the cluster.
#[derive(Serialize)]
struct Job<'a, P> {
    work: &'static str,
    plan: &'a P,
    numbers: &'a [u64],
}

/// A line of the interpreter.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Ready { processors: usize },
    Result(serde_json::Value),
    Done {},
    Error(String),
}

/// How often the stop flag is looked at while nothing comes.
const PATIENCE: Duration = Duration::from_millis(100);

impl Cluster {
    /// Connects to the cluster that the arguments name, if they name one. Returns `None` also when `stop` is set
    /// before.
    pub fn connect(
        arguments: &ClusterArguments,
        stop: &AtomicBool,
    ) -> Result<Option<Cluster>, Failure> {
        let Some(address) = &arguments.cluster else {
            return Ok(None);
        };
        let named = arguments.python.clone().map(OsString::from);
        let named = named.or_else(|| std::env::var_os(VARIABLE).filter(|name| !name.is_empty()));
        let python = named.unwrap_or_else(|| "python3".into());
        let mut child = start(&python, address)?;
        let (sender, answers) = channel();
        if let Some(output) = child.stdout.take() {
            std::thread::spawn(move || {
                let mut lines = BufReader::new(output).lines().map_while(Result::ok);
                lines.try_for_each(|line| sender.send(line))
            });
        }
        let errors = child.stderr.take();
        let errors = errors.map(|output| std::thread::spawn(move || last_line(output)));
        let mut cluster = Cluster {
            address: address.clone(),
            python,
            jobs: child.stdin.take(),
            child,
            answers,
            errors,
            processors: 0,
        };
        let Some(line) = cluster.next(stop)? else {
            return Ok(None);
        };
        match cluster.read(&line)? {
            Answer::Ready { processors } => cluster.processors = processors,
            _ => return Err(cluster.strange(&line)),
        }
        Ok(Some(cluster))
    }

    /// The processors of the cluster.
    pub fn processors(&self) -> usize {
        self.processors
    }

    /// Makes the runs with these numbers, and passes each result to `take` when it arrives, in no defined order. Ends
    /// early when `stop` is set; then no more jobs can be sent.
    pub fn run<T: DeserializeOwned>(
        &mut self,
        work: &'static str,
        plan: &impl Serialize,
        numbers: &[u64],
        stop: &AtomicBool,
        mut take: impl FnMut(T) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let Some(jobs) = self.jobs.as_mut().filter(|_| !stop.load(Ordering::Relaxed)) else {
            return Ok(());
        };
        let job = Job {
            work,
            plan,
            numbers,
        };
        let mut text = serde_json::to_vec(&job)
            .unwrap_or_else(|error| unreachable!("only plain data is sent: {error}"));
        text.push(b'\n');
        if jobs.write_all(&text).and_then(|()| jobs.flush()).is_err() {
            return Err(self.gone());
        }
        while let Some(line) = self.next(stop)? {
            match self.read(&line)? {
                Answer::Result(result) => match serde_json::from_value(result) {
                    Ok(result) => take(result)?,
                    Err(_) => return Err(self.strange(&line)),
                },
                Answer::Done {} => return Ok(()),
                _ => return Err(self.strange(&line)),
            }
        }
        self.jobs = None;
        Ok(())
    }

    /// The next line; none when `stop` is set.
    fn next(&mut self, stop: &AtomicBool) -> Result<Option<String>, Failure> {
        loop {
            match self.answers.recv_timeout(PATIENCE) {
                _ if stop.load(Ordering::Relaxed) => return Ok(None),
                Ok(line) => return Ok(Some(line)),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(self.gone()),
            }
        }
    }

    fn read(&self, line: &str) -> Result<Answer, Failure> {
        match serde_json::from_str(line) {
            Ok(Answer::Error(message)) => Err(Failure(format!("--cluster: {message}"))),
            Ok(answer) => Ok(answer),
            Err(_) => Err(self.strange(line)),
        }
    }

    fn strange(&self, line: &str) -> Failure {
        let line: String = line.chars().take(200).collect();
        Failure(format!(
            "--cluster: {} answers what this command does not understand: {line}; install the package `starl` {} for it",
            self.python.display(),
            env!("CARGO_PKG_VERSION")
        ))
    }

    /// The interpreter has ended by itself.
    fn gone(&mut self) -> Failure {
        let last = self.errors.take().and_then(|reader| reader.join().ok());
        let said = last.flatten();
        let said = said.map_or(String::new(), |line| format!(": {}", line.trim()));
        Failure(format!(
            "--cluster: {} -m starl._cluster has ended{said}; it needs a Python with the package `starl` of `make wheel`, \
             version {}: name one with --python or {VARIABLE}",
            self.python.display(),
            env!("CARGO_PKG_VERSION")
        ))
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        // It ends when its input does. One that hangs is not waited for.
        self.jobs = None;
        for _ in 0..40 {
            if !matches!(self.child.try_wait(), Ok(None)) {
                return;
            }
            std::thread::sleep(PATIENCE);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Starts the interpreter.
fn start(python: &OsStr, address: &str) -> Result<Child, Failure> {
    let arguments = ["-m", "starl._cluster", address, env!("CARGO_PKG_VERSION")];
    let mut command = Command::new(python);
    let command = command.args(arguments);
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    command.stderr(Stdio::piped()).spawn().map_err(|error| {
        let (name, reason) = (python.display(), reason(&error));
        Failure(format!(
            "--cluster: {name} cannot be started: {reason}; name a Python that has the package `starl` with --python or \
             {VARIABLE}"
        ))
    })
}

/// The last line of a stream that has letters, when it has ended.
fn last_line(stream: impl Read) -> Option<String> {
    let lines = BufReader::new(stream).lines().map_while(Result::ok);
    lines.filter(|line| !line.trim().is_empty()).last()
}

/// Where runs are made.
pub enum Workers {
    /// This number of threads of this process.
    Threads(usize),
    /// A cluster.
    Cluster(Box<Cluster>),
}

impl Workers {
    /// The cluster that is named, or the threads.
    pub fn of(
        arguments: &ClusterArguments,
        threads: Option<u32>,
        stop: &AtomicBool,
    ) -> Result<Workers, Failure> {
        let cluster = Cluster::connect(arguments, stop)?;
        let threads = || Workers::Threads(crate::threads::for_runs(threads));
        Ok(cluster.map_or_else(threads, |cluster| Workers::Cluster(Box::new(cluster))))
    }

    /// How many runs are made at once.
    pub fn count(&self) -> usize {
        match self {
            Workers::Threads(count) => *count,
            Workers::Cluster(cluster) => cluster.processors(),
        }
    }

    /// For people: `2 threads`, `ray with 8 processors`.
    pub fn words(&self) -> String {
        match self {
            Workers::Threads(count) => console::counted(*count, "thread"),
            Workers::Cluster(cluster) => {
                let processors = console::counted(cluster.processors, "processor");
                format!("the cluster {} with {processors}", cluster.address)
            }
        }
    }
}
