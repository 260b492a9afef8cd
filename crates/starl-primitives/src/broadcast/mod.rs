//! Broadcast: a message to every other robot (thesis, section 3.3.1), in one of several orders.
//!
//! Property (d1): over a network that delivers a datagram within `longest_delay` or not at all, every
//! robot that receives the message does so within [`Broadcast::delivery_bound`] of the call, once.
//! Every robot receives it that is up and for which not all copies are lost.
//! [`Broadcast::take_failures`] names the robots without acknowledgement.
//!
//! "This can be easily expanded to enforce message ordering, such as FIFO ordering, causal ordering, and
//! total ordering", says the thesis: see [`Order`].

mod causal;
mod order;
mod total;

pub use order::Order;

use crate::Failure;
use crate::channel::{Carrier, Channel};
use crate::reliable::{MessageId, Options, encode};
use alloc::boxed::Box;
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use causal::Causal;
use serde::Serialize;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Duration, Input, Port, Primitive, Random, Robot, RobotId};
use total::Total;

/// Sends messages to all other robots of the application. Received messages are passed to
/// [`starl_core::Program::receive`] with this primitive's port.
#[derive(Clone, Debug)]
pub struct Broadcast {
    order: Order,
    way: Way,
}

/// The implementation of the order.
#[derive(Clone, Debug)]
enum Way {
    Acknowledged(Box<Channel>),
    Causal(Box<Causal>),
    Total(Box<Total>),
}

/// Messages that were passed over: others may have received them, and this robot will not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gap {
    /// Their sender; none if unknown.
    pub from: Option<RobotId>,
}

/// The latest gaps are kept up to this number.
const MOST_GAPS: usize = 64;

/// The messages that were passed over and not queried.
#[derive(Clone, Debug, Default)]
struct Gaps(VecDeque<Gap>);

impl Gaps {
    fn push(&mut self, gap: Gap) {
        if self.0.len() == MOST_GAPS {
            self.0.pop_front();
        }
        self.0.push_back(gap);
    }

    fn take(&mut self) -> Vec<Gap> {
        core::mem::take(&mut self.0).into()
    }
}

impl Broadcast {
    /// An instance; those of the same name on all robots talk to each other. Its order is that of the
    /// options: [`Order::Fifo`] or none.
    pub fn new(name: &str, options: Options) -> Broadcast {
        let order = match options.first_in_first_out {
            true => Order::Fifo,
            false => Order::Unordered,
        };
        Broadcast::in_order(name, order, options)
    }

    /// An instance with this order.
    pub fn in_order(name: &str, order: Order, options: Options) -> Broadcast {
        let options = Options {
            first_in_first_out: order != Order::Unordered,
            ..options
        };
        let channel = Channel::new(Carrier::Broadcast, name, options);
        let way = match order {
            Order::Unordered | Order::Fifo => Way::Acknowledged(Box::new(channel)),
            Order::Causal => Way::Causal(Box::new(Causal::new(channel))),
            Order::Total => Way::Total(Box::new(Total::new(channel.port, options))),
        };
        Broadcast { order, way }
    }

    /// The order of its messages.
    pub fn order(&self) -> Order {
        self.order
    }

    /// Sends `content` to every other robot; in total order, to this one too.
    pub fn broadcast<T: Serialize>(&mut self, robot: &mut Robot<'_>, content: &T) -> MessageId {
        // The command is recorded ahead of what it brings about.
        let message = match &mut self.way {
            Way::Acknowledged(channel) => channel.reliable.next_to_all(robot),
            Way::Causal(causal) => causal.channel.reliable.next_to_all(robot),
            Way::Total(total) => total.next(robot),
        };
        let broadcast = BroadcastEvent::Broadcast {
            message: message.numbered(),
            retry_span: self.options().retry_span(),
            order: self.order.promised(),
        };
        robot.report(self.port(), broadcast);
        match &mut self.way {
            Way::Acknowledged(channel) => channel.send_to_peers(robot, encode(content)),
            Way::Causal(causal) => causal.broadcast(robot, encode(content)),
            Way::Total(total) => total.broadcast(robot, encode(content)),
        }
    }

    /// Whether the message still waits for the acknowledgement of some robot; in total order, whether this robot has
    /// neither delivered it nor given it up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        match &self.way {
            Way::Acknowledged(channel) => channel.reliable.is_outstanding(message),
            Way::Causal(causal) => causal.channel.reliable.is_outstanding(message),
            Way::Total(total) => total.is_outstanding(message),
        }
    }

    /// How many messages are outstanding.
    pub fn backlog(&self) -> usize {
        match &self.way {
            Way::Acknowledged(channel) => channel.reliable.backlog(),
            Way::Causal(causal) => causal.channel.reliable.backlog(),
            Way::Total(total) => total.backlog(),
        }
    }

    /// The messages that some robot did not acknowledge, since the last call; at most the latest 64. In total order,
    /// the messages that were given up without a position, whose receivers are unknown.
    pub fn take_failures(&mut self) -> Vec<Failure> {
        match &mut self.way {
            Way::Acknowledged(channel) => channel.take_failures(),
            Way::Causal(causal) => causal.channel.take_failures(),
            Way::Total(total) => total.take_failures(),
        }
    }

    /// The messages passed over since the last call; at most the latest 64.
    pub fn take_gaps(&mut self) -> Vec<Gap> {
        match &mut self.way {
            Way::Acknowledged(_) => Vec::new(),
            Way::Causal(causal) => causal.take_gaps(),
            Way::Total(total) => total.take_gaps(),
        }
    }

    /// Whether nothing can be ordered at present, since no majority of the fleet is in reach. Only in
    /// total order.
    pub fn failed(&self) -> bool {
        matches!(&self.way, Way::Total(total) if total.failed())
    }

    /// The thesis's d1, for the longest time that the network takes to deliver a datagram. In total
    /// order a message may take longer, where no majority is in reach or its leader fails.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        self.options().delivery_bound(longest_delay)
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        match &mut self.way {
            Way::Acknowledged(_) => {}
            Way::Causal(causal) => causal.corrupt(random),
            Way::Total(total) => total.corrupt(random),
        }
    }

    fn options(&self) -> &Options {
        match &self.way {
            Way::Acknowledged(channel) => channel.reliable.options(),
            Way::Causal(causal) => causal.channel.reliable.options(),
            Way::Total(total) => total.options(),
        }
    }
}

impl Primitive for Broadcast {
    fn port(&self) -> Port {
        match &self.way {
            Way::Acknowledged(channel) => channel.port,
            Way::Causal(causal) => causal.channel.port,
            Way::Total(total) => total.port,
        }
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match &mut self.way {
            // Nothing else is of interest to the protocol, and the memory of thousands of robots is far.
            Way::Acknowledged(_) if !matches!(input, Input::Message(_) | Input::Timer(_)) => {}
            Way::Acknowledged(channel) => {
                let port = channel.port;
                channel.handle(robot, input, |robot, arrival| {
                    let (from, message) = arrival.numbered();
                    robot.report(
                        port,
                        BroadcastEvent::from(TransferEvent::Deliver { from, message }),
                    );
                    robot.deliver(arrival.from, port, arrival.content);
                });
            }
            Way::Causal(causal) => causal.handle(robot, input),
            Way::Total(total) => total.handle(robot, input),
        }
    }
}
