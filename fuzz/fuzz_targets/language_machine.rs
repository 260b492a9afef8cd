//! Any text form of a program is refused, or read and written back the same; what the verifier takes
//! runs within its limits. Seeds: `fuzz/seeds/language_machine`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::{RobotId, message};
use starl_lang::machine::{
    Bytecode, Fault, Host, HostCall, Import, Layout, Limits, Machine, Object, Program, State,
    Workspace, assemble, disassemble,
};
use std::borrow::Cow;

/// A host that has every function; it gives zeros and nothing.
struct AnyHost(State);

impl Host for AnyHost {
    fn call(&mut self, _: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        call.scalars.fill(0);
        call.objects.fill(Object::EMPTY);
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        (robot.0 < 2).then_some(&self.0)
    }
}

fuzz_target!(|text: &str| {
    let Ok(bytecode) = assemble(text) else {
        return;
    };
    let stored: Option<Bytecode> = message::decode(&message::encode(&bytecode));
    assert_eq!(stored.as_ref(), Some(&bytecode));
    let Ok(program) = Program::load(bytecode, &|_: &Import| Some(0)) else {
        return;
    };
    let written = disassemble(program.bytecode());
    assert_eq!(
        assemble(&written).as_ref(),
        Ok(program.bytecode()),
        "{written}"
    );

    let limits = Limits {
        fuel: 2000,
        memory: 20_000,
    };
    let mut workspace = Workspace::new();
    let mut state = program.new_state();
    let mut host = AnyHost(program.new_state());
    for (index, function) in program.bytecode().functions.iter().enumerate() {
        let layout = Layout::of(&function.arguments);
        let scalars: Vec<u64> = (1..).take(layout.scalars.len()).collect();
        let objects = vec![Object::EMPTY; layout.objects.len()];
        let mut machine = Machine::new(&program, &mut state, &mut workspace, &mut host, limits);
        if let Err(error) = machine.call(index as u32, &scalars, &objects) {
            assert_ne!(error.fault, Fault::Malformed, "{error}");
        }
        assert!(state.bytes() <= 2 * limits.memory + 16 * state.scalars.len() + 1000);
    }
    // The program's final state can be shown, stored and compared.
    assert!(program.values(&state).count() <= program.bytecode().variables.len());
    let stored: Option<State> = message::decode(&message::encode(&state));
    assert_eq!(stored.as_ref(), Some(&state));
});
