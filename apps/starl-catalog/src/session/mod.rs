//! A simulation as front ends hold it that keep files in memory, such as a web page: opened from texts, stepped,
//! steered, looked into, copied and brought back.
//!
//! Everything that goes out is plain data that can be serialised. Nothing here makes a difference to what a run
//! does: its digest is that of `starl run`.

mod breakpoint;
mod diagnostic;
mod editor;
mod files;
mod inspect;
mod open;
mod poses;
mod recorded;
mod report;
mod senses;
mod shared;

pub use breakpoint::{Breakpoint, Stopped};
pub use diagnostic::{Diagnostic, Edit, Extent, Related, check};
pub use editor::{Completion, Definition, Document, Hover, Part};
pub use files::{Beside, Disk, Files};
pub use inspect::{
    ActionReport, ClockReport, MailReport, PrimitiveReport, RobotReport, TimerReport,
    VariableReport,
};
pub(crate) use open::{Opened, open};
pub use open::{Options, Refused};
pub use poses::{MOST_FRAME_NUMBERS, POSE_NUMBERS};
pub use recorded::Recorded;
pub use report::{
    Excused, Failure, Member, Messages, Progress, Property, Report, Standing, Status, Thing,
    Violation, World, fleet, states,
};
pub use senses::{DetectionReport, RayReport, SensorReport};
pub use shared::SharedValue;

use crate::Application;
use crate::programs::Registry;
use breakpoint::Breakpoints;
use poses::Frames;
use shared::SharedValues;
use starl_core::{Duration, Intervention, Record, RobotId, Time};
use starl_sim::engine::InterventionError;
use starl_sim::{Run, write};
use starl_trace::Topic;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The default limit of records that are kept until they are taken; beyond it the oldest are dropped.
pub const MOST_RECORDS: usize = 200_000;

/// A simulation with its snapshots. A copy continues exactly as the original would.
#[derive(Clone)]
pub struct Session {
    application: Application,
    global_names: BTreeMap<String, String>,
    warnings: Vec<Diagnostic>,
    topics: Option<BTreeSet<Topic>>,
    most_records: usize,
    breakpoints: Breakpoints,
    shared: SharedValues,
    live: Live,
    kept: BTreeMap<u32, Live>,
    next: u32,
    interrupt: Arc<AtomicBool>,
}

/// Everything that changes as time continues. A copy continues exactly as the original would.
#[derive(Clone)]
struct Live {
    run: Run,
    records: VecDeque<Record>,
    dropped: u64,
    frames: Frames,
}

/// How far to run at most; to the end of the run by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The time at which to stop.
    pub until: Time,
    /// How many physics steps to make.
    pub steps: u64,
}

impl Default for Budget {
    fn default() -> Budget {
        Budget {
            until: Time::NEVER,
            steps: u64::MAX,
        }
    }
}

/// Records that were taken.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// All records, in order.
    pub records: Vec<Record>,
    /// The number of records left to take.
    pub left: usize,
    /// The number of records dropped since the last call, because they were not taken in time.
    pub dropped: u64,
}

impl Session {
    /// Opens the scenario that the options name. Programs in Rust are those of the registry.
    ///
    /// # Errors
    /// All problems of the options, the scenario and its programs.
    pub fn open(files: &Files, options: &Options, registry: &Registry) -> Result<Session, Refused> {
        let opened = open(files, options, registry)?;
        Session::of(opened.application, opened.global_names, opened.warnings)
    }

    /// The run of an application at its start.
    fn of(
        application: Application,
        global_names: BTreeMap<String, String>,
        warnings: Vec<Diagnostic>,
    ) -> Result<Session, Refused> {
        let run = application
            .run()
            .map_err(|error| application.problem(error))?;
        Ok(Session::new(run, application, warnings, global_names))
    }

    /// A session of a run that was started elsewhere, such as from files on disk. `global_names` are the names that
    /// programs have everywhere, by those that they have in the scenario, see [`Session::scenario`].
    pub fn of_run(
        run: Run,
        application: &Application,
        global_names: BTreeMap<String, String>,
    ) -> Session {
        let files = Files::default();
        let warnings = Diagnostic::of_warnings(application, &Beside::new(&files, ""));
        Session::new(run, application.clone(), warnings, global_names)
    }

