//! Properties read shared variables as each robot reads them, from its own copy.

use crate::robot_support::seen::Seen;
use crate::robot_support::{World, compile};
use starl_core::{Duration, Input, Random, RobotId};
use starl_lang::robot::properties::{Excuse, Judge, Standing, Violation};

/// The second robot writes; the first one only hears of it, so none of its actions or handlers runs.
const SHARED: &str = r#"
program Shared

allread places[RobotId]: Point
allwrite counter: Int = 7
allwrite note: String

tell()
    pre robot_name(me) == "robot1" and counter == 7
    eff counter = 100; places[me] = Point(1.0, 2.0); note = "written"

always small: counter < 100
always agreed: forall r, s: r.counter == s.counter
always noted: forall r: forall s in r.places: some p = r.places[s] and p.x == 1.0 and r.note != none
always own: places[me] == none or Int(me) == 1
eventually heard: counter == 100 within 1s
eventually all: exists r: r.places.size() == 1 and r.id in r.places
always fresh: counter == 7 leads_to counter == 100 within 1s
"#;

fn names(violations: &[Violation]) -> Vec<String> {
    let row = |violation: &Violation| {
        let robots: Vec<u32> = violation.robots.iter().map(|robot| robot.0).collect();
        format!("{} {robots:?}", violation.name)
    };
    violations.iter().map(row).collect()
}

#[test]
fn each_robot_by_its_own_copy() {
    let code = compile(SHARED);
    let mut world = World::of(&code, 2);
    let mut judge = Judge::new(&code);
    assert_eq!(judge.observe(world.now, &Seen::new(&world)), []);

    // The message with the write has not arrived.
    world.input(1, &Input::Activate);
    let found = judge.observe(world.now, &Seen::new(&world));
    let expected = ["small [1]", "agreed [0, 1]", "agreed [1, 0]"];
    assert_eq!(names(&found), expected);
    let texts: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert_eq!(
        texts[..2],
        [
            "is not true; robot 1 at (0.00, 0.00, 0.00): counter = 100",
            "is not true; robot 0 at (0.00, 0.00, 0.00): counter = 7; \
             robot 1 at (0.00, 0.00, 0.00): counter = 100",
        ]
    );
    assert_eq!(judge.standing_of(4, &[RobotId(0)]), Standing::Open);
    assert_eq!(judge.standing_of(4, &[RobotId(1)]), Standing::Holds);

    let version = world.program(0).version();
    world.steps(2);
    assert_eq!(world.program(0).version(), version, "it has only listened");
    let found = judge.observe(world.now, &Seen::new(&world));
    assert_eq!(names(&found), ["small [0]"]);
    for property in [2, 3, 4, 5, 6] {
        assert_eq!(judge.standing(property), Standing::Holds, "{property}");
    }
}

#[test]
fn overwritten_copies_are_excused() {
    let code = compile(
        "program Kept

allwrite counter: Int = 7

write()
    pre counter == 7
    eff counter = 8

always eight: counter == 8
",
    );
    let mut world = World::of(&code, 1);
    world.steps(2);
    let mut excused = 0;
    for seed in 0..20 {
        let mut world = world.clone();
        world.corrupt(0, &mut Random::keyed(seed, &[1]));
        let mut judge = Judge::new(&code);
        let after_a_fault = Seen {
            uncorrupted: Duration::ZERO,
            ..Seen::new(&world)
        };
        assert_eq!(judge.observe(world.now, &after_a_fault), []);
        excused += judge
            .excused(0)
            .map(|(excuse, count)| {
                assert_eq!(excuse, Excuse::Corruption);
                count
            })
            .sum::<u64>();
        let judged = Judge::new(&code).observe(world.now, &Seen::new(&world));
        assert_eq!(judged.len() as u64, judge.excused(0).count() as u64);
    }
    assert!(excused > 5, "{excused}");
}
