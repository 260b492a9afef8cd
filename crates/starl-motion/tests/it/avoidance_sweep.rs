//! The figures of `docs/explanation/avoidance.md`: 200 seeds a scene and model, each with exact and with
//! noisy estimates. It takes minutes:
//! `cargo test --release -p starl-motion --test it avoidance_sweep -- --ignored --nocapture`

use crate::avoidance_world::scenes::{AGILE, circle, crossing, head_on, narrow_corridor, strewn};
use crate::avoidance_world::{Scene, World, runs};

/// Runs of a scene that take longer are given up, seconds.
const BOUND: f64 = 900.0;

/// The times in the table may be exceeded by these factors: the median hardly depends on chance, the slowest runs do.
const MARGINS: (f64, f64) = (1.1, 1.4);

/// Fails if there is a collision in any run. Says what is worse unless the time until the last robot has been at its goal
/// is about at most `median` in half of the runs and `most` in 99 of 100, seconds, as measured for the table.
fn sweep(
    name: &str,
    (median, most): (f64, f64),
    scene: impl Fn(u64) -> Scene,
) -> Result<(), String> {
    let (mut times, mut least_gap) = (Vec::new(), f64::INFINITY);
    for (positioning, seed) in runs(200) {
        let mut world = World::new(&scene(seed), positioning, seed);
        let took = world.run(BOUND);
        world.must_be_clear();
        least_gap = world.least_gap.min(least_gap);
        times.push(took.unwrap_or(f64::INFINITY));
    }
    times.sort_by(f64::total_cmp);
    let (middle, late) = (times[times.len() / 2], times[times.len() * 99 / 100]);
    let endless = times.iter().filter(|time| time.is_infinite()).count();
    println!(
        "{name}: {middle:.2}, {late:.2}; {endless} of {} runs were given up; {:.0} mm between bodies",
        times.len(),
        1000.0 * least_gap
    );
    match middle <= MARGINS.0 * median && late <= MARGINS.1 * most {
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
        [(22.1, 23.5), (5.3, 5.4), (8.0, 8.1), (21.3, 22.1)],
        |model, _| head_on(model),
    );
}

#[test]
#[ignore = "minutes"]
fn circles_of_4() {
    sweep_agile(
        [(28.4, 53.0), (11.3, 19.3), (11.7, 16.3), (24.5, 37.1)],
        |model, _| circle(model, 4),
    );
}

#[test]
#[ignore = "minutes"]
fn circles_of_8() {
    sweep_agile(
        [(45.1, 70.4), (34.6, 87.7), (12.5, 20.7), (29.9, 43.8)],
        |model, _| circle(model, 8),
    );
}

#[test]
#[ignore = "minutes"]
fn circles_of_16() {
    sweep_agile(
        [(71.9, 120.4), (32.7, 112.1), (23.0, 34.8), (45.5, 60.5)],
        |model, _| circle(model, 16),
    );
}

#[test]
#[ignore = "minutes"]
fn crossing_streams() {
    sweep_agile(
        [(45.6, 61.3), (18.6, 32.1), (20.5, 25.0), (45.7, 58.0)],
        |model, _| crossing(model),
    );
}

#[test]
#[ignore = "minutes"]
fn strewn_robots() {
    sweep_agile(
        [(25.4, 65.0), (10.7, 88.2), (9.5, 39.2), (23.3, 33.6)],
        |model, seed| strewn(&[model], 8, &[], seed),
    );
}

#[test]
#[ignore = "minutes"]
fn narrow_corridors() {
    sweep_agile(
        [(121.4, 386.6), (39.3, 90.4), (73.9, 230.5), (137.0, 529.8)],
        |model, _| narrow_corridor(model),
    );
}

#[test]
#[ignore = "minutes"]
fn cars() {
    let worse = [
        sweep("two cars head-on", (6.1, 15.0), |_| head_on("car")),
        sweep("circle of 4 cars", (17.6, 41.3), |_| circle("car", 4)),
        sweep("streams of cars", (19.7, 42.8), |_| crossing("car")),
        sweep("strewn cars", (7.4, 113.6), |seed| {
            strewn(&["car"], 4, &[], seed)
        }),
    ];
    let worse: Vec<String> = worse.into_iter().filter_map(Result::err).collect();
    assert!(worse.is_empty(), "{worse:#?}");
}

#[test]
#[ignore = "minutes"]
fn mixed_fleets() {
    let fleet = ["create", "car", "holonomic", "differential", "drone"];
    sweep("mixed", (23.2, 219.6), |seed| strewn(&fleet, 10, &[], seed)).unwrap();
}
