//! Mutual exclusion by Ricart and Agrawala (1981), without the tie-break: of two requests with the same
//! time neither goes before the other, so both robots permit the other's.

use serde::{Deserialize, Serialize};
use starl_core::event::MutexEvent;
use starl_core::{Destination, Message, Port, Primitives, Program, Robot, RobotId};
use std::collections::BTreeSet;
use std::sync::Arc;

const PORT: Port = Port::PROGRAM;
/// Activations for which the resource is held.
const HOLDS: u32 = 3;

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Packet {
    Request { clock: u64 },
    Permit { clock: u64 },
}

/// A robot that wants the door now and then.
#[derive(Clone, Debug, Default, Primitives)]
pub struct Locker {
    /// Lamport's clock.
    clock: u64,
    /// The time of the pending request, and the robots that have permitted it.
    wants: Option<(u64, BTreeSet<RobotId>)>,
    /// Activations for which it still holds the door.
    holds: u32,
    deferred: Vec<(RobotId, u64)>,
    /// Whether the robots' numbers order equal times, as they should.
    breaks_ties: bool,
}

fn door() -> Arc<str> {
    "door".into()
}

impl Locker {
    /// One without the mistake.
    pub fn without_mistake() -> Locker {
        Locker {
            breaks_ties: true,
            ..Locker::default()
        }
    }

    fn enter_if_permitted(&mut self, robot: &mut Robot<'_>) {
        let others = robot.fleet().len() - 1;
        if self
            .wants
            .as_ref()
            .is_some_and(|(_, permits)| permits.len() == others)
        {
            self.wants = None;
            self.holds = HOLDS;
            let enter = MutexEvent::Enter {
                resource: door(),
                fencing: None,
                drift: None,
            };
            robot.report(PORT, enter);
        }
    }

    fn permit(robot: &mut Robot<'_>, to: RobotId, clock: u64) {
        robot.transmit(Destination::Robot(to), PORT, &Packet::Permit { clock });
    }

    fn comes_first(&self, me: RobotId, other: RobotId, clock: u64) -> bool {
        let before = |own: u64| match self.breaks_ties {
            true => (own, me) < (clock, other),
            // The mistake.
            false => own < clock,
        };
        self.holds > 0 || self.wants.as_ref().is_some_and(|(own, _)| before(*own))
    }
}

impl Program for Locker {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if self.holds > 0 {
            self.holds -= 1;
            if self.holds == 0 {
                robot.report(PORT, MutexEvent::Release { resource: door() });
                for (peer, clock) in std::mem::take(&mut self.deferred) {
                    Locker::permit(robot, peer, clock);
                }
            }
        } else if self.wants.is_none() && robot.random().chance(0.02) {
            self.clock += 1;
            let clock = self.clock;
            self.wants = Some((clock, BTreeSet::new()));
            robot.report(PORT, MutexEvent::Acquire { resource: door() });
            robot.transmit(Destination::All, PORT, &Packet::Request { clock });
            self.enter_if_permitted(robot);
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        match message.read::<Packet>() {
            Some(Packet::Request { clock }) => {
                self.clock = self.clock.max(clock);
                match self.comes_first(robot.id(), from, clock) {
                    true => self.deferred.push((from, clock)),
                    false => Locker::permit(robot, from, clock),
                }
            }
            Some(Packet::Permit { clock }) => {
                if let Some((wanted, permits)) = &mut self.wants
                    && *wanted == clock
                {
                    permits.insert(from);
                    self.enter_if_permitted(robot);
                }
            }
            None => {}
        }
    }
}
