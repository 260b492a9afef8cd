//! Lidar, contacts, free places, and settings that are refused.

use crate::support::{Arrays, radio, settings, square};
use starl_core::{Obstacle, Point, Pose};
use starl_env::{Batch, NoRoom, NotFinite, Radio, Region, Settings};
use starl_motion::models;

#[test]
fn lidar_sees_obstacles_and_robots() {
    let mut batch = Batch::new(settings("holonomic", 2), 1).expect("fair settings");
    let at = |x: f64, yaw: f64| Pose::level(Point::planar(x, 0.0), yaw);
    batch.place(0, &[at(1.0, 0.0), at(1.9, 0.0)]);
    let mut arrays = Arrays::of(&batch);
    batch.show(|_| true, arrays.outputs());
    // Bodies have a radius of 0.15 m, the pillar at 0 has 0.2 m.
    let near = |ray: usize, expected: f64| {
        let found = arrays.lidar[ray];
        assert!((found - expected).abs() < 1e-9, "ray {ray}: {found} m");
    };
    near(0, 0.6);
    near(6, 0.65);
    near(3, 1.0);
    near(12 + 6, 0.6);
}

#[test]
fn bodies_stop_at_contacts() {
    let mut batch = Batch::new(settings("holonomic", 2), 1).expect("fair settings");
    let at = |x: f64| Pose::level(Point::planar(x, 0.0), 0.0);
    batch.place(0, &[at(-1.0), at(-2.0)]);
    let mut arrays = Arrays::of(&batch);
    let mut touched = Vec::new();
    for _ in 0..20 {
        let forwards = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        batch
            .step(&forwards, &[], arrays.outputs())
            .expect("finite");
        touched.push((arrays.contacts[0], arrays.contacts[1]));
    }
    let x = |robot: usize| batch.state(0, robot).pose.position.x;
    assert!((x(0) + 0.35).abs() < 1e-5, "{} m", x(0));
    assert!((x(1) + 0.65).abs() < 1e-5, "{} m", x(1));
    assert_eq!(touched[0], (-1, -1));
    // The first robot touches the obstacle, the second one the first.
    assert_eq!(touched[19], (2, 0));
}

#[test]
fn an_environment_may_have_obstacles_of_its_own() {
    let mut batch = Batch::new(settings("holonomic", 1), 2).expect("fair settings");
    batch.set_obstacles(1, &[Obstacle::circle(Point::planar(2.0, 0.0), 0.2)]);
    for environment in 0..2 {
        batch.place(environment, &[Pose::level(Point::planar(1.0, 0.0), 0.0)]);
    }
    let mut arrays = Arrays::of(&batch);
    batch.show(|_| true, arrays.outputs());
    assert_eq!(arrays.lidar[0], 1.0);
    assert!((arrays.lidar[12] - 0.65).abs() < 1e-9);
    assert!(
        (arrays.lidar[12 + 6] - 0.65).abs() < 1e-9,
        "the common one is there too"
    );
}

#[test]
fn places_are_free_and_apart() {
    let mut batch = Batch::new(settings("holonomic", 1), 1).expect("fair settings");
    for seed in 0..50 {
        batch.seed(0, seed);
        let mut places = [Point::ZERO; 5];
        batch.scatter(0, &square(1.2), &mut places).expect("room");
        for (index, place) in places.iter().enumerate() {
            assert!(place.length() >= 0.6);
            assert!(
                places[..index]
                    .iter()
                    .all(|other| other.distance(*place) >= 0.8)
            );
        }
    }
    let small = Region {
        low: Point::planar(0.7, 0.7),
        high: Point::planar(0.9, 0.9),
        ..square(1.0)
    };
    let refused = batch.scatter(0, &small, &mut [Point::ZERO; 3]);
    let expected = NoRoom {
        found: 1,
        wanted: 3,
    };
    assert_eq!(refused, Err(expected));
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let mut batch = Batch::new(settings("holonomic", 2), 2).expect("fair settings");
    let mut arrays = Arrays::of(&batch);
    let mut actions = [0.5; 12];
    actions[10] = f64::NAN;
    let before = *batch.state(1, 0);
    let error = batch.step(&actions, &[], arrays.outputs());
    let expected = NotFinite {
        environment: 1,
        robot: 1,
    };
    assert_eq!(error, Err(expected));
    assert_eq!(*batch.state(1, 0), before);
}

#[test]
fn settings_out_of_range_are_refused() {
    let refuse = |settings: Settings, expected: &str| {
        let error = Batch::new(settings, 1).expect_err("refused").to_string();
        assert!(error.contains(expected), "{error}");
    };
    let fair = || settings("create", 2);
    refuse(settings("create", 0), "`robots`: 0 robots");
    let mixed = ["create", "drone"].map(|name| models::by_name(name).expect("a model"));
    let models = mixed.to_vec();
    refuse(Settings { models, ..fair() }, "different controls");
    let lossy = Radio {
        loss: 1.5,
        ..radio(1)
    };
    let radio = Some(lossy);
    refuse(Settings { radio, ..fair() }, "1.5 is not a probability");
    let late = Radio {
        delay: (3, 1),
        ..crate::support::radio(1)
    };
    let radio = Some(late);
    refuse(Settings { radio, ..fair() }, "a delay of 3 to 1");
}
