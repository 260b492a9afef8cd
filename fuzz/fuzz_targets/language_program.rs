//! Every program that is generated from bytes is well typed, does on the machine what it means, never
//! goes wrong, and means the same in any layout and formatted. With `SHOW` in the environment the program
//! is printed, to look at what was found. Seeds: `fuzz/seeds/language_program`.

#![no_main]

use libfuzzer_sys::fuzz_target;

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../crates/starl-lang/tests/it/support/mod.rs"]
mod support;

fuzz_target!(|bytes: &[u8]| {
    let bytes = &bytes[..bytes.len().min(2000)];
    if std::env::var_os("SHOW").is_some() {
        eprintln!("{}", support::generate::program(bytes));
    }
    support::hold::all(bytes);
});
