//! Prints one JSON object. Its keys are described in `docs/reference/command.md`.

use crate::console;
use crate::failure::Failure;
use serde::Serialize;

/// Prints a value as one JSON object over several lines, and nothing else.
pub fn print(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value)
        .unwrap_or_else(|error| unreachable!("only plain data is printed: {error}"));
    console::print(&(text + "\n"))
}
