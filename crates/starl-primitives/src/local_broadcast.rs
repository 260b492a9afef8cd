//! Local broadcast: one datagram to all robots in radio range, without guarantees.
//!
//! A message may be lost, late or duplicated, and is not acknowledged. It costs one datagram and no memory,
//! whatever the size of the fleet. Use it for values that are sent repeatedly, such as positions and readings,
//! where the next message replaces a lost one. In the literature it is the broadcast of the abstract MAC layer
//! without acknowledgements (Kuhn, Lynch and Newport 2011), or a beacon.

use starl_core::{Destination, Input, Payload, Port, Primitive, Robot};

/// Sends messages to all robots in range. Received messages are passed to [`starl_core::Program::receive`]
/// with this primitive's port.
#[derive(Clone, Debug)]
pub struct LocalBroadcast(Port);

impl LocalBroadcast {
    /// An instance; those of the same name on all robots talk to each other.
    pub fn new(name: &str) -> LocalBroadcast {
        LocalBroadcast(Port::named(name))
    }

    /// Sends these bytes to all robots in reach: [`starl_core::message::encode`] makes them of any value.
    pub fn broadcast(&self, robot: &mut Robot<'_>, content: Payload) {
        robot.transmit_bytes(Destination::All, self.0, content);
    }
}

impl Primitive for LocalBroadcast {
    fn port(&self) -> Port {
        self.0
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        if let Input::Message(message) = input
            && message.port == self.0
        {
            robot.deliver(message.from, self.0, message.payload.clone());
        }
    }
}
