//! The checkers of orders and the primitive agree on simulated robots: the primitive keeps its promises under
//! every fault, and those that promise too much are found out.

mod engine_support;

use engine_support::scenario;
use starl_core::{
    Destination, Duration, Event, Message, Port, Primitive, Program, Record, Robot, RobotId, Time,
    message,
};
use starl_primitives::Broadcast;
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;
use starl_sim::{Run, Scenario};
use std::collections::BTreeMap;

/// Five robots within reach of each other for two and a half minutes.
fn calm(seed: u64) -> Scenario {
    let places: Vec<_> = (0..5).map(|robot| (f64::from(robot), 0.0)).collect();
    let mut scenario = scenario("create", &places);
    scenario.seed = seed;
    scenario.duration = Duration::from_seconds(150);
    scenario.properties.no_collision = false;
    scenario
}

fn lossy(seed: u64) -> Scenario {
    let mut scenario = calm(seed);
    scenario.network.link.loss = 0.3;
    scenario.network.link.duplication = 0.2;
    scenario.network.link.reordering = 0.2;
    scenario
}

fn partitions(seed: u64) -> Scenario {
    let mut scenario = lossy(seed);
    scenario.faults.rates.partition = 0.05;
    scenario.faults.rates.heal_after = Duration::from_seconds(8);
    scenario
}

fn chaos(seed: u64) -> Scenario {
    let mut scenario = partitions(seed);
    scenario.faults.rates.crash = 0.01;
    scenario.faults.rates.restart_after = Duration::from_seconds(4);
    scenario
}

/// Broadcasts now and then for a minute and a half.
#[derive(Clone)]
struct Teller(Broadcast);

impl Program for Teller {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let is_time = robot.now() < Time::ZERO + Duration::from_seconds(90);
        if is_time && robot.random().chance(0.05) {
            self.0.broadcast(robot, &0u8);
        }
    }

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.0);
    }
}

/// Total order without a majority: the robot with the least number of those that were heard within a second
/// says which message comes next.
#[derive(Clone, Default)]
struct Presumptuous {
    heard: BTreeMap<RobotId, Time>,
    sent: u32,
    /// The place that is given next, or handed out next.
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
            let fields = [
                ("from", from.into()),
                ("number", number.into()),
                ("incarnation", 1u32.into()),
            ];
            robot.emit_primitive("broadcast", NAIVE, "deliver", fields);
        }
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
            let fields = [
                ("number", number.into()),
                ("incarnation", 1u32.into()),
                ("order", "total".into()),
            ];
            robot.emit_primitive("broadcast", NAIVE, "broadcast", fields);
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

/// The properties that are violated, and how many messages were handed out.
fn judge(scenario: Scenario, program: impl Program + Clone + 'static) -> (Vec<String>, usize) {
    let mut run = Run::new(scenario, &|_| Ok(Box::new(program.clone()))).expect("the run starts");
    let mut delivered = 0;
    while !run.is_over() {
        let is_delivery = |record: &&Record| matches!(&record.event, Event::Primitive { name, .. } if name == "deliver");
        delivered += run.step().iter().filter(is_delivery).count();
    }
    for violation in run.violations() {
        println!(
            "{} {}: {}",
            violation.at, violation.property, violation.text
        );
    }
    let verdicts = run.verdicts();
    let violated = verdicts
        .into_iter()
        .filter(|verdict| verdict.violations > 0);
    let violated = violated.map(|verdict| verdict.property.to_string());
    (violated.collect(), delivered)
}

#[test]
fn the_primitive_keeps_its_promises_under_every_fault() {
    for seed in 0..6 {
        for (profile, make) in [calm, lossy, partitions, chaos].into_iter().enumerate() {
            for order in [Order::Fifo, Order::Causal, Order::Total] {
                let broadcast = Broadcast::in_order("news", order, Options::default());
                let (violated, delivered) = judge(make(seed), Teller(broadcast));
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
    let (violated, delivered) = judge(calm(1), Presumptuous::default());
    assert!(delivered > 200);
    assert_eq!(violated, [] as [&str; 0], "without faults it does well");
    let found = (0..4).filter(|&seed| {
        let mut scenario = calm(seed);
        scenario.faults.rates.partition = 0.05;
        scenario.faults.rates.heal_after = Duration::from_seconds(8);
        let (violated, _) = judge(scenario, Presumptuous::default());
        violated.contains(&"broadcast.total_order".to_string())
    });
    assert_eq!(found.count(), 4);
}
