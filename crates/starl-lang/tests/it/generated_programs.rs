//! Random programs that are well typed never go wrong.
//!
//! Bytes decide what a program is (`support/generate`); proptest makes the bytes, and of those that show a
//! fault the least.

use crate::support::compare::Compared;
use crate::support::{generate, hold};
use proptest::collection::vec;
use proptest::prelude::{Strategy, any};
use proptest::test_runner::{Config, RngSeed, TestError, TestRunner};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

/// Bytes, shown as the program that they stand for.
#[derive(Clone)]
struct Generated(Vec<u8>);

impl fmt::Debug for Generated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}, which is\n{}", self.0, generate::program(&self.0))
    }
}

/// Tries so many programs; those of another seed are others. `PROPTEST_CASES` and `PROPTEST_RNG_SEED` in
/// the environment ask for more and for others.
fn each(seed: u64, cases: u32, holds: impl Fn(&[u8])) {
    let asked = |name: &str| std::env::var_os(name).is_some();
    let default = Config::default();
    let config = Config {
        cases: if asked("PROPTEST_CASES") {
            default.cases
        } else {
            cases
        },
        rng_seed: match default.rng_seed {
            RngSeed::Fixed(other) => RngSeed::Fixed(other.wrapping_add(seed)),
            RngSeed::Random => RngSeed::Fixed(seed),
        },
        failure_persistence: None,
        max_shrink_iters: 20_000,
        ..default
    };
    let programs = vec(any::<u8>(), 0..1500).prop_map(Generated);
    let tried = TestRunner::new(config).run(&programs, |Generated(bytes)| {
        holds(&bytes);
        Ok(())
    });
    match tried {
        Ok(()) => {}
        Err(TestError::Fail(reason, least)) => panic!("{reason}\nof the bytes {least:?}"),
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

#[test]
fn the_checker_takes_them() {
    each(1, 1000, |bytes| {
        drop(hold::checks(&generate::program(bytes)))
    });
}

#[test]
fn the_machine_agrees_with_the_reference_interpreter() {
    let counts = RefCell::new(BTreeMap::<Option<Compared>, u32>::new());
    each(2, 600, |bytes| {
        let compiled = hold::compiled(&generate::program(bytes));
        let compared = compiled.map(|(checked, bytecode)| hold::means(&checked, &bytecode));
        *counts.borrow_mut().entry(compared).or_default() += 1;
    });
    // Else too little would be shown.
    let counts = counts.into_inner();
    let all: u32 = counts.values().sum();
    let percent = |of| counts.get(&of).copied().unwrap_or(0) * 100 / all;
    assert!(percent(Some(Compared::Whole)) > 40, "{counts:?}");
    assert!(percent(Some(Compared::Part)) < 5, "{counts:?}");
    assert!(percent(None) < 10, "{counts:?}");
}

#[test]
fn their_bytecode_is_the_same_written_as_text_and_read() {
    each(3, 300, |bytes| {
        if let Some((_, bytecode)) = hold::compiled(&generate::program(bytes)) {
            hold::can_be_written(&bytecode);
        }
    });
}

#[test]
fn they_mean_the_same_with_all_parentheses() {
    each(4, 300, |bytes| {
        if let Some((_, bytecode)) = hold::compiled(&generate::program(bytes)) {
            hold::needs_no_parentheses(bytes, &bytecode);
        }
    });
}

#[test]
fn they_mean_the_same_in_any_layout() {
    each(5, 300, |bytes| {
        let text = generate::program(bytes);
        if let Some((_, bytecode)) = hold::compiled(&text) {
            hold::has_any_layout(bytes, &text, &bytecode);
        }
    });
}
