//! The figures of `docs/explanation/avoidance.md`: 200 seeds a scene and model, each with exact and with
//! noisy estimates. It takes minutes:
//! `cargo test --release -p starl-motion --test it avoidance_sweep -- --ignored`

use crate::avoidance_world::scenes::{AGILE, circle, crossing, head_on, narrow_corridor, strewn};
use crate::avoidance_world::{Scene, World, runs};

/// Runs of a scene that take longer are given up, seconds.
const BOUND: f64 = 900.0;

/// Says what is worse unless there is no collision in any run, and the time until the last robot has been at its goal
/// is at most `median` in half of the runs and at most `most` in 99 of 100, seconds.
fn sweep(
    name: &str,
    (median, most): (f64, f64),
    scene: impl Fn(u64) -> Scene,
) -> Result<(), String> {
    let mut times = Vec::new();
    for (positioning, seed) in runs(200) {
        let mut world = World::new(&scene(seed), positioning, seed);
        let took = world.run(BOUND);
        world.must_be_clear();
        times.push(took.unwrap_or(f64::INFINITY));
    }
    times.sort_by(f64::total_cmp);
    let (middle, late) = (times[times.len() / 2], times[times.len() * 99 / 100]);
    let endless = times.iter().filter(|time| time.is_infinite()).count();
    println!(
        "{name}: {middle:.2}, {late:.2}; {endless} of {} runs were given up",
        times.len()
    );
    match middle <= median && late <= most {
        true => Ok(()),
        false => Err(format!(
            "{name}: half of the runs take {middle} s, one of a hundred {late} s"
        )),
    }
}

/// A scene for each of the models of [`AGILE`] in turn; all are run before one fails the test.
fn sweep_agile(expected: [(f64, f64); 4], scene: impl Fn(&'static str, u64) -> Scene) {
    let mut worse = Vec::new();
    for (model, expected) in AGILE.into_iter().zip(expected) {
        worse.extend(sweep(model, expected, |seed| scene(model, seed)).err());
    }
    assert!(worse.is_empty(), "{worse:#?}");
}

#[test]
#[ignore = "minutes"]
fn head_on_pairs() {
    sweep_agile(
        [(22.2, 23.6), (6.0, 6.0), (9.0, 9.0), (22.0, 23.0)],
        |model, _| head_on(model),
    );
    sweep("car", (7.0, 21.0), |_| head_on("car")).unwrap();
}

#[test]
#[ignore = "minutes"]
fn circles_of_4() {
    sweep_agile(
        [(29.0, 53.0), (11.0, 21.0), (12.0, 17.0), (25.0, 37.2)],
        |model, _| circle(model, 4),
    );
    sweep("car", (20.0, 60.0), |_| circle("car", 4)).unwrap();
}

#[test]
#[ignore = "minutes"]
fn circles_of_8() {
    sweep_agile(
        [(45.0, 72.0), (34.0, 96.0), (13.0, 21.0), (30.0, 42.0)],
        |model, _| circle(model, 8),
    );
}

#[test]
#[ignore = "minutes"]
fn circles_of_16() {
    sweep_agile(
        [(72.0, 120.5), (33.0, 104.0), (24.0, 35.0), (45.0, 61.0)],
        |model, _| circle(model, 16),
    );
}

#[test]
#[ignore = "minutes"]
fn crossing_streams() {
    sweep_agile(
        [(46.0, 62.0), (19.0, 31.0), (21.0, 26.0), (46.0, 58.0)],
        |model, _| crossing(model),
    );
    sweep("car", (23.0, 143.0), |_| crossing("car")).unwrap();
}

#[test]
#[ignore = "minutes"]
fn strewn_robots() {
    sweep_agile(
        [(26.0, 61.0), (11.0, 94.0), (10.0, 40.0), (24.0, 35.0)],
        |model, seed| strewn(&[model], 8, &[], seed),
    );
}

#[test]
#[ignore = "minutes"]
fn narrow_corridors() {
    sweep_agile(
        [(125.0, 385.0), (40.0, 93.0), (74.0, 231.0), (138.0, 514.0)],
        |model, _| narrow_corridor(model),
    );
}

#[test]
#[ignore = "minutes"]
fn strewn_cars() {
    sweep("car", (8.0, 318.0), |seed| strewn(&["car"], 4, &[], seed)).unwrap();
}

#[test]
#[ignore = "minutes"]
fn mixed_fleets() {
    let fleet = ["create", "car", "holonomic", "differential", "drone"];
    sweep("mixed", (24.0, 472.0), |seed| strewn(&fleet, 10, &[], seed)).unwrap();
}
