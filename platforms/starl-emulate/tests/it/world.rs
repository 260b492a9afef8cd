//! Bodies share a floor: they stop at obstacles, and run in wall time.

use starl_core::{Command, Obstacle, Point, Pose};
use starl_emulate::{AddError, BodyHandle, Noise, World};
use starl_motion::models::by_name;
use std::thread::sleep;
use std::time::{Duration, Instant};

const RADIUS: f64 = 0.165;

fn create(world: &World, name: &str, x: f64, yaw: f64) -> BodyHandle {
    let pose = Pose::level(Point::planar(x, 0.0), yaw);
    world.add(name, by_name("create").unwrap(), pose).unwrap()
}

fn straight(speed: f64) -> Command {
    Command::Straight { speed }
}

fn x(body: &BodyHandle) -> f64 {
    body.state().pose.position.x
}

#[test]
fn robots_that_meet_stop_and_press_their_bumpers() {
    let world = World::new(Vec::new(), Noise::NONE);
    let left = create(&world, "left", 0.0, 0.0);
    let right = create(&world, "right", 0.6, std::f64::consts::PI);
    left.command(straight(0.5));
    right.command(straight(0.25));
    sleep(Duration::from_millis(800));
    let gap = x(&right) - x(&left) - 2.0 * RADIUS;
    assert!((0.0..0.01).contains(&gap), "{gap} m apart");
    for body in [&left, &right] {
        let contact = body.bumper().expect("it touches the other");
        assert!(contact.bearing.abs() < 1e-6, "{contact:?}");
    }
    // The wheels have turned all the time.
    assert!(left.odometer().distance > 0.35, "{:?}", left.odometer());

    let touches = world.take_touches();
    assert_eq!(touches.len(), 1, "{touches:?}");
    let told = [Some(touches[0].body.as_str()), touches[0].with.as_deref()];
    assert!(
        told.contains(&Some("left")) && told.contains(&Some("right")),
        "{touches:?}"
    );

    left.command(straight(-0.5));
    sleep(Duration::from_millis(200));
    assert_eq!(left.bumper(), None);
    assert!(world.take_touches().is_empty());
}

#[test]
fn a_robot_passes_where_an_obstacle_has_expired() {
    let wall = |x| Obstacle::cuboid(Point::planar(x, -1.0), Point::new(x + 0.1, 1.0, 1.0));
    let until = starl_core::Duration::from_millis;
    let walls = vec![(wall(0.4), until(300)), (wall(0.7), until(60_000))];
    let world = World::with_temporary(walls, Noise::NONE);
    let robot = create(&world, "robot", 0.0, 0.0);
    robot.command(straight(0.5));
    sleep(Duration::from_millis(1600));
    assert!((x(&robot) + RADIUS - 0.7).abs() < 0.01, "{}", x(&robot));
}

#[test]
fn robot_pushes_nothing_out_of_its_place() {
    let world = World::new(Vec::new(), Noise::NONE);
    let standing = create(&world, "standing", 1.0, 1.0);
    let driving = create(&world, "driving", 0.4, 0.0);
    driving.command(straight(0.5));
    sleep(Duration::from_millis(900));
    assert_eq!(x(&standing), 1.0);
    let bearing = standing.bumper().expect("it is touched").bearing;
    assert!(
        (bearing - (std::f64::consts::PI - 1.0)).abs() < 1e-6,
        "{bearing}"
    );
}

#[test]
fn drone_passes_over_a_robot_and_a_wall_stops_it_only_at_its_height() {
    let low = Obstacle::cuboid(Point::new(1.0, -1.0, 0.0), Point::new(1.2, 1.0, 0.3));
    let high = Obstacle::cuboid(Point::new(3.0, -1.0, 0.0), Point::new(3.2, 1.0, 2.0));
    let world = World::new(vec![low, high], Noise::NONE);
    create(&world, "below", 0.5, 0.0);
    let start = Pose::level(Point::new(-0.5, 0.0, 1.0), 0.0);
    let drone = world
        .add("drone", by_name("drone").unwrap(), start)
        .unwrap();
    drone.command(Command::Attitude {
        yaw_rate: 0.0,
        pitch: 0.3,
        roll: 0.0,
        gaz: 0.0,
    });
    let limit = Instant::now() + Duration::from_secs(6);
    while drone.bumper().is_none() && Instant::now() < limit {
        sleep(Duration::from_millis(10));
    }
    let gap = 3.0 - x(&drone) - 0.34;
    assert!((0.0..0.05).contains(&gap), "{gap} m from the high wall");
}

#[test]
fn body_is_not_put_where_something_is() {
    let wall = Obstacle::cuboid(Point::new(2.0, -1.0, 0.0), Point::new(2.2, 1.0, 1.0));
    let world = World::new(vec![wall], Noise::NONE);
    create(&world, "r1", 0.0, 0.0);
    let add = |name: &str, x: f64| {
        let pose = Pose::level(Point::planar(x, 0.0), 0.0);
        world.add(name, by_name("create").unwrap(), pose).err()
    };
    assert_eq!(add("r1", 1.0), Some(AddError::NameTaken("r1".into())));
    assert_eq!(add("r2", 0.3), Some(AddError::Blocked("r2".into())));
    assert_eq!(add("r2", 1.9), Some(AddError::Blocked("r2".into())));
    assert_eq!(add("r2", 1.0), None);
    assert_eq!(world.poses().len(), 2);
}

#[test]
fn time_passes_as_on_the_wall() {
    let world = World::new(Vec::new(), Noise::NONE);
    let body = create(&world, "r1", 0.0, 0.0);
    let (from, began) = (world.elapsed(), Instant::now());
    body.command(straight(0.5));
    sleep(Duration::from_millis(1500));
    let passed = world.elapsed().seconds() - from.seconds();
    let wall = began.elapsed().as_secs_f64();
    assert!((passed - wall).abs() < 0.1, "{passed} s in {wall} s");
    assert!((x(&body) - 0.5 * wall).abs() < 0.05, "{} m", x(&body));
}

#[test]
fn errors_of_motion_are_the_seed_s_and_hidden_from_the_odometer() {
    let drive = |seed| {
        let noise = Noise {
            speed: 0.3,
            turn: 0.3,
            seed,
        };
        let world = World::new(Vec::new(), noise);
        let body = create(&world, "r1", 0.0, 0.0);
        body.command(straight(0.5));
        while body.odometer().distance < 0.3 {
            sleep(Duration::from_millis(5));
        }
        // How much farther it has come than its wheels say, per step.
        (x(&body) - body.odometer().distance) / body.odometer().distance
    };
    assert!(drive(1) != 0.0 && drive(1) != drive(2));
}
