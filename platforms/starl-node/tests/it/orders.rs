//! Orders of operators reach a robot's program once.

use crate::support::{Idle, Notes, Sent, at, setup};
use starl_core::event::Level;
use starl_core::{Event, Order, Program, Robot};
use starl_node::link::channel::Opened;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, OPERATORS, Origin};
use starl_node::robot::{Core, Incoming};
use std::time::Instant;

const OPERATOR: Member = OPERATORS | 1;

/// Logs the names of its orders.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Obedient;

impl Program for Obedient {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        robot.log(Level::Info, order.name.clone());
    }
}

/// An order in a packet of the operator.
fn order(operator: &mut Channel, number: u32, name: &'static str) -> Incoming {
    let order = Order {
        name: name.into(),
        fields: Default::default(),
    };
    let frame = starl_core::message::encode(&Frame::Order(number, order));
    operator.want(0);
    Incoming::Packet(Arrival {
        at: Instant::now(),
        origin: Origin::Named,
        packet: operator.seal(0, &frame).expect("it is not encrypted"),
    })
}

/// The orders that the robot has confirmed.
fn confirmed(idle: &Idle) -> Vec<u32> {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    let sent = idle.sent.borrow();
    let number = |(to, packet): &Sent| match operator.open(at(0), packet) {
        Opened::Content { content, .. } if *to == OPERATOR => {
            match starl_core::message::decode(&content) {
                Some(Frame::Ordered(number)) => Some(number),
                _ => None,
            }
        }
        _ => None,
    };
    sent.iter().filter_map(number).collect()
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
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
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
        core.step(at(ms), &mut vec![order(&mut operator, number, name)]);
    }
    assert_eq!(confirmed(&idle), [1, 1, 2, 1]);
    assert_eq!(logged(&core.end(at(150))), ["go", "stop"]);
}

#[test]
fn an_order_is_not_confirmed_before_the_program_starts() {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    let (channel, idle) = (Channel::new(0, "fleet", Vec::new()), Idle::default());
    let mut software = setup(Obedient);
    software.start = None;
    let mut core = Core::new(at(0), software, channel, idle.clone(), Notes::default());
    core.step(at(100), &mut vec![order(&mut operator, 1, "go")]);
    assert_eq!(confirmed(&idle), [] as [u32; 0]);
    assert!(logged(&core.end(at(150))).is_empty());
}
