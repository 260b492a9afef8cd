//! The driver of the AR.Drone passes the suite on the emulated one, and tests of its own.

use starl_ardrone::{Ardrone, ArdroneOptions};
use starl_core::{Command, Estimate, Point, Pose};
use starl_emulate::ardrone::EmulatedArdrone;
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::{BodyHandle, Noise, World};
use starl_motion::models::{by_name, drone_mode as mode};
use starl_node::{Device, Reading};
use std::net::{SocketAddr, UdpSocket};
use std::rc::Rc;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn robot() -> (Ardrone, BodyHandle, EmulatedArdrone) {
    let world = World::new(Vec::new(), Noise::NONE);
    let start = Pose::level(Point::planar(-1.0, 2.0), 2.0);
    let body = world.add("d1", by_name("drone").unwrap(), start).unwrap();
    let any: SocketAddr = "127.0.0.1:0".parse().unwrap();
    let emulated = EmulatedArdrone::start(body.clone(), any, any).unwrap();
    let driver = Ardrone::connect(&options(&emulated)).unwrap();
    (driver, body, emulated)
}

fn options(emulated: &EmulatedArdrone) -> ArdroneOptions {
    ArdroneOptions {
        commands: emulated.commands(),
        navdata: emulated.navdata().unwrap(),
        ..ArdroneOptions::new([127, 0, 0, 1].into())
    }
}

fn rig() -> Rig {
    let (driver, body, emulated) = robot();
    let emulated = Rc::new(emulated);
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    let (commands, drone) = (emulated.commands(), emulated.clone());
    Rig {
        device: Box::new(driver),
        body,
        noise: Box::new(move |bytes| {
            drone.interfere(bytes);
            stranger.send_to(bytes, commands).unwrap();
        }),
        watchdog: Some(Duration::from_secs(2)),
        keep: Box::new(emulated),
    }
}

#[test]
fn ardrone_conforms() {
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
    driver: &mut Ardrone,
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
        height(reading) > 0.45
    });
    drive(&mut driver, Command::Hover, |_| {
        body.state().mode == mode::HOVERING
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
    // A drone on the floor stays there, whatever the command is, except to take off.
    for command in [Command::Hover, fly(0.0, 0.1, 0.0, 1.0), Command::Stop] {
        driver.drive(&command, &Estimate::default()).unwrap();
        sleep(Duration::from_millis(100));
        assert_eq!(body.state().mode, mode::LANDED, "{command:?}");
    }
}

#[test]
fn new_driver_leaves_a_drone_in_the_air() {
    let (mut driver, body, emulated) = robot();
    drive(&mut driver, Command::TakeOff, |reading| {
        reading.height.unwrap() > 0.45
    });
    // The first driver is killed: it lands nothing.
    std::mem::forget(driver);
    let mut second = Ardrone::connect(&options(&emulated)).unwrap();
    let reading = drive(&mut second, Command::Hover, |_| true);
    assert!(reading.height.unwrap() > 0.4, "{reading:?}");
    sleep(Duration::from_millis(200));
    let now = body.state().mode;
    assert!(now != mode::LANDED && now != mode::LANDING, "mode {now}");
    drop(second);
    let limit = Instant::now() + Duration::from_secs(5);
    while body.state().mode != mode::LANDED && Instant::now() < limit {
        sleep(Duration::from_millis(10));
    }
    assert_eq!(body.state().mode, mode::LANDED, "a dropped driver lands it");
}

#[test]
fn drone_that_is_switched_off_and_on_is_configured_again() {
    let (mut driver, body, emulated) = robot();
    let wait = |driver: &mut Ardrone| {
        let limit = Instant::now() + Duration::from_secs(5);
        loop {
            if let Ok(Some(reading)) = driver.read() {
                return reading;
            }
            assert!(Instant::now() < limit, "no reading has come");
            sleep(Duration::from_millis(20));
        }
    };
    wait(&mut driver);
    let (commands, navdata) = (emulated.commands(), emulated.navdata().unwrap());
    drop(emulated);
    let limit = Instant::now() + Duration::from_secs(3);
    while !matches!(driver.read(), Err(error) if error.to_string().contains("silent")) {
        assert!(Instant::now() < limit, "the silence is not reported");
        sleep(Duration::from_millis(20));
    }
    let _again = EmulatedArdrone::start(body, commands, navdata).unwrap();
    assert_eq!(wait(&mut driver).height, Some(0.0));
}

#[test]
fn greater_number_of_a_stranger_does_not_shut_the_driver_out() {
    let (mut driver, body, emulated) = robot();
    drive(&mut driver, Command::Hover, |_| true);
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    let forged = b"AT*COMWDG=4000000000\r";
    stranger.send_to(forged, emulated.commands()).unwrap();
    drive(&mut driver, Command::TakeOff, |reading| {
        reading.height.unwrap() > 0.4
    });
    assert_ne!(body.state().mode, mode::LANDED);
}
