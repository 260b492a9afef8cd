//! What Broadcast, Geocast and Unicast share: the protocol, their trace events, their failures.

use crate::reliable::{Arrival, MessageId, Notice, Notices, Options, Reliable};
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use starl_core::{Input, Payload, Port, Robot, RobotId};

/// Failures that nobody asks for are kept up to this number, the latest.
const MOST_FAILURES: usize = 64;

/// A message that some receivers did not acknowledge in time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Which message.
    pub message: MessageId,
    /// The receivers that were not heard of. They may have taken it, if only their acknowledgements
    /// were lost.
    pub unreached: Vec<RobotId>,
}

/// An end of the protocol that reports under the name of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    pub reliable: Reliable,
    pub port: Port,
    pub primitive: &'static str,
    failures: VecDeque<Failure>,
}

impl Channel {
    pub fn new(primitive: &'static str, name: &str, options: Options) -> Channel {
        let port = Port::named(name);
        let reliable = Reliable::new(port, options);
        Channel {
            reliable,
            port,
            primitive,
            failures: VecDeque::new(),
        }
    }

    /// Sends to one robot.
    pub fn send(&mut self, robot: &mut Robot<'_>, to: RobotId, content: Payload) -> MessageId {
        let (message, notices) = self.reliable.send(robot, to, content);
        self.settle(robot, notices);
        message
    }

    /// Sends to all other robots of the application.
    pub fn send_to_peers(&mut self, robot: &mut Robot<'_>, content: Payload) -> MessageId {
        let (message, notices) = self.reliable.send_to_all(robot, robot.peers(), content);
        self.settle(robot, notices);
        message
    }

    /// Takes an input; each message that arrives is handed to `arrive`.
    pub fn handle(
        &mut self,
        robot: &mut Robot<'_>,
        input: &Input,
        mut arrive: impl FnMut(&mut Robot<'_>, Arrival),
    ) {
        for notice in self.hear(robot, input) {
            if let Notice::Arrived(arrival) = notice {
                arrive(robot, arrival);
            }
        }
    }

    /// Takes an input; gives what arrived and what other robots said of their messages.
    pub fn hear(&mut self, robot: &mut Robot<'_>, input: &Input) -> Vec<Notice> {
        let notices = self.reliable.handle(robot, input);
        self.settle(robot, notices)
    }

    /// How long copies of a message are sent, in seconds, for trace events.
    pub fn retry_span(&self) -> f64 {
        self.reliable.options().retry_span().seconds()
    }

    /// The failures since the last call.
    pub fn take_failures(&mut self) -> Vec<Failure> {
        core::mem::take(&mut self.failures).into()
    }

    /// Reports what became of this robot's messages and returns what others said.
    fn settle(&mut self, robot: &mut Robot<'_>, notices: Notices) -> Vec<Notice> {
        let mut heard = Vec::new();
        for notice in notices {
            match notice {
                Notice::Arrived(_) | Notice::Settled { .. } => heard.push(notice),
                Notice::Repeated { message, to } => self.report_repeated(robot, message, &to),
                Notice::Acknowledged(message) => self.report_acknowledged(robot, message),
                Notice::Failed { message, unreached } => {
                    self.report_failed(robot, message, &unreached);
                    if self.failures.len() == MOST_FAILURES {
                        self.failures.pop_front();
                    }
                    self.failures.push_back(Failure { message, unreached });
                }
            }
        }
        heard
    }

    fn report_repeated(&self, robot: &mut Robot<'_>, message: MessageId, to: &[RobotId]) {
        for &peer in to {
            robot.emit_primitive(
                self.primitive,
                self.port,
                "retransmit",
                [
                    ("number", message.number.into()),
                    ("incarnation", message.incarnation.into()),
                    ("to", peer.into()),
                ],
            );
        }
    }

    fn report_acknowledged(&self, robot: &mut Robot<'_>, message: MessageId) {
        let MessageId {
            incarnation,
            to,
            number,
        } = message;
        let (number, incarnation) = (
            ("number", number.into()),
            ("incarnation", incarnation.into()),
        );
        match to {
            None => robot.emit_primitive(
                self.primitive,
                self.port,
                "acknowledged",
                [number, incarnation],
            ),
            Some(to) => robot.emit_primitive(
                self.primitive,
                self.port,
                "acknowledged",
                [number, incarnation, ("to", to.into())],
            ),
        }
    }

    fn report_failed(&self, robot: &mut Robot<'_>, message: MessageId, unreached: &[RobotId]) {
        robot.emit_primitive(
            self.primitive,
            self.port,
            "fail",
            [
                ("number", message.number.into()),
                ("incarnation", message.incarnation.into()),
                ("to", unreached.to_vec().into()),
            ],
        );
    }
}

/// Reports what became of a message at its receiver.
pub(crate) fn report_arrival(
    robot: &mut Robot<'_>,
    primitive: &'static str,
    port: Port,
    name: &'static str,
    arrival: &Arrival,
) {
    robot.emit_primitive(
        primitive,
        port,
        name,
        [
            ("from", arrival.from.into()),
            ("number", arrival.number.into()),
            ("incarnation", arrival.incarnation.into()),
        ],
    );
}
