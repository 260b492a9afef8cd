//! In causal order a message is delivered after all its predecessors, under all faults; messages that will not arrive
//! are passed over, and this is recorded.

use crate::harness::teller::{
    Teller, causal_violation, is_fifo, runs, sequences, tell, teller, trouble,
};
use crate::harness::{Wire, World, int};
use starl_core::Duration;
use starl_core::RobotId;
use starl_primitives::broadcast::{Gap, Order};

const PERIOD: Duration = Duration::from_millis(100);

fn world(robots: usize, seed: u64, wire: Wire, count: u32) -> World {
    let make = Teller::boxed(Order::Causal, count, 0.1);
    World::new(robots, seed, wire, Some(PERIOD), make)
}

#[test]
fn all_deliver_all_messages_after_their_predecessors() {
    for seed in 0..60 {
        for wire in [Wire::perfect(), Wire::bad()] {
            for robots in [2, 3, 5] {
                let mut world = world(robots, seed, wire.clone(), 10);
                world.run_for(Duration::from_seconds(60));
                let runs = runs(&world, &[]);
                assert_eq!(causal_violation(&runs), None, "seed {seed}");
                for (robot, sequence) in sequences(&runs, seed) {
                    assert_eq!(sequence.len(), 10 * (robots - 1), "seed {seed}: {robot}");
                    assert!(is_fifo(&sequence), "seed {seed}: {robot}");
                }
                assert!(world.events("pass_over").is_empty(), "seed {seed}");
            }
        }
    }
}

#[test]
fn the_order_is_kept_under_crashes_and_partitions() {
    let mut passed_over = 0;
    for seed in 0..200 {
        let wire = if seed % 2 == 0 {
            Wire::perfect()
        } else {
            Wire::bad()
        };
        let robots = 3 + seed as usize % 3;
        let mut world = world(robots, seed, wire, 40);
        let starts = trouble(&mut world, robots, seed, Duration::from_seconds(40));
        world.run_for(Duration::from_seconds(60));
        let all = runs(&world, &starts);
        sequences(&all, seed);
        assert_eq!(causal_violation(&all), None, "seed {seed}");
        passed_over += world.events("pass_over").len();
        // It continues when all are well.
        for robot in 0..robots {
            world.command(robot, tell(1007));
        }
        world.run_for(Duration::from_seconds(20));
        let got = world.events("got");
        let handed = got.iter().filter(|got| int(&got.2["value"]) == 1007);
        assert_eq!(handed.count(), robots * (robots - 1), "seed {seed}");
    }
    assert!(passed_over > 100, "faults do strike: {passed_over}");
}

#[test]
fn an_unordered_broadcast_breaks_it() {
    let broken = (0..20).filter(|&seed| {
        let make = Teller::boxed(Order::Fifo, 20, 0.3);
        let mut world = World::new(3, seed, Wire::bad(), Some(PERIOD), make);
        world.run_for(Duration::from_seconds(60));
        causal_violation(&runs(&world, &[])).is_some()
    });
    assert_eq!(broken.count(), 20);
}

/// Robot 0 tells robot 1, which tells robot 2 of it; robot 2 does not hear robot 0, and the message to it is on its
/// way.
fn hearsay_begins(seed: u64) -> World {
    let mut world = world(3, seed, Wire::perfect(), 0);
    for robot in 0..3 {
        world.command(robot, tell(0));
    }
    world.run_for(Duration::from_seconds(5));
    world.wire.cut.insert((0, 2));
    world.command(0, tell(1));
    world.run_for(Duration::from_millis(50));
    world.command(1, tell(2));
    world
}

/// The same, after robot 2 has received the message.
fn hearsay(seed: u64) -> World {
    let mut world = hearsay_begins(seed);
    world.run_for(Duration::from_seconds(1));
    world
}

fn told_to_2(world: &World) -> Vec<i64> {
    let got = world.events("got");
    let to_2 = got.iter().filter(|got| got.1 == RobotId(2));
    to_2.map(|got| int(&got.2["value"])).collect()
}

#[test]
fn a_message_waits_for_the_one_before_it() {
    let mut world = hearsay(1);
    assert_eq!(told_to_2(&world), [0, 0]);
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(3));
    assert_eq!(told_to_2(&world), [0, 0, 1, 2]);
}

#[test]
fn a_lost_message_is_passed_over_and_never_delivered() {
    let mut world = hearsay(2);
    world.crash(0);
    world.run_for(Duration::from_seconds(10));
    assert_eq!(told_to_2(&world), [0, 0, 2], "its sender is suspected");
    let passed = world.events("pass_over");
    assert_eq!(passed.len(), 1);
    assert_eq!(int(&passed[0].2["number"]), 2);

    let mut world = hearsay(3);
    world.run_for(Duration::from_seconds(120));
    assert_eq!(told_to_2(&world), [0, 0, 2], "its sender gave it up");
    world.wire.cut.clear();
    world.command(0, tell(3));
    world.run_for(Duration::from_seconds(5));
    assert_eq!(told_to_2(&world), [0, 0, 2, 3]);
}

