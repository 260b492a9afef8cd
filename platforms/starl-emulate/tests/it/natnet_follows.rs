//! The client of NatNet sees what the emulated server streams.

use starl_core::{Command, Point, Pose};
use starl_emulate::natnet::{Cameras, EmulatedNatNet};
use starl_emulate::{Noise, World};
use starl_motion::models::by_name;
use starl_natnet::{NatNet, NatNetError, NatNetOptions, UpAxis};
use std::net::SocketAddr;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn any() -> SocketAddr {
    "127.0.0.1:0".parse().unwrap()
}

fn world() -> World {
    let world = World::new(Vec::new(), Noise::NONE);
    for (name, x) in [("r0", 0.0), ("r1", 2.0)] {
        let start = Pose::level(Point::planar(x, -1.5), 2.5);
        world.add(name, by_name("create").unwrap(), start).unwrap();
    }
    world
}

fn client(server: SocketAddr, body: &str) -> NatNet {
    NatNet::connect(NatNetOptions {
        server,
        ..NatNetOptions::new(server.ip(), body)
    })
    .unwrap()
}

#[test]
fn other_bodies_are_seen_too() {
    let server = EmulatedNatNet::start(world(), any(), Cameras::default()).unwrap();
    let options = NatNetOptions::new(server.address().ip(), "r0");
    let mut client = NatNet::connect(NatNetOptions {
        server: server.address(),
        others: vec!["ghost".to_string(), "r1".to_string()],
        ..options
    })
    .unwrap();
    wait(&mut client, |answer| answer.ok().flatten());
    let seen: Vec<_> = client.others().collect();
    assert_eq!(seen.len(), 1, "no server knows the first");
    let (index, _, pose) = seen[0];
    assert_eq!(index, 1);
    assert!(pose.position.distance(Point::planar(2.0, -1.5)) < 1e-4);
    assert_eq!(client.others().count(), 0, "they are told once");
}

/// The first answer that `wanted` takes, within 3 s.
fn wait<T>(
    client: &mut NatNet,
    mut wanted: impl FnMut(Result<Option<(Instant, Pose)>, NatNetError>) -> Option<T>,
) -> T {
    let limit = Instant::now() + Duration::from_secs(3);
    loop {
        if let Some(answer) = wanted(client.poll()) {
            return answer;
        }
        assert!(Instant::now() < limit, "nothing has come within 3 s");
        sleep(Duration::from_millis(2));
    }
}

#[test]
fn each_version_shows_the_named_body_where_it_is() {
    for version in [(3, 0), (3, 1), (4, 0), (4, 1)] {
        let world = world();
        let cameras = Cameras {
            version,
            latency: Duration::from_millis(30),
            ..Cameras::default()
        };
        let server = EmulatedNatNet::start(world, any(), cameras).unwrap();
        let mut client = client(server.address(), "r1");
        let (taken, pose) = wait(&mut client, |answer| answer.unwrap());
        assert!(
            (pose.position.x - 2.0).abs() < 1e-5,
            "{version:?}: {pose:?}"
        );
        assert!(
            (pose.position.y + 1.5).abs() < 1e-5,
            "{version:?}: {pose:?}"
        );
        assert!((pose.yaw - 2.5).abs() < 1e-5, "{version:?}: {pose:?}");
        let age = taken.elapsed();
        assert!(
            (Duration::from_millis(30)..Duration::from_millis(200)).contains(&age),
            "{version:?}: {age:?}"
        );
    }
}

#[test]
fn tilted_drone_is_seen_with_its_angles() {
    let world = World::new(Vec::new(), Noise::NONE);
    let start = Pose::level(Point::new(0.0, 0.0, 1.0), 1.0);
    let body = world.add("d1", by_name("drone").unwrap(), start).unwrap();
    let server = EmulatedNatNet::start(world, any(), Cameras::default()).unwrap();
    body.command(Command::Attitude {
        yaw_rate: 0.0,
        pitch: 0.2,
        roll: -0.1,
        gaz: 0.0,
    });
    let mut client = client(server.address(), "d1");
    wait(&mut client, |answer| {
        let (_, pose) = answer.unwrap()?;
        ((pose.pitch - 0.2).abs() < 0.01 && (pose.roll + 0.1).abs() < 0.01).then_some(())
    });
}

#[test]
fn unknown_body_is_named_with_those_there_are() {
    let server = EmulatedNatNet::start(world(), any(), Cameras::default()).unwrap();
    let mut client = client(server.address(), "r7");
    let error = wait(&mut client, Result::err);
    assert_eq!(
        error.to_string(),
        "Motive has no rigid body `r7`; it has r0, r1"
    );
}

#[test]
fn hidden_body_is_not_seen_and_a_server_that_ends_is_silent() {
    let cameras = Cameras {
        hidden: 1.0,
        ..Cameras::default()
    };
    let server = EmulatedNatNet::start(world(), any(), cameras).unwrap();
    let mut hidden = client(server.address(), "r1");
    let limit = Instant::now() + Duration::from_millis(500);
    while Instant::now() < limit {
        assert!(hidden.poll().unwrap().is_none());
        sleep(Duration::from_millis(5));
    }
    let address = server.address();
    drop(server);
    let silent = wait(&mut hidden, |answer| match answer {
        Err(NatNetError::Silent(server)) => Some(server),
        _ => None,
    });
    assert_eq!(silent, address);
    let again = EmulatedNatNet::start(world(), address, Cameras::default()).unwrap();
    wait(&mut hidden, |answer| answer.ok().flatten());
    drop(again);
}

#[test]
fn server_with_y_up_is_turned() {
    let world = World::new(Vec::new(), Noise::NONE);
    // A server with y up calls (1, 3, 2) the point that is (1, -2, 3) on our floor. The emulated server has z up, so
    // the client is configured for y up and reads the server's z as y.
    let start = Pose::level(Point::new(1.0, 3.0, 2.0), 0.0);
    world.add("d1", by_name("drone").unwrap(), start).unwrap();
    let server = EmulatedNatNet::start(world, any(), Cameras::default()).unwrap();
    let mut client = NatNet::connect(NatNetOptions {
        server: server.address(),
        up: UpAxis::Y,
        ..NatNetOptions::new(server.address().ip(), "d1")
    })
    .unwrap();
    let (_, pose) = wait(&mut client, |answer| answer.unwrap());
    let error = pose.position.distance(Point::new(1.0, -2.0, 3.0));
    assert!(error < 1e-5, "{pose:?}");
}
