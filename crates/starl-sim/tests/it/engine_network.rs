//! The network does to datagrams what the scenario says, and says so in the trace.

use crate::engine_support::{self, Chatter, count, exact_delay, run, scenario, simulate};
use starl_core::event::DropReason;
use starl_core::{
    Destination, Duration, Event, Message, Payload, Port, Primitives, Program, Record, Robot,
    RobotId, Time,
};
use starl_sim::scenario::{DelayDistribution, Link, LinkOverride};

fn heard(event: &Event) -> bool {
    matches!(event, Event::Program { name, .. } if name == "heard")
}

fn dropped(records: &[Record], why: DropReason) -> usize {
    count(
        records,
        |event| matches!(event, Event::Dropped { reason, .. } if *reason == why),
    )
}

/// When each datagram was sent and delivered, in the order of delivery.
fn travels(records: &[Record]) -> Vec<(Time, Time)> {
    let mut sent = std::collections::BTreeMap::new();
    let mut travels = Vec::new();
    for record in records {
        match record.event {
            Event::Sent { sequence, .. } => {
                sent.insert((record.robot, sequence), record.at);
            }
            Event::Delivered { from, sequence } => {
                travels.push((sent[&(Some(from), sequence)], record.at));
            }
            _ => {}
        }
    }
    travels
}

/// Delays of all deliveries, in seconds, in the order of delivery.
fn delays(records: &[Record]) -> Vec<f64> {
    let travels = travels(records).into_iter();
    travels
        .map(|(sent, delivered)| delivered.since(sent).seconds())
        .collect()
}

#[test]
fn everyone_else_hears_a_broadcast_after_the_delay() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
    exact_delay(&mut scenario, 30);
    let records = run(&mut simulate(scenario, Chatter::default()), 1.0);
    // Ten activations, including the last one's message; no robot hears itself.
    assert_eq!(count(&records, heard), 20);
    assert!(
        delays(&records)
            .iter()
            .all(|&delay| (delay - 0.030).abs() < 1e-12)
    );
}

#[test]
fn delays_have_the_mean_and_deviation_they_should() {
    for (distribution, tolerance) in [
        (DelayDistribution::Uniform, 0.003),
        (DelayDistribution::Normal, 0.003),
        (DelayDistribution::Exponential, 0.004),
    ] {
        let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
        scenario.fleet.groups[0].control_period = Duration::from_millis(25);
        scenario.network.link = Link {
            delay: Duration::from_millis(200),
            jitter: Duration::from_millis(40),
            distribution,
            ..Link::default()
        };
        let records = run(&mut simulate(scenario, Chatter::default()), 60.0);
        let delays = delays(&records);
        let mean = delays.iter().sum::<f64>() / delays.len() as f64;
        let spread = delays.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>();
        let deviation = (spread / delays.len() as f64).sqrt();
        assert!(
            (mean - 0.2).abs() < tolerance,
            "{distribution:?}: mean {mean}"
        );
        assert!(
            (deviation - 0.04).abs() < tolerance,
            "{distribution:?}: deviation {deviation}"
        );
    }
}

#[test]
fn loss_and_duplication_happen_as_often_as_they_should() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    scenario.fleet.groups[0].control_period = Duration::from_millis(25);
    scenario.network.link.loss = 0.25;
    scenario.network.link.duplication = 0.1;
    let records = run(&mut simulate(scenario, Chatter::default()), 60.0);
    let sent = count(&records, |event| matches!(event, Event::Sent { .. })) as f64;
    let lost = dropped(&records, DropReason::Loss) as f64;
    assert!((lost / sent - 0.25).abs() < 0.03, "{lost} of {sent} lost");
    let heard = count(&records, heard) as f64;
    assert!(
        (heard / (sent - lost) - 1.1).abs() < 0.03,
        "{heard} of {} heard",
        sent - lost
    );
}

#[test]
fn held_back_datagrams_are_overtaken() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    exact_delay(&mut scenario, 10);
    scenario.network.link.reordering = 0.2;
    scenario.network.link.reordering_delay = Duration::from_millis(250);
    let records = run(&mut simulate(scenario, Chatter::default()), 20.0);
    let order: Vec<u32> = records
        .iter()
        .filter_map(|record| match record.event {
            Event::Delivered { sequence, .. } => Some(sequence),
            _ => None,
        })
        .collect();
    assert!(!order.is_sorted());
}

#[test]
fn radio_reaches_robots_within_its_range() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.9, 0.0), (2.1, 0.0)]);
    scenario.network.range = Some(2.0);
    let records = run(&mut simulate(scenario, Chatter::default()), 2.0);
    let hearers = records.iter().filter(|record| heard(&record.event));
    assert!(
        hearers
            .map(|record| record.robot)
            .all(|robot| robot == Some(RobotId(1)))
    );
}

