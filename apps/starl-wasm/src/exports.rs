//! The names that the module exports.
//!
//! One buffer carries JSON both ways: JavaScript requests memory with [`buffer`], writes a request there, calls
//! [`call`], and reads the returned number of bytes at [`answer`]. Numbers are read in place: [`poses`] and
//! [`poses_at`], [`frames`] and [`frames_at`]. Earlier results are invalid after the next call, and memory may have
//! grown.
//!
//! A panic is a bug of StarL and ends the instance: the call traps, and [`failure`] writes the message to [`answer`].

#![allow(
    unsafe_code,
    reason = "exported names are unsafe attributes; no pointer is followed here"
)]

use starl_catalog::service::Service;
use std::sync::{LazyLock, Mutex, MutexGuard, Once, PoisonError};
use std::{mem, panic};

static BUFFER: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static SERVICE: LazyLock<Mutex<Service>> = LazyLock::new(Mutex::default);
static NUMBERS: Mutex<Vec<f64>> = Mutex::new(Vec::new());
static HOOK: Once = Once::new();

fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes room for a request of `length` bytes and says where.
#[unsafe(no_mangle)]
pub extern "C" fn buffer(length: usize) -> *mut u8 {
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|panic| {
            *locked(&BUFFER) = panic.to_string().into_bytes();
        }));
    });
    let mut buffer = locked(&BUFFER);
    buffer.clear();
    buffer.resize(length, 0);
    buffer.as_mut_ptr()
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    locked(&BUFFER).as_ptr()
}

/// Carries out the request in the buffer, puts the answer there and returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    // Not locked meanwhile: the message of a panic goes there.
    let request = mem::take(&mut *locked(&BUFFER));
    let answer = locked(&SERVICE).answer(&request);
    let mut buffer = locked(&BUFFER);
    *buffer = answer;
    buffer.len()
}

/// After a trap: the length of the message of the panic.
#[unsafe(no_mangle)]
pub extern "C" fn failure() -> usize {
    locked(&BUFFER).len()
}

/// Takes the poses of a simulation's robots, see [`Service::poses`]; returns how many numbers there are, or -1 if
/// there is no such simulation.
#[unsafe(no_mangle)]
pub extern "C" fn poses(simulation: u32) -> isize {
    let mut numbers = locked(&NUMBERS);
    let is_known = locked(&SERVICE).poses(simulation, &mut numbers);
    count(is_known, &numbers)
}

/// Where the poses are: 64-bit floating-point numbers.
#[unsafe(no_mangle)]
pub extern "C" fn poses_at() -> *const f64 {
    locked(&NUMBERS).as_ptr()
}

/// Takes the frames of a simulation that were not taken yet, see [`Service::frames`]; returns how many numbers there
/// are, or -1 if there is no such simulation.
#[unsafe(no_mangle)]
pub extern "C" fn frames(simulation: u32) -> isize {
    let mut numbers = locked(&NUMBERS);
    let is_known = locked(&SERVICE).frames(simulation, &mut numbers);
    count(is_known, &numbers)
}

/// Where the frames are: 64-bit floating-point numbers.
#[unsafe(no_mangle)]
pub extern "C" fn frames_at() -> *const f64 {
    locked(&NUMBERS).as_ptr()
}

fn count(is_known: bool, numbers: &[f64]) -> isize {
    match is_known {
        true => numbers.len() as isize,
        false => -1,
    }
}
