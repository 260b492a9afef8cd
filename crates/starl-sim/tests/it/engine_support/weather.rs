//! The environment of primitives under test: robots that all hear each other, under increasing
//! faults, and the verdicts of all checkers.

use super::scenario;
use starl_core::{Duration, Event, Program};
use starl_sim::Run;
use starl_sim::scenario::{Clock, Scenario};

/// From calm to the worst; each does what the one before it does.
pub const WEATHERS: [fn(&mut Scenario); 4] = [calm, lossy, chaotic, corrupting];

/// This number of robots within range of each other for two minutes.
pub fn fleet(robots: u32, seed: u64) -> Scenario {
    let places: Vec<_> = (0..robots).map(|robot| (f64::from(robot), 0.0)).collect();
    let mut scenario = scenario("create", &places);
    scenario.seed = seed;
    scenario.duration = Duration::from_seconds(120);
    // Programs that do not drive may be put down on each other.
    scenario.properties.no_collision = false;
    scenario
}

/// Nothing goes wrong.
pub fn calm(_: &mut Scenario) {}

/// Loses, repeats and reorders datagrams; clocks are up to an hour apart, and drift.
pub fn lossy(scenario: &mut Scenario) {
    scenario.network.link.loss = 0.3;
    scenario.network.link.duplication = 0.2;
    scenario.network.link.reordering = 0.2;
    scenario.fleet.groups[0].clock = Clock {
        offset: Duration::from_seconds(3600),
        drift_ppm: 5000.0,
    };
}

/// And partitions and crashes.
pub fn chaotic(scenario: &mut Scenario) {
    lossy(scenario);
    let rates = &mut scenario.faults.rates;
    rates.crash = 0.02;
    rates.restart_after = Duration::from_seconds(3);
    rates.partition = 0.05;
    rates.heal_after = Duration::from_seconds(5);
}

/// And overwrites the robots' state.
pub fn corrupting(scenario: &mut Scenario) {
    chaotic(scenario);
    scenario.faults.rates.corrupt_state = 0.02;
}

/// The properties that are violated when all run the program, each once, and how many events of primitives
/// had this name.
pub fn judge(
    scenario: Scenario,
    program: impl Program + Clone + 'static,
    counted: &str,
) -> (Vec<String>, usize) {
    let mut run = Run::new(scenario, &|_| Ok(Box::new(program.clone()))).expect("the run starts");
    let mut count = 0;
    while !run.is_over() {
        let records = run.step().iter();
        let is_counted = |event: &Event| matches!(event, Event::Primitive { event, .. } if event.name() == counted);
        count += records.filter(|record| is_counted(&record.event)).count();
    }
    for violation in run.violations() {
        let (at, text) = (violation.at, &violation.text);
        println!("{at} {}: {text}", violation.property);
    }
    let verdicts = run.verdicts().into_iter();
    let violated = verdicts.filter(|verdict| verdict.violations > 0);
    let names = violated.map(|verdict| verdict.property.to_string());
    (names.collect(), count)
}
