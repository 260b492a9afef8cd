//! The driver of the Create passes the suite on the emulated one, and tests of its own.

use starl_core::{Command, Estimate, Obstacle, Point, Pose};
use starl_create::sensor::Mode;
use starl_create::{Create, CreateOptions, Generation};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::create::{EmulatedCreate, Hazards, model};
use starl_emulate::{BodyHandle, Noise, World};
use starl_node::{Device, Reading};
use std::rc::Rc;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn options(generation: Generation) -> CreateOptions {
    CreateOptions::new(generation)
}

/// Without a guard, so that the driver itself stops the robot.
fn robot(generation: Generation, world: &World) -> (Create, BodyHandle, EmulatedCreate) {
    let start = Pose::level(Point::planar(-1.0, 2.0), 0.7);
    let body = world.add("r1", model(generation), start).unwrap();
    let emulated = EmulatedCreate::start(body.clone(), None).unwrap();
    let options = CreateOptions {
        guard: false,
        ..options(generation)
    };
    let driver = Create::open(emulated.path(), &options).unwrap();
    (driver, body, emulated)
}

fn rig(generation: Generation) -> Rig {
    let world = World::new(Vec::new(), Noise::NONE);
    let (driver, body, emulated) = robot(generation, &world);
    let emulated = Rc::new(emulated);
    let line = emulated.clone();
    Rig {
        device: Box::new(driver),
        body,
        noise: Box::new(move |bytes| line.interfere(bytes)),
        watchdog: None,
        keep: Box::new(emulated),
    }
}

fn conforms(generation: Generation) {
    let checks: Vec<_> = CHECKS
        .iter()
        .map(|&(name, check)| (name, std::thread::spawn(move || check(rig(generation)))))
        .collect();
    for (name, check) in checks {
        let measured = check
            .join()
            .unwrap()
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        println!("{generation:?} {name}: {measured}");
    }
}

#[test]
fn create_2_conforms() {
    conforms(Generation::Create2);
}

#[test]
fn create_1_conforms() {
    conforms(Generation::Create1);
}

/// Drives straight until `done`, for 10 s at most. On a busy machine the robot may be silent for a while meanwhile.
fn drive(driver: &mut Create, mut done: impl FnMut(&Reading) -> bool) -> bool {
    let limit = Instant::now() + Duration::from_secs(10);
    let straight = Command::Straight { speed: 0.4 };
    while Instant::now() < limit {
        let _ = driver.drive(&straight, &Estimate::default());
        sleep(Duration::from_millis(30));
        if let Ok(Some(reading)) = driver.read()
            && done(&reading)
        {
            return true;
        }
    }
    false
}

#[test]
fn wall_stops_it_and_presses_its_bumper() {
    let wall = Obstacle::cuboid(Point::new(0.3, 0.0, 0.0), Point::new(0.5, 6.0, 1.0));
    let world = World::new(vec![wall], Noise::NONE);
    let (mut driver, body, _emulated) = robot(Generation::Create2, &world);
    // The wall is to the right of straight ahead, since the robot faces 0.7 rad to the left of its normal.
    let bumped = drive(&mut driver, |reading| {
        reading
            .bumper
            .flatten()
            .is_some_and(|contact| contact.bearing < 0.0)
    });
    assert!(bumped, "no bump at {:?}", body.state().pose);
    let gap = 0.3 - body.state().pose.position.x - body.model().body().radius;
    assert!((0.0..0.02).contains(&gap), "{gap} m from the wall");
    let back = Command::Straight { speed: -0.2 };
    driver.drive(&back, &Estimate::default()).unwrap();
    sleep(Duration::from_millis(300));
    assert_eq!(driver.read().unwrap().unwrap().bumper, Some(None));
}

#[test]
fn lifted_robot_stops_until_it_is_put_down() {
    let world = World::new(Vec::new(), Noise::NONE);
    let (mut driver, body, emulated) = robot(Generation::Create2, &world);
    assert!(drive(&mut driver, |reading| reading.moved.unwrap().x > 0.001));
    emulated.set_hazards(Hazards {
        wheel_drop: true,
        ..Hazards::default()
    });
    sleep(Duration::from_millis(100));
    driver.read().unwrap();
    assert_eq!(emulated.mode(), Mode::Passive);
    let straight = Command::Straight { speed: 0.4 };
    let fault = driver.drive(&straight, &Estimate::default()).unwrap_err();
    assert!(fault.to_string().contains("put it on the floor"), "{fault}");
    assert_eq!(body.state().twist.linear, Point::ZERO);

    emulated.set_hazards(Hazards::default());
    assert!(drive(&mut driver, |_| body.state().twist.linear.length() > 0.3));
}

#[test]
fn silent_robot_is_reported_and_taken_back() {
    let world = World::new(Vec::new(), Noise::NONE);
    let path = std::env::temp_dir().join(format!("starl-create-{}", std::process::id()));
    let body = world
        .add("r1", model(Generation::Create2), Pose::default())
        .unwrap();
    let emulated = EmulatedCreate::start(body.clone(), Some(&path)).unwrap();
    let mut driver = Create::open(&path, &options(Generation::Create2)).unwrap();
    assert!(drive(&mut driver, |_| true));
    // The robot is switched off and on again: its interface is closed and nothing is streamed.
    let line = starl_create::SerialLine::open(&path, 115_200).unwrap();
    line.send(&[173]).unwrap();
    sleep(Duration::from_millis(200));
    while driver.read().unwrap().is_some() {}
    sleep(Duration::from_millis(1100));
    let fault = driver.read().unwrap_err();
    assert!(fault.to_string().contains("silent"), "{fault}");
    assert!(drive(&mut driver, |_| true));
    drop(emulated);
    assert!(!path.is_symlink());
}

/// Names the line for the process that is killed.
const LINE: &str = "STARL_TEST_LINE";

#[test]
fn killed_driver_leaves_a_robot_that_stops() {
    if let Ok(line) = std::env::var(LINE) {
        // This is the process to be killed.
        let mut driver = Create::open(line, &options(Generation::Create2)).unwrap();
        drive(&mut driver, |_| false);
        return;
    }
    let world = World::new(Vec::new(), Noise::NONE);
    let body = world
        .add("r1", model(Generation::Create2), Pose::default())
        .unwrap();
    let emulated = EmulatedCreate::start(body.clone(), None).unwrap();
    let moves = || body.state().twist.linear.length() > 0.0;
    let wait_until = |wanted: bool| {
        let limit = Instant::now() + Duration::from_secs(3);
        while moves() != wanted && Instant::now() < limit {
            sleep(Duration::from_millis(5));
        }
    };
    let mut child = std::process::Command::new(std::env::current_exe().unwrap())
        .args([
            "--exact",
            "create_conforms::killed_driver_leaves_a_robot_that_stops",
        ])
        .env(LINE, emulated.path())
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    wait_until(true);
    assert!(moves(), "the other process has not driven the robot");
    child.kill().unwrap();
    child.wait().unwrap();
    wait_until(false);
    assert!(!moves(), "nothing has stopped the robot");
}
