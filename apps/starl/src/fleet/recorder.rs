//! Takes down what a robot does: a trace like that of any run, and lines for the person who watches.

use crate::console;
use crate::failure::Failure;
use crate::trace_output::TraceOutput;
use starl_core::event::{Event, Level};
use starl_core::{Program, Record, RobotId, Time};
use starl_host::Observed;
use starl_host::journal::{Batch, Journal};
use starl_lang::robot::RobotProgram;
use starl_node::robot::Recorder;
use starl_trace::Outcome;

/// The outcome of a trace that has reached its limit: its robot continues.
pub const LIMIT_REACHED: &str = "limit_reached";

/// The recorder of one robot.
pub struct FleetRecorder {
    robot: RobotId,
    name: String,
    /// None once it could not be written: a full disk does not stop a robot.
    trace: Option<TraceOutput>,
    journal: Journal,
    batch: Batch,
    end: Time,
    /// The trace ends when it is larger, bytes.
    limit: u64,
    is_quiet: bool,
}

impl FleetRecorder {
    /// A recorder that writes to this trace until it has `limit` bytes. A robot whose trace cannot be written does
    /// without one.
    pub fn new(
        robot: RobotId,
        name: &str,
        trace: Result<TraceOutput, Failure>,
        limit: u64,
        is_quiet: bool,
    ) -> FleetRecorder {
        FleetRecorder {
            robot,
            name: name.to_string(),
            trace: trace.map_err(|failure| tell_lost(&failure)).ok(),
            journal: Journal::new(robot, 1),
            batch: Batch::default(),
            end: Time::ZERO,
            limit,
            is_quiet,
        }
    }

    /// Completes the trace.
    pub fn finish(mut self) {
        self.advance(self.end);
        self.complete("stopped");
    }

    fn complete(&mut self, outcome: &str) {
        if let Some(trace) = self.trace.take() {
            let outcome = Outcome {
                outcome: outcome.to_string(),
                digest: 0,
                end: self.end,
            };
            if let Err(failure) = trace.finish(&outcome) {
                console::error(&failure.0);
            }
        }
    }

    fn say(&self, at: Time, text: &str) {
        if !self.is_quiet {
            console::complain(&format!("{:9.3} {}: {text}\n", at.seconds(), self.name));
        }
    }

    fn keep(&mut self, done: impl FnOnce(&mut TraceOutput) -> Result<(), Failure>) {
        if let Some(Err(failure)) = self.trace.as_mut().map(done) {
            tell_lost(&failure);
            self.trace = None;
        }
    }
}

fn tell_lost(failure: &Failure) {
    console::error(&format!(
        "{}: the robot continues without a trace",
        failure.0
    ));
}

impl Recorder for FleetRecorder {
    fn record(&mut self, at: Time, event: Event) {
        self.end = self.end.max(at);
        match &event {
            Event::Log { level, text } => {
                let level = match level {
                    Level::Debug => "debug: ",
                    Level::Info => "",
                    Level::Warning => "warning: ",
                    Level::Error => "error: ",
                };
                self.say(at, &format!("{level}{text}"));
            }
            Event::Finished => self.say(at, "finished"),
            Event::Failed(why) => self.say(at, &format!("its program cannot continue: {why}")),
            _ => {}
        }
        let robot = Some(self.robot);
        let record = Record { at, robot, event };
        self.keep(|trace| trace.write(&record));
    }

    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        self.journal.observe(self.robot, at, observed);
    }

    fn advance(&mut self, now: Time) {
        self.end = self.end.max(now);
        let mut batch = std::mem::take(&mut self.batch);
        batch.clear();
        self.journal.append_to(&mut batch);
        self.keep(|trace| trace.advance(&batch, now));
        self.batch = batch;
        if self
            .trace
            .as_ref()
            .is_some_and(|trace| trace.size() >= self.limit)
        {
            let text = format!(
                "the trace has {} MiB and ends here; the robot continues without one",
                self.limit >> 20
            );
            self.notice(now, &text);
            self.complete(LIMIT_REACHED);
        }
    }

    fn commit(&mut self) {
        self.keep(TraceOutput::save);
    }

    fn notice(&mut self, at: Time, text: &str) {
        self.say(at, text);
        let level = Level::Warning;
        let text = text.to_string().into();
        let event = Event::Log { level, text };
        let robot = Some(self.robot);
        self.keep(|trace| trace.write(&Record { at, robot, event }));
    }

    fn state(&self, program: &dyn Program) -> Option<String> {
        let program = program.inspect()?.downcast_ref::<RobotProgram>()?;
        program.stage().map(str::to_string)
    }
}
