//! Roles: the scenario gives the first, the program changes it, and what a role's robots do follows.

use crate::robot_support::{World, compile};
use starl_lang::machine::Value;
use starl_lang::robot::RobotProgram;

const ROLES: &str = r#"
program Roles

message Vote(round: Int)

radio = Broadcast()
votes: Int = 0

role follower
    patience: Int = 2

    count()
        pre patience > 0
        eff patience -= 1

    stand()
        pre patience == 0
        eff role = leader

role leader
    init
        radio.broadcast(Vote(1))

    lead()
        eff emit("leads")

    on Vote(from, round)
        votes += round

on Vote(from, _)
    votes += 10
"#;

#[test]
fn a_robot_that_changes_its_role_runs_the_actions_of_the_new_one() {
    let mut world = World::of(&compile(ROLES), 1);
    assert_eq!(world.get(0, "role"), Value::Variant("follower".into()));
    world.steps(3);
    assert_eq!(world.get(0, "role"), Value::Variant("leader".into()));
    assert!(!world.emitted(0).is_empty());
    let counts = world.actions(0);
    assert_eq!(
        counts.iter().filter(|name| name.contains("count")).count(),
        2
    );
}

#[test]
fn the_scenario_gives_the_first_role() {
    let code = compile(ROLES);
    let role = |name: &str| {
        let given = [("role", Value::Variant(name.into()))];
        RobotProgram::new(&code, &given)
    };
    let programs = vec![role("leader").unwrap(), role("leader").unwrap()];
    let mut world = World::new(programs);
    world.steps(2);
    // Each hears the other's vote: as any robot, and as a leader.
    assert_eq!(world.int(0, "votes"), 11);
    assert_eq!(world.int(1, "votes"), 11);
    let error = role("king").map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("follower, leader"), "{error}");
}
