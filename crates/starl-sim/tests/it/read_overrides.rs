//! The command line changes any field, in the order given, as if the file said so.

use crate::reading;
use starl_core::{Duration, RobotId, Time};
use starl_sim::read::{self, Request, Source};
use starl_sim::scenario::{FaultKind, Parameter};

fn with(overrides: &[&str]) -> starl_sim::Scenario {
    let text = "program = \"race\"\nparameters = { speed = \"1m/s\", tries = 3 }\n\
        [[robots]]\nmodel = \"create\"\nparameters = { tries = 5 }\n\
        start = [{ position = [0, 0] }, { position = [1, 0] }]\n";
    reading::read(text, overrides)
        .unwrap_or_else(|problems| panic!("{problems}"))
        .scenario
}

#[test]
fn a_field_in_a_table_that_is_not_there_yet() {
    assert_eq!(with(&["network.loss=0.2"]).network.link.loss, 0.2);
    assert_eq!(
        with(&["network.delay = 100ms"]).network.link.delay,
        Duration::from_millis(100)
    );
    let avoidance = with(&["motion.avoidance.margin=5cm"]).motion.avoidance;
    assert_eq!(avoidance.unwrap().margin, 0.05);
    assert_eq!(with(&["motion.avoidance=false"]).motion.avoidance, None);
}

#[test]
fn the_last_one_counts() {
    assert_eq!(with(&["seed=1", "seed=2"]).seed, 2);
    let switched = with(&["motion.avoidance=false", "motion.avoidance.margin=5cm"]);
    assert!(switched.motion.avoidance.is_some());
}

#[test]
fn elements_of_lists() {
    let scenario = with(&["robots.0.start.1.heading=90deg", "robots.0.name=left"]);
    assert_eq!(
        scenario.fleet.groups[0].starts[1].yaw,
        std::f64::consts::FRAC_PI_2
    );
    assert_eq!(scenario.fleet.name(RobotId(1)), "left1");
}

#[test]
fn the_first_element_of_a_list_that_is_not_there_yet() {
    let text = "program = \"race\"\n[[robots]]\nmodel = \"create\"\n";
    let set = ["robots.0.start.0.position=[3, 4]"];
    let scenario = reading::read(text, &set).unwrap().scenario;
    assert_eq!(scenario.fleet.groups[0].starts[0].position.y, 4.0);
}

#[test]
fn a_whole_list() {
    let faults = with(&["fault=[{ at = \"2s\", kind = \"crash\", robots = \"all\" }]"]).faults;
    assert_eq!(faults.schedule[0].at, Time(2_000_000_000));
    assert_eq!(
        faults.schedule[0].kind,
        FaultKind::Crash(vec![RobotId(0), RobotId(1)])
    );
}

#[test]
fn parameters_of_programs_have_types() {
    let scenario = with(&["parameters.patience=3s", "robots.0.parameters.label=\"7\""]);
    let parameters = &scenario.fleet.groups[0].parameters;
    assert_eq!(parameters["speed"], Parameter::Float(1.0));
    assert_eq!(
        parameters["tries"],
        Parameter::Int(5),
        "the group goes before the scenario"
    );
    assert_eq!(
        parameters["patience"],
        Parameter::Duration(Duration::from_seconds(3))
    );
    assert_eq!(parameters["label"], Parameter::Text("7".to_string()));
}

#[test]
fn a_fault_file_adds_to_the_schedule_and_replaces_rates() {
    let text = "program = \"race\"\n[[robots]]\nmodel = \"create\"\nstart = [{ position = [0, 0] }]\n\
        [[fault]]\nat = \"1s\"\nkind = \"heal\"\n[fault_rates]\ncrash = \"1/min\"\nstuck_motor = \"1/h\"\n";
    let faults = "[[fault]]\nat = \"2s\"\nkind = \"restart\"\nrobots = [\"create0\"]\n\
        [fault_rates]\ncrash = \"2/min\"\n";
    let request = Request {
        faults: Some(Source::new("faults.toml", faults)),
        ..reading::request(text, &["fault.1.at=3s"])
    };
    let read = read::scenario(&request, &reading::Files::default())
        .unwrap()
        .scenario
        .faults;
    let times: Vec<Time> = read.schedule.iter().map(|fault| fault.at).collect();
    assert_eq!(times, [Time(1_000_000_000), Time(3_000_000_000)]);
    assert_eq!(read.schedule[1].kind, FaultKind::Restart(vec![RobotId(0)]));
    assert_eq!(
        (read.rates.crash, read.rates.stuck_motor),
        (2.0 / 60.0, 1.0 / 3600.0)
    );
}

#[test]
fn links_name_robots_and_groups_and_inherit_the_rest() {
    let network = with(&[
        "network.loss=0.1",
        "network.link=[{ from = [\"create1\"], delay = \"1ms\" }, { to = [\"create\"] }]",
    ])
    .network;
    assert_eq!(network.overrides[0].from, Some(vec![RobotId(1)]));
    assert_eq!(network.overrides[0].to, None);
    let link = network.overrides[0].link;
    assert_eq!((link.delay, link.loss), (Duration::from_millis(1), 0.1));
    assert_eq!(network.overrides[1].to, Some(vec![RobotId(0), RobotId(1)]));
}
