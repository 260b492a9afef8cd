//! How often a robot tells each other robot where it is.

use crate::support::{Idle, Notes, at, setup};
use starl_core::{Point, Pose, Program, Robot};
use starl_node::link::beacon::Beacon;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, Origin};
use starl_node::motors::Report;
use starl_node::robot::{Core, Incoming};
use std::time::Instant;

#[derive(Clone, Debug, starl_core::Primitives)]
struct Waiting;

impl Program for Waiting {
    fn activate(&mut self, _: &mut Robot<'_>) {}
}

/// The number of packets to a member.
fn count(idle: &Idle, member: Member) -> usize {
    let sent = idle.sent.borrow();
    sent.iter().filter(|(to, _)| *to == member).count()
}

/// A beacon of a robot that stands as many metres away as its number says.
fn beacon(from: Member) -> Incoming {
    numbered(from, 0)
}

fn numbered(from: Member, number: u32) -> Incoming {
    let place = Point::planar(f64::from(from), 0.0);
    let frame = Frame::Beacon(Beacon {
        number,
        pose: Some(Pose::level(place, 0.0)),
        ..Beacon::default()
    });
    let mut channel = Channel::new(from, "fleet", Vec::new());
    channel.want(0);
    let packet = channel.seal(0, &starl_core::message::encode(&frame));
    Incoming::Packet(Arrival {
        at: Instant::now(),
        origin: Origin::Named,
        packet: packet.expect("packets are not protected"),
    })
}

/// A core of robot 0 of a fleet that has heard all others, and the packets that it has sent since.
fn core(robots: u32) -> (Core<Notes, Idle>, Idle) {
    let mut setup = setup(Waiting);
    setup.bodies = vec![setup.bodies[0]; robots as usize];
    let idle = Idle::default();
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(at(0), setup, channel, idle.clone(), Notes::default());
    core.step(at(0), &mut (1..robots).map(beacon).collect());
    idle.sent.borrow_mut().clear();
    (core, idle)
}

/// The number of beacons that robot 0 of a fleet sends to each of the others in 6 s, if it is called so often and drives
/// at so many metres per second.
fn beacons(robots: u32, every_ms: usize, speed: f64) -> Vec<usize> {
    let (mut core, idle) = core(robots);
    for ms in (1..=6000).step_by(every_ms) {
        let place = Point::planar(0.0, speed * ms as f64 * 1e-3);
        let seen = Report::Seen(at(ms), Pose::level(place, 0.0));
        core.step(at(ms), &mut vec![Incoming::Device(seen)]);
    }
    (1..robots).map(|other| count(&idle, other)).collect()
}

#[test]
fn all_robots_of_a_small_fleet_hear_ten_beacons_a_second() {
    assert_eq!(beacons(9, 1, 0.1), [60; 8]);
    assert_eq!(beacons(9, 1, 0.0), [60; 8]);
}

#[test]
fn far_robots_of_a_large_fleet_hear_fewer_beacons() {
    let counts = beacons(100, 1, 0.1);
    assert_eq!(counts[..8], [60; 8]);
    assert_eq!(counts[8..], [10; 91]);
}

#[test]
fn a_robot_of_a_large_fleet_that_stands_tells_others_in_turns() {
    // It drove until it was seen for the first time, and stands for 2 s.
    let counts = beacons(100, 1, 0.0);
    assert!(
        counts[..8].iter().all(|count| (20..23).contains(count)),
        "{counts:?}"
    );
    assert!(
        counts[8..].iter().all(|count| (3..6).contains(count)),
        "{counts:?}"
    );
}

#[test]
fn a_robot_that_restarts_or_was_silent_for_long_is_answered_at_once() {
    let (mut core, idle) = core(100);
    for ms in (1..=3000).step_by(50) {
        core.step(at(ms), &mut Vec::new());
    }
    let mut answers = |ms: u64, number: u32| {
        // No round is due.
        core.step(at(ms), &mut Vec::new());
        idle.sent.borrow_mut().clear();
        core.step(at(ms), &mut vec![numbered(50, number)]);
        count(&idle, 50)
    };
    assert_eq!(answers(3001, 7), 0, "it goes on");
    assert_eq!(answers(4001, 8), 0, "it goes on");
    assert_eq!(answers(5001, 1), 1, "it has restarted");
    assert_eq!(answers(5002, 2), 0, "it goes on");
    assert_eq!(answers(30_000, 3), 1, "it was silent");
}

#[test]
fn far_robots_miss_beacons_of_a_robot_that_is_late() {
    // Rounds are due every 100 ms, and take place 50 ms late.
    let counts = beacons(100, 150, 0.1);
    assert_eq!(counts[..8], [39; 8]);
    let most = counts[8..].iter().max().expect("there are some");
    assert!((1..=2).contains(most), "{counts:?}");
}
