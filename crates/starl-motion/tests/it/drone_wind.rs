//! A quadcopter holds its place in wind, as far as it can tilt against it.

use crate::conformance::{Positioning, Run};
use starl_core::math::{TAU, radians, sin, tan};
use starl_core::{Duration, Point, Pose};
use starl_motion::{Goal, models};

/// The wind that an AR.Drone at its greatest tilt can just hold against, m/s: its drag is 0.3 kg/s,
/// its mass 0.42 kg.
fn strongest() -> f64 {
    9.80665 * tan(radians(20.0)) * 0.42 / 0.3
}

/// How far a drone strays from the place that it tracks, in wind after it has settled.
fn stray(steady: f64, gust: f64, period: f64, positioning: Positioning, hovers: bool) -> f64 {
    let drone = models::by_name("drone").unwrap();
    let place = Point::new(1.0, 2.0, 1.0);
    let mut run = Run::new(&*drone, Pose::level(Point::ZERO, 0.4), positioning, 3);
    let mut farthest: f64 = 0.0;
    for turn in 0..800 {
        let speed = steady + gust * sin(TAU * run.now.seconds() / period);
        run.disturbance.wind = Point::polar(speed, 0.3);
        if hovers && turn > 300 {
            hover(&mut run);
        } else {
            run.turn(&Goal::stop_at(place));
        }
        if turn > 400 {
            let [x, y] = run.state.memory;
            let wanted = if hovers { Point::planar(x, y) } else { place };
            farthest = farthest.max(run.state.pose.position.planar_distance(wanted));
        }
    }
    farthest
}

fn hover(run: &mut Run<'_>) {
    let step = Duration::from_millis(10);
    for _ in 0..run.positioning.period.0 / step.0 {
        let command = starl_core::Command::Hover;
        run.state = run
            .model
            .predict(&run.state, &command, &run.disturbance, step);
    }
    run.now += run.positioning.period;
}

#[test]
fn it_holds_its_place_in_steady_wind_up_to_nine_tenths_of_its_tilt() {
    for hovers in [false, true] {
        for part in [0.0, 0.25, 0.5, 0.75, 0.9] {
            let strayed = stray(part * strongest(), 0.0, 1.0, Positioning::EXACT, hovers);
            assert!(
                strayed < 0.05,
                "{part} of the strongest wind: {strayed} m, hovers: {hovers}"
            );
        }
    }
}

#[test]
fn it_holds_its_place_in_gusts() {
    for hovers in [false, true] {
        for period in [
            0.5, 0.7, 0.85, 1.0, 1.2, 1.5, 1.75, 2.0, 2.25, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0,
        ] {
            for (steady, gust) in [(0.0, 1.0), (1.0, 1.0), (3.0, 1.0), (0.0, 2.0), (2.0, 2.0)] {
                let strayed = stray(steady, gust, period, Positioning::EXACT, hovers);
                assert!(
                    strayed < 0.2,
                    "{steady} m/s, gusts of {gust} m/s every {period} s: {strayed} m, hovers: {hovers}"
                );
            }
        }
    }
}

#[test]
fn it_knows_when_the_wind_is_too_strong() {
    let drone = models::by_name("drone").unwrap();
    for (part, expected) in [(0.9, false), (0.97, false), (1.1, true), (2.0, true)] {
        let up = Pose::level(Point::new(0.0, 0.0, 1.0), 0.4);
        let mut run = Run::new(&*drone, up, Positioning::EXACT, 3);
        run.disturbance.wind = Point::polar(part * strongest(), 0.3);
        let mut overpowered = false;
        for _ in 0..400 {
            run.turn(&Goal::stop_at(Point::new(0.0, 0.0, 1.0)));
            overpowered |= drone.is_overpowered(&run.tracking);
        }
        assert_eq!(overpowered, expected, "{part} of the strongest wind");
    }
}

/// It was stopped to replan before it knew, and forgot each time how long the wind had been too strong.
#[test]
fn it_knows_so_too_when_it_is_stopped_again_and_again() {
    let drone = models::by_name("drone").unwrap();
    for (part, expected) in [(0.9, false), (1.1, true), (2.0, true)] {
        let up = Pose::level(Point::new(0.0, 0.0, 1.0), 0.4);
        let mut run = Run::new(&*drone, up, Positioning::EXACT, 3);
        run.disturbance.wind = Point::polar(part * strongest(), 0.3);
        let mut overpowered = false;
        for turn in 0..400 {
            match turn % 40 < 2 {
                true => drop(run.turn(&Goal::stop_at(Point::new(0.0, 0.0, 1.0)))),
                false => run.rest(),
            }
            overpowered |= drone.is_overpowered(&run.tracking);
        }
        assert_eq!(overpowered, expected, "{part} of the strongest wind");
    }
}
