//! The robots of Formation form a regular polygon and keep it, from any start and over a bad network, if
//! their number is odd; if it is even they do not, and the program's own properties say so.

use rayon::prelude::*;
use starl_catalog::examples;
use starl_sim::read::{Override, Request};
use starl_sim::{Outcome, Run};

const SEEDS: u64 = 10;

fn run(robots: Option<&str>, sets: &[&str]) -> Run {
    let example = examples::find("formation").expect("it is an example");
    let sets = sets.iter();
    let request = Request {
        overrides: sets.map(|set| Override::set(set).unwrap()).collect(),
        robots: robots.map(String::from),
        ..Request::new(example.source())
    };
    let application = starl_catalog::read(&request, example).unwrap();
    let mut run = application.run().unwrap();
    while !run.is_over() {
        run.step();
    }
    run
}

fn all_form(robots: Option<&str>, sets: &[&str]) {
    let form = |seed| {
        let seed = format!("seed={seed}");
        let sets: Vec<&str> = sets.iter().copied().chain([&*seed]).collect();
        let run = run(robots, &sets);
        let first = run.violations().first();
        assert_eq!(
            run.outcome(),
            Outcome::Reached,
            "{robots:?} {sets:?} {first:?}"
        );
        let verdicts = run.verdicts();
        let judged = ["Formation.formed", "Formation.kept"]
            .map(|name| verdicts.iter().any(|verdict| verdict.property == name));
        assert_eq!(judged, [true, true]);
    };
    (0..SEEDS).into_par_iter().for_each(form);
}

#[test]
fn five_in_calm() {
    all_form(None, &[]);
}

#[test]
fn five_over_a_bad_network() {
    all_form(None, &["network.loss=0.2", "network.delay=100ms"]);
}

#[test]
fn the_three_of_the_thesis() {
    all_form(Some("create=2,drone=1"), &[]);
}

#[test]
fn seven_on_the_floor() {
    all_form(Some("create=7"), &[]);
}

#[test]
fn an_even_number_forms_none() {
    for robots in ["create=4", "create=6"] {
        let run = run(Some(robots), &[]);
        let violated = |name: &str| run.violations().iter().any(|v| v.property == name);
        assert!(violated("Formation.formed"), "{robots}");
        assert!(violated("Formation.kept"), "{robots}");
    }
}
