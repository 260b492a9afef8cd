//! A scenario that is written and read again is the same scenario.

use crate::engine_support::{Wander, simulate};
use crate::reading::{self, fields};
use starl_core::Duration;
use starl_sim::read::{self, Override};
use starl_sim::{Scenario, write};

/// The scenario read from the written one.
fn again(scenario: &Scenario) -> Scenario {
    let text = write::scenario(scenario);
    match reading::read(&text, &[]) {
        Ok(resolved) => resolved.scenario,
        Err(problems) => panic!("{problems}\n{text}"),
    }
}

fn assert_same(scenario: &Scenario, what: &str) {
    let (written, read) = (format!("{scenario:#?}"), format!("{:#?}", again(scenario)));
    for (line, (written, read)) in written.lines().zip(read.lines()).enumerate() {
        assert_eq!(written, read, "{what}, line {line}");
    }
    assert_eq!(written.len(), read.len(), "{what}");
}

#[test]
fn a_scenario_at_its_defaults_is_the_same_again() {
    let read = reading::read(reading::LEAST, &[]).unwrap().scenario;
    assert_same(&read, "the least scenario");
}

#[test]
fn every_field_is_written() {
    let files = fields::files();
    let mut count = 0;
    fields::walk(&mut |path, field| {
        let (path, value) = fields::sample(path, field);
        let mut request = reading::request(fields::FULL, &[]);
        request.overrides = vec![Override::named("--set", &path, &value)];
        let read = read::scenario(&request, &files).unwrap_or_else(|problems| panic!("{problems}"));
        assert_same(&read.scenario, &format!("{path}={value}"));
        count += 1;
    });
    assert!(count > 90, "only {count} fields were tried");
}

#[test]
fn parameters_keep_their_kinds() {
    let text = r#"
        program = "p.starl"
        [parameters]
        flag = true
        count = -3
        whole = 2.0
        tiny = 1e-12
        text = "a \"b\" \\ c"
        "odd name" = "250ms"
        list = [[1, 2.5], ["x", "3s"], []]
        [[robots]]
        model = "create"
        name = "a b"
        start = [{ position = [0.1, -0.2], heading = "33deg" }]
    "#;
    let read = reading::read(text, &[]).unwrap().scenario;
    assert_same(&read, "parameters");
}

#[test]
fn it_runs_the_same() {
    let text = r#"
        program = "wander"
        goal = "duration"
        duration = "20s"
        seed = 7
        [world]
        bounds = { low = [0, 0], high = [4, 4] }
        [[world.obstacle]]
        polygon = [[1.3, 1.7], [2.1, 1.7], [2.1, 1.9]]
        hidden = true
        [[robots]]
        model = "create"
        count = 3
        sensors = { proximity = true }
        clock = { offset = "7s", drift = "123ppm" }
        [[robots]]
        model = "differential"
        model_parameters = { radius = "61mm" }
        count = 2
        [positioning]
        position_noise = "5mm"
        heading_noise = "0.5deg"
        [motion]
        speed_noise = "2%"
        [network]
        loss = "20%"
        duplication = 0.1
        [fault_rates]
        crash = "0.1/s"
        restart_after = "700ms"
        partition = "0.2/s"
        [[fault]]
        at = "1234567890ns"
        kind = "partition"
        groups = [["create0", "differential"], ["create2"]]
        [[event]]
        rate = "1/s"
        within = { low = [0.5, 0.5], high = [3, 3] }
        kind = "set_way_point"
        name = "A"
        [[event]]
        rate = "10/min"
        kind = "push"
        robot = "create1"
        by = [0.1, -0.1]
        [[event]]
        at = "3s"
        kind = "join"
        like = "differential0"
        name = "late"
        position = [0.3, 0.3]
        heading = "20deg"
        [[event]]
        at = "4s"
        kind = "crash"
        robots = ["late", "create"]
    "#;
    let read = reading::read(text, &[]).unwrap().scenario;
    let digest = |scenario: Scenario| {
        let end = starl_core::Time::ZERO + scenario.duration;
        let mut simulation = simulate(scenario, Wander::default());
        while simulation.now() < end {
            simulation.step();
        }
        simulation.digest()
    };
    let written = again(&read);
    assert_eq!(digest(read.clone()), digest(written));
    let mut other = read.clone();
    other.duration = Duration::from_seconds(19);
    assert_ne!(digest(read), digest(other), "the runs show nothing");
}
