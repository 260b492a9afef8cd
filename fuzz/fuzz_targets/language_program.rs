//! Every program that is generated from bytes is well typed, does on the machine what it means, never
//! goes wrong, and means the same in any layout and formatted. With `SHOW` in the environment the program
//! is printed, to look at what was found. Seeds: `fuzz/seeds/language_program`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use support::{generate, hold};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../crates/starl-lang/tests/it/support/mod.rs"]
mod support;

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../crates/starl-editor/tests/it/support/formatting.rs"]
mod formatting;

fuzz_target!(|bytes: &[u8]| {
    let bytes = &bytes[..bytes.len().min(2000)];
    let text = generate::program(bytes);
    if std::env::var_os("SHOW").is_some() {
        eprintln!("{text}");
    }
    hold::all(bytes);
    formatting::keeps(&generate::layout::other(&text, bytes));
});
