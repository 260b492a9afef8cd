//! Writes to standard output and to the error stream. A closed reader (`| head`) is not an error; a full disk is.

use crate::failure::Failure;
use starl_catalog::disk::reason;
use starl_lang::diagnostic::Colour;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Writes text to standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    let written = output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush());
    match written {
        // A closed output cannot be written to.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure(format!(
            "standard output: cannot be written: {}",
            reason(&error)
        ))),
        _ => Ok(()),
    }
}

/// The name of this command: `starl`, or that of a program that contains the command with programs of its own.
pub fn command() -> String {
    let path = std::env::args_os().next().map(PathBuf::from);
    let name = path.as_deref().and_then(Path::file_stem);
    name.map_or_else(|| "starl".to_string(), |name| name.display().to_string())
}

/// Writes a message to the error stream.
pub fn error(message: &str) {
    // In one piece, because several processes may write to the same terminal.
    complain(&format!("error: {message}\n"));
}

/// Writes text to the error stream.
pub fn complain(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Whether standard output is coloured.
pub fn colour() -> Colour {
    colour_where(io::stdout().is_terminal())
}

/// Whether the error stream is coloured.
pub fn colour_of_errors() -> Colour {
    colour_where(io::stderr().is_terminal())
}

/// A terminal is, unless the person does not want it (<https://no-color.org>) or it cannot.
fn colour_where(is_terminal: bool) -> Colour {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let unable = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
    match is_terminal && !refused && !unable {
        true => Colour::On,
        false => Colour::Off,
    }
}

/// `1 file`, `2 files`
pub fn counted(number: usize, thing: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {thing}{plural}", grouped(number as u64))
}

/// A whole number with its digits in groups of three: `1,234,567`.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Three significant digits or more, in groups of three where there are many.
pub fn rounded(number: f64) -> String {
    match number {
        n if !n.is_finite() => n.to_string(),
        n if n.abs() >= 100.0 => grouped(n.abs().round() as u64),
        n if n.abs() >= 10.0 => format!("{n:.1}"),
        n if n.abs() >= 0.1 || n == 0.0 => format!("{n:.2}"),
        n => format!("{n:.4}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_grouped_by_three() {
        let texts: Vec<String> = [0, 999, 1000, 1_234_567].map(grouped).to_vec();
        assert_eq!(texts, ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn small_and_large_numbers_stay_readable() {
        let texts: Vec<String> = [0.0, 0.0123, 0.5, 12.34, 1234.5].map(rounded).to_vec();
        assert_eq!(texts, ["0.00", "0.0123", "0.50", "12.3", "1,235"]);
    }
}
