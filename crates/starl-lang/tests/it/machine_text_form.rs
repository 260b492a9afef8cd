//! The text form of a program: written, read back, and refused with the line that is wrong.

use crate::machine_support::{RACE, every::EVERY};
use starl_core::message;
use starl_lang::machine::{Bytecode, Instruction, assemble, disassemble};

#[test]
fn the_text_form_is_read_back() {
    let inputs = "program P\nhandler go input f0 f1 speed\nhandler halt input f1\nfunction on.input.go \
                  procedure (Bool, Float) () registers 2 objects 0\n return #0 #0\nfunction on.input.halt \
                  procedure () () registers 1 objects 0\n return #0 #0\n";
    let stable =
        "program P\nstable count Int\nvariable other Int\nparameter fixed Int in 0x0 0x5\n";
    for text in [RACE, EVERY, inputs, stable] {
        let bytecode = assemble(text).expect("it is well written");
        let written = disassemble(&bytecode);
        assert_eq!(assemble(&written).as_ref(), Ok(&bytecode), "{written}");
        let stored: Bytecode = message::decode(&message::encode(&bytecode)).expect("it was stored");
        assert_eq!(stored, bytecode);
    }
}

#[test]
fn the_example_has_every_instruction() {
    let bytecode = assemble(EVERY).expect("it is well written");
    for mnemonic in Instruction::MNEMONICS {
        let found = bytecode.code.iter().any(|i| i.mnemonic() == *mnemonic);
        assert!(found, "{mnemonic}");
    }
}

#[test]
fn names_stand_beside_numbers() {
    let written = disassemble(&assemble(RACE).expect("it is well written"));
    for line in [
        "    call_host r3 b0 h2 // Motion.reach_avoid",
        "    load r1 v1 // currentIndex",
        "    load_text b0 t0 // \"arrived\"",
        "    jump_if_state_not 0 @6 v0 // loc",
    ] {
        assert!(
            written.lines().any(|written| written == line),
            "{line}\n{written}"
        );
    }
}

#[test]
fn errors_name_the_line() {
    let function = "function f function () () registers 1 objects 0";
    for (text, line) in [
        ("program A\nnonsense", 2),
        ("type List[Int", 1),
        ("type Map[Int]", 1),
        ("variable x", 1),
        ("variable x Int?, Int", 1),
        ("constant one", 1),
        ("text \"open", 1),
        ("text \"\\q\"", 1),
        ("function f something () () registers 1 objects 0", 1),
    ] {
        assert_eq!(
            assemble(text).map_err(|error| error.line),
            Err(line),
            "{text}"
        );
    }
    for (body, line) in [
        ("\n jump @nowhere", 3),
        ("\n add_int r0 r0", 3),
        ("\n add_int r0 r0 r0 r0", 3),
        ("\n add_int r0 r256 r0", 3),
        ("\n copy_object b128 b0", 3),
        ("\n copy_object s128 b0", 3),
        ("\n unary r0 r0 secant", 3),
        ("\na:\na:", 4),
        ("\n fly r0", 3),
    ] {
        let text = format!("{function}\n{body}");
        assert_eq!(
            assemble(&text).map_err(|error| error.line),
            Err(line),
            "{text}"
        );
    }
}
