//! The driver of the Crazyflie passes the suite on the emulated one, and tests of its own.

use starl_core::{Command, Estimate, Point, Pose};
use starl_crazyflie::{Crazyflie, CrazyflieOptions};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::crazyflie::EmulatedCrazyflie;
use starl_emulate::{BodyHandle, Noise, World};
use starl_motion::models::{by_name, drone_mode as mode};
use starl_node::{Device, Reading};
use std::net::SocketAddr;
use std::rc::Rc;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn robot() -> (Crazyflie, BodyHandle, EmulatedCrazyflie) {
    let world = World::new(Vec::new(), Noise::NONE);
    let start = Pose::level(Point::planar(-1.0, 2.0), 2.0);
    let body = world.add("c1", by_name("drone").unwrap(), start).unwrap();
    let any: SocketAddr = "127.0.0.1:0".parse().unwrap();
    let emulated = EmulatedCrazyflie::start(body.clone(), any).unwrap();
    let driver = Crazyflie::connect(&CrazyflieOptions::new(emulated.address().unwrap())).unwrap();
    (driver, body, emulated)
}

fn rig() -> Rig {
    let (driver, body, emulated) = robot();
    let emulated = Rc::new(emulated);
    let crazyflie = emulated.clone();
    Rig {
        device: Box::new(driver),
        body,
        // Packets have no checksum, so noise may be a command; it goes to the driver alone.
        noise: Box::new(move |bytes| crazyflie.interfere(bytes)),
        watchdog: Some(Duration::from_secs(2)),
        keep: Box::new(emulated),
    }
}

#[test]
fn crazyflie_conforms() {
    let checks: Vec<_> = CHECKS
        .iter()
        .map(|&(name, check)| (name, std::thread::spawn(move || check(rig()))))
        .collect();
    for (name, check) in checks {
        let measured = check
            .join()
            .unwrap()
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        println!("{name}: {measured}");
    }
}

/// Drives `command` until `done`, for 8 s at most; returns the last reading.
fn drive(
    driver: &mut Crazyflie,
    command: Command,
    mut done: impl FnMut(&Reading) -> bool,
) -> Reading {
    let limit = Instant::now() + Duration::from_secs(8);
    while Instant::now() < limit {
        driver.drive(&command, &Estimate::default()).unwrap();
        sleep(Duration::from_millis(30));
        if let Some(reading) = driver.read().unwrap()
            && done(&reading)
        {
            return reading;
        }
    }
    panic!("{command:?} has not led there within 8 s");
}

#[test]
fn signs_of_attitude_are_the_platform_s() {
    let (mut driver, body, _emulated) = robot();
    let height = |reading: &Reading| reading.height.unwrap();
    drive(&mut driver, Command::TakeOff, |reading| {
        height(reading) > 0.5
    });
    let fly = |yaw_rate, pitch, roll, gaz| Command::Attitude {
        yaw_rate,
        pitch,
        roll,
        gaz,
    };
    let speed = |reading: &Reading| reading.velocity.unwrap();
    drive(&mut driver, fly(0.0, 0.1, 0.0, 0.0), |reading| {
        speed(reading).x > 0.3
    });
    drive(&mut driver, fly(0.0, -0.1, 0.0, 0.0), |reading| {
        speed(reading).x < -0.3
    });
    drive(&mut driver, fly(0.0, 0.0, 0.1, 0.0), |reading| {
        speed(reading).y < -0.3
    });
    drive(&mut driver, fly(0.0, 0.0, -0.1, 0.0), |reading| {
        speed(reading).y > 0.3
    });
    drive(&mut driver, fly(0.0, 0.0, 0.0, 0.5), |reading| {
        speed(reading).z > 0.3
    });
    let left = drive(&mut driver, fly(0.5, 0.0, 0.0, 0.0), |reading| {
        reading.heading.unwrap() > 0.3
    });
    let turned = body.state().pose.yaw - 2.0;
    assert!((left.heading.unwrap() - turned).abs() < 0.1, "{turned}");
    drive(&mut driver, Command::Land, |reading| height(reading) == 0.0);
    for command in [Command::Hover, fly(0.0, 0.1, 0.0, 1.0), Command::Stop] {
        driver.drive(&command, &Estimate::default()).unwrap();
        sleep(Duration::from_millis(100));
        assert_eq!(body.state().mode, mode::LANDED, "{command:?}");
    }
}

#[test]
fn new_driver_leaves_a_crazyflie_in_the_air() {
    let (mut driver, body, emulated) = robot();
    drive(&mut driver, Command::TakeOff, |reading| {
        reading.height.unwrap() > 0.5
    });
    // The first driver is killed: it lands nothing.
    std::mem::forget(driver);
    let options = CrazyflieOptions::new(emulated.address().unwrap());
    let mut second = Crazyflie::connect(&options).unwrap();
    let reading = drive(&mut second, Command::Hover, |_| true);
    assert!(reading.height.unwrap() > 0.4, "{reading:?}");
    drop(second);
    let limit = Instant::now() + Duration::from_secs(5);
    while body.state().mode != mode::LANDED && Instant::now() < limit {
        sleep(Duration::from_millis(10));
    }
    assert_eq!(body.state().mode, mode::LANDED, "a dropped driver lands it");
}

#[test]
fn crazyflie_that_is_switched_off_and_on_is_found_again() {
    let (mut driver, body, emulated) = robot();
    drive(&mut driver, Command::Stop, |_| true);
    let address = emulated.address().unwrap();
    drop(emulated);
    let limit = Instant::now() + Duration::from_secs(3);
    while !matches!(driver.read(), Err(error) if error.to_string().contains("silent")) {
        assert!(Instant::now() < limit, "the silence is not reported");
        sleep(Duration::from_millis(20));
    }
    let _again = EmulatedCrazyflie::start(body, address).unwrap();
    let limit = Instant::now() + Duration::from_secs(5);
    while !matches!(driver.read(), Ok(Some(_))) {
        assert!(Instant::now() < limit, "no reading has come");
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn crazyflie_on_its_side_is_reported_and_does_not_fly() {
    let (mut driver, body, emulated) = robot();
    drive(&mut driver, Command::Stop, |_| true);
    emulated.tumble();
    let limit = Instant::now() + Duration::from_secs(2);
    let mut is_told = false;
    while Instant::now() < limit {
        let _ = driver.read();
        let driven = driver.drive(&Command::TakeOff, &Estimate::default());
        is_told |= driven.is_err_and(|error| error.to_string().contains("on its side"));
        sleep(Duration::from_millis(30));
    }
    assert!(is_told);
    assert_eq!(body.state().mode, mode::LANDED);
}
