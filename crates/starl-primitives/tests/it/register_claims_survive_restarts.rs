//! A robot keeps its promise to a claim although it restarts without memory. An unfinished write of a crashed robot is
//! completed by the next robot that finds it, or never.

use crate::harness::keeper::{Keeper, claim, keeper, known, read, result, status, update, write};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::register::Status;

const SECOND: Duration = Duration::from_seconds(1);

fn idle() -> World {
    let mut world = World::new(3, 1, Wire::perfect(), None, Keeper::boxed(false, None));
    world.run_for(SECOND * 5);
    world
}

/// Parts two robots, or joins them again.
fn set_linked(world: &mut World, one: u32, other: u32, linked: bool) {
    for pair in [(one, other), (other, one)] {
        match linked {
            true => world.wire.cut.remove(&pair),
            false => world.wire.cut.insert(pair),
        };
    }
}

#[test]
fn a_restarted_robot_recovers_its_promises() {
    let mut world = idle();
    world.command(0, claim());
    world.run_for(SECOND);
    assert_eq!(status(&world, 0), Status::Done(None));
    // Robot 2 promises the register to robot 1, and forgets it.
    set_linked(&mut world, 0, 1, false);
    world.command(1, claim());
    world.run_for(SECOND);
    assert_eq!(status(&world, 1), Status::Done(None));
    world.crash(2);
    world.start(2);
    world.run_for(SECOND * 5);
    assert!(keeper(&world, 2).register.is_up());
    // It is the only other one that each of them has. It refuses robot 0, which claims the register
    // itself.
    let written = Status::Done(Some(1_u32.to_le_bytes().as_slice().into()));
    world.command(0, update(1));
    world.run_for(SECOND * 10);
    assert_eq!(status(&world, 0), written);
    // The value that it found then differs from the one that robot 1 found.
    world.command(1, update(2));
    world.run_for(SECOND * 10);
    assert_eq!(status(&world, 1), Status::Lost);
    world.command(2, read());
    world.run_for(SECOND);
    assert_eq!(result(&world, 2), Some(1));
}

#[test]
fn a_crashed_robots_update_stored_by_one_other_is_completed() {
    let mut world = idle();
    world.command(0, claim());
    world.run_for(SECOND);
    // Robot 1 alone hears of it.
    set_linked(&mut world, 0, 2, false);
    set_linked(&mut world, 1, 2, false);
    world.command(0, update(1));
    world.run_for(Duration(1_500_000));
    world.crash(0);
    world.run_for(SECOND);
    assert_eq!(known(&world, 1), Some(1));
    set_linked(&mut world, 1, 2, true);
    world.command(2, claim());
    world.run_for(SECOND);
    assert_eq!(result(&world, 2), Some(1));
    world.command(2, update(11));
    world.run_for(SECOND);
    assert_eq!(result(&world, 2), Some(11));
}

#[test]
fn a_refused_update_that_was_read_by_the_next_is_done() {
    let mut world = idle();
    world.command(0, claim());
    world.run_for(SECOND);
    // Robot 1 stores it and cannot tell robot 0, which cannot reach robot 2.
    set_linked(&mut world, 0, 2, false);
    world.wire.cut.insert((1, 0));
    world.command(0, update(1));
    world.run_for(Duration::from_millis(20));
    // Robot 2 reads it there, and builds on it.
    world.command(2, claim());
    world.run_for(SECOND);
    assert_eq!(result(&world, 2), Some(1));
    world.command(2, update(2));
    world.run_for(SECOND);
    assert_eq!(result(&world, 2), Some(2));
    assert!(!matches!(status(&world, 0), Status::Done(_)));
    world.wire.cut.clear();
    world.run_for(SECOND * 10);
    // It has taken effect, and what robot 2 made of it is what there is.
    assert_eq!(
        status(&world, 0),
        Status::Done(Some(2_u32.to_le_bytes().as_slice().into()))
    );
}

#[test]
fn a_plain_write_gives_way_to_a_claim() {
    let mut world = idle();
    world.command(0, claim());
    world.run_for(SECOND);
    // Robot 0 claims between robot 1's two questions.
    world.wire.delay_ms = (10, 10);
    world.command(1, write(5));
    world.run_for(Duration::from_millis(12));
    world.command(2, claim());
    world.run_for(SECOND);
    assert_eq!(status(&world, 1), Status::Refused);
}
