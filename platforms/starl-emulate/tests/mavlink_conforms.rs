//! The driver of MAVLink vehicles passes the suite on emulated ones with PX4 and with ArduPilot.

use starl_core::{Point, Pose};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::mavlink::EmulatedVehicle;
use starl_emulate::{Noise, World};
use starl_mavlink::{Autopilot, MavlinkOptions, MavlinkVehicle};
use starl_motion::models::by_name;
use std::net::{SocketAddr, UdpSocket};
use std::rc::Rc;
use std::time::Duration;

fn rig(autopilot: Autopilot) -> Rig {
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
