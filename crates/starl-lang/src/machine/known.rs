//! Functions that have no arguments and see neither the state nor the host, such as those that make the value of a
//! constant: their results never change, so they are computed once, when the program is loaded.
//!
//! Invariant: calling such a function and using its known result differ only in fuel.

use crate::machine::bytecode::FunctionKind;
use crate::machine::host::{Host, HostCall};
use crate::machine::interpreter::workspace::Workspace;
use crate::machine::interpreter::{Limits, Machine};
use crate::machine::program::{Known, Program};
use crate::machine::value::object::Object;
use crate::machine::value::state::State;
use alloc::borrow::Cow;
use alloc::vec::Vec;

/// The results of a program's functions, by number; none of those that have arguments, see something, or end in an
/// error. All together use at most the fuel of one activation; otherwise they are computed in the activations.
pub(in crate::machine) fn of(program: &Program) -> Vec<Option<Known>> {
    let (mut state, mut workspace) = (State::default(), Workspace::new());
    let mut fuel = Limits::default().fuel;
    let functions = program.bytecode.functions.iter().zip(0u32..);
    functions
        .map(|(function, number)| {
            if function.kind != FunctionKind::Function || !function.arguments.is_empty() {
                return None;
            }
            let limits = Limits {
                fuel,
                ..Limits::default()
            };
            let mut host = Nobody;
            let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, limits);
            let known = machine
                .call(number, &[], &[])
                .ok()
                .map(|(scalars, objects)| Known {
                    scalars: scalars.to_vec(),
                    objects: objects.to_vec(),
                    bytes: objects.iter().map(Object::bytes).sum(),
                });
            fuel = machine.fuel();
            known
        })
        .collect()
}

/// These functions cannot call the host.
struct Nobody;

impl Host for Nobody {
    fn call(&mut self, _: u32, _: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        Err("a constant cannot call the host".into())
    }
}
