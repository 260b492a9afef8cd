//! How long it takes until memories agree again from any state (self-stabilisation, Dijkstra 1974).

mod harness;

use harness::sharer::{Sharer, memory, write, write_own};
use harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::shared_memory::Options;

const PERIOD: Duration = Duration::from_millis(100);

fn agree(world: &World) -> bool {
    let one = memory(world, 0);
    (0..8).all(|variable| {
        let name = format!("x{variable}");
        (1..4).all(|robot| {
            let other = memory(world, robot);
            one.read(&name) == other.read(&name) && one.all(&name).eq(other.all(&name))
        })
    })
}

/// How long after the corruption of these robots all agree, and stay so for 10 s; seconds.
fn time(seed: u64, wire: Wire, whom: &[usize]) -> f64 {
    let make = Sharer::boxed(Options::default());
    let mut world = World::new(4, seed, wire, Some(PERIOD), make);
    for robot in 0..4 {
        for variable in 0..8 {
            world.command(robot, write(variable, robot as u32));
            world.command(robot, write_own(variable, robot as u32));
        }
    }
    world.run_for(Duration::from_seconds(20));
    whom.iter().for_each(|&robot| world.corrupt(robot));
    let at = world.now;
    let mut since = at;
    while world.now.since(since) < Duration::from_seconds(10) {
        world.run_for(Duration::from_millis(50));
        if !agree(&world) {
            since = world.now;
        }
        assert!(
            world.now.since(at) < Duration::from_seconds(60),
            "seed {seed}"
        );
    }
    since.since(at).seconds()
}

#[test]
fn memories_agree_again_soon() {
    for (name, wire) in [("perfect", Wire::perfect()), ("bad", Wire::bad())] {
        for whom in [&[1][..], &[0, 1, 2, 3]] {
            let mut times: Vec<f64> = (0..50).map(|seed| time(seed, wire.clone(), whom)).collect();
            times.sort_by(f64::total_cmp);
            let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
            println!("{name}, {} robots: {median:.2} s, {worst:.2} s", whom.len());
            assert!(worst < 20.0, "{name}, {whom:?}: {worst}");
        }
    }
}
