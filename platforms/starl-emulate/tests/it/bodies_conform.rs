//! Simulated robots with bodies in a world that they share with emulated ones pass the suite of drivers, and are not alone
//! there.

use starl_core::{Command, Estimate, Point, Pose};
use starl_emulate::bodies::{EmulatedBodies, WATCHDOG};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::{BodyHandle, Noise, World};
use starl_motion::models::by_name;
use starl_node::Device;
use starl_node::world_body::{WorldBody, WorldDevice};
use std::net::UdpSocket;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn robot(world: &World, model: &str, start: Pose) -> (WorldDevice, BodyHandle, EmulatedBodies) {
    let model = by_name(model).unwrap();
    let body = world.add("r1", model.clone(), start).unwrap();
    let any = "127.0.0.1:0".parse().unwrap();
    let server = EmulatedBodies::start(vec![body.clone()], any).unwrap();
    let driver = WorldBody::new(server.address(), "r1", model).unwrap();
    (driver.device(), body, server)
}

fn rig(model: &str) -> Rig {
    let world = World::new(Vec::new(), Noise::NONE);
    let start = Pose::level(Point::planar(-1.0, 2.0), 2.0);
    let (driver, body, server) = robot(&world, model, start);
    let (socket, address) = (UdpSocket::bind("127.0.0.1:0").unwrap(), server.address());
    Rig {
        device: Box::new(driver),
        body,
        noise: Box::new(move |bytes| {
            socket.send_to(bytes, address).unwrap();
        }),
        watchdog: Some(WATCHDOG),
        keep: Box::new(server),
    }
}

#[test]
fn bodies_in_a_world_conform() {
    let cases = ["create", "drone"].into_iter().flat_map(|model| {
        let case = move |(name, check)| (model, name, check);
        CHECKS.into_iter().map(case)
    });
    let checks: Vec<_> = cases
        .map(|(model, name, check)| {
            let checked = std::thread::spawn(move || check(rig(model)));
            (model, name, checked)
        })
        .collect();
    for (model, name, checked) in checks {
        let measured = checked.join().unwrap();
        let measured = measured.unwrap_or_else(|failure| panic!("{model}: {name}: {failure}"));
        println!("{model}: {name}: {measured}");
    }
}

#[test]
fn a_simulated_robot_stops_at_another_body_and_feels_it() {
    let world = World::new(Vec::new(), Noise::NONE);
    let emulated = Pose::level(Point::planar(1.0, 0.0), 0.0);
    let emulated = world.add("emulated", by_name("create").unwrap(), emulated);
    let (mut driver, body, _server) = robot(&world, "create", Pose::default());
    let begun = Instant::now();
    let mut touched = None;
    while touched.is_none() && begun.elapsed() < Duration::from_secs(10) {
        let ahead = Command::Straight { speed: 0.5 };
        driver.drive(&ahead, &Estimate::default()).unwrap();
        sleep(Duration::from_millis(10));
        let reading = driver.read().unwrap();
        touched = reading.and_then(|reading| reading.bumper).flatten();
    }
    let contact = touched.expect("it meets the other one");
    assert!(contact.bearing.abs() < 0.01, "{contact:?}");
    let at = emulated.unwrap().state().pose.position;
    let gap = at.x - body.state().pose.position.x - 2.0 * body.model().body().radius;
    assert!((0.0..0.01).contains(&gap), "{gap} m apart");
}

#[test]
fn a_world_that_is_missing_is_reported() {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let address = socket.local_addr().unwrap();
    let body = WorldBody::new(address, "r1", by_name("create").unwrap()).unwrap();
    let mut driver = body.device();
    assert_eq!(driver.read().unwrap(), None);
    sleep(Duration::from_millis(1100));
    let fault = driver.read().unwrap_err().to_string();
    assert!(fault.contains("`starl emulate fleet`"), "{fault}");
}