    fn new(
        run: Run,
        application: Application,
        warnings: Vec<Diagnostic>,
        global_names: BTreeMap<String, String>,
    ) -> Session {
        Session {
            application,
            global_names,
            warnings,
            topics: None,
            most_records: MOST_RECORDS,
            breakpoints: Breakpoints::default(),
            shared: SharedValues::default(),
            live: Live {
                run,
                records: VecDeque::new(),
                dropped: 0,
                frames: Frames::default(),
            },
            kept: BTreeMap::new(),
            next: 0,
            interrupt: Arc::default(),
        }
    }

    /// While this flag is set, [`Session::advance`] makes no step.
    pub fn set_interrupt(&mut self, interrupt: Arc<AtomicBool>) {
        self.interrupt = interrupt;
    }

    /// Keeps the records of these topics only, by their names in traces such as `/starl/action`; of all topics
    /// at first.
    ///
    /// # Errors
    /// Names the topic that there is not.
    pub fn set_topics(&mut self, names: &[String]) -> Result<(), Refused> {
        let topic = |name: &String| {
            let topic = Topic::named(name).filter(|&topic| topic != Topic::Summary);
            topic.ok_or_else(|| {
                let known = Topic::ALL.iter().filter(|&&known| known != Topic::Summary);
                let known: Vec<&str> = known.map(|known| known.name()).collect();
                let known = known.join(", ");
                format!("there is no topic {name:?}; the topics are {known}")
            })
        };
        self.topics = Some(names.iter().map(topic).collect::<Result<_, _>>()?);
        Ok(())
    }

    /// Sets the limit of records that are kept until they are taken.
    pub fn set_most_records(&mut self, most: usize) {
        self.most_records = most;
    }

    /// The records that are kept, in order.
    pub fn records(&self) -> impl ExactSizeIterator<Item = &Record> {
        self.live.records.iter()
    }

    /// The warnings of the compiler.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// The scenario with its programs, as they were opened.
    pub fn application(&self) -> &Application {
        &self.application
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.live.run
    }

    /// How far the run is.
    pub fn status(&self) -> Status {
        Status::of(&self.live.run, 0)
    }

    /// Makes one physics step, also when the run is over.
    pub fn step(&mut self) -> Status {
        let kept = (self.topics.as_ref(), self.most_records);
        let stopped = self
            .live
            .step(kept, &mut self.breakpoints, &mut self.shared);
        Status {
            stopped,
            ..Status::of(&self.live.run, 1)
        }
    }

    /// Makes physics steps until the run is over, the budget is spent, a breakpoint is met, or it is interrupted. With
    /// a period to `sample` by, which must not be zero, it keeps a frame after each step that reaches or passes a
    /// multiple of the period, see [`Session::take_frames`].
    pub fn advance(&mut self, budget: Budget, sample: Option<Duration>) -> Status {
        let mut steps = 0;
        let live = &mut self.live;
        loop {
            let before = live.run.simulation().now();
            let is_spent = steps >= budget.steps || before >= budget.until;
            if is_spent || live.run.is_over() || self.interrupt.load(Ordering::Relaxed) {
                return Status::of(&live.run, steps);
            }
            let kept = (self.topics.as_ref(), self.most_records);
            let stopped = live.step(kept, &mut self.breakpoints, &mut self.shared);
            steps += 1;
            if let Some(period) = sample {
                live.frames.sample(&live.run, before, period);
            }
            if stopped.is_some() {
                return Status {
                    stopped,
                    ..Status::of(&live.run, steps)
                };
            }
        }
    }

    /// Steers the run: see [`starl_sim::Simulation::apply`].
    ///
    /// # Errors
    /// The error of the intervention.
    pub fn apply(&mut self, at: Time, what: Intervention) -> Result<(), InterventionError> {
        self.live.run.apply(at, what)
    }

    /// Replaces the breakpoints, see [`Session::advance`].
    ///
    /// # Errors
    /// The error of one of them; the previous ones stay.
    pub fn set_breakpoints(&mut self, breakpoints: Vec<Breakpoint>) -> Result<(), Refused> {
        self.breakpoints = Breakpoints::new(breakpoints, &self.application, &self.live.run)?;
        Ok(())
    }

