//! Writes a trace with every kind of event to the standard output, for readers to be tried on:
//! `cargo run -p starl-trace --example every_event > every_event.mcap`.

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../tests/it/common/mod.rs"]
mod common;

use std::io::Write;

fn main() -> std::io::Result<()> {
    let file = common::file(&starl_trace::ViewOptions::default());
    std::io::stdout().write_all(&file)
}
