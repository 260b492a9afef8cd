//! The robots of Line come to stand evenly on a line and stay there, from any start and over a bad network;
//! where one dies the others close the gap.

mod support;

use rayon::prelude::*;
use starl_core::{Event, Point};
use starl_sim::Outcome;
use support::Case;

const SEEDS: u64 = 10;

fn all_form(sets: &[&str]) {
    let sets: Vec<&str> = sets.iter().copied().chain(["duration=3min"]).collect();
    (0..SEEDS).into_par_iter().for_each(|seed| {
        let run = Case::new("line", &sets, seed).run();
        assert_eq!(
            run.outcome(),
            Outcome::Reached,
            "{sets:?} seed {seed} {:?}",
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
    let mut run = Case {
        faults: crash,
        ..Case::new("line", &["duration=3min"], 1)
    }
    .start();
    while !run.is_over() {
        for record in run.step() {
            if let (Some(robot), Event::Moved(pose)) = (record.robot, &record.event) {
                at[robot.index()] = pose.position;
            }
        }
    }
    assert_eq!(run.outcome(), Outcome::Reached, "{:?}", run.violations());
    let left = [0, 1, 3, 4, 5, 6].map(|robot: usize| at[robot].at_height(0.0));
    for neighbours in left.windows(3) {
        let middle = neighbours[0].lerp(neighbours[2], 0.5);
        assert!(neighbours[1].distance(middle) < 0.15, "{left:?}");
    }
}
