//! Properties excuse faults: robots that are down, variables that were just overwritten, times after a fault, and false
//! assumptions.

use crate::robot_properties::{Given, rows, seconds};
use starl_core::{Duration, Point};
use starl_lang::machine::Value;
use starl_lang::robot::properties::{Excuse, Standing};

const SAFE: &str = "program Safe

x: Int = 0

work()
    eff x += 1

always small: x < 10
always near: forall r: r.position.x < 5.0
always bodies: forall r: r.position.x < 5.0 despite crashes
always slow: x < 10 recovers within 20s
always alone: forall r: r.x < 10 assuming crashed == 0
";

#[test]
fn robots_that_are_down_are_excused_by_default() {
    let mut fleet = Given::new(SAFE, 3);
    let mut judge = fleet.judge();
    fleet.up[1] = false;
    fleet.set(1, "x", Value::Int(10));
    fleet.places[1] = Point::planar(9.0, 0.0);
    let found = judge.observe(seconds(5), &fleet);
    let names: Vec<&str> = found.iter().map(|violation| &*violation.name).collect();
    assert_eq!(names, ["bodies"]);
    assert_eq!(rows(&found), [[1]]);
    let excused = |property| judge.excused(property).collect::<Vec<_>>();
    assert_eq!(excused(0), [(Excuse::Down, 1)]);
    assert_eq!(excused(1), [(Excuse::Down, 1)]);
    // It starts again as it is.
    fleet.up[1] = true;
    let found = judge.observe(seconds(6), &fleet);
    let names: Vec<&str> = found.iter().map(|violation| &*violation.name).collect();
    assert_eq!(names, ["small", "near", "slow", "alone"]);
}

#[test]
fn overwritten_variables_are_not_judged_for_a_while() {
    let mut fleet = Given::new(SAFE, 1);
    let mut judge = fleet.judge();
    fleet.set(0, "x", Value::Int(10));
    fleet.places[0] = Point::planar(9.0, 0.0);
    fleet.uncorrupted = Duration::from_millis(900);
    let names = |found: &[starl_lang::robot::properties::Violation]| -> Vec<String> {
        found
            .iter()
            .map(|violation| violation.name.clone())
            .collect()
    };
    // No fault overwrites a robot's position.
    assert_eq!(
        names(&judge.observe(seconds(5), &fleet)),
        ["near", "bodies"]
    );
    fleet.uncorrupted = Duration::from_millis(1100);
    assert_eq!(
        names(&judge.observe(seconds(6), &fleet)),
        ["small", "alone"]
    );
    fleet.uncorrupted = Duration::from_seconds(20);
    assert_eq!(names(&judge.observe(seconds(25), &fleet)), ["slow"]);
    assert_eq!(
        judge.excused(3).collect::<Vec<_>>(),
        [(Excuse::Corruption, 1)]
    );
}

#[test]
fn a_run_in_which_nothing_was_overwritten_is_judged_from_its_start() {
    let mut fleet = Given::new(SAFE, 1);
    let mut judge = fleet.judge();
    fleet.set(0, "x", Value::Int(10));
    fleet.uncorrupted = Duration::from_millis(500);
    let found = judge.observe(starl_core::Time(500_000_000), &fleet);
    assert_eq!(found.len(), 3);
}

#[test]
fn nothing_is_judged_while_the_assumption_is_false() {
    let mut fleet = Given::new(SAFE, 2);
    let mut judge = fleet.judge();
    fleet.up[1] = false;
    fleet.set(0, "x", Value::Int(10));
    let found = judge.observe(seconds(5), &fleet);
    assert!(
        found.iter().all(|violation| violation.name != "alone"),
        "{found:?}"
    );
    assert_eq!(
        judge.excused(4).collect::<Vec<_>>(),
        [(Excuse::Down, 0), (Excuse::Assumption, 1)][1..]
    );
    fleet.up[1] = true;
    assert_eq!(judge.observe(seconds(6), &fleet)[0].name, "alone");
}

const LIVE: &str = "program Live

done: Bool = false

work()
    eff done = true

eventually each: done within 10s
eventually always stays: done within 10s
always follows: not done leads_to done within 10s
eventually together: forall r: r.done within 10s
";

#[test]
fn times_count_from_the_last_fault() {
    let mut fleet = Given::new(LIVE, 2);
    let mut judge = fleet.judge();
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    // A fault at 8 s.
    fleet.undisturbed = Duration::from_seconds(9);
    assert_eq!(judge.observe(seconds(17), &fleet), []);
    assert_eq!(
        judge.excused(0).collect::<Vec<_>>(),
        [(Excuse::Recovery, 2)]
    );
    fleet.undisturbed = Duration::from_seconds(11);
    let found = judge.observe(seconds(19), &fleet);
    let names: Vec<&str> = found.iter().map(|violation| &*violation.name).collect();
    assert_eq!(
        names,
        [
            "each", "each", "stays", "stays", "follows", "follows", "together"
        ]
    );
}

#[test]
fn eventually_always_must_stay_true() {
    let mut fleet = Given::new(LIVE, 1);
    let mut judge = fleet.judge();
    fleet.set(0, "done", Value::Bool(true));
    assert_eq!(judge.observe(seconds(9), &fleet), []);
    assert_eq!(judge.observe(seconds(11), &fleet), []);
    fleet.set(0, "done", Value::Bool(false));
    let found = judge.observe(seconds(12), &fleet);
    assert_eq!(found[0].name, "stays");
    assert_eq!(judge.standing(1), Standing::Violated);
    assert_eq!(judge.standing(0), Standing::Holds);
}

#[test]
fn a_robot_that_is_down_is_owed_nothing() {
    let mut fleet = Given::new(LIVE, 2);
    let mut judge = fleet.judge();
    fleet.set(0, "done", Value::Bool(true));
    fleet.up[1] = false;
    assert_eq!(judge.observe(seconds(5), &fleet), []);
    assert_eq!(judge.observe(seconds(50), &fleet), []);
    assert_eq!(judge.standing(3), Standing::Holds);
}
