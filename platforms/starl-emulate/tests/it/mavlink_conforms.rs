//! The driver of MAVLink vehicles passes the suite on emulated ones with PX4 and with ArduPilot.

use starl_core::{Command, Estimate, Point, Pose};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::mavlink::EmulatedVehicle;
use starl_emulate::{BodyHandle, Noise, World};
use starl_mavlink::{Autopilot, MavlinkOptions, MavlinkVehicle};
use starl_motion::models::by_name;
use starl_node::{Device, Reading};
use std::net::{SocketAddr, UdpSocket};
use std::rc::Rc;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn robot(autopilot: Autopilot) -> (MavlinkVehicle, BodyHandle, EmulatedVehicle) {
    let world = World::new(Vec::new(), Noise::NONE);
    let start = Pose::level(Point::planar(-1.0, 2.0), 2.0);
    let body = world.add("v1", by_name("drone").unwrap(), start).unwrap();
    let any: SocketAddr = "127.0.0.1:0".parse().unwrap();
    let driver = MavlinkVehicle::connect(&MavlinkOptions {
        listen: any,
        ..MavlinkOptions::default()
    })
    .unwrap();
    let client = Some(driver.address().unwrap());
    let emulated = EmulatedVehicle::start(body.clone(), autopilot, any, client).unwrap();
    (driver, body, emulated)
}

fn rig(autopilot: Autopilot) -> Rig {
    let (driver, body, emulated) = robot(autopilot);
    let emulated = Rc::new(emulated);
    let stranger = UdpSocket::bind("127.0.0.1:0").unwrap();
    let (address, vehicle) = (emulated.address().unwrap(), emulated.clone());
    Rig {
        device: Box::new(driver),
        body,
        noise: Box::new(move |bytes| {
            vehicle.interfere(bytes);
            stranger.send_to(bytes, address).unwrap();
        }),
        watchdog: Some(Duration::from_secs(3)),
        keep: Box::new(emulated),
    }
}

fn conforms(autopilot: Autopilot) {
    let checks: Vec<_> = CHECKS
        .iter()
        .map(|&(name, check)| (name, std::thread::spawn(move || check(rig(autopilot)))))
        .collect();
    for (name, check) in checks {
        let measured = check
            .join()
            .unwrap()
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        println!("{autopilot:?} {name}: {measured}");
    }
}

#[test]
fn px4_conforms() {
    conforms(Autopilot::Px4);
}

#[test]
fn ardupilot_conforms() {
    conforms(Autopilot::ArduPilot);
}

/// Drives `command` until `done`, for 8 s at most.
fn drive(driver: &mut MavlinkVehicle, command: Command, mut done: impl FnMut(&Reading) -> bool) {
    let limit = Instant::now() + Duration::from_secs(8);
    while Instant::now() < limit {
        driver.drive(&command, &Estimate::default()).unwrap();
        sleep(Duration::from_millis(30));
        if driver.read().unwrap().is_some_and(|reading| done(&reading)) {
            return;
        }
    }
    panic!("{command:?} has not led there within 8 s");
}

#[test]
fn driver_stops_steering_when_a_pilot_takes_over() {
    // PX4's Position mode, ArduCopter's Stabilize.
    for (autopilot, by_hand) in [(Autopilot::Px4, 3 << 16), (Autopilot::ArduPilot, 0)] {
        let (mut driver, body, emulated) = robot(autopilot);
        drive(&mut driver, Command::TakeOff, |reading| {
            reading.height.unwrap() > 0.5
        });
        emulated.switch(by_hand);
        let limit = Instant::now() + Duration::from_secs(4);
        let mut told = false;
        while Instant::now() < limit {
            let driven = driver.drive(&Command::Hover, &Estimate::default());
            told |= driven.is_err_and(|error| error.to_string().contains("taken over"));
            let _ = driver.read();
            if told {
                let _ = driver.stop();
            }
            sleep(Duration::from_millis(30));
            assert_eq!(
                emulated.mode(),
                by_hand,
                "{autopilot:?}: the driver fights the pilot"
            );
            assert!(
                body.state().pose.position.z > 0.3,
                "{autopilot:?}: it lands"
            );
            if told && limit - Instant::now() < Duration::from_secs(1) {
                break;
            }
        }
        assert!(told, "{autopilot:?}: nobody is told");
    }
}

#[test]
fn vehicle_that_is_switched_on_by_hand_is_taken_off() {
    let (mut driver, _body, emulated) = robot(Autopilot::Px4);
    // On the ground a PX4 with a remote control is in Position mode.
    emulated.switch(3 << 16);
    drive(&mut driver, Command::TakeOff, |reading| {
        reading.height.unwrap() > 0.5
    });
    drive(&mut driver, Command::Land, |reading| {
        reading.height.unwrap() < 0.01
    });
}

#[test]
fn a_vehicle_that_sends_before_it_is_asked_is_asked_for_more() {
    for autopilot in [Autopilot::Px4, Autopilot::ArduPilot] {
        let (mut driver, _body, emulated) = robot(autopilot);
        // By now the vehicle has sent each message without being asked.
        sleep(Duration::from_millis(100));
        let limit = Instant::now() + Duration::from_secs(20);
        let asked = |interval: f64| (interval - 0.05).abs() < 1e-6;
        while !emulated.interval(32).is_some_and(asked) {
            assert!(Instant::now() < limit, "{autopilot:?}: it is not asked");
            let _ = driver.drive(&Command::Stop, &Estimate::default());
            let _ = driver.read();
            sleep(Duration::from_millis(30));
        }
    }
}
