//! The robots of Line come to stand evenly on a line and stay there, from any start and over a bad network;
//! where one dies the others close the gap.

use rayon::prelude::*;
use starl_catalog::examples;
use starl_core::{Event, Point};
use starl_sim::read::{Override, Request, Source};
use starl_sim::{Outcome, Run};

const SEEDS: u64 = 10;

/// Runs the example; is told where each robot is.
fn start(sets: &[&str], faults: &str, mut moved: impl FnMut(usize, Point)) -> Run {
    let example = examples::find("line").expect("it is an example");
    let request = Request {
        overrides: sets.iter().map(|set| Override::set(set).unwrap()).collect(),
        faults: (!faults.is_empty()).then(|| Source::new("faults.toml", faults)),
        ..Request::new(example.source())
    };
    let mut run = starl_catalog::read(&request, example)
        .unwrap()
        .run()
        .unwrap();
    while !run.is_over() {
        for record in run.step() {
            if let (Some(robot), Event::Moved(pose)) = (record.robot, &record.event) {
                moved(robot.index(), pose.position);
            }
        }
    }
    run
}

fn all_form(sets: &[&str]) {
    (0..SEEDS).into_par_iter().for_each(|seed| {
        let seed = format!("seed={seed}");
        let sets = sets.iter().copied().chain(["duration=3min", &*seed]);
        let sets: Vec<&str> = sets.collect();
        let run = start(&sets, "", |_, _| {});
        assert_eq!(
            run.outcome(),
            Outcome::Reached,
            "{sets:?} {:?}",
            run.violations()
        );
    });
}

#[test]
fn seven_in_calm() {
    all_form(&[]);
}

#[test]
fn seven_over_a_bad_network() {
    all_form(&["network.loss=0.2", "network.delay=100ms"]);
}

#[test]
fn ten() {
    all_form(&["robots.1.count=7"]);
}

#[test]
fn those_that_are_left_close_the_gap_of_one_that_died() {
    let crash = "[[fault]]\nat = \"100ms\"\nkind = \"crash\"\nrobots = [\"iRobot1\"]\n";
    let mut at = [Point::ZERO; 7];
    let run = start(&["duration=3min"], crash, |robot, place| at[robot] = place);
    assert_eq!(run.outcome(), Outcome::Reached, "{:?}", run.violations());
    let left = [0, 1, 3, 4, 5, 6].map(|robot: usize| at[robot].at_height(0.0));
    for neighbours in left.windows(3) {
        let middle = neighbours[0].lerp(neighbours[2], 0.5);
        assert!(neighbours[1].distance(middle) < 0.15, "{left:?}");
    }
}
