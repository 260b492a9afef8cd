//! The checkers of orders and the primitive agree on simulated robots: the primitive keeps its promises under
//! every fault, and those that promise too much are found out.

use crate::engine_support::weather::{calm, chaotic, fleet, judge, lossy};
use starl_core::event::messaging;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{
    Destination, Duration, Message, Port, Primitives, Program, Robot, RobotId, Time, message,
};
use starl_primitives::Broadcast;
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;
use std::collections::BTreeMap;

/// Broadcasts now and then for a minute and a half.
#[derive(Clone, Primitives)]
struct Teller {
    broadcast: Broadcast,
    begun: Option<Time>,
}

impl Program for Teller {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let begun = *self.begun.get_or_insert(robot.now());
        let is_time = robot.now().since(begun) < Duration::from_seconds(90);
        if is_time && robot.random().chance(0.05) {
            self.broadcast.broadcast(robot, &0u8);
        }
    }
}

/// Total order without a majority: the robot with the least number of those that were heard within a second
/// says which message comes next.
#[derive(Clone, Default, Primitives)]
struct Presumptuous {
    heard: BTreeMap<RobotId, Time>,
    sent: u32,
    /// The place that is given next, or delivered next.
    place: u32,
    waiting: BTreeMap<u32, (RobotId, u32)>,
}

const NAIVE: Port = Port::named("naive");

impl Presumptuous {
    fn is_first(&self, robot: &Robot<'_>) -> bool {
        let recent = |at: &Time| robot.now().since(*at) < Duration::from_seconds(1);
        let mut heard = self.heard.iter();
        !heard.any(|(&other, at)| other < robot.id() && recent(at))
    }

    fn give_place(&mut self, robot: &mut Robot<'_>, from: RobotId, number: u32) {
        let place = self.place;
        let content = (1u8, place, from, number);
        robot.transmit(Destination::All, Port::PROGRAM, &content);
        self.waiting.insert(place, (from, number));
        self.hand_out(robot);
    }

    fn hand_out(&mut self, robot: &mut Robot<'_>) {
        while let Some((from, number)) = self.waiting.remove(&self.place) {
            self.place += 1;
            let message = numbered(number);
            let deliver = TransferEvent::Deliver { from, message };
            robot.report(NAIVE, BroadcastEvent::from(deliver));
        }
    }
}

fn numbered(number: u32) -> MessageNumber {
    let incarnation = 1;
    MessageNumber {
        number,
        incarnation,
    }
}

impl Program for Presumptuous {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.transmit(
            Destination::All,
            Port::PROGRAM,
            &(2u8, 0u32, robot.id(), 0u32),
        );
        if robot.random().chance(0.05) {
            self.sent += 1;
            let number = self.sent;
            let broadcast = BroadcastEvent::Broadcast {
                message: numbered(number),
                retry_span: Duration::ZERO,
                order: Some(messaging::Order::Total),
            };
            robot.report(NAIVE, broadcast);
            let me = robot.id();
            match self.is_first(robot) {
                true => self.give_place(robot, me, number),
                false => {
                    let content = (0u8, 0u32, me, number);
                    robot.transmit(Destination::All, Port::PROGRAM, &content);
                }
            }
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let (kind, place, from, number): (u8, u32, RobotId, u32) =
            message::decode(&message.payload).expect("our encoding");
        self.heard.insert(message.from, robot.now());
        match kind {
            0 if self.is_first(robot) => self.give_place(robot, from, number),
            1 => {
                self.waiting.insert(place, (from, number));
                self.hand_out(robot);
            }
            _ => {}
        }
    }
}

#[test]
fn the_primitive_keeps_its_promises_under_every_fault() {
    for seed in 0..6 {
        for (profile, weather) in [calm, lossy, chaotic].into_iter().enumerate() {
            for order in [Order::Fifo, Order::Causal, Order::Total] {
                let teller = Teller {
                    broadcast: Broadcast::in_order("news", order, Options::default()),
                    begun: None,
                };
                let mut scenario = fleet(5, seed);
                weather(&mut scenario);
                scenario.duration = Duration::from_seconds(150);
                let (violated, delivered) = judge(scenario, teller, "deliver");
                assert_eq!(
                    violated,
                    [] as [&str; 0],
                    "{order:?}, profile {profile}, seed {seed}"
                );
                assert!(delivered > 200, "{order:?}, profile {profile}: {delivered}");
            }
        }
    }
}

#[test]
fn a_total_order_without_a_majority_is_found_out() {
    let (violated, delivered) = judge(fleet(5, 1), Presumptuous::default(), "deliver");
    assert!(delivered > 200);
    // Without faults too it delivers what no other robot can have yet, but all deliver the same.
    assert_eq!(violated, ["broadcast.agreement"]);
    let found = (0..4).filter(|&seed| {
        let mut scenario = fleet(5, seed);
        scenario.faults.rates.partition = 0.05;
        scenario.faults.rates.heal_after = Duration::from_seconds(8);
        let (violated, _) = judge(scenario, Presumptuous::default(), "deliver");
        violated.contains(&"broadcast.total_order".to_string())
    });
    assert_eq!(found.count(), 4);
}
