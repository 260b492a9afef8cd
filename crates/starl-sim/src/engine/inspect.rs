//! Looks into a running simulation without changing it.

use super::Simulation;
use super::act::snapshot;
use super::shard::SIZE;
use starl_core::{Obstacle, Port, Program, Robot, RobotId, Time, View};
use starl_motion::sensing::Readings;

/// A datagram on its way to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mail {
    /// When it arrives.
    pub at: Time,
    /// Its sender.
    pub from: RobotId,
    /// The sender's number for it.
    pub sequence: u32,
    /// The endpoint that it is for.
    pub port: Port,
    /// The length of its payload, bytes.
    pub bytes: usize,
}

/// An obstacle that stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing<'a> {
    /// Its index in the world.
    pub index: u32,
    /// Its shape and place.
    pub obstacle: &'a Obstacle,
    /// Robots do not know it until they meet it.
    pub is_hidden: bool,
}

impl Simulation {
    /// The datagrams on their way to a robot, in the order in which they will arrive. Some of them may be lost
    /// yet, because the robot is down when they arrive. Takes time in proportion to all datagrams under way.
    pub fn mail(&self, robot: RobotId) -> Vec<Mail> {
        let mail = self.calendar.mail(robot).into_iter();
        mail.map(|(at, content)| Mail {
            at,
            from: content.from,
            sequence: content.sequence,
            port: content.port,
            bytes: content.payload.len(),
        })
        .collect()
    }

    /// The payload of a datagram that arrived in the last step; none if no datagram with this number did.
    pub fn arrived(&self, from: RobotId, sequence: u32) -> Option<&[u8]> {
        let content = self.shared.inboxes.find(from, sequence)?;
        Some(&content.payload)
    }

    /// The obstacles that stand, the walls around the world included, by index.
    pub fn standing_obstacles(&self) -> impl Iterator<Item = Standing<'_>> {
        let shared = &self.shared;
        let obstacles = (0..).zip(shared.standing.iter().zip(shared.map.obstacles()));
        obstacles.map(|(place, (&index, obstacle))| Standing {
            index,
            obstacle,
            is_hidden: shared.hidden.binary_search(&place).is_ok(),
        })
    }

    /// Whether a robot's motors are stuck.
    pub fn has_stuck_motors(&self, robot: RobotId) -> bool {
        self.member(robot).motor_stuck
    }

    /// Whether a robot's sensors and positioning repeat their last readings.
    pub fn has_frozen_sensors(&self, robot: RobotId) -> bool {
        self.member(robot).senses.are_frozen
    }

    /// The index of the thing that a robot holds.
    pub fn holding(&self, robot: RobotId) -> Option<u32> {
        self.member(robot).senses.holding
    }

    /// Lets an observer query a robot's program with a handle to the robot in its current state, without
    /// effects: see [`starl_core::Agent::rehearse`]. Sensors are read for it.
    pub fn rehearse<T>(
        &self,
        robot: RobotId,
        run: impl FnOnce(&dyn Program, &mut Robot<'_>) -> T,
    ) -> T {
        let shared = &self.shared;
        let member = self.member(robot);
        let (node, senses) = (&member.node, &member.senses);
        let kind = &shared.kinds[member.group as usize];
        let mut readings = Readings::default();
        if let Some(frozen) = &senses.frozen {
            readings.proximity.clone_from(&frozen.proximity);
            readings.detections.clone_from(&frozen.detections);
        } else if kind.sensors.proximity.is_some() || kind.sensors.detector.is_some() {
            // The index over robots is that of the step's start, before they moved.
            let mut shared = shared.clone();
            shared.grid.rebuild(&shared.bodies, &shared.gone);
            let pose = &self.shards[robot.index() / SIZE].states[robot.index() % SIZE].pose;
            let (scene, things) = (shared.scene(), shared.things.lying());
            readings.read(&kind.sensors, &scene, things, robot, pose.yaw);
        }
        let snapshot = snapshot(shared, kind, senses, Some(&readings));
        let view = View {
            id: robot,
            now: node.clock().read(self.now),
            estimate: *node.estimate(),
            body: snapshot.hardware.body,
            sensors: snapshot.sensors,
            fleet: snapshot.fleet,
            way_points: snapshot.way_points,
            obstacles: snapshot.obstacles,
        };
        node.agent().rehearse(&view, run)
    }
}
