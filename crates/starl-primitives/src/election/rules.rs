//! The common interface of the three algorithms for [`super::LeaderElection`].

use super::Options;
use super::packet::Packet;
use alloc::collections::BTreeSet;
use starl_core::{Destination, Port, Random, Robot, RobotId, Time};

/// A leader, and in which epoch, where there are epochs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leadership {
    pub leader: RobotId,
    pub epoch: Option<u64>,
}

/// An algorithm.
pub(super) trait Rules {
    /// The robot becomes a candidate, or requests a new election.
    fn elect(&mut self, scene: &mut Scene<'_, '_>);
    /// The robot no longer stands.
    fn resign(&mut self, scene: &mut Scene<'_, '_>);
    /// A participant says something.
    fn receive(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, packet: Packet);
    /// A participant is believed to have failed.
    fn suspect(&mut self, scene: &mut Scene<'_, '_>, peer: RobotId);
    /// Performs the due steps, and repairs states that a corruption may have left.
    fn settle(&mut self, scene: &mut Scene<'_, '_>);
    /// When something is due next.
    fn due(&self, scene: &Scene<'_, '_>) -> Time;
    /// The leader known to this robot.
    fn leadership(&self, me: RobotId) -> Option<Leadership>;
    /// The winner's round and ballot, where there are ballots.
    fn ballot(&self) -> Option<(u64, u32)> {
        None
    }
    /// Takes up what storage holds, when the robot starts.
    fn recall(&mut self, scene: &mut Scene<'_, '_>) {
        let _ = scene;
    }
    /// Saves the state for a restart, if it has changed.
    fn save(&mut self, robot: &mut Robot<'_>, port: Port) {
        let _ = (robot, port);
    }
    /// Overwrites the state at random.
    fn corrupt(&mut self, random: &mut Random);
}

/// The environment of an algorithm at one moment.
pub(super) struct Scene<'s, 'r> {
    pub robot: &'s mut Robot<'r>,
    pub port: Port,
    pub options: &'s Options,
    /// The participants but this robot, in ascending order.
    pub others: &'s [RobotId],
    /// Whether this robot is a participant.
    pub takes_part: bool,
    /// Whether it is one and has called for an election.
    pub stands: bool,
    pub suspects: &'s BTreeSet<RobotId>,
}

impl Scene<'_, '_> {
    pub fn me(&self) -> RobotId {
        self.robot.id()
    }

    pub fn now(&self) -> Time {
        self.robot.now()
    }

    /// More than half of the participants.
    pub fn majority(&self) -> usize {
        self.others.len().div_ceil(2) + 1
    }

    /// Whether this robot may hear from a majority of the participants.
    pub fn trusts_majority(&self) -> bool {
        let trusted = self.others.iter().filter(|&&peer| !self.is_suspected(peer));
        trusted.count() + 1 >= self.majority()
    }

    pub fn is_suspected(&self, peer: RobotId) -> bool {
        self.suspects.contains(&peer)
    }

    pub fn send(&mut self, to: RobotId, packet: Packet) {
        self.robot
            .transmit(Destination::Robot(to), self.port, &packet);
    }

    /// Sends a message to all robots: those that do not participate also learn the leader.
    pub fn tell_all(&mut self, packet: Packet) {
        if self.robot.peers().next().is_some() {
            self.robot.transmit(Destination::All, self.port, &packet);
        }
    }

    /// Says something to some participants; others may hear it.
    pub fn tell(&mut self, receivers: &[RobotId], packet: Packet) {
        if 2 * receivers.len() > self.robot.peers().count() {
            self.robot.transmit(Destination::All, self.port, &packet);
        } else {
            for &peer in receivers {
                self.send(peer, packet);
            }
        }
    }
}
