//! The simulator for JavaScript and other hosts of WebAssembly.
//!
//! One buffer carries JSON both ways: the host asks for room with [`buffer`], writes a request there,
//! calls [`run`], and reads as many bytes as that returns from where [`answer`] says. No memory is
//! shared in any other way.

#![allow(
    unsafe_code,
    reason = "exported names are unsafe attributes; no pointer is followed here"
)]

use serde::{Deserialize, Serialize};
use starl_catalog::examples;
use starl_catalog::programs::Registry;
use starl_sim::read;
use std::sync::{Mutex, MutexGuard, PoisonError};

static BUFFER: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// What to run.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    /// An example's name.
    example: String,
    /// Fields of its scenario to set, as after `starl run --set`.
    #[serde(default)]
    set: Vec<String>,
    /// Another fleet, as after `starl run --robots`.
    robots: Option<String>,
}

/// What came of it.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    /// The run came to an end.
    Ran {
        /// The hash of all that happened, hexadecimal.
        digest: String,
        /// Its end, simulated seconds.
        sim_seconds: f64,
        /// What it came to: `reached`, `violated`, `timed_out` or `failed`.
        outcome: &'static str,
    },
    /// It could not start; the text says why.
    Refused(String),
}

fn shared() -> MutexGuard<'static, Vec<u8>> {
    BUFFER.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes room for a request of `length` bytes and says where.
#[unsafe(no_mangle)]
pub extern "C" fn buffer(length: usize) -> *mut u8 {
    let mut buffer = shared();
    buffer.clear();
    buffer.resize(length, 0);
    buffer.as_mut_ptr()
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    shared().as_ptr()
}

/// Carries out the request in the buffer, puts the answer there and returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn run() -> usize {
    let mut buffer = shared();
    let answer = match serde_json::from_slice(&buffer) {
        Ok(request) => carry_out(&request).unwrap_or_else(Answer::Refused),
        Err(error) => Answer::Refused(format!("the request is not as it should be: {error}")),
    };
    *buffer = serde_json::to_vec(&answer).unwrap_or_default();
    buffer.len()
}

fn carry_out(request: &Request) -> Result<Answer, String> {
    let example = examples::find(&request.example)
        .ok_or_else(|| format!("there is no example {:?}", request.example))?;
    let overrides: Result<_, _> = request
        .set
        .iter()
        .map(|assignment| read::Override::set(assignment))
        .collect();
    let wanted = read::Request {
        overrides: overrides.map_err(|problem| problem.to_string())?,
        robots: request.robots.clone(),
        ..read::Request::new(example.source())
    };
    let application = starl_catalog::read(&wanted, example, &Registry::default())
        .map_err(|refusal| refusal.to_string())?;
    let mut run = application.run().map_err(|error| error.message)?;
    while !run.is_over() {
        run.step();
    }
    Ok(Answer::Ran {
        digest: run.simulation().digest().to_string(),
        sim_seconds: run.simulation().now().seconds(),
        outcome: run.outcome().word(),
    })
}
