//! Messages on their way out.

use super::packet::Packet;
use alloc::collections::VecDeque;
use starl_core::{Robot, RobotId};

/// Messages to be sent, in order.
#[derive(Debug, Default)]
pub(super) struct Post(pub VecDeque<(RobotId, Packet)>);

impl Post {
    pub fn send(&mut self, to: RobotId, packet: Packet) {
        self.0.push_back((to, packet));
    }

    /// Takes the packet that goes to all others, as one datagram.
    pub fn for_all(&mut self, robot: &Robot<'_>) -> Option<Packet> {
        let me = robot.id();
        let (_, first) = self.0.iter().find(|(to, _)| *to != me)?;
        let first = first.clone();
        let is_same = |(to, packet): &(RobotId, Packet)| *to != me && *packet == first;
        let count = self.0.iter().filter(|item| is_same(item)).count();
        if count < 2 || count < robot.peers().count() {
            return None;
        }
        self.0.retain(|item| !is_same(item));
        Some(first)
    }
}
