//! Local broadcast: one datagram to all robots in reach of the radio, without any promise.
//!
//! It may be lost, come late or come twice, and nobody says that it has come. It costs one datagram and no memory,
//! whatever the size of the fleet: for what is said again and again, such as positions and readings, where the next
//! message makes up for one that was lost. The field knows it as the broadcast of the abstract MAC layer without
//! acknowledgements (Kuhn, Lynch and Newport 2011), or as a beacon.

use starl_core::{Destination, Input, Payload, Port, Primitive, Robot};

/// Sends messages to whoever is in reach. What arrives is handed to [`starl_core::Program::receive`] with this
/// primitive's port.
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
