//! The order in which messages are delivered to programs.

use starl_core::event::messaging;

/// The order of messages. Each includes the previous ones, except that total order does not include causal order across
/// senders (Hadzilacos and Toueg 1994).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// In the order of arrival.
    #[default]
    Unordered,
    /// Each sender's in the order in which they were sent.
    Fifo,
    /// A message is delivered after all messages that its sender had sent or received before it.
    Causal,
    /// The same order on all robots, the sender's own messages among them.
    Total,
}

impl Order {
    /// The name of the order in records; none without an order.
    pub(super) fn promised(self) -> Option<messaging::Order> {
        match self {
            Order::Unordered => None,
            Order::Fifo => Some(messaging::Order::Fifo),
            Order::Causal => Some(messaging::Order::Causal),
            Order::Total => Some(messaging::Order::Total),
        }
    }
}
