//! Operators see the last events of a robot that ends.

use crate::support::{Idle, Notes, at, setup};
use starl_core::{Command, Estimate, Event, Program, Robot, Saved};
use starl_host::{PlanJob, StoreJob};
use starl_motion::Neighbour;
use starl_node::link::channel::Opened;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, OPERATORS, Origin};
use starl_node::robot::{Core, Equipment, Incoming};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

/// The operator that watches.
const OPERATOR: Member = OPERATORS | 1;

/// Finishes after 100 ms.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Finishing;

impl Program for Finishing {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.now() > at(100) {
            robot.finish();
        }
    }
}

/// Keeps the packets to the operator.
#[derive(Clone, Default)]
struct Keeping(Rc<RefCell<Vec<Vec<u8>>>>);

impl Equipment for Keeping {
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

    fn send(&mut self, to: Member, packet: &[u8]) -> std::io::Result<()> {
        assert_eq!(to, OPERATOR);
        self.0.borrow_mut().push(packet.to_vec());
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

/// The events in the packets to the operator.
fn told(packets: &[Vec<u8>]) -> Vec<Event> {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    let open = |packet: &Vec<u8>| match operator.open(at(0), packet) {
        Opened::Content { content, .. } => starl_core::message::decode(&content),
        _ => None,
    };
    let frames = packets.iter().filter_map(open);
    let seen = frames.filter_map(|frame| match frame {
        Frame::Seen(seen) => Some(seen.events),
        _ => None,
    });
    seen.flatten().map(|(_, event)| event).collect()
}

#[test]
fn a_robot_that_ends_sends_its_last_events_to_the_operators_that_watch_it() {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    operator.want(0);
    let watch = starl_core::message::encode(&Frame::Watch);
    let watch = Incoming::Packet(Arrival {
        at: Instant::now(),
        origin: Origin::Named,
        packet: operator.seal(0, &watch).expect("it is not encrypted"),
    });
    let (channel, sent) = (Channel::new(0, "fleet", Vec::new()), Keeping::default());
    let software = setup(Finishing);
    let mut core = Core::new(at(0), software, channel, sent.clone(), Notes::default());
    core.step(at(100), &mut vec![watch]);
    // The next report is due at 150 ms.
    for ms in 101..149 {
        core.step(at(ms), &mut Vec::new());
    }
    assert!(!told(&sent.0.borrow()).contains(&Event::Finished));
    core.end(at(149));
    assert!(told(&sent.0.borrow()).contains(&Event::Finished));
}
