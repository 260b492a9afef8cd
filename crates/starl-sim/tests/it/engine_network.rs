//! The network does to datagrams what the scenario says, and says so in the trace.

use crate::engine_support::{self, Chatter, count, exact_delay, run, scenario, simulate};
use starl_core::event::DropReason;
use starl_core::{Duration, Event, Record, RobotId, Time};
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

/// Delays of all deliveries, in seconds, in the order of sending.
fn delays(records: &[Record]) -> Vec<f64> {
    let sent: Vec<Time> = records
        .iter()
        .filter(|record| matches!(record.event, Event::Sent { .. }))
        .map(|record| record.at)
        .collect();
    let delivered = records.iter().filter_map(|record| match record.event {
        Event::Delivered { sequence, .. } => Some((sequence, record.at)),
        _ => None,
    });
    delivered
        .map(|(sequence, at)| at.since(sent[sequence as usize]).seconds())
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
fn a_delay_shorter_than_a_step_lasts_until_the_next_step() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    exact_delay(&mut scenario, 0);
    let step = scenario.physics.step.seconds();
    let records = run(&mut simulate(scenario, Chatter::default()), 1.0);
    assert!(delays(&records).iter().all(|&delay| delay == step));
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
fn radio_reaches_as_far_as_its_range() {
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
