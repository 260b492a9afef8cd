//! The checkers understand what the primitives themselves report: real robots, simulated, that keep
//! their promises or are kept from it.

use crate::engine_support::{exact_delay, scenario};
use starl_core::motion::Obstacles;
use starl_core::{Area, Command, Duration, Message, Obstacle, Point, Primitives, Program, Robot};
use starl_primitives::reliable::Options;
use starl_primitives::{Broadcast, Geocast, ReachAvoid};
use starl_sim::{Run, Scenario};

/// Robot 0 broadcasts, geocasts to the left half and goes 1 m ahead; the others stay.
#[derive(Clone, Primitives)]
struct Messenger {
    broadcast: Broadcast,
    geocast: Geocast,
    motion: ReachAvoid,
    sent: bool,
    /// Drives on by hand, into what it is to avoid.
    reckless: bool,
    received: u32,
}

fn messenger(reckless: bool) -> Messenger {
    let options = Options {
        retries: 2,
        ..Options::default()
    };
    Messenger {
        broadcast: Broadcast::new("broadcast", options),
        geocast: Geocast::new("geocast", options),
        motion: ReachAvoid::default(),
        sent: false,
        reckless,
        received: 0,
    }
}

impl Program for Messenger {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.id().0 != 0 {
            return;
        }
        if !std::mem::replace(&mut self.sent, true) {
            let left = Area::Box {
                low: Point::new(-10.0, 0.0, -1.0),
                high: Point::new(10.0, 10.0, 1.0),
            };
            self.broadcast.broadcast(robot, &1u8);
            self.geocast.geocast(robot, &2u8, &left);
            let unsafe_set: Obstacles = [Obstacle::circle(Point::planar(1.0, 1.0), 0.3)].into();
            let target = Point::planar(2.0, 1.0);
            self.motion.reach_avoid(robot, target, unsafe_set);
        }
        if self.reckless {
            robot.drive(Command::Straight { speed: 0.4 });
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, _message: &Message) {
        self.received += 1;
        robot.log(starl_core::event::Level::Info, "received");
    }
}

/// Robot 1 is in the geocast's area, robot 2 is not.
fn three_robots() -> Scenario {
    let mut scenario = scenario("create", &[(0.0, 1.0), (-2.0, 3.0), (-2.0, -3.0)]);
    exact_delay(&mut scenario, 10);
    scenario.properties.broadcast_bound = Duration::from_seconds(10);
    scenario.properties.geocast_bound = Duration::from_seconds(10);
    scenario.duration = Duration::from_seconds(40);
    scenario
}

/// Runs to the end and returns the properties with their violations.
fn verdicts(scenario: Scenario, reckless: bool) -> Vec<(String, Vec<String>)> {
    let mut run =
        Run::new(scenario, &|_| Ok(Box::new(messenger(reckless)))).expect("the run starts");
    while !run.is_over() {
        run.step();
    }
    let told = |property: &str| {
        let of = run.violations().iter().filter(|v| v.property == property);
        of.map(|v| format!("{} {:?} {}", v.at, v.robots, v.text))
            .collect()
    };
    let verdicts = run.verdicts();
    verdicts
        .iter()
        .map(|verdict| (verdict.property.to_string(), told(&verdict.property)))
        .collect()
}

/// The names of the properties that are violated.
fn violated(verdicts: &[(String, Vec<String>)]) -> Vec<&str> {
    let violated = verdicts.iter().filter(|(_, told)| !told.is_empty());
    violated.map(|(property, _)| property.as_str()).collect()
}

#[test]
fn all_properties_hold_when_nothing_is_in_the_way() {
    let verdicts = verdicts(three_robots(), false);
    let properties: Vec<_> = verdicts.iter().map(|(property, _)| property).collect();
    assert_eq!(
        properties,
        [
            "no_collision",
            "reach_avoid.safety",
            "reach_avoid.goal",
            "reach_avoid.progress",
            "broadcast.delivery",
            "broadcast.integrity",
            "broadcast.fifo",
            "broadcast.causal_order",
            "broadcast.total_order",
            "broadcast.agreement",
            "geocast.exclusion",
            "geocast.inclusion",
            "geocast.integrity",
            "unicast.delivery",
            "unicast.integrity",
            "shared_memory.integrity",
            "shared_memory.order",
            "shared_memory.convergence",
            "shared_memory.causality",
            "election.uniqueness",
            "election.order",
            "election.exclusion",
            "election.soundness",
            "election.agreement",
            "election.progress",
            "register.linearizability",
            "mutex.safety",
            "mutex.fencing",
            "mutex.non_interference",
            "mutex.progress",
            "registration.agreement",
            "registration.exclusion",
            "registration.soundness",
            "registration.progress",
            "registration.convergence",
            "barrier.safety",
            "barrier.progress",
            "failure_detector.completeness",
            "failure_detector.accuracy",
        ]
    );
    assert_eq!(violated(&verdicts), [""; 0], "{verdicts:#?}");
}

#[test]
fn a_network_that_loses_everything_breaks_delivery_and_inclusion() {
    let mut scenario = three_robots();
    scenario.network.link.loss = 1.0;
    let verdicts = verdicts(scenario, false);
    assert_eq!(
        violated(&verdicts),
        ["broadcast.delivery", "geocast.inclusion"],
        "{verdicts:#?}"
    );
    let told = |property: &str| {
        let found = verdicts.iter().find(|(name, _)| name == property);
        found.map(|(_, told)| told.join("\n")).unwrap_or_default()
    };
    assert!(told("broadcast.delivery").contains("did not reach robots 1 and 2 before its sender"));
    assert!(told("geocast.inclusion").contains("did not reach robot 1 within 10s"));
}

#[test]
fn a_robot_steered_by_hand_breaks_safety() {
    let verdicts = verdicts(three_robots(), true);
    assert_eq!(violated(&verdicts), ["reach_avoid.safety"], "{verdicts:#?}");
}

#[test]
fn a_bound_shorter_than_the_way_breaks_progress() {
    let mut scenario = three_robots();
    scenario.properties.progress_bound = Duration::from_seconds(1);
    let verdicts = verdicts(scenario, false);
    assert_eq!(
        violated(&verdicts),
        ["reach_avoid.progress"],
        "{verdicts:#?}"
    );
}

#[test]
fn only_enabled_properties_are_checked() {
    let mut scenario = three_robots();
    scenario.network.link.loss = 1.0;
    scenario.properties.broadcast = false;
    scenario.properties.geocast = false;
    scenario.properties.unicast = false;
    scenario.properties.shared_memory = false;
    scenario.properties.election = false;
    scenario.properties.register = false;
    scenario.properties.mutex = false;
    scenario.properties.registration = false;
    scenario.properties.barrier = false;
    scenario.properties.failure_detector = false;
    scenario.properties.no_collision = false;
    scenario.properties.reach_avoid = false;
    assert_eq!(verdicts(scenario, true), []);
}
