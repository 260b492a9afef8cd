//! Barrier in programs: robots continue together.

use crate::robot_support::{World, compile};
use starl_lang::machine::Value;

const LAPS: &str = r#"
program Laps

gate = Barrier("gate")
loc: enum {lap, wait} = lap
left: Int = 3
laps: Int = 0
warned: Bool = false

go()
    pre loc == lap
    eff
        left -= 1
        if left == 0
            gate.arrive()
            loc = wait

next()
    pre loc == wait and gate.passed
    eff laps += 1; left = 3; loc = lap

warn()
    pre gate.failed
    eff warned = true
"#;

#[test]
fn laps_begin_together() {
    let mut world = World::of(&compile(LAPS), 4);
    world.wire.cut = [(1, 2)].into();
    for _ in 0..20 {
        world.steps(10);
        let laps = [0, 1, 2, 3].map(|robot| world.int(robot, "laps"));
        let (low, high) = (laps.iter().min(), laps.iter().max());
        assert!(high.unwrap() - low.unwrap() <= 1, "{laps:?}");
    }
    world.wire.cut.clear();
    world.steps(100);
    assert!((0..4).all(|robot| world.int(robot, "laps") >= 10));
}

#[test]
fn a_robot_knows_that_it_waits_for_a_crashed_robot() {
    let mut world = World::of(&compile(LAPS), 3);
    world.steps(50);
    assert_eq!(world.get(0, "warned"), Value::Bool(false));
    world.crash(2);
    world.steps(100);
    assert_eq!(world.get(0, "warned"), Value::Bool(true));
}
