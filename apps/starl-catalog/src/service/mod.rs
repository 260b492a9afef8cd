//! Simulations behind requests and answers in JSON: what the WebAssembly module, and the server of `starl run --open`,
//! offer to a page. A bad request of any kind gets an answer that says why.

mod request;

use crate::examples::{self, EXAMPLES};
use crate::programs::Registry;
use crate::schema::schema;
use crate::session::{
    Budget, Disk, Document, Files, Refused, Session, Status, World, check, fleet, states,
};
use crate::trial::{Trials, profiles};
use request::{Contents, Request};
use serde::Serialize;
use serde_json::{Value, json};
use starl_core::Time;
use starl_editor::format::format;
use starl_sim::shrink::Limits;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Simulations by number, of programs in the StarL language and those in Rust that ship with StarL.
#[derive(Default)]
pub struct Service {
    registry: Registry,
    sessions: BTreeMap<u32, Session>,
    next: u32,
    trials: Trials,
    interrupt: Arc<AtomicBool>,
    disk: Option<Disk>,
}

impl Service {
    /// Without simulations at first. Programs in Rust are those of the registry.
    pub fn new(registry: Registry) -> Service {
        Service {
            registry,
            ..Service::default()
        }
    }

    /// The same, for a host with a disk: scenarios and programs find the files there that are not in a request.
    #[must_use]
    pub fn with_disk(self, disk: Disk) -> Service {
        Service {
            disk: Some(disk),
            ..self
        }
    }

    /// A simulation.
    ///
    /// # Errors
    /// If there is none of this number.
    pub fn session(&mut self, simulation: u32) -> Result<&mut Session, Refused> {
        let session = self.sessions.get_mut(&simulation);
        let what = || format!("there is no simulation {simulation}; it may have been closed");
        session.ok_or_else(|| what().into())
    }

    fn files(&self, contents: Contents) -> Files {
        Files::from(contents).with_disk(self.disk)
    }

    /// A flag that stops the current work: while it is set, no simulation advances. Any thread may set it.
    pub fn interrupt(&self) -> Arc<AtomicBool> {
        self.interrupt.clone()
    }

    /// Adds a simulation that was opened elsewhere. Returns the answer of the request `open`.
    pub fn adopt(&mut self, mut session: Session) -> Value {
        session.set_interrupt(self.interrupt.clone());
        let number = self.next;
        self.next += 1;
        let scenario = session.run().simulation().scenario();
        let opened = json!({
            "simulation": number,
            "title": scenario.title,
            "seed": scenario.seed.to_string(),
            "duration": scenario.duration.seconds(),
            "step_length": scenario.physics.step.seconds(),
            "warnings": session.warnings(),
        });
        self.sessions.insert(number, session);
        opened
    }

