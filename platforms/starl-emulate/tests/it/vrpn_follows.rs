//! The client of VRPN sees what the emulated server streams.

use starl_core::{Point, Pose};
use starl_emulate::vrpn::EmulatedVrpn;
use starl_emulate::{Noise, World};
use starl_motion::models::by_name;
use starl_vrpn::{Vrpn, VrpnError, VrpnOptions};
use std::io::Write;
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
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

fn client(server: SocketAddr, tracker: &str) -> Vrpn {
    Vrpn::connect(VrpnOptions {
        server,
        tracker: tracker.to_string(),
        others: vec!["ghost".to_string(), "r1".to_string()],
    })
}

/// The first answer that `wanted` takes, within 4 s.
fn wait<T>(
    client: &mut Vrpn,
    mut wanted: impl FnMut(Result<Option<(Instant, Pose)>, VrpnError>) -> Option<T>,
) -> T {
    let limit = Instant::now() + Duration::from_secs(4);
    loop {
        if let Some(answer) = wanted(client.poll()) {
            return answer;
        }
        assert!(Instant::now() < limit, "nothing has come within 4 s");
        sleep(Duration::from_millis(2));
    }
}

#[test]
fn other_trackers_are_seen_too() {
    let server = EmulatedVrpn::start(world(), any()).unwrap();
    let mut client = client(server.address(), "r0");
    let limit = Instant::now() + Duration::from_secs(4);
    let (index, _, pose) = loop {
        let _ = client.poll();
        if let Some(seen) = client.others().pop() {
            break seen;
        }
        assert!(Instant::now() < limit, "nothing has come within 4 s");
        sleep(Duration::from_millis(2));
    };
    assert_eq!(index, 1, "no server knows the first");
    assert!(pose.position.distance(Point::planar(2.0, -1.5)) < 1e-6);
}

#[test]
fn named_tracker_is_seen_where_it_is() {
    let server = EmulatedVrpn::start(world(), any()).unwrap();
    let mut client = client(server.address(), "r1");
    let (_, pose) = wait(&mut client, |answer| answer.unwrap());
    assert_eq!(pose.position, Point::planar(2.0, -1.5));
    assert!((pose.yaw - 2.5).abs() < 1e-12, "{pose:?}");
}

#[test]
fn body_that_is_added_later_is_seen() {
    let world = world();
    let server = EmulatedVrpn::start(world.clone(), any()).unwrap();
    let mut client = client(server.address(), "late");
    let silent = wait(&mut client, Result::err);
    assert_eq!(
        silent.to_string(),
        "the VRPN server does not see `late`; it knows r0, r1"
    );
    let start = Pose::level(Point::planar(5.0, 5.0), 0.0);
    let _late = world
        .add("late", by_name("create").unwrap(), start)
        .unwrap();
    let (_, pose) = wait(&mut client, |answer| answer.ok().flatten());
    assert_eq!(pose.position, Point::planar(5.0, 5.0));
}

#[test]
fn server_that_ends_is_reported_and_found_again() {
    let server = EmulatedVrpn::start(world(), any()).unwrap();
    let address = server.address();
    let mut client = client(address, "r1");
    wait(&mut client, |answer| answer.unwrap());
    drop(server);
    wait(&mut client, |answer| match answer {
        Err(VrpnError::Connection(server, _)) => Some(server),
        _ => None,
    });
    let _again = EmulatedVrpn::start(world(), address).unwrap();
    wait(&mut client, |answer| answer.ok().flatten());
}

#[test]
fn garbage_ends_a_connection_and_no_other() {
    let server = EmulatedVrpn::start(world(), any()).unwrap();
    let mut client = client(server.address(), "r1");
    wait(&mut client, |answer| answer.unwrap());
    let mut stranger = TcpStream::connect(server.address()).unwrap();
    stranger.write_all(&[0xFF; 5000]).unwrap();
    let requests = UdpSocket::bind(any()).unwrap();
    for request in [
        &b"\xFF\xFF"[..],
        b"127.0.0.1",
        b"127.0.0.1 99999",
        b"127.0.0.1 1\0",
    ] {
        requests.send_to(request, server.address()).unwrap();
    }
    sleep(Duration::from_millis(300));
    wait(&mut client, |answer| answer.unwrap());
    // A server that does not speak VRPN does not end the client either.
    let fake = TcpListener::bind(any()).unwrap();
    let mut fooled = self::client(fake.local_addr().unwrap(), "r1");
    let (mut stream, _) = fake.accept().unwrap();
    stream.write_all(b"HTTP/1.1 400 Bad Request\r\n").unwrap();
    let error = wait(&mut fooled, Result::err);
    assert!(
        error.to_string().contains("does not send VRPN 7"),
        "{error}"
    );
}
