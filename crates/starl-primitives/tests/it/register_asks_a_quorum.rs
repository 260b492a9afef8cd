//! The cost of operations, the reports of their progress, and the return of an operation after a
//! crash.

use crate::harness::keeper::{Keeper, keeper, known, read, result, status, withdraw, write};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::register::Status;

const SECOND: Duration = Duration::from_seconds(1);

fn idle(count: usize) -> World {
    let mut world = World::new(count, 1, Wire::perfect(), None, Keeper::boxed(false, None));
    world.run_for(SECOND * 20);
    world
}

/// How many datagrams about registers are sent in the first milliseconds after a command, in which nothing
/// else is.
fn sent(world: &mut World, robot: usize, command: impl starl_core::Timer) -> usize {
    // Heartbeats are sent by timers that fire at other times than this.
    world.run_for(Duration::from_millis(20));
    let before = world.sent_count();
    world.command(robot, command);
    world.run_for(Duration::from_millis(5));
    world.sent_count() - before
}

#[test]
fn operations_have_their_documented_cost() {
    for count in [3, 5, 8] {
        let mut world = idle(count);
        // A question to all is one datagram; the answers are one each.
        let phase = 1 + (count - 1);
        assert_eq!(sent(&mut world, 0, write(7)), 2 * phase, "{count} robots");
        assert_eq!(sent(&mut world, 1, read()), phase, "{count} robots");
        assert_eq!(result(&world, 1), Some(7));
    }
}

#[test]
fn an_operation_without_a_quorum_says_so_and_is_done_when_there_is_one() {
    let mut world = idle(3);
    world.crash(1);
    world.command(0, write(5));
    world.run_for(SECOND);
    assert_eq!(result(&world, 0), Some(5), "two of three are a majority");
    world.crash(2);
    world.command(0, read());
    assert_eq!(status(&world, 0), Status::Pending);
    world.run_for(SECOND * 6);
    assert_eq!(status(&world, 0), Status::NoQuorum);
    assert!(keeper(&world, 0).register.failed());
    world.start(1);
    world.start(2);
    world.run_for(SECOND * 10);
    assert_eq!(result(&world, 0), Some(5), "all that are left agree");
    assert!(!keeper(&world, 0).register.failed());
}

#[test]
fn an_operation_that_is_withdrawn_is_forgotten() {
    let mut world = idle(3);
    world.crash(1);
    world.crash(2);
    world.command(0, write(5));
    world.run_for(SECOND * 10);
    let register = &keeper(&world, 0).register;
    assert_eq!((register.pending(), register.failed()), (1, true));
    world.command(0, withdraw());
    let register = &keeper(&world, 0).register;
    assert_eq!((register.pending(), register.failed()), (0, false));
}

#[test]
fn a_robot_that_restarts_answers_when_it_has_recovered() {
    let mut world = idle(3);
    world.command(0, write(5));
    world.run_for(SECOND);
    world.crash(0);
    world.run_for(SECOND);
    world.wire.cut = [(1, 0), (2, 0)].into();
    world.start(0);
    world.run_for(SECOND * 20);
    assert!(!keeper(&world, 0).register.is_up(), "it hears nobody");
    world.wire.cut = [(1, 0)].into();
    world.run_for(SECOND * 20);
    assert!(!keeper(&world, 0).register.is_up(), "one is no majority");
    world.wire.cut.clear();
    world.run_for(SECOND * 5);
    assert!(keeper(&world, 0).register.is_up());
    assert_eq!(known(&world, 0), Some(5));
}

#[test]
fn a_fleet_starts_without_those_that_are_down() {
    let make = Keeper::boxed(false, None);
    let mut world = World::new(5, 1, Wire::perfect(), None, make);
    world.crash(3);
    world.crash(4);
    world.run_for(SECOND * 3);
    (0..3).for_each(|robot| assert!(keeper(&world, robot).register.is_up(), "{robot}"));
    world.command(0, write(5));
    world.run_for(SECOND);
    assert_eq!(result(&world, 0), Some(5));
    world.start(3);
    world.run_for(SECOND * 3);
    assert!(keeper(&world, 3).register.is_up());
    assert_eq!(known(&world, 3), Some(5));
}

#[test]
fn values_stored_by_a_majority_spread_to_the_others() {
    let mut world = idle(4);
    world.wire.cut = (0..3).flat_map(|robot| [(robot, 3), (3, robot)]).collect();
    world.command(0, write(5));
    world.run_for(SECOND * 5);
    assert_eq!(result(&world, 0), Some(5));
    assert_eq!(known(&world, 3), None);
    world.wire.cut.clear();
    world.run_for(SECOND * 10);
    assert_eq!(known(&world, 3), Some(5));
}

#[test]
fn robots_that_fail_soon_after_the_start_leave_a_majority_that_works() {
    for seed in 0..60 {
        let wire = Wire {
            loss: [0.0, 0.3][seed as usize % 2],
            ..Wire::perfect()
        };
        let mut world = World::new(5, seed, wire, None, Keeper::boxed(false, None));
        let rest = world.lose_two_early(seed);
        for (round, &robot) in rest.iter().enumerate() {
            let value = round as u32 + 1;
            world.command(robot, write(value));
            let done = (0..40).find(|_| {
                world.run_for(SECOND);
                !matches!(status(&world, robot), Status::Pending | Status::NoQuorum)
            });
            assert!(done.is_some(), "seed {seed}, robot {robot}");
            assert_eq!(
                result(&world, robot),
                Some(value),
                "seed {seed}, robot {robot}"
            );
        }
    }
}

#[test]
fn a_founder_that_restarts_is_none() {
    // Robot 1 forgets what it has acknowledged, and must learn it again although it was there when the fleet began.
    for seed in 0..20 {
        let mut world = World::new(3, seed, Wire::perfect(), None, Keeper::boxed(false, None));
        world.run_for(SECOND * 20);
        world.wire.cut.extend([(0, 2), (2, 0)]);
        world.command(2, write(7));
        world.run_for(SECOND * 2);
        assert_eq!(result(&world, 2), Some(7), "seed {seed}");
        world.crash(1);
        world.wire.cut.extend([(1, 2), (2, 1)]);
        world.start(1);
        world.run_for(SECOND * 10);
        world.command(1, read());
        world.run_for(SECOND * 10);
        assert_eq!(status(&world, 1), Status::NoQuorum, "seed {seed}");
        world.wire.cut.clear();
        world.run_for(SECOND * 10);
        assert_eq!(result(&world, 1), Some(7), "seed {seed}");
    }
}
