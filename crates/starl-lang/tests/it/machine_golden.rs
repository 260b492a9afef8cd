//! The program with every instruction leaves the same state for the same fuel, always and everywhere.

use crate::machine_support::{TestHost, every::EVERY, program};
use starl_core::Digest;
use starl_lang::machine::{Limits, Machine, Workspace};

#[test]
fn the_same_state_for_the_same_fuel() {
    let program = program(EVERY);
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let limits = Limits::default();
    let mut machine = Machine::new(&program, &mut state, &mut workspace, &mut host, limits);
    machine.defaults().expect("no error");
    machine.start().expect("no error");
    let numbers = [3i64 as u64, 5];
    let (scalar, _) = machine.call(0, &numbers, &[]).expect("no error");
    assert_eq!(scalar, [1]);
    let points = [1.0, 2.0, 0.5, -1.0, 0.25, 3.0].map(f64::to_bits);
    let (distance, _) = machine.call(1, &points, &[]).expect("no error");
    let expected = starl_core::math::sqrt(2.25 * 2.25 + 3.5 * 3.5);
    assert_eq!(f64::from_bits(distance[0]), expected);
    let used = limits.fuel - machine.fuel();
    let mut digest = Digest::default();
    state.digest(&mut digest);
    assert_eq!(
        (digest.to_string().as_str(), used),
        ("102c01f7cb155ab3", 290)
    );
}
