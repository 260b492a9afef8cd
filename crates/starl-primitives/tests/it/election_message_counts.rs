//! The datagrams of an election are as many as theory says, for 3 to 100 robots. The table is that of the
//! reference.

use crate::harness::elector::{ELECT, Elector, RESIGN, agreed, by, election};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::election::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const COUNTS: [usize; 6] = [3, 5, 10, 20, 50, 100];

/// A fleet over a perfect network, without heartbeats, of which no robot stands yet.
fn idle(count: usize, algorithm: Algorithm) -> World {
    let make = Elector::boxed(by(algorithm), None, false, false);
    World::new(count, 1, Wire::perfect(), None, make)
}

/// Runs until all agree; gives the datagrams that it took from the moment of the first.
fn until_agreed(world: &mut World, count: usize) -> usize {
    let sent = world.sent_count();
    let all: Vec<usize> = (0..count).collect();
    for _ in 0..20_000 {
        if agreed(world, &all).is_some() {
            return world.sent_count() - sent;
        }
        world.run_for(Duration::from_millis(1));
    }
    panic!("{count} robots do not agree");
}

/// All robots call for an election at once.
fn of_all(count: usize, algorithm: Algorithm) -> usize {
    let mut world = idle(count, algorithm);
    world.run_for(SECOND * 5);
    (0..count).for_each(|robot| world.command(robot, ELECT));
    until_agreed(&mut world, count)
}

/// Each of n robots tells its ballot, and the winner that it has won.
#[test]
fn by_ballots() {
    for count in COUNTS {
        let mut world = idle(count, Algorithm::Ballots);
        let sent = world.sent_count();
        (0..count).for_each(|robot| world.command(robot, ELECT));
        until_agreed(&mut world, count);
        assert_eq!(world.sent_count() - sent, count + 1);
    }
}

/// Each asks the greater ones: one datagram if these are more than half of the fleet, else one to each. All of
/// them answer. The greatest says at once that it leads.
#[test]
fn by_bully_if_all_begin() {
    for count in COUNTS {
        let mut world = idle(count, Algorithm::Bully);
        let sent = world.sent_count();
        (0..count).for_each(|robot| world.command(robot, ELECT));
        world.run_for(Duration::from_millis(10));
        let greater = (0..count - 1).map(|robot| count - 1 - robot);
        let questions: usize = greater
            .map(|greater| if 2 * greater > count - 1 { 1 } else { greater })
            .sum();
        let answers = count * (count - 1) / 2;
        let counted = world.sent_count() - sent;
        assert_eq!(counted, questions + answers + 1, "{count} robots");
    }
}

/// One robot asks for the vote of the others, all of them give it, and it says that it leads.
#[test]
fn by_leases_with_one_candidate() {
    for count in COUNTS {
        let mut world = idle(count, Algorithm::Leases);
        world.run_for(SECOND * 5);
        let sent = world.sent_count();
        world.command(1, ELECT);
        until_agreed(&mut world, count);
        assert_eq!(world.sent_count() - sent, 1 + (count - 1) + 1);
    }
}

/// Where all stand the first is mostly through before the others try.
#[test]
fn by_leases_if_all_stand() {
    for count in COUNTS {
        let counted = of_all(count, Algorithm::Leases);
        println!("{count}: {counted}");
        assert!(counted <= 2 * (count + 1), "{counted} for {count} robots");
    }
}

/// A leader that resigns says so; its successor takes no more than the first did.
#[test]
fn by_leases_after_a_resignation() {
    for count in COUNTS {
        let mut world = idle(count, Algorithm::Leases);
        world.run_for(SECOND * 5);
        (0..count).for_each(|robot| world.command(robot, ELECT));
        until_agreed(&mut world, count);
        let leader = election(&world, 0).leader().unwrap().index();
        world.run_for(SECOND);
        world.command(leader, RESIGN);
        world.run_for(Duration::from_millis(2));
        let counted = until_agreed(&mut world, count);
        println!("{count}: {counted}");
        assert!(counted <= 2 * (count + 1), "{counted} for {count} robots");
    }
}

/// In each period a leader by leases asks once, and all others answer; another only says that it leads.
#[test]
fn afterwards() {
    for count in COUNTS {
        for (algorithm, each) in [
            (Algorithm::Leases, count),
            (Algorithm::Ballots, 1),
            (Algorithm::Bully, 1),
        ] {
            let mut world = idle(count, algorithm);
            (0..count).for_each(|robot| world.command(robot, ELECT));
            world.run_for(SECOND * 20);
            let sent = world.sent_count();
            world.run_for(SECOND * 10);
            let periods = 20;
            assert_eq!(world.sent_count() - sent, periods * each, "{algorithm:?}");
        }
    }
}

/// When a fleet starts each asks what was promised before, and all others answer; once.
#[test]
fn leases_when_the_fleet_starts() {
    for count in COUNTS {
        let mut world = idle(count, Algorithm::Leases);
        world.run_for(SECOND * 20);
        assert_eq!(world.sent_count(), count + count * (count - 1));
    }
}
