//! The result of a function without arguments is computed when the program is loaded. Calling it returns the same
//! result as running it, at a lower cost, and its errors occur at the call.

use crate::machine_support::{call_within, program};
use starl_lang::machine::{Fault, Limits};

/// Calls the second function, which is made of this body.
fn called(body: &str) -> (Result<Vec<u64>, Fault>, u64) {
    let text = format!(
        "function f function () (Int) registers 8 objects 0\n call r0 b0 f1\n return_scalar r0 #0\n\
         function g function () (Int) registers 8 objects 0\n{body}"
    );
    let (outcome, used) = call_within(&program(&text), Limits::default(), &[], &[]);
    let outcome = outcome.map(|(scalars, _)| scalars);
    (outcome.map_err(|error| error.fault), used)
}

#[test]
fn it_is_not_run_again() {
    let many = "int r0 0\n int r1 0\n int r2 1000\nagain:\n add_constant r0 r0 2\n loop r1 r2 @again\n\
                return_scalar r0 #0";
    assert_eq!(called(many), (Ok(vec![2000]), 2));
}

#[test]
fn errors_occur_at_the_call() {
    let wrong = "int r0 1\n int r1 0\n divide_int r0 r0 r1\n return_scalar r0 #0";
    assert_eq!(called(wrong).0, Err(Fault::DivisionByZero));
}

#[test]
fn functions_that_take_too_long_are_loaded_anyway() {
    let endless = "again:\n jump @again\n return_scalar r0 #0";
    assert_eq!(called(endless).0, Err(Fault::OutOfFuel));
}

#[test]
fn objects_are_shared_and_can_be_changed() {
    let text = program(
        "type Text\n text \"a\"\n text \"b\"\n\
         function f function () (type0, type0) registers 1 objects 4\n\
         call r0 b0 f1\n call r0 b1 f1\n load_text b2 t1\n append_text b0 b2\n return #2 #4\n\
         function g function () (type0) registers 1 objects 1\n load_text b0 t0\n return #1 #1",
    );
    for _ in 0..2 {
        let (outcome, _) = call_within(&text, Limits::default(), &[], &[]);
        let (_, objects) = outcome.expect("no error");
        assert_eq!([objects[0].text(), objects[1].text()], ["ab", "a"]);
    }
}