    /// The answer to a request, both in JSON: `{"ok": ...}`, or `{"error": {"message": ..., "diagnostics": ...}}`.
    pub fn answer(&mut self, request: &[u8]) -> Vec<u8> {
        let answered = serde_json::from_slice(request)
            .map_err(|error| Refused::from(format!("the request cannot be read: {error}")))
            .and_then(|request| self.carry_out(request));
        match answered {
            Ok(Answer::Json(value)) => encoded(&json!({ "ok": value })),
            Ok(Answer::Text(text)) => [br#"{"ok":"#, &text[..], b"}"].concat(),
            Err(refused) => encoded(&json!({ "error": refused })),
        }
    }

    /// Replaces `numbers` by the poses of a simulation's robots, see [`Session::poses`]. False if there is no such
    /// simulation.
    pub fn poses(&self, simulation: u32, numbers: &mut Vec<f64>) -> bool {
        numbers.clear();
        let session = self.sessions.get(&simulation);
        session
            .map(|session| numbers.extend(session.poses()))
            .is_some()
    }

    /// Replaces `numbers` by the frames of a simulation that were not taken yet, see [`Session::take_frames`]. False if
    /// there is no such simulation.
    pub fn frames(&mut self, simulation: u32, numbers: &mut Vec<f64>) -> bool {
        let session = self.sessions.get_mut(&simulation);
        session
            .map(|session| *numbers = session.take_frames())
            .is_some()
    }

    fn carry_out(&mut self, request: Request) -> Result<Answer, Refused> {
        let answer = match request {
            Request::Examples {} => answer(&all_examples()),
            Request::Schema {} => answer(&schema()),
            Request::Check { files } => answer(&check(&self.files(files), &self.registry)),
            Request::Hover {
                files,
                path,
                position,
            } => answer(&Document::open(&self.files(files), &path)?.hover(position)),
            Request::Complete {
                files,
                path,
                position,
            } => answer(&Document::open(&self.files(files), &path)?.complete(position)),
            Request::Definition {
                files,
                path,
                position,
            } => answer(&Document::open(&self.files(files), &path)?.definition(position)),
            Request::Outline { files, path } => {
                answer(&Document::open(&self.files(files), &path)?.outline())
            }
            Request::Format { text } => answer(&format(&text)),
            Request::Profiles {} => answer(&profiles()),
            Request::Try {
                files,
                options,
                profile,
                seed,
            } => {
                let (target, trial) = ((self.files(files), options), (&*profile, &*seed));
                answer(&self.trials.try_out(target, trial, &self.registry)?)
            }
            Request::ProfileScenario {
                files,
                options,
                profile,
                seed,
            } => {
                let (target, trial) = ((self.files(files), options), (&*profile, &*seed));
                answer(&self.trials.scenario(target, trial, &self.registry)?)
            }
            Request::Shrink {
                files,
                options,
                profile,
                seed,
                most,
            } => {
                let (target, trial) = ((self.files(files), options), (&*profile, &*seed));
                let most = most.unwrap_or(Limits::default().trials);
                answer(&self.trials.shrink(target, trial, most, &self.registry)?)
            }
            Request::Open {
                files,
                options,
                topics,
            } => {
                let mut session = Session::open(&self.files(files), &options, &self.registry)?;
                if let Some(topics) = topics {
                    session.set_topics(&topics)?;
                }
                Answer::Json(self.adopt(session))
            }
            Request::OpenRecorded { recorded, topics } => {
                let mut session = Session::open_recorded(recorded, &self.registry)?;
                if let Some(topics) = topics {
                    session.set_topics(&topics)?;
                }
                Answer::Json(self.adopt(session))
            }
            Request::Trace { simulation } => {
                Answer::Text(starl_trace::json_bytes(&self.session(simulation)?.trace()?))
            }
            Request::Close { simulation } => {
                self.session(simulation)?;
                self.sessions.remove(&simulation);
                Answer::Json(Value::Null)
            }
            Request::Status { simulation } => answer(&self.session(simulation)?.status()),
            Request::Step { simulation } => answer(&self.session(simulation)?.step()),
            Request::Run {
                simulation,
                until,
                steps,
                sample,
            } => {
                let budget = Budget {
                    until: until.map_or(Time::NEVER, |until| until.0),
                    steps: steps.unwrap_or(u64::MAX),
                };
                let sample = sample.map(|sample| sample.0);
                answer(&self.session(simulation)?.advance(budget, sample))
            }
            Request::Breakpoints {
                simulation,
                breakpoints,
            } => {
                self.session(simulation)?.set_breakpoints(breakpoints)?;
                Answer::Json(Value::Null)
            }
            Request::Apply {
                simulation,
                at,
                intervention,
            } => {
                let session = self.session(simulation)?;
                let at = at.map_or(Time::ZERO, |at| at.0);
                session.apply(at, intervention)?;
                Answer::Json(Value::Null)
            }
            Request::Snapshot { simulation } => answer(&self.session(simulation)?.snapshot()),
            Request::Restore {
                simulation,
                snapshot,
            } => answer::<Status>(&self.session(simulation)?.restore(snapshot)?),
            Request::Drop {
                simulation,
                snapshot,
            } => {
                self.session(simulation)?.forget(snapshot)?;
                Answer::Json(Value::Null)
            }
            Request::Scenario { simulation } => answer(&self.session(simulation)?.scenario()),
            Request::Records { simulation, max } => {
                let session = self.session(simulation)?;
                let batch = session.take_records(max.unwrap_or(usize::MAX));
                let records = starl_trace::json_list(&batch.records);
                let rest = format!(r#","left":{},"dropped":{}}}"#, batch.left, batch.dropped);
                Answer::Text([br#"{"records":"#, &records[..], rest.as_bytes()].concat())
            }
            Request::World { simulation } => answer(&World::of(self.session(simulation)?.run())),
            Request::Fleet { simulation } => answer(&fleet(self.session(simulation)?.run())),
            Request::States { simulation } => answer(&states(self.session(simulation)?.run())),
            Request::Values { simulation } => {
                answer(&self.session(simulation)?.take_shared_values())
            }
            Request::Robot { simulation, robot } => {
                let found = self.session(simulation)?.robot(robot);
                answer(&found.ok_or_else(|| format!("there is no robot {robot}"))?)
            }
            Request::Report { simulation } => answer(&self.session(simulation)?.report()),
        };
        Ok(answer)
    }
}

/// The answer to a request.
enum Answer {
    /// A value.
    Json(Value),
    /// A value that is written down already.
    Text(Vec<u8>),
}

/// Numbers that are infinite or not a number become null.
fn answer<T: Serialize + ?Sized>(content: &T) -> Answer {
    Answer::Text(encoded(content))
}

fn encoded<T: Serialize + ?Sized>(content: &T) -> Vec<u8> {
    serde_json::to_vec(content)
        .unwrap_or_else(|error| unreachable!("plain data can be written as JSON: {error}"))
}

/// The examples with their files; those that are not text are left out.
fn all_examples() -> Vec<Value> {
    let example = |example: &examples::Example| {
        let own = example.path.rsplit('/').next().unwrap_or(example.path);
        let mut files = BTreeMap::from([(own, example.text)]);
        let texts = example.files.iter();
        files.extend(texts.filter_map(|(path, bytes)| Some((*path, str::from_utf8(bytes).ok()?))));
        json!({
            "name": example.name,
            "summary": example.summary,
            "scenario": own,
            "files": files,
        })
    };
    EXAMPLES.iter().map(example).collect()
}
