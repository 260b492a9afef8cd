//! Runs of the examples, as a test wants them.

pub mod memory;

use starl_catalog::programs::Registry;
use starl_catalog::{Application, examples};
use starl_sim::Run;
use starl_sim::read::{Override, Request, Source};

/// The case.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// The example.
    pub example: &'a str,
    /// Another fleet than its own.
    pub robots: Option<&'a str>,
    /// Settings of its scenario.
    pub sets: &'a [&'a str],
    /// Another seed than its own.
    pub seed: Option<u64>,
    /// Faults, as the text of a file.
    pub faults: &'a str,
}

impl<'a> Case<'a> {
    pub const fn new(example: &'a str, sets: &'a [&'a str], seed: u64) -> Case<'a> {
        Case {
            example,
            robots: None,
            sets,
            seed: Some(seed),
            faults: "",
        }
    }

    /// The application of the case.
    pub fn application(&self) -> Application {
        let example = examples::find(self.example).expect("it is an example");
        let seed = self.seed.map(|seed| format!("seed={seed}"));
        let sets = self.sets.iter().copied().chain(seed.as_deref());
        let request = Request {
            overrides: sets.map(|set| Override::set(set).unwrap()).collect(),
            robots: self.robots.map(String::from),
            faults: (!self.faults.is_empty()).then(|| Source::new("faults.toml", self.faults)),
            ..Request::new(example.source())
        };
        starl_catalog::read(&request, example, &Registry::default()).unwrap()
    }

    /// The run before its first step.
    pub fn start(&self) -> Run {
        self.application().run().unwrap()
    }

    /// The run when it is over.
    pub fn run(&self) -> Run {
        let mut run = self.start();
        while !run.is_over() {
            run.step();
        }
        run
    }
}

/// The number of lines of code of a program, as `tools/program_lengths.py` counts them: without comments, parameters
/// and properties.
pub fn code_lines(program: &str) -> usize {
    let mut counts = true;
    let mut is_counted = |line: &&str| {
        let line = line.split("//").next().unwrap_or_default().trim_end();
        if !line.is_empty() && !line.starts_with(' ') {
            let left_out = ["param ", "invariant", "always", "eventually"];
            counts = !left_out.iter().any(|word| line.starts_with(word));
        }
        counts && !line.is_empty()
    };
    program.lines().filter(|line| is_counted(line)).count()
}
