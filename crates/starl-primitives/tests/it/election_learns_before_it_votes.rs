//! The steps of a restarted robot before it votes again, and their reasons: without any one of them two robots
//! could lead at once or epochs could go back.

use crate::harness::elector::{ELECT, Elector, RESIGN, agreed, by, judge};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::election::{Algorithm, Options};

const SECOND: Duration = Duration::from_seconds(1);

/// Of three robots one is disconnected, while the other two elect again. Then the one that voted restarts, and
/// is connected only with the third: these two are a majority.
fn voter_changes_sides(seed: u64, options: Options, first: Wire) -> (World, Vec<(usize, u32)>) {
    let make = Elector::eager(options);
    let mut world = World::new(3, seed, first, None, make);
    world.run_for(SECOND * 4);
    world.wire = Wire::perfect();
    world.run_for(SECOND * 6);
    let leader = agreed(&world, &[0, 1, 2]).expect("a leader");
    let (voter, third) = ((leader + 1) % 3, (leader + 2) % 3);
    // The third robot's clock stands still, as it were: its epochs would be earlier ones.
    for robot in [leader, voter] {
        world.set_clock_ahead(robot as usize, 3_600_000_000_000);
        world.wire.cut.extend([(robot, third), (third, robot)]);
    }
    world.command(leader as usize, RESIGN);
    world.command(leader as usize, ELECT);
    world.run_for(SECOND * 10);
    let leader = agreed(&world, &[leader as usize, voter as usize]).expect("a leader");
    let voter = 3 - third - leader;
    let crashes = vec![(world.records.len(), voter)];
    world.crash(voter as usize);
    world.start(voter as usize);
    world.wire.cut.clear();
    for robot in [voter, third] {
        world.wire.cut.extend([(robot, leader), (leader, robot)]);
    }
    (world, crashes)
}

/// The voter must not help the third robot to lead before it knows its earlier promise from the leader: no
/// robot leads until the three are connected.
#[test]
fn a_voter_that_forgot_does_not_help_another_to_an_earlier_epoch() {
    for seed in 0..100 {
        let options = by(Algorithm::Leases);
        let (mut world, crashes) = voter_changes_sides(seed, options, Wire::perfect());
        world.run_for(SECOND * 30);
        let led = judge(&world, &crashes).len();
        assert_eq!(led, 2, "seed {seed}");
        world.wire.cut.clear();
        world.run_for(SECOND * 10);
        assert!(agreed(&world, &[0, 1, 2]).is_some());
        assert!(judge(&world, &crashes).len() > led);
    }
}

/// Each robot asked for promises when it first started, and copies of the answers come when the voter asks again in its
/// second life: they say that nothing was promised.
#[test]
fn late_answers_to_an_earlier_life_do_not_count() {
    for seed in 0..100 {
        let late = Wire {
            duplication: 1.0,
            late: (0.5, 21_000),
            ..Wire::perfect()
        };
        let (mut world, crashes) = voter_changes_sides(seed, by(Algorithm::Leases), late);
        world.run_for(SECOND * 30);
        assert_eq!(judge(&world, &crashes).len(), 2, "seed {seed}");
    }
}
