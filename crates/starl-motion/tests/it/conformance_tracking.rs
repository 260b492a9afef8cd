//! Waypoint tracking reaches its target in time, and stays there.

use crate::conformance::{Positioning, Run, every_model, every_model_and_variants, place, start};
use starl_core::{Duration, Point, Random};
use starl_motion::{Goal, Model};
use std::sync::Arc;

/// How near a robot must come to its target, and stay, metres.
fn tolerance(model: &dyn Model) -> f64 {
    if model.body().flies() { 0.1 } else { 0.075 }
}

/// Seconds that tracking may take over `distance` metres: turning, taking off and shunting included.
fn time_bound(model: &dyn Model, distance: f64) -> f64 {
    let limits = model.limits();
    let turning = std::f64::consts::TAU * limits.turn_radius / limits.cruise_speed;
    8.0 + 1.3 * distance / limits.cruise_speed + 1.5 * turning
}

/// Tracks random targets one after the other, from random poses: in time the robot must be within
/// tolerance, and stay there.
fn reaches_targets(models: &[Arc<dyn Model>], positioning: Positioning, targets: u32) {
    const STAY: f64 = 3.0;
    for model in models {
        let model = &**model;
        let most = tolerance(model);
        let (mut slowest, mut worst): (f64, f64) = (0.0, 0.0);
        for seed in 0..u64::from(targets) / 5 {
            let mut random = Random::keyed(seed, &[5]);
            let mut run = Run::new(model, start(model, &mut random), positioning, seed);
            for _ in 0..5 {
                // Far and near, and to fly to, low and high.
                let height = random.between(0.0, 2.0);
                let far = place(model, &mut random, height);
                let near = run.state.pose.position.lerp(far, 0.1);
                let target = if random.chance(0.3) {
                    model.body().reachable(near)
                } else {
                    far
                };
                let bound = time_bound(model, run.distance(target));
                let began = run.now;
                let seconds = |run: &Run<'_>| run.now.since(began).seconds();
                while seconds(&run) <= bound + STAY {
                    run.turn(&Goal::stop_at(target));
                    let distance = run.distance(target);
                    if distance > most {
                        slowest = slowest.max(seconds(&run) / bound);
                    }
                    if seconds(&run) > bound {
                        worst = worst.max(distance);
                    }
                    assert!(
                        distance <= most || seconds(&run) <= bound,
                        "{}: seed {seed}: {distance} m from {target} after {bound} s: {:?}",
                        model.name(),
                        run.state
                    );
                }
            }
        }
        println!(
            "{}: {slowest:.2} of the time, then within {worst:.3} m",
            model.name()
        );
    }
}

#[test]
fn reaches_500_targets() {
    reaches_targets(&every_model(), Positioning::EXACT, 500);
}

#[test]
fn reaches_targets_with_other_parameters() {
    reaches_targets(&every_model_and_variants(), Positioning::EXACT, 100);
}

#[test]
fn reaches_500_targets_with_noise() {
    let period = Duration::from_millis(50);
    reaches_targets(
        &every_model(),
        Positioning {
            period,
            noise: [0.01, 0.02, 0.05],
        },
        500,
    );
}

#[test]
fn reaches_500_targets_with_slow_and_noisy_estimates() {
    let period = Duration::from_millis(200);
    reaches_targets(
        &every_model(),
        Positioning {
            period,
            noise: [0.02, 0.03, 0.05],
        },
        500,
    );
}

#[test]
fn stands_still_at_its_target_despite_noise() {
    let period = Duration::from_millis(50);
    let positioning = Positioning {
        period,
        noise: [0.01, 0.02, 0.05],
    };
    for model in every_model().iter().filter(|model| !model.body().flies()) {
        for seed in 0..20 {
            let mut random = Random::keyed(seed, &[6]);
            let mut run = Run::new(&**model, start(&**model, &mut random), positioning, seed);
            let target = place(&**model, &mut random, 0.0);
            for _ in 0..1200 {
                run.turn(&Goal::stop_at(target));
            }
            let settled = run.state.pose.position;
            let mut way = 0.0;
            let mut last = settled;
            for _ in 0..400 {
                run.turn(&Goal::stop_at(target));
                way += run.state.pose.position.distance(last);
                last = run.state.pose.position;
            }
            assert!(
                way < 0.05,
                "{}: seed {seed}: moved {way} m in 20 s",
                model.name()
            );
        }
    }
}

/// Lets robots of this model travel for 20 s and then stop as `halt` says. Returns the distance in metres from where they
/// were that none of them exceeds.
fn halts_within(model: &dyn Model, halt: impl Fn(&mut Run<'_>, Point)) -> f64 {
    let periods = [20, 50, 100].map(Duration::from_millis);
    let mut farthest: f64 = 0.0;
    for (seed, period) in periods.into_iter().cycle().take(60).enumerate() {
        let mut random = Random::keyed(seed as u64, &[8]);
        let positioning = Positioning {
            period,
            noise: [0.0; 3],
        };
        let start = start(model, &mut random);
        let mut run = Run::new(model, start, positioning, 0);
        let far = model
            .body()
            .reachable(Point::polar(100.0, random.between(-3.0, 3.0)));
        for _ in 0..20_000 / period.0.div_euclid(1_000_000) {
            run.turn(&Goal::stop_at(far));
        }
        // The estimate comes a period late at worst.
        let here = run.state.pose.position;
        run.turn(&Goal::stop_at(far));
        for _ in 0..5_000 / period.0.div_euclid(1_000_000) {
            halt(&mut run, here);
            farthest = farthest.max(run.state.pose.position.planar_distance(here));
        }
    }
    farthest
}

#[test]
fn halts_within_its_stopping_distance() {
    for model in every_model_and_variants() {
        let bound = model.limits().stopping_distance;
        let stay = halts_within(&*model, |run, here| {
            run.turn(&Goal::stop_at(here));
        });
        let rest = halts_within(&*model, |run, _| run.rest());
        for (told, farthest) in [("told to be where it is", stay), ("told to rest", rest)] {
            let name = model.name();
            println!("{name}, {told}: halts within {farthest:.3} of {bound:.3} m");
            assert!(
                farthest <= bound,
                "{name}, {told}: {farthest} m > {bound} m"
            );
            assert!(
                farthest >= 0.2 * bound,
                "{name}, {told}: the bound is idle: {farthest} m"
            );
        }
    }
}
