//! Orders of operators reach a robot's program once.

use crate::support::{Idle, Notes, at, from_operator, setup, to_operator};
use starl_core::event::Level;
use starl_core::{Event, Order, Program, Robot};
use starl_node::link::Channel;
use starl_node::link::frame::Frame;
use starl_node::robot::{Core, Incoming};

/// Logs the names of its orders.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Obedient;

impl Program for Obedient {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        robot.log(Level::Info, order.name.clone());
    }
}

fn order(number: u32, name: &'static str) -> Incoming {
    let order = Order {
        name: name.into(),
        fields: Default::default(),
    };
    from_operator(&Frame::Order(number, order))
}

/// The orders that the robot has confirmed.
fn confirmed(idle: &Idle) -> Vec<u32> {
    let number = |frame| match frame {
        Frame::Ordered(number) => Some(number),
        _ => None,
    };
    to_operator(idle).into_iter().filter_map(number).collect()
}

fn logged(notes: &Notes) -> Vec<&str> {
    let lines = notes.0.iter().filter_map(|(_, event)| match event {
        Event::Log { text, .. } => Some(&text[..]),
        _ => None,
    });
    lines.collect()
}

#[test]
fn an_order_reaches_the_program_once_and_each_copy_is_confirmed() {
    let (channel, idle) = (Channel::new(0, "fleet", Vec::new()), Idle::default());
    let software = setup(Obedient);
    let mut core = Core::new(at(0), software, channel, idle.clone(), Notes::default());
    core.step(at(100), &mut Vec::new());
    for (ms, number, name) in [
        (110, 1, "go"),
        (120, 1, "go"),
        (130, 2, "stop"),
        (140, 1, "go"),
    ] {
        core.step(at(ms), &mut vec![order(number, name)]);
    }
    assert_eq!(confirmed(&idle), [1, 1, 2, 1]);
    assert_eq!(logged(&core.end(at(150))), ["go", "stop"]);
}

#[test]
fn an_order_is_not_confirmed_before_the_program_starts() {
    let (channel, idle) = (Channel::new(0, "fleet", Vec::new()), Idle::default());
    let mut software = setup(Obedient);
    software.start = None;
    let mut core = Core::new(at(0), software, channel, idle.clone(), Notes::default());
    core.step(at(100), &mut vec![order(1, "go")]);
    assert_eq!(confirmed(&idle), [] as [u32; 0]);
    assert!(logged(&core.end(at(150))).is_empty());
}