    /// Keeps the present moment, records and frames that were not taken included; gives its number.
    pub fn snapshot(&mut self) -> u32 {
        let number = self.next;
        self.next += 1;
        self.kept.insert(number, self.live.clone());
        number
    }

    /// Returns to a snapshot, earlier or later, which is kept. Breakpoints do not change; a condition that is true at
    /// that moment must become false before it can stop the run.
    ///
    /// # Errors
    /// If there is no such moment.
    pub fn restore(&mut self, number: u32) -> Result<Status, Refused> {
        let kept = self.kept.get(&number);
        self.live = kept.ok_or_else(|| unknown(number))?.clone();
        self.breakpoints.look_anew(&self.live.run);
        Ok(self.status())
    }

    /// Deletes a snapshot.
    ///
    /// # Errors
    /// If there is no such moment.
    pub fn forget(&mut self, number: u32) -> Result<(), Refused> {
        let kept = self.kept.remove(&number);
        kept.map(|_| ()).ok_or_else(|| unknown(number))
    }

    /// Takes up to `most` records, the oldest first.
    pub fn take_records(&mut self, most: usize) -> Batch {
        let records = &mut self.live.records;
        let taken = most.min(records.len());
        Batch {
            records: records.drain(..taken).collect(),
            left: records.len(),
            dropped: std::mem::take(&mut self.live.dropped),
        }
    }

    /// The scenario with all interventions, as the text of a file: it repeats this run from the start. Programs of an
    /// example get their global names; other programs keep their paths from the scenario's folder.
    pub fn scenario(&self) -> String {
        let mut scenario = self.live.run.simulation().as_scenario();
        for group in &mut scenario.fleet.groups {
            if let Some(name) = self.global_names.get(&group.program) {
                group.program.clone_from(name);
            }
        }
        write::scenario(&scenario)
    }

    /// The names that programs have everywhere, by those that they have in the scenario.
    pub fn global_names(&self) -> &BTreeMap<String, String> {
        &self.global_names
    }

    /// The report of the run so far.
    pub fn report(&self) -> Report {
        Report::of(&self.live.run)
    }

    /// Takes the values of shared variables that records since the last call are about, as far as robots of programs in
    /// the StarL language held them after the step. Values of linearizable variables are not among them.
    pub fn take_shared_values(&mut self) -> Vec<SharedValue> {
        self.shared.take()
    }

    /// One robot as it is now; none if there is no such robot.
    pub fn robot(&self, robot: RobotId) -> Option<RobotReport> {
        RobotReport::of(&self.live.run, robot)
    }

    /// [`POSE_NUMBERS`] numbers for each robot in the order of their numbers: the true x, y, z, yaw, pitch and roll;
    /// x, y, z and yaw as the robot believes them; and its condition, 0 for running, 1 for finished, 2 for failed, 3
    /// for down, 4 for left. Metres and radians.
    pub fn poses(&self) -> impl Iterator<Item = f64> {
        poses::poses(&self.live.run)
    }

    /// Takes all sampled frames, the oldest first: each has its time in seconds, the number of robots, and the result
    /// of [`Session::poses`] then. No more than [`MOST_FRAME_NUMBERS`] numbers are kept; then the oldest frames are
    /// dropped.
    pub fn take_frames(&mut self) -> Vec<f64> {
        self.live.frames.take()
    }
}

impl Live {
    /// Makes a step, of whose records it keeps those of some topics, and no more than so many; gives the breakpoint
    /// that was met in it.
    fn step(
        &mut self,
        (topics, most): (Option<&BTreeSet<Topic>>, usize),
        breakpoints: &mut Breakpoints,
        shared: &mut SharedValues,
    ) -> Option<Stopped> {
        self.run.step();
        let records = self.run.records();
        shared.look(&self.run, records);
        let wanted = records.iter().filter(|record| {
            topics.is_none_or(|topics| topics.contains(&Topic::of(&record.event)))
        });
        self.records.extend(wanted.cloned());
        let excess = self.records.len().saturating_sub(most);
        self.records.drain(..excess);
        self.dropped += excess as u64;
        match breakpoints.are_none() {
            true => None,
            false => breakpoints.look(&self.run, records),
        }
    }
}

fn unknown(number: u32) -> Refused {
    format!("there is no snapshot {number}").into()
}
