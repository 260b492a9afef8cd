//! How often a robot tells each other robot where it is.

use crate::support::{Idle, Notes, at, setup};
use starl_core::{Command, Estimate, Point, Pose, Program, Robot, Saved};
use starl_host::{PlanJob, StoreJob};
use starl_motion::Neighbour;
use starl_node::link::beacon::Beacon;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, Origin};
use starl_node::robot::{Core, Equipment, Incoming};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

#[derive(Clone, Debug, starl_core::Primitives)]
struct Waiting;

impl Program for Waiting {
    fn activate(&mut self, _: &mut Robot<'_>) {}
}

/// Counts the packets to each member.
#[derive(Clone, Default)]
struct Counting(Rc<RefCell<BTreeMap<Member, u32>>>);

impl Equipment for Counting {
    fn saved(&self) -> Option<Arc<Saved>> {
        Idle.saved()
    }

    fn has_fixes(&self) -> bool {
        false
    }

    fn drive(&mut self, _: Command, _: &Estimate) {}

    fn stop(&mut self) {}

    fn end(&mut self) {}

    fn find(&mut self, _: PlanJob, _: Vec<Neighbour>) {}

    fn write(&mut self, _: StoreJob) {}

    fn send(&mut self, to: Member, _: &[u8]) -> std::io::Result<()> {
        *self.0.borrow_mut().entry(to).or_default() += 1;
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

/// A beacon of a robot that stands as many metres away as its number says.
fn beacon(from: Member) -> Incoming {
    let place = Point::planar(f64::from(from), 0.0);
    let frame = Frame::Beacon(Beacon {
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

/// The number of beacons that robot 0 of a fleet sends to each of the others in 6 s, if it is called so often.
fn beacons(robots: u32, every_ms: usize) -> Vec<u32> {
    let mut setup = setup(Waiting);
    setup.bodies = vec![setup.bodies[0]; robots as usize];
    let counting = Counting::default();
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(at(0), setup, channel, counting.clone(), Notes::default());
    core.step(at(0), &mut (1..robots).map(beacon).collect());
    counting.0.borrow_mut().clear();
    for ms in (1..=6000).step_by(every_ms) {
        core.step(at(ms), &mut Vec::new());
    }
    let counts = counting.0.borrow();
    (1..robots).map(|other| counts[&other]).collect()
}

#[test]
fn all_robots_of_a_small_fleet_hear_ten_beacons_a_second() {
    assert_eq!(beacons(9, 1), [60; 8]);
}

#[test]
fn far_robots_of_a_large_fleet_hear_fewer_beacons() {
    let counts = beacons(100, 1);
    assert_eq!(counts[..8], [60; 8]);
    assert_eq!(counts[8..], [10; 91]);
}

#[test]
fn far_robots_miss_beacons_of_a_robot_that_is_late() {
    // Rounds are due every 100 ms, and take place 50 ms late.
    let counts = beacons(100, 150);
    assert_eq!(counts[..8], [39; 8]);
    let most = counts[8..].iter().max().expect("there are some");
    assert!((1..=2).contains(most), "{counts:?}");
}
