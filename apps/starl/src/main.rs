//! The command as it ships; all of it is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    starl::command().run()
}
