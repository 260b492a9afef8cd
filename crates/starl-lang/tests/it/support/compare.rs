//! Holding the compiler and the machine to what the program means.

use super::reference::{Reference, Stop};
use super::run::{Input, Run, inputs};
use starl_lang::ir;
use starl_lang::machine::{Bytecode, Fault, Program, RuntimeError, Value};

/// How far a program was compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Compared {
    /// To the end.
    Whole,
    /// To a run-time error, the same in both.
    Error,
    /// To where it takes too long, or the language does not say what happens.
    Part,
}

/// Runs a program on the machine and by its meaning; panics where they differ.
pub fn compare(program: &ir::Program, bytecode: &Bytecode, loaded: &Program) -> Compared {
    let mut run = Run::new(loaded);
    let mut reference = Reference::new(program, bytecode);
    for input in inputs(bytecode) {
        let event = run_event(program, &run, input);
        let meant = match input {
            Input::Defaults => reference.defaults().map(|()| true),
            Input::Start => reference.start().map(|()| true),
            Input::Action(number) => reference.action(&program.actions[number as usize]),
            Input::Handler(number) => {
                let handler = &program.handlers[number as usize];
                reference.handler(handler, &event).map(|()| true)
            }
        };
        let done = run.input(input);
        match verdict(&done, &meant) {
            Verdict::Same => {}
            Verdict::Limited => return Compared::Part,
            Verdict::Different => panic!("{input:?} gives {done:?}, but means {meant:?}"),
        }
        if done.is_err() {
            return Compared::Error;
        }
        let left: Vec<String> = loaded
            .values(&run.state)
            .map(|(name, value)| format!("{name} = {value:?}"))
            .collect();
        let right: Vec<String> = reference
            .values()
            .iter()
            .map(|(name, value)| format!("{name} = {value:?}"))
            .collect();
        assert_eq!(left, right, "after {input:?}");
        assert_eq!(run.host.world.log, reference.world.log, "after {input:?}");
    }
    for (done, meant) in run.properties().iter().zip(reference.properties()) {
        let is_same = verdict(done, &meant) != Verdict::Different;
        assert!(is_same, "a property gives {done:?}, but means {meant:?}");
    }
    Compared::Whole
}

#[derive(PartialEq)]
enum Verdict {
    Same,
    Different,
    Limited,
}

fn verdict(done: &Result<bool, RuntimeError>, meant: &Result<bool, Stop>) -> Verdict {
    match (done, meant) {
        (_, Err(Stop::Unknown | Stop::TooLong)) => Verdict::Limited,
        (Err(error), _) if is_limit(&error.fault) => Verdict::Limited,
        (Ok(done), Ok(meant)) if done == meant => Verdict::Same,
        (Err(error), Err(Stop::Fault(fault))) if error.fault == *fault => Verdict::Same,
        _ => Verdict::Different,
    }
}

fn is_limit(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::OutOfFuel | Fault::OutOfMemory { .. } | Fault::CallDepth
    )
}

/// The parts of the event that a handler gets, with their types.
fn run_event(program: &ir::Program, run: &Run<'_>, input: Input) -> Vec<(ir::Type, Value)> {
    let Input::Handler(number) = input else {
        return Vec::new();
    };
    let mut run = run.split();
    run.host.world.moment += 1;
    let types = match &program.handlers[number as usize].event {
        ir::Event::Message(id) => {
            let fields = program[*id].fields.iter().map(|field| field.ty.clone());
            std::iter::once(ir::Type::Robot).chain(fields).collect()
        }
        _ => vec![ir::Type::Int, ir::Type::list(ir::Type::Robot)],
    };
    types
        .into_iter()
        .zip(run.event(input))
        .map(|(ty, (_, value))| (ty, value))
        .collect()
}
