//! The one command of StarL: checks, explains, runs, replays, shows, judges, tests, draws, lists and measures. See
//! `docs/reference/command.md`.
//!
//! As a library it is the same command with programs of one's own:
//!
//! ```no_run
//! use starl_core::{Primitives, Program, Robot};
//!
//! #[derive(Clone, Primitives)]
//! struct Idle;
//!
//! impl Program for Idle {
//!     fn activate(&mut self, _: &mut Robot<'_>) {}
//! }
//!
//! fn main() -> std::process::ExitCode {
//!     starl::command().program("idle", "do nothing", |_| Idle).run()
//! }
//! ```
//!
//! Exit status: 0 the goal was reached and no property violated (or, for other commands, all is as it
//! should be); 1 it was not; 2 bad input or an output that cannot be written, with one message on the
//! error stream. `starl explore` has a status of its own besides: see `explore/`.

mod args;
mod bench;
mod changed_program;
mod check;
mod cluster;
mod compare;
mod console;
mod diagram;
mod explain;
mod explore;
mod failure;
#[cfg(feature = "fleet")]
mod fleet;
#[cfg(not(feature = "fleet"))]
#[path = "no_fleet.rs"]
mod fleet;
mod fmt;
mod json;
mod list;
mod log;
mod lsp;
mod origin;
mod output;
mod outputs;
mod paths;
mod picture;
mod plot;
mod progress;
mod replay;
mod replay_robot;
mod report;
mod run;
mod sources;
mod summary;
mod sweep;
mod target;
mod test;
mod threads;
mod trace_output;
mod verify;
#[cfg(feature = "web")]
mod web;
#[cfg(not(feature = "web"))]
#[path = "no_web.rs"]
mod web;

pub use starl_catalog::Parameters;

use args::{Arguments, Command};
use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use starl_catalog::programs::Registry;
use starl_catalog::schema::schema;
use starl_core::Program;
use std::process::ExitCode;

/// The command, with the programs in Rust that StarL ships with.
pub fn command() -> CommandLine {
    CommandLine {
        registry: Registry::default(),
    }
}

/// The command and the programs in Rust that it knows.
#[derive(Clone, Debug)]
pub struct CommandLine {
    registry: Registry,
}

impl CommandLine {
    /// Adds a program: its name in scenarios, its summary in one line for `list`, and a function that makes a robot's
    /// program from the `parameters` of the scenario. A scenario with a parameter that `make` does not request is
    /// rejected.
    ///
    /// # Panics
    /// If the name is empty, is taken, or ends in `.starl`, which names files.
    #[must_use]
    pub fn program<P: Program + 'static>(
        self,
        name: &str,
        summary: &str,
        make: impl Fn(&mut Parameters<'_>) -> P + Send + Sync + 'static,
    ) -> CommandLine {
        CommandLine {
            registry: self.registry.with(name, summary, make),
        }
    }

    /// Does what the arguments of the process ask for, and returns its exit status.
    pub fn run(&self) -> ExitCode {
        let arguments = match Arguments::try_parse() {
            Ok(arguments) => arguments,
            Err(error) => return refuse(&error),
        };
        output::fail_beyond_size_limit();
        let registry = &self.registry;
        let result = match &arguments.command {
            Command::Explore(arguments) => return exit(explore::run(arguments, registry)),
            Command::Run(arguments) if arguments.open => web::serve_run(arguments, registry),
            Command::Run(arguments) => run::run(arguments, registry),
            Command::Replay(arguments) => match &arguments.robot {
                Some(name) => replay_robot::replay(arguments, name, registry),
                None => replay::replay(arguments, registry),
            },
            Command::Verify(arguments) => verify::verify(arguments, registry),
            Command::Test(arguments) => test::test(arguments, registry),
            Command::Sweep(arguments) => sweep::sweep(arguments, registry),
            Command::Compare(arguments) => compare::compare(arguments, registry),
            Command::Diagram(arguments) => diagram::diagram(arguments, registry),
            Command::Check(arguments) => check::run(arguments),
            Command::Fmt(arguments) => fmt::run(arguments),
            Command::Explain(arguments) => explain::run(arguments),
            Command::Lsp(_) => lsp::run(),
            Command::View(arguments) => web::serve_view(arguments, registry),
            Command::Robot(arguments) => fleet::robot(arguments, registry),
            Command::Emulate { what } => fleet::emulate(what, registry),
            Command::Fleet { command } => fleet::fleet(command, registry),
            Command::Web(arguments) => web::serve_page(arguments),
            Command::Schema => json::print(&schema()).map(|()| true),
            Command::List(arguments) => list::list(arguments, registry),
            Command::Bench(arguments) => bench::bench(arguments),
        };
        exit(result.map(|is_well| ExitCode::from(u8::from(!is_well))))
    }
}

/// Prints an error in the arguments, or the text that was requested, such as the help.
fn refuse(error: &clap::Error) -> ExitCode {
    let argument = error.get(ContextKind::InvalidArg);
    if let (ErrorKind::UnknownArgument, Some(ContextValue::String(word))) = (error.kind(), argument)
        && word.starts_with('-')
        && word.parse::<f64>().is_ok()
    {
        // A field and its value as two words: the parser would say that `-- -1` passes a value.
        let form = match option_before(word) {
            Some((option, value)) => format!("{option}={value}"),
            None => format!("--set parameters.count={word}"),
        };
        let message = format!(
            "{word} does not belong to an option; join a value to its option, as in {form}"
        );
        console::error(&message);
        return ExitCode::from(2);
    }
    // Without a reader there is no output.
    let _ = error.print();
    ExitCode::from(error.exit_code() as u8)
}

/// The option before the argument that begins with `word`, which is negative, and that argument.
fn option_before(word: &str) -> Option<(String, String)> {
    let next = std::env::args().skip(1);
    std::env::args()
        .zip(next)
        .find(|(option, value)| option.starts_with("--") && value.starts_with(word))
}

/// The status, or one message on what went wrong.
fn exit(result: Result<ExitCode, failure::Failure>) -> ExitCode {
    result.unwrap_or_else(|failure| {
        console::error(&failure.0);
        ExitCode::from(2)
    })
}
