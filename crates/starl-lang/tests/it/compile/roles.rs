//! Roles: entering, leaving, their variables, and what only they do.

use starl_lang::machine::{Fault, Parameter, Value};

use super::support::Robot;

const SOURCE: &str = "program Test
message Ping()
base: Int = 10
init
    log(\"init {}\", role)
role scout
    seen: Int = base + 1
    names: List[String]
    init
        log(\"scout {} {}\", seen, names)
        seen = 5
        names.add(\"x\")
    look()
        pre seen > 4
        eff
            base = 20
            role = leader
            log(\"went on as {}\", role)
    on Ping(from)
        log(\"scout hears {}\", from)
role leader
    init
        log(\"leader\")
        if base == 99
            return
        log(\"of {}\", base)
    back()
        eff
            role = leader
            role = scout
    on Ping(from)
        log(\"leader hears {}\", from)
role idle
    seen_idle: Int
";

#[test]
fn entering_a_role_runs_its_init() {
    let mut robot = Robot::new(SOURCE);
    robot.start().unwrap();
    assert_eq!(
        robot.told(),
        ["log(\"init scout\")", "log(\"scout 11 []\")"]
    );
    assert_eq!(robot.get("names"), "[\"x\"]");
    assert_eq!(robot.action("leader.back"), Ok(false));
    assert_eq!(robot.action("scout.look"), Ok(true));
    assert_eq!(
        robot.told(),
        [
            "log(\"leader\")",
            "log(\"of 20\")",
            "log(\"went on as leader\")"
        ]
    );
    assert_eq!(robot.get("role"), "leader");
    assert_eq!(robot.action("scout.look"), Ok(false));
    // Becoming what one is already is nothing; variables get their first values again.
    assert_eq!(robot.action("leader.back"), Ok(true));
    assert_eq!(robot.told(), ["log(\"scout 21 []\")"]);
    assert_eq!(robot.get("seen"), "5");
}

#[test]
fn handlers_of_a_role_are_for_those_in_it() {
    let mut robot = Robot::started(SOURCE);
    robot.handle("Ping", &[super::support::robot(3)]).unwrap();
    assert_eq!(robot.told(), ["log(\"scout hears robot3\")"]);
    robot.action("scout.look").unwrap();
    robot.told();
    robot.handle("Ping", &[super::support::robot(3)]).unwrap();
    assert_eq!(robot.told(), ["log(\"leader hears robot3\")"]);
}

#[test]
fn the_scenario_may_say_the_first_role() {
    let mut robot = Robot::new(SOURCE);
    let variables = &robot.program.bytecode().variables;
    let role = variables
        .iter()
        .find(|variable| variable.name == "role")
        .unwrap();
    assert_eq!(role.parameter, Parameter::Optional);
    robot.set("role", &Value::Variant("leader".into()));
    robot.start().unwrap();
    assert_eq!(
        robot.told(),
        ["log(\"init leader\")", "log(\"leader\")", "log(\"of 10\")"]
    );
}

#[test]
fn roles_that_enter_each_other_for_ever_are_stopped() {
    let source =
        "program Test\nrole a\n    init\n        role = b\nrole b\n    init\n        role = a\n";
    let mut robot = Robot::new(source);
    assert_eq!(
        robot.start().expect_err("it has no end").fault,
        Fault::CallDepth
    );
}
