//! With a waypoint after the next, robots flow through instead of stopping; speed limits hold.

use crate::conformance::{Positioning, Run, every_model};
use starl_core::{Duration, Point, Pose, Random};
use starl_motion::{Goal, Model};

/// The slowest speed while a robot drives past the middle one of three waypoints in a line, which
/// it leaves at 0.2 m.
fn slowest(model: &dyn Model, tells_next: bool) -> f64 {
    let start = model.body().reachable(Point::ZERO);
    let mut run = Run::new(model, Pose::level(start, 0.0), Positioning::EXACT, 1);
    let [one, two] = [3.0, 8.0].map(|x| model.body().reachable(Point::planar(x, 0.0)));
    while run.distance(one) > 0.2 {
        run.turn(&Goal {
            next: tells_next.then_some(two),
            ..Goal::stop_at(one)
        });
    }
    run.state.twist.linear.length()
}

#[test]
fn robots_keep_their_speed_through_waypoints_in_a_line() {
    for model in every_model() {
        let cruise = model.limits().cruise_speed;
        let (flowing, stopping) = (slowest(&*model, true), slowest(&*model, false));
        assert!(
            flowing > 0.9 * cruise,
            "{}: {flowing} of {cruise}",
            model.name()
        );
        assert!(
            stopping <= flowing,
            "{}: {stopping} {flowing}",
            model.name()
        );
    }
}

#[test]
fn robots_slow_down_for_a_sharp_turn() {
    for model in every_model() {
        let start = model.body().reachable(Point::ZERO);
        let mut run = Run::new(&*model, Pose::level(start, 0.0), Positioning::EXACT, 1);
        let one = model.body().reachable(Point::planar(3.0, 0.0));
        let back = model.body().reachable(Point::planar(0.0, 0.5));
        while run.distance(one) > 0.05 {
            run.turn(&Goal {
                next: Some(back),
                ..Goal::stop_at(one)
            });
        }
        let cruise = model.limits().cruise_speed;
        let speed = run.state.twist.linear.planar_length();
        assert!(speed < 0.8 * cruise, "{}: {speed}", model.name());
    }
}

#[test]
fn the_speed_limit_of_a_goal_is_kept() {
    for model in every_model() {
        let mut random = Random::keyed(1, &[]);
        for _ in 0..10 {
            let limit = random.between(0.2, 0.9) * model.limits().cruise_speed;
            let pose = Pose::level(
                model.body().reachable(Point::ZERO),
                random.between(-3.0, 3.0),
            );
            let mut run = Run::new(&*model, pose, Positioning::EXACT, 1);
            let target = model.body().reachable(Point::planar(4.0, 1.0));
            let goal = Goal {
                speed_limit: limit,
                ..Goal::stop_at(target)
            };
            for _ in 0..400 {
                run.turn(&goal);
                let speed = run.state.twist.linear.planar_length();
                // A tilted robot's speed answers with some overshoot.
                let most = if model.body().flies() {
                    1.15 * limit + 0.05
                } else {
                    limit + 1e-9
                };
                assert!(speed <= most, "{}: {speed} > {limit}", model.name());
            }
        }
    }
}

#[test]
fn a_limit_of_zero_brings_every_robot_to_a_halt() {
    for model in every_model() {
        let pose = Pose::level(model.body().reachable(Point::ZERO), 0.0);
        let mut run = Run::new(&*model, pose, Positioning::EXACT, 1);
        let goal = Goal::stop_at(model.body().reachable(Point::planar(9.0, 0.0)));
        while run.now.seconds() < 3.0 {
            run.turn(&goal);
        }
        for _ in 0..Duration::from_seconds(5).0 / run.positioning.period.0 {
            run.turn(&Goal {
                speed_limit: 0.0,
                ..goal
            });
        }
        let speed = run.state.twist.linear.length();
        assert!(speed < 0.02, "{}: {speed}", model.name());
    }
}
