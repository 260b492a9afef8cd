//! Operators see the last events of a robot that ends.

use crate::support::{Idle, Notes, at, from_operator, setup, to_operator};
use starl_core::{Event, Program, Robot};
use starl_node::link::Channel;
use starl_node::link::frame::Frame;
use starl_node::robot::Core;

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

/// The events in the packets to the operator.
fn told(idle: &Idle) -> Vec<Event> {
    let frames = to_operator(idle).into_iter();
    let seen = frames.filter_map(|frame| match frame {
        Frame::Seen(seen) => Some(seen.events),
        _ => None,
    });
    seen.flatten().map(|(_, event)| event).collect()
}

#[test]
fn a_robot_that_ends_sends_its_last_events_to_the_operators_that_watch_it() {
    let (channel, idle) = (Channel::new(0, "fleet", Vec::new()), Idle::default());
    let software = setup(Finishing);
    let mut core = Core::new(at(0), software, channel, idle.clone(), Notes::default());
    core.step(at(100), &mut vec![from_operator(&Frame::Watch)]);
    // The next report is due at 150 ms.
    for ms in 101..149 {
        core.step(at(ms), &mut Vec::new());
    }
    assert!(!told(&idle).contains(&Event::Finished));
    core.end(at(149));
    assert!(told(&idle).contains(&Event::Finished));
}
