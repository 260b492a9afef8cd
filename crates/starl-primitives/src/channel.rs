//! Shared code of Broadcast, Geocast and Unicast: the protocol, their trace events, their failures.

use crate::reliable::{Arrival, MessageId, Notice, Notices, Options, Reliable};
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use starl_core::event::{BroadcastEvent, PrimitiveEvent, TransferEvent, UnicastEvent};
use starl_core::{Duration, Input, Payload, Port, Robot, RobotId};

/// The latest failures are kept up to this number.
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

/// Which primitive sends and reports.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Carrier {
    Unicast,
    Broadcast,
    Geocast,
}

/// An end of the protocol that reports under the name of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    pub reliable: Reliable,
    pub port: Port,
    carrier: Carrier,
    failures: VecDeque<Failure>,
}

impl Channel {
    pub fn new(carrier: Carrier, name: &str, options: Options) -> Channel {
        let port = Port::named(name);
        let reliable = match carrier {
            Carrier::Geocast => Reliable::local(port, options),
            Carrier::Unicast | Carrier::Broadcast => Reliable::new(port, options),
        };
        Channel {
            reliable,
            port,
            carrier,
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
        let (message, notices) = self.reliable.send_to_all(robot, content);
        self.settle(robot, notices);
        message
    }

    /// Handles an input; each message that arrives is passed to `arrive`.
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

    /// Handles an input; returns the arrived messages and the notices of other robots about their messages.
    pub fn hear(&mut self, robot: &mut Robot<'_>, input: &Input) -> Vec<Notice> {
        let notices = self.reliable.handle(robot, input);
        self.settle(robot, notices)
    }

    /// How long copies of a message are sent.
    pub fn retry_span(&self) -> Duration {
        self.reliable.options().retry_span()
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
                Notice::Acknowledged(id) => {
                    let (message, to) = (id.numbered(), id.to);
                    self.report(robot, TransferEvent::Acknowledged { message, to });
                }
                Notice::Failed { message, unreached } => {
                    let fail = TransferEvent::Fail {
                        message: message.numbered(),
                        to: unreached.clone(),
                    };
                    self.report(robot, fail);
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
        let message = message.numbered();
        for &to in to {
            self.report(robot, TransferEvent::Retransmit { message, to });
        }
    }

    fn report(&self, robot: &mut Robot<'_>, event: TransferEvent) {
        let event = match self.carrier {
            Carrier::Unicast => UnicastEvent::from(event).into(),
            Carrier::Broadcast => BroadcastEvent::from(event).into(),
            Carrier::Geocast => PrimitiveEvent::Geocast(event.into()),
        };
        robot.report(self.port, event);
    }
}
