//! Members of a fleet on one machine, over TCP.

use starl_node::link::{Arrival, Transport};
use starl_zenoh::{Zenoh, ZenohOptions};
use std::net::TcpListener;
use std::sync::atomic::{AtomicU16, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

/// A free port, given once, and below those that the system gives to sockets that ask for any.
pub fn free_port() -> u16 {
    static GIVEN: AtomicU16 = AtomicU16::new(0);
    let start = 22_000 + (std::process::id() % 40) as u16 * 50;
    loop {
        let port = start + GIVEN.fetch_add(1, Ordering::Relaxed);
        if TcpListener::bind(("127.0.0.1", port)).is_ok() {
            return port;
        }
    }
}

fn join(me: u32, options: &ZenohOptions) -> (Zenoh, Receiver<Arrival>) {
    let (sender, inbox) = mpsc::channel();
    let deliver = move |arrival| sender.send(arrival).is_ok();
    (
        Zenoh::open("a fleet/*", me, options, deliver).unwrap(),
        inbox,
    )
}

/// Sends until something arrives: the members may still be connecting.
fn meets(from: &mut Zenoh, to: u32, inbox: &Receiver<Arrival>) -> bool {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(20) {
        from.send(to, b"hello").unwrap();
        if inbox.recv_timeout(Duration::from_millis(100)).is_ok() {
            return true;
        }
    }
    false
}

#[test]
fn members_find_each_other_by_gossip() {
    let ports: Vec<u16> = (0..3).map(|_| free_port()).collect();
    let options = |me: usize| ZenohOptions {
        listen: vec![format!("tcp/127.0.0.1:{}", ports[me])],
        // All know the first one alone.
        connect: (me > 0)
            .then(|| format!("tcp/127.0.0.1:{}", ports[0]))
            .into_iter()
            .collect(),
        ..ZenohOptions::default()
    };
    let members: Vec<_> = (0..3).map(|me| join(me as u32, &options(me))).collect();
    let mut members = members.into_iter();
    let (_first, _) = members.next().unwrap();
    let (mut second, _) = members.next().unwrap();
    let (_third, inbox) = members.next().unwrap();
    assert!(meets(&mut second, 2, &inbox));
}

#[test]
fn a_burst_arrives_whole_and_in_order() {
    let port = free_port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let (_first, inbox) = join(
        0,
        &ZenohOptions {
            listen: vec![endpoint.clone()],
            ..ZenohOptions::default()
        },
    );
    let (mut second, _) = join(
        1,
        &ZenohOptions {
            connect: vec![endpoint],
            ..ZenohOptions::default()
        },
    );
    assert!(meets(&mut second, 0, &inbox));
    while inbox.recv_timeout(Duration::from_millis(300)).is_ok() {}
    for number in 0..2000u32 {
        second.send(0, &number.to_le_bytes()).unwrap();
    }
    for number in 0..2000u32 {
        let arrival = inbox.recv_timeout(Duration::from_secs(10)).unwrap();
        assert_eq!(arrival.packet, number.to_le_bytes());
    }
}

#[test]
fn a_malformed_endpoint_is_refused() {
    let options = ZenohOptions {
        listen: vec!["nowhere".to_string()],
        ..ZenohOptions::default()
    };
    let error = Zenoh::open("fleet", 0, &options, |_| true).err().unwrap();
    assert!(error.to_string().contains("nowhere"), "{error}");
}
