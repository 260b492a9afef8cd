//! Election by the bully algorithm (Garcia-Molina 1982) with timeouts as a failure detector, and without
//! epochs: a robot that hears nothing of a greater robot for a while leads. A partition has one leader in
//! each part.

use starl_core::event::ElectionEvent;
use starl_core::event::agreement::Algorithm;
use starl_core::{Destination, Duration, Message, Port, Primitives, Program, Robot, RobotId, Time};

const PORT: Port = Port::PROGRAM;
/// A robot that has not been heard for this time counts as dead.
const PATIENCE: Duration = Duration::from_millis(1000);

/// A robot that leads, or follows a greater one.
#[derive(Clone, Debug, Default, Primitives)]
pub struct Bully {
    /// When each greater robot was last heard.
    heard: Vec<(RobotId, Time)>,
    shown: Option<RobotId>,
    since: Time,
}

impl Program for Bully {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let participants = robot.fleet().to_vec();
        self.since = robot.now();
        // It promises what elections with leases do: one leader at a time.
        let algorithm = Algorithm::Leases;
        let start = ElectionEvent::Start {
            algorithm,
            participants,
        };
        robot.report(PORT, start);
        robot.report(PORT, ElectionEvent::Elect);
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
                    let epoch = None;
                    robot.report(
                        PORT,
                        ElectionEvent::Leader {
                            leader,
                            epoch,
                            round: None,
                            ballot: None,
                        },
                    );
                }
                None => robot.report(PORT, ElectionEvent::Lost),
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
