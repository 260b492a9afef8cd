//! How long it takes until memories agree again from any state (self-stabilisation, Dijkstra 1974).

use crate::harness::sharer::{busy_world, memory};
use crate::harness::{Wire, World};
use starl_core::Duration;

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
    let mut world = busy_world(seed, wire, PERIOD);
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
    let all: &[usize] = &[0, 1, 2, 3];
    for (name, wire, longest) in [
        ("perfect", Wire::perfect(), 6.6),
        ("bad", Wire::bad(), 14.7),
    ] {
        for whom in [&[1], all] {
            let mut times: Vec<f64> = (0..50).map(|seed| time(seed, wire.clone(), whom)).collect();
            times.sort_by(f64::total_cmp);
            let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
            println!("{name}, {} robots: {median:.2} s, {worst:.2} s", whom.len());
            assert!(worst <= longest, "{name}, {whom:?}: {worst}");
        }
    }
}
