//! The robots of Formation form a regular polygon and keep it, from any start and over a bad network, on the
//! floor and in a tilted plane, around one that has failed too, if their number is odd; if it is even they do
//! not, and the program's own properties say so.

use crate::support::Case;
use rayon::prelude::*;
use starl_sim::{Outcome, Run};

const SEEDS: u64 = 10;

const PLANE: Case<'_> = Case::new("formation", &[], 1);

fn run(case: Case<'_>) -> Run {
    let sets: Vec<&str> = case.sets.iter().copied().chain(["duration=150s"]).collect();
    Case {
        sets: &sets,
        ..case
    }
    .run()
}

fn all_form(case: Case<'_>) {
    all_form_but(case, 0);
}

/// All form, and at most so many of the runs have a collision.
fn all_form_but(case: Case<'_>, collisions: usize) {
    let form = |seed| {
        let run = run(Case {
            seed: Some(seed),
            ..case
        });
        let first = run.violations().first();
        let (robots, sets) = (case.robots, case.sets);
        let collides = first.is_some_and(|first| first.property == "no_collision");
        assert!(
            collides || run.outcome() == Outcome::Reached,
            "{} {robots:?} {sets:?} seed {seed} {first:?}",
            case.example
        );
        let verdicts = run.verdicts();
        let judged = ["Formation.polygon", "Formation.level"]
            .map(|name| verdicts.iter().any(|verdict| verdict.property == name));
        assert_eq!(judged, [true, true]);
        usize::from(collides)
    };
    let collided: usize = (0..SEEDS).into_par_iter().map(form).sum();
    assert!(collided <= collisions, "{collided} runs with a collision");
}

#[test]
fn five_in_calm() {
    all_form(PLANE);
}

#[test]
fn five_over_a_bad_network() {
    let sets = &["network.loss=0.2", "network.delay=100ms"];
    all_form(Case { sets, ..PLANE });
}

#[test]
fn the_three_of_the_thesis() {
    let robots = Some("create=2,drone=1");
    all_form(Case { robots, ..PLANE });
}

#[test]
fn seven_on_the_floor() {
    let robots = Some("create=7");
    all_form(Case { robots, ..PLANE });
}

#[test]
fn five_in_a_tilted_plane() {
    let example = "formation-space";
    all_form(Case { example, ..PLANE });
}

/// Seven drones that take off beside each other and climb to 8 m at once come too near in 1 run of 20.
#[test]
fn seven_in_a_steep_plane() {
    let case = Case {
        example: "formation-space",
        robots: Some("drone=7"),
        sets: &["parameters.tilt=45deg", "parameters.height=8m"],
        ..PLANE
    };
    all_form_but(case, 1);
}

#[test]
fn four_around_one_that_crashed_on_its_way() {
    for (example, robot) in [("formation", "iRobot1"), ("formation-space", "quadcopter0")] {
        let faults = format!("[[fault]]\nat = \"5s\"\nkind = \"crash\"\nrobots = [\"{robot}\"]\n");
        let faults = &faults;
        all_form(Case {
            example,
            faults,
            ..PLANE
        });
    }
}

#[test]
fn an_even_number_forms_none() {
    for robots in ["create=4", "create=6"] {
        let robots = Some(robots);
        let run = run(Case { robots, ..PLANE });
        let violated = |name: &str| run.violations().iter().any(|v| v.property == name);
        assert!(violated("Formation.polygon"), "{robots:?}");
    }
}
