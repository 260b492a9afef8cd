//! Robots' estimates of their positions are separate from their true positions.

use crate::engine_support::{Drive, run, scenario, simulate};
use starl_core::{Command, Duration, Event, RobotId};

#[test]
fn neither_noise_nor_rate_of_positioning_moves_a_robot() {
    let path = |noise: f64, period: u64| {
        let mut scenario = scenario("create", &[(0.0, 0.0)]);
        scenario.positioning.position_noise = noise;
        scenario.positioning.heading_noise = noise;
        scenario.positioning.velocity_noise = noise;
        scenario.positioning.period = Duration::from_millis(period);
        let mut simulation = simulate(
            scenario,
            Drive(Command::Curve {
                speed: 0.2,
                radius: 0.5,
            }),
        );
        let records = run(&mut simulation, 10.0);
        let poses = records.into_iter().filter_map(|record| match record.event {
            Event::Moved(pose) => Some(pose),
            _ => None,
        });
        poses.collect::<Vec<_>>()
    };
    let exact = path(0.0, 50);
    assert!(exact.len() > 90);
    assert_eq!(exact, path(0.3, 50));
    assert_eq!(exact, path(0.3, 730));
}

#[test]
fn estimates_scatter_around_the_truth_as_they_should() {
    let mut scenario = scenario("create", &[(2.0, 3.0)]);
    scenario.positioning.position_noise = 0.05;
    scenario.positioning.heading_noise = 0.1;
    let records = run(&mut simulate(scenario, Drive(Command::Stop)), 55.0);
    let poses: Vec<_> = records
        .iter()
        .filter_map(|record| match record.event {
            Event::Estimated(pose) => Some(pose),
            _ => None,
        })
        .collect();
    let spread = |error: &dyn Fn(&starl_core::Pose) -> f64| {
        let squares: f64 = poses.iter().map(|pose| error(pose) * error(pose)).sum();
        (squares / poses.len() as f64).sqrt()
    };
    assert!(poses.len() > 1000);
    assert!((spread(&|pose| pose.position.x - 2.0) - 0.05).abs() < 0.005);
    assert!((spread(&|pose| pose.position.y - 3.0) - 0.05).abs() < 0.005);
    assert!((spread(&|pose| pose.yaw) - 0.1).abs() < 0.01);
    // A robot on the floor is not told that it floats.
    assert!(poses.iter().all(|pose| pose.position.z == 0.0));
}

#[test]
fn an_estimate_between_two_steps_is_not_stale() {
    let mut scenario = scenario("create", &[(0.0, 0.0)]);
    scenario.positioning.period = Duration::from_millis(60);
    scenario.physics.step = Duration::from_millis(50);
    let records = run(
        &mut simulate(scenario, Drive(Command::Straight { speed: 0.2 })),
        5.0,
    );
    for record in records {
        if let Event::Estimated(pose) = record.event
            && record.at.seconds() > 0.3
        {
            assert!(
                (pose.position.x - 0.2 * record.at.seconds()).abs() < 1e-9,
                "{record:?}"
            );
        }
    }
}

#[test]
fn clocks_are_off_by_their_offset_and_drift() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
    scenario.fleet.groups[0].clock.offset = Duration::from_seconds(100);
    scenario.fleet.groups[0].clock.drift_ppm = 50_000.0;
    let mut simulation = simulate(scenario, Drive(Command::Stop));
    run(&mut simulation, 10.0);
    let early: Vec<_> = (0..3)
        .map(|id| simulation.estimate(RobotId(id)).at)
        .collect();
    run(&mut simulation, 10.0);
    for id in 0..3 {
        let passed = simulation
            .estimate(RobotId(id))
            .at
            .since(early[id as usize])
            .seconds();
        assert!(
            (passed - 10.0).abs() <= 0.5 + 1e-9 && passed != 10.0,
            "{passed} s in 10 s"
        );
    }
    assert!(early[0] != early[1] && early.iter().all(|at| at.seconds() < 111.0));
}