#[test]
fn a_held_message_of_an_earlier_life_counts_when_it_is_delivered() {
    // Robot 2 holds back what robot 1 says, as it does not hear what robot 0 has said before.
    let mut world = hearsay_begins(6);
    world.run_for(Duration::from_millis(100));
    world.crash(1);
    world.start(1);
    world.command(1, tell(3));
    world.run_for(Duration::from_millis(300));
    assert_eq!(told_to_2(&world), [0, 0]);
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(3));
    assert_eq!(told_to_2(&world), [0, 0, 1, 2, 3]);
    assert!(world.events("pass_over").is_empty(), "nothing was missed");
    assert_eq!(teller(&world, 2).clone().take_gaps(), []);
}

#[test]
fn messages_of_an_earlier_life_are_not_delivered_after_a_later_one_was_passed_over() {
    let mut passed_over = 0;
    for seed in 0..20 {
        let mut world = world(4, seed, Wire::perfect(), 0);
        let pause = Duration::from_millis(200);
        for robot in 0..4 {
            world.command(robot, tell(robot as u32));
            world.run_for(pause);
        }
        // Robot 0 misses a message of robot 3, and holds what robot 2 says after it.
        world.wire.cut.insert((3, 0));
        world.command(3, tell(10));
        world.run_for(pause);
        world.command(2, tell(20));
        world.run_for(pause);
        // It hears nothing of the next life of robot 2, but of robot 1, which does.
        world.wire.cut.insert((2, 0));
        let mut starts = Vec::new();
        world.crash(2);
        world.start(2);
        starts.push((world.now, 2));
        world.command(2, tell(21));
        world.run_for(pause);
        world.command(1, tell(11));
        world.run_for(pause);
        world.crash(2);
        world.wire.cut.remove(&(2, 0));
        world.start(2);
        starts.push((world.now, 2));
        world.command(2, tell(22));
        world.run_for(pause);
        world.wire.cut.clear();
        world.run_for(Duration::from_seconds(5));
        assert_eq!(
            causal_violation(&runs(&world, &starts)),
            None,
            "seed {seed}"
        );
        let got = world.events("got");
        let to_0 = got.iter().filter(|got| got.1 == RobotId(0));
        let to_0: Vec<i64> = to_0.map(|got| int(&got.2["value"])).collect();
        assert!(
            to_0.ends_with(&[10, 11, 22]) || to_0.ends_with(&[11, 10, 22]),
            "{to_0:?}"
        );
        passed_over += world.events("pass_over").len();
    }
    assert!(passed_over >= 20, "{passed_over}");
}

#[test]
fn recent_messages_wait_until_it_is_known_which_life_is_later() {
    let mut world = world(3, 7, Wire::perfect(), 0);
    // Robot 2 hears nothing of the first life of robot 0, and late that robot 1 does.
    world.wire.cut.extend([(0, 2), (1, 2)]);
    let pause = Duration::from_millis(500);
    world.command(0, tell(1));
    world.run_for(pause);
    world.command(1, tell(2));
    world.run_for(pause);
    // It meets the second life, holds its messages behind those of robot 1, and cannot ask it any more.
    world.crash(0);
    world.start(0);
    world.wire.cut.remove(&(0, 2));
    world.command(0, tell(3));
    world.run_for(pause);
    world.wire.cut.clear();
    world.wire.cut.insert((2, 0));
    world.command(1, tell(4));
    world.run_for(pause);
    let mut last = 4;
    let passes_over = |world: &World| {
        world
            .events("pass_over")
            .iter()
            .any(|event| event.1 == RobotId(2))
    };
    while !passes_over(&world) {
        assert!(last < 200, "robot 2 waits for ever");
        last += 1;
        world.command(0, tell(last));
        world.run_for(pause);
    }
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(3));
    let told = told_to_2(&world);
    assert!(told.len() > 10, "{told:?}");
    assert!(told.ends_with(&[last.into()]), "{last}: {told:?}");
}

#[test]
fn the_program_is_notified_of_missed_messages() {
    let mut world = hearsay(4);
    world.crash(0);
    world.run_for(Duration::from_seconds(10));
    let mut broadcast = teller(&world, 2).clone();
    let from = Some(RobotId(0));
    assert_eq!(broadcast.take_gaps(), [Gap { from }]);
    assert_eq!(broadcast.take_gaps(), []);
}

#[test]
fn a_late_joiner_does_not_wait_for_earlier_messages() {
    let mut world = world(3, 5, Wire::perfect(), 0);
    for value in 0..5 {
        world.command(0, tell(value));
        world.run_for(Duration::from_millis(50));
        world.command(1, tell(value));
        world.run_for(Duration::from_millis(50));
    }
    world.run_for(Duration::from_seconds(5));
    world.join();
    world.run_for(Duration::from_seconds(1));
    world.command(1, tell(9));
    world.run_for(Duration::from_seconds(2));
    let got = world.events("got");
    let (at, robot, fields) = got.last().expect("someone got it");
    assert_eq!((*robot, int(&fields["value"])), (RobotId(3), 9), "at {at}");
    assert_eq!(teller(&world, 3).clone().take_gaps(), [], "that is no loss");
}