#[test]
fn bodies_and_obstacles_block_a_radio_that_needs_line_of_sight() {
    let places = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 2.0)];
    let mut scenario = scenario("create", &places);
    scenario.network.line_of_sight = true;
    let wall = [
        starl_core::Point::planar(-1.0, 1.0),
        starl_core::Point::planar(1.0, 1.0),
    ];
    let wall = starl_core::ConvexPolygon::new(&wall).unwrap();
    scenario
        .world
        .obstacles
        .push(engine_support::obstacle(starl_core::Obstacle::polygon(
            wall,
        )));
    let records = run(&mut simulate(scenario, Chatter::default()), 2.0);
    let hearers: Vec<_> = records
        .iter()
        .filter(|record| heard(&record.event))
        .map(|record| record.robot)
        .collect();
    // Robot 2 is behind robot 1, robot 3 behind the wall.
    assert!(!hearers.is_empty() && hearers.iter().all(|&robot| robot == Some(RobotId(1))));
}

#[test]
fn an_override_holds_for_its_links_alone() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
    let dead = Link {
        loss: 1.0,
        ..Link::default()
    };
    let to = Some(vec![RobotId(2)]);
    scenario.network.overrides.push(LinkOverride {
        from: None,
        to,
        link: dead,
    });
    let records = run(&mut simulate(scenario, Chatter::default()), 2.0);
    let hearers = records.iter().filter(|record| heard(&record.event));
    assert!(
        hearers
            .map(|record| record.robot)
            .all(|robot| robot == Some(RobotId(1)))
    );
    assert_eq!(dropped(&records, DropReason::Loss), 20);
}

#[test]
fn a_slow_radio_queues_and_then_drops() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    exact_delay(&mut scenario, 0);
    // A datagram of 4 bytes and its header of 64 takes 200 ms; there is one every 100 ms.
    scenario.network.bandwidth = Some(68.0 * 8.0 / 0.2);
    scenario.network.queue = Duration::from_millis(500);
    let records = run(&mut simulate(scenario, Chatter::default()), 20.0);
    let heard = count(&records, heard);
    assert!((95..=100).contains(&heard), "{heard} heard");
    assert!(dropped(&records, DropReason::Bandwidth) > 80);
    assert!(
        delays(&records)
            .iter()
            .all(|&delay| delay <= 0.5 + 0.2 + 0.025 + 1e-9)
    );
}

#[test]
fn a_datagram_that_is_too_large_is_dropped_and_reported() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    scenario.network.largest = 3;
    let records = run(&mut simulate(scenario, Chatter::default()), 1.0);
    assert_eq!(dropped(&records, DropReason::Size), 10);
    assert_eq!(count(&records, heard), 0);
}

#[test]
fn delays_shorter_than_a_physics_step_are_exact() {
    for delay in [1, 3, 15, 24, 25, 40] {
        let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
        exact_delay(&mut scenario, delay);
        let mut simulation = simulate(scenario, Chatter::default());
        let travels = travels(&run(&mut simulation, 5.0));
        assert!(travels.len() > 40);
        for (sent, delivered) in travels {
            assert_eq!(delivered.since(sent), Duration::from_millis(delay));
        }
    }
}

#[test]
fn a_datagram_takes_at_least_until_the_next_slot() {
    for (delay, resolution, least) in [(0, 1, 1), (0, 5, 5), (2, 5, 5), (7, 5, 7)] {
        let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
        exact_delay(&mut scenario, delay);
        scenario.network.resolution = Duration::from_millis(resolution);
        let mut simulation = simulate(scenario, Chatter::default());
        for (sent, delivered) in travels(&run(&mut simulation, 5.0)) {
            // Chatter sends at whole periods, where slots begin.
            assert_eq!(delivered.since(sent), Duration::from_millis(least));
        }
    }
}

/// Robot 0 begins; everybody sends back what it hears.
#[derive(Clone, Default, Primitives)]
struct Rally {
    has_begun: bool,
}

impl Program for Rally {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.id().0 == 0 && !std::mem::replace(&mut self.has_begun, true) {
            self.receive_from(robot, RobotId(1));
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        self.receive_from(robot, message.from);
    }
}

impl Rally {
    fn receive_from(&mut self, robot: &mut Robot<'_>, other: RobotId) {
        let ball = Payload::from_slice(&[7]);
        robot.transmit_bytes(Destination::Robot(other), Port::PROGRAM, ball);
    }
}

#[test]
fn answers_travel_within_one_physics_step() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    exact_delay(&mut scenario, 2);
    scenario.physics.step = Duration::from_millis(100);
    let mut simulation = simulate(scenario, Rally::default());
    let travels = travels(&run(&mut simulation, 1.0));
    assert_eq!(travels.len(), 499, "one arrival every 2 ms");
    for (index, (_, delivered)) in travels.iter().enumerate() {
        assert_eq!(delivered.0, 2_000_000 * (index as u64 + 1));
    }
}

#[test]
fn the_physics_step_does_not_change_when_datagrams_arrive() {
    let arrivals = |step: u64| {
        let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
        scenario.physics.step = Duration::from_millis(step);
        let mut simulation = simulate(scenario, Chatter::default());
        travels(&run(&mut simulation, 5.0))
    };
    let fine = arrivals(1);
    assert_eq!(fine, arrivals(5));
    assert_eq!(fine, arrivals(25));
    assert_eq!(fine, arrivals(50));
}
