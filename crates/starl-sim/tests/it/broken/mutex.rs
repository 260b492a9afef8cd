//! Mutual exclusion by Ricart and Agrawala (1981), without the tie-break: of two requests with the same
//! time neither goes before the other, so both robots permit the other's.

use serde::{Deserialize, Serialize};
use starl_core::{Destination, Message, Port, Program, Robot, RobotId, Value};
use std::collections::BTreeSet;

const PORT: Port = Port::PROGRAM;
/// Activations for which the resource is held.
const HOLDS: u32 = 3;

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Packet {
    Request { clock: u64 },
    Permit { clock: u64 },
}

/// A robot that wants the door now and then.
#[derive(Clone, Debug, Default)]
pub struct Locker {
    /// Lamport's clock.
    clock: u64,
    /// The time of the request under way, and who has permitted it.
    wants: Option<(u64, BTreeSet<RobotId>)>,
    /// Activations for which it still holds the door.
    holds: u32,
    deferred: Vec<(RobotId, u64)>,
    /// Whether equal times are told apart by the robots' numbers, as they should be.
    breaks_ties: bool,
}

fn report(robot: &mut Robot<'_>, event: &'static str) {
    let door = Value::Text("door".into());
    robot.emit_primitive("mutex", PORT, event, [("resource", door)]);
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
            report(robot, "enter");
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
                report(robot, "release");
                for (peer, clock) in std::mem::take(&mut self.deferred) {
                    Locker::permit(robot, peer, clock);
                }
            }
        } else if self.wants.is_none() && robot.random().chance(0.02) {
            self.clock += 1;
            let clock = self.clock;
            self.wants = Some((clock, BTreeSet::new()));
            report(robot, "acquire");
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
