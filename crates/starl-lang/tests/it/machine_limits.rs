//! Fuel, memory and call depth limit every program.

use crate::machine_support::{RACE, TestHost, call, call_within, ints, program};
use starl_lang::machine::{Fault, Limits, Machine, Workspace};

const FOREVER: &str =
    "function f function () () registers 1 objects 0\nagain:\n jump @again\n return #0 #0";

fn limits(fuel: u64, memory: usize) -> Limits {
    Limits { fuel, memory }
}

#[test]
fn every_instruction_counts() {
    let program = program(
        "function f function (Int) (Int) registers 3 objects 0\n int r1 0\nagain:\n\
         add_constant r0 r0 1\n loop r1 r0 @next\nnext:\n return_scalar r0 #0",
    );
    let (outcome, used) = call_within(&program, limits(100, 1000), &[5], &[]);
    assert_eq!(outcome.expect("no error").0, [6]);
    assert_eq!(used, 4);
    for fuel in 0..4 {
        let (outcome, _) = call_within(&program, limits(fuel, 1000), &[5], &[]);
        let error = outcome.expect_err("there is not enough fuel");
        assert_eq!(
            (error.fault, error.position),
            (Fault::OutOfFuel, fuel as u32)
        );
    }
}

#[test]
fn loops_and_recursion_end() {
    let (outcome, used) = call_within(&program(FOREVER), limits(5000, 1000), &[], &[]);
    assert_eq!(outcome.map_err(|e| e.fault), Err(Fault::OutOfFuel));
    assert_eq!(used, 5000);
    for window in [0, 1, 255] {
        let text = format!(
            "function f function () () registers 256 objects 128\n\
             call r{window} b{} f0\n return #0 #128",
            window / 2
        );
        let (outcome, _) = call_within(&program(&text), limits(1_000_000, 1000), &[], &[]);
        let error = outcome.expect_err("it does not end");
        assert_eq!(
            (error.fault, error.position),
            (Fault::CallDepth, 0),
            "window {window}"
        );
    }
}

#[test]
fn an_activation_shares_its_fuel() {
    let program = program(RACE);
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let mut machine = Machine::new(
        &program,
        &mut state,
        &mut workspace,
        &mut host,
        limits(20, 4096),
    );
    machine.start().expect("there is enough for the start");
    let before = machine.fuel();
    assert_eq!(machine.guard(0), Ok(true));
    assert_eq!(machine.fuel(), before - 3);
    let rest = (0..20).find_map(|_| machine.guard(0).err());
    assert_eq!(rest.map(|error| error.fault), Some(Fault::OutOfFuel));
}

#[test]
fn work_on_collections_costs_by_their_size() {
    let program = program(
        "type List[Int]\n function f function (type0) (type0) registers 1 objects 1\n\
         list_sort b0 type0\n return #1 #1",
    );
    let cost = |size: i64| {
        let numbers: Vec<i64> = (0..size).rev().collect();
        call_within(&program, Limits::default(), &[], &[ints(&numbers)]).1
    };
    assert!(cost(2) < 10);
    assert!(
        cost(1000) > 1000,
        "1,000 elements, 10 levels, 8 bytes each over 64"
    );
    assert!(cost(2000) > 2 * cost(1000) && cost(2000) < 3 * cost(1000));
}

#[test]
fn the_cost_of_the_host_is_charged() {
    let program = program(
        "import expensive () ()\n function f procedure () () registers 1 objects 0\n\
         call_host r0 b0 h0\n return #0 #0",
    );
    let (_, used) = call_within(&program, Limits::default(), &[], &[]);
    assert_eq!(used, 1002);
    let (outcome, _) = call_within(&program, limits(500, 1000), &[], &[]);
    assert_eq!(outcome.map_err(|e| e.fault), Err(Fault::OutOfFuel));
}

/// Adds to a list for ever.
const GROWING: &str = "type List[Int]\n function f function () () registers 1 objects 1\n\
    clear_object b0 type0\n int r0 1\nagain:\n list_add b0 r0 b0 type0\n jump @again\n return #0 #1";

#[test]
fn memory_is_bounded() {
    for budget in [100, 1000, 100_000] {
        let (outcome, used) = call_within(&program(GROWING), limits(u64::MAX, budget), &[], &[]);
        let expected = Fault::OutOfMemory {
            budget: budget as u64,
        };
        assert_eq!(outcome.map_err(|e| e.fault), Err(expected));
        // Two instructions for each eight bytes, and a little for the counting.
        assert!(
            used >= 2 * (budget as u64 / 8 - 8),
            "{used} for {budget} bytes"
        );
    }
}

#[test]
fn copies_count_as_if_they_were_made() {
    // Doubles a list of lists' element by sharing: the memory that it stands for doubles too.
    let program = program(
        "type List[Int]\n type List[type0]\n\
         function f function (type0) () registers 1 objects 2\n\
         clear_object b1 type1\nagain:\n list_add b1 r0 b0 type1\n jump @again\n return #0 #2",
    );
    let list = ints(&[0; 1000]); // 8 kB
    let (outcome, used) = call_within(&program, limits(u64::MAX, 100_000), &[], &[list]);
    let expected = Fault::OutOfMemory { budget: 100_000 };
    assert_eq!(outcome.map_err(|e| e.fault), Err(expected));
    assert!(
        used > 11 * 125 && used < 15 * 150,
        "a share of 8 kB costs 125: {used}"
    );
}

#[test]
fn dropped_values_do_not_count() {
    let program = program(
        "type Text\n text \"0123456789012345678901234567890123456789\"\n\
         function f function (Int) (Int) registers 3 objects 1\n int r1 0\nagain:\n\
         load_text b0 t0\n append_text b0 b0\n loop r1 r0 @again\n return_scalar r1 #1",
    );
    let (outcome, _) = call_within(&program, limits(1_000_000, 500), &[10_000], &[]);
    assert_eq!(outcome.map(|(scalars, _)| scalars), Ok(vec![10_000]));
}

#[test]
fn a_workspace_serves_many_programs() {
    // After an error, and between programs, nothing of the one before is left.
    let (growing, race) = (program(GROWING), program(RACE));
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    for _ in 0..3 {
        let mut state = growing.new_state();
        let small = limits(u64::MAX, 10_000);
        let mut machine = Machine::new(&growing, &mut state, &mut workspace, &mut host, small);
        assert!(machine.call(0, &[], &[]).is_err());
        let mut state = race.new_state();
        let mut machine = Machine::new(
            &race,
            &mut state,
            &mut workspace,
            &mut host,
            limits(100, 300),
        );
        machine.start().expect("no error");
        assert_eq!(machine.action(0), Ok(true));
    }
    assert_eq!(
        call(&growing, &[], &[]).map_err(|e| e.fault),
        Err(Fault::OutOfFuel)
    );
}
