//! Election by the bully algorithm (Garcia-Molina 1982) with time-outs for a failure detector, and without
//! epochs: whoever hears nothing of a greater robot for a while leads. A partition has one leader in each
//! part.

use starl_core::{Destination, Duration, Message, Port, Program, Robot, RobotId, Time};

const PORT: Port = Port::PROGRAM;
/// Who has not been heard for so long is taken for dead.
const PATIENCE: Duration = Duration::from_millis(1000);

/// A robot that leads, or follows a greater one.
#[derive(Clone, Debug, Default)]
pub struct Bully {
    /// When each greater robot was last heard.
    heard: Vec<(RobotId, Time)>,
    shown: Option<RobotId>,
    since: Time,
}

const KIND: &str = "election";

impl Program for Bully {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let participants = robot.fleet().to_vec();
        self.since = robot.now();
        // It promises what elections with leases do: one leader at a time.
        let fields = [
            ("algorithm", "leases".into()),
            ("participants", participants.into()),
        ];
        robot.emit_primitive(KIND, PORT, "start", fields);
        robot.emit_primitive(KIND, PORT, "elect", []);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.transmit(Destination::All, PORT, &());
        let now = robot.now();
        self.heard.retain(|(_, at)| now.since(*at) < PATIENCE);
        let greatest = self.heard.iter().map(|(peer, _)| *peer).max();
        let leader = match greatest {
            Some(greatest) => Some(greatest),
            None if now.since(self.since) < PATIENCE => None,
            None => Some(robot.id()),
        };
        if leader != self.shown {
            self.shown = leader;
            match leader {
                Some(leader) => {
                    robot.emit_primitive(KIND, PORT, "leader", [("leader", leader.into())]);
                }
                None => robot.emit_primitive(KIND, PORT, "lost", []),
            }
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        if message.from > robot.id() {
            self.heard.retain(|(peer, _)| *peer != message.from);
            self.heard.push((message.from, robot.now()));
        }
    }
}
