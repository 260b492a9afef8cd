//! Valid code changed at random is refused by the verifier or runs within its limits; it never makes
//! the machine panic.

use crate::machine_support::{RACE, TestHost, every::EVERY, resolve};
use starl_core::{Random, RobotId, message};
use starl_lang::machine::{
    Block, Body, Bytecode, Fault, Layout, Limits, List, Machine, Map, Object, ObjectType, Parts,
    Program, State, Workspace, assemble, disassemble,
};

const LIMITS: Limits = Limits {
    fuel: 3000,
    memory: 20_000,
};

fn scalar(random: &mut Random) -> u64 {
    match random.below(5) {
        0 => u64::from(random.below(4)),
        1 => random.between(-10.0, 10.0).to_bits(),
        2 => (-i64::from(random.below(4))) as u64,
        3 => [u64::MAX, 1 << 63, i64::MAX as u64, f64::NAN.to_bits()][random.below(4) as usize],
        _ => u64::from(random.bits()) << 32 | u64::from(random.bits()),
    }
}

fn block(program: &Program, layout: &Layout, random: &mut Random) -> (Vec<u64>, Vec<Object>) {
    let scalars = layout.scalars.iter().map(|_| scalar(random)).collect();
    let objects = layout
        .objects
        .iter()
        .map(|&kind| object(program, kind, random));
    (scalars, objects.collect())
}

fn list(program: &Program, layout: &Layout, length: u32, random: &mut Random) -> List {
    let mut list = List::new(layout);
    for _ in 0..length {
        let (scalars, objects) = block(program, layout, random);
        let (scalars, objects) = (&scalars[..], &objects[..]);
        assert!(list.push(Block { scalars, objects }));
    }
    list
}

/// An object of this type; sets and the keys of maps are not in order, which the machine survives.
fn object(program: &Program, kind: u16, random: &mut Random) -> Object {
    let parts: &Parts = &program.parts()[usize::from(kind)];
    let length = random.below(4);
    match &program.bytecode().types[usize::from(kind)] {
        _ if length == 0 => Object::EMPTY,
        ObjectType::Text => ["a", "a, b", "caf\u{e9}"][length as usize - 1].into(),
        ObjectType::List(_) | ObjectType::Set(_) => {
            list(program, &parts.element, length, random).into()
        }
        ObjectType::Map(..) => Body::Map(Map::new(
            &list(program, &parts.element, length, random),
            &list(program, &parts.value, length, random),
        ))
        .into(),
        ObjectType::Area | ObjectType::Obstacles => Object::EMPTY,
    }
}

/// Runs every function with random arguments on a random state.
fn run(program: &Program, random: &mut Random) -> u32 {
    let mut workspace = Workspace::new();
    let mut faults = 0;
    for (index, function) in program.bytecode().functions.iter().enumerate() {
        let (scalars, objects) = block(program, program.state_layout(), random);
        let mut state = State {
            scalars: scalars.into(),
            objects: objects.into(),
        };
        let mut host = TestHost::default();
        host.states.insert(0, state.clone());
        let (scalars, objects) = block(program, &Layout::of(&function.arguments), random);
        let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, LIMITS);
        let result = machine.call(index as u32, &scalars, &objects).map(|_| ());
        if let Err(error) = result {
            assert_ne!(
                error.fault,
                Fault::Malformed,
                "{error}\n{}",
                disassemble(program.bytecode())
            );
            faults += 1;
        }
        assert!(machine.fuel() <= LIMITS.fuel);
    }
    let mut host = TestHost::default();
    let mut state = program.new_state();
    let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, LIMITS);
    let _ = machine.start();
    for action in 0..program.bytecode().actions.len() {
        let _ = machine.action(action as u32);
    }
    let _ = Machine::holds(program, 0, &[RobotId(0)], &mut workspace, &mut host, LIMITS);
    faults
}

#[test]
fn the_unchanged_programs_run() {
    let mut random = Random::keyed(3, &[0]);
    for text in [RACE, EVERY] {
        let bytecode = assemble(text).expect("it is well written");
        let program = Program::load(bytecode, &resolve).expect("it is valid");
        run(&program, &mut random);
    }
}

/// Bytes of the stored form changed: operands, instructions, types, tables.
#[test]
fn bytes_of_the_stored_form() {
    let mut random = Random::keyed(4, &[0]);
    let (mut taken, mut refused) = (0, 0);
    for text in [RACE, EVERY] {
        let stored = message::encode(&assemble(text).expect("it is well written"));
        for _ in 0..20_000 {
            let mut changed = stored.clone();
            for _ in 0..=random.below(2) {
                let place = random.below(changed.len() as u32) as usize;
                changed[place] = match random.below(3) {
                    0 => changed[place].wrapping_add(1),
                    1 => changed[place].wrapping_sub(1),
                    _ => random.bits() as u8,
                };
            }
            let Some(bytecode) = message::decode::<Bytecode>(&changed) else {
                continue;
            };
            match Program::load(bytecode, &resolve) {
                Ok(program) => {
                    run(&program, &mut random);
                    taken += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(
        taken > 1000 && refused > 1000,
        "{taken} taken, {refused} refused"
    );
}

/// Instructions moved, doubled and left out within the code.
#[test]
fn instructions_in_other_places() {
    let mut random = Random::keyed(5, &[0]);
    let (mut taken, mut refused) = (0, 0);
    for text in [RACE, EVERY] {
        let original = assemble(text).expect("it is well written");
        for _ in 0..10_000 {
            let mut bytecode = original.clone();
            let mut place = || random.below(original.code.len() as u32) as usize;
            let (from, to) = (place(), place());
            bytecode.code[to] = original.code[from];
            if random.chance(0.5) {
                bytecode.code[from] = original.code[to];
            }
            match Program::load(bytecode, &resolve) {
                Ok(program) => {
                    run(&program, &mut random);
                    taken += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(
        taken > 500 && refused > 500,
        "{taken} taken, {refused} refused"
    );
}
