//! Total order at a hundred messages a second from each of ten robots, over a network that loses a fifth of
//! all datagrams, and after the fleet was in two parts for a while.

use crate::harness::teller::{Id, Step, Teller, is_fifo, runs, tell, total_violation};
use crate::harness::{Wire, World};
use starl_core::{Duration, Time};
use starl_primitives::broadcast::Order;
use std::collections::BTreeMap;

const ROBOTS: usize = 10;
const PERIOD: Duration = Duration::from_millis(10);

fn world(seed: u64, delay_ms: (u64, u64)) -> World {
    let wire = Wire {
        loss: 0.2,
        delay_ms,
        ..Wire::perfect()
    };
    let make = Teller::boxed(Order::Total, 0, 0.0);
    let mut world = World::new(ROBOTS, seed, wire, None, make);
    world.run_for(Duration::from_seconds(5));
    world
}

/// Each robot broadcasts a hundred messages a second.
fn load(world: &mut World, span: Duration) {
    let end = world.now + span;
    while world.now < end {
        for robot in 0..ROBOTS {
            world.command(robot, tell(robot as u32));
        }
        world.run_for(PERIOD);
    }
}

/// When each message was sent, and when all had delivered it.
struct Times {
    sent: BTreeMap<Id, Time>,
    all: BTreeMap<Id, Time>,
}

impl Times {
    fn of(world: &World) -> Times {
        let runs = runs(world, &[]);
        assert_eq!(total_violation(&runs), None);
        let mut sent = BTreeMap::new();
        let mut handed: BTreeMap<Id, Vec<Time>> = BTreeMap::new();
        for (_, steps) in &runs {
            let mut sequence = Vec::new();
            for (place, step) in steps {
                let at = world.records[*place].0;
                match step {
                    Step::Sent(id) => drop(sent.insert(*id, at)),
                    Step::Handed(id) => {
                        handed.entry(*id).or_default().push(at);
                        sequence.push(*id);
                    }
                    _ => {}
                }
            }
            assert!(is_fifo(&sequence));
        }
        let by_all = handed.into_iter().filter(|(_, at)| at.len() == ROBOTS);
        let all = by_all.map(|(id, at)| (id, *at.iter().max().expect("some")));
        Times {
            sent,
            all: all.collect(),
        }
    }

    /// The time until all had delivered a message: the median and the longest of those that were sent
    /// between these, seconds. All have delivered it.
    fn latency(&self, from: Time, to: Time) -> (f64, f64) {
        let of_then = self.sent.iter().filter(|(_, at)| (from..to).contains(*at));
        let latency = of_then.map(|(id, at)| match self.all.get(id) {
            Some(all) => all.since(*at).seconds(),
            None => panic!("{id:?}, sent at {at}, was not handed to all"),
        });
        let mut all: Vec<f64> = latency.collect();
        all.sort_by(f64::total_cmp);
        (all[all.len() / 2], all[all.len() - 1])
    }
}

#[test]
fn a_hundred_messages_a_second_from_each_are_ordered_at_line_rate() {
    let cases = [
        (1, (1, 10), 1.0),
        (2, (5, 50), 1.0),
        (3, (5, 50), 1.0),
        (4, (100, 100), 3.0),
    ];
    for (seed, delay_ms, bound) in cases {
        let mut world = world(seed, delay_ms);
        let (begin, before) = (world.now, world.sent_on("news"));
        load(&mut world, Duration::from_seconds(20));
        let (end, datagrams) = (world.now, world.sent_on("news") - before);
        world.run_for(Duration::from_seconds(5));
        assert!(world.events("gap").is_empty());
        let times = Times::of(&world);
        let middle = begin + Duration::from_seconds(10);
        let first = times.latency(begin, middle);
        let second = times.latency(middle, end);
        let messages = times.sent.len();
        let each = datagrams as f64 / (messages * (ROBOTS - 1)) as f64;
        println!("{delay_ms:?} ms: {first:?} s, {second:?} s, {each:.2} datagrams");
        assert_eq!(messages, 20 * 100 * ROBOTS);
        // It keeps up: what comes later takes no longer.
        assert!(second.0 < bound && second.1 < 3.0 * bound, "{second:?}");
        assert!(each < 0.2, "{each} datagrams a message and receiver");
    }
}

#[test]
fn the_backlog_of_a_partition_clears_within_seconds() {
    for seed in 0..4 {
        let mut world = world(seed, (5, 50));
        load(&mut world, Duration::from_seconds(2));
        // With even seeds the leader is among the few.
        let led = world.events("lead");
        let leader = led.last().expect("someone leads").1.0;
        let few: Vec<u32> = (0..3)
            .map(|i| (leader + i + seed as u32 % 2) % ROBOTS as u32)
            .collect();
        for &one in &few {
            for other in (0..ROBOTS as u32).filter(|other| !few.contains(other)) {
                world.wire.part(one, other);
            }
        }
        load(&mut world, Duration::from_seconds(20));
        world.wire.cut.clear();
        let healed = world.now;
        load(&mut world, Duration::from_seconds(15));
        let end = world.now;
        world.run_for(Duration::from_seconds(5));
        let times = Times::of(&world);
        let gaps = world.events("gap").len();
        let of = |after| times.latency(healed + Duration::from_seconds(after), end);
        println!("seed {seed}: {gaps} gaps, {:?} s", of(5));
        assert_eq!(gaps, 0);
        assert!(of(5).1 < 6.0, "{:?}", of(5));
        assert!(of(0).1 < 10.0, "{:?}", of(0));
    }
}
