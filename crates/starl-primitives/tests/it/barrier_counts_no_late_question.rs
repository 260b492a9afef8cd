//! Announcements of a robot before it knows the generation do not count: by the time they arrive the robot may
//! have restarted, and passed.

use crate::harness::crosser::{Crosser, arrive, barrier, crossings};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Port, RobotId};

const SECOND: Duration = Duration::from_seconds(1);

fn cross(world: &mut World, robots: &[usize]) {
    for &robot in robots {
        world.command(robot, arrive());
    }
    world.run_for(SECOND * 10);
}

#[test]
fn a_late_question_of_an_earlier_life_is_not_an_arrival() {
    let make = Crosser::boxed(None, None);
    let mut world = World::new(4, 1, Wire::perfect(), None, make);
    let mut crashes = Vec::new();
    let mut restart = |world: &mut World| {
        world.crash(2);
        crashes.push((world.records.len(), 2));
        world.start(2);
    };
    cross(&mut world, &[0, 1, 2, 3]);
    cross(&mut world, &[0, 1, 3]);

    // This life hears robot 0 alone, so it does not learn the generation.
    restart(&mut world);
    world.wire.cut.extend([(1, 2), (3, 2)]);
    cross(&mut world, &[2]);
    let before = world.records.len();
    let port = Port::named("gate");
    world.time_out(2, port);
    let late = world.payloads_from(before);
    assert!(!late.is_empty() && barrier(&world, 2).is_waiting());

    // This one passes.
    restart(&mut world);
    world.wire.cut.clear();
    cross(&mut world, &[2]);
    assert!((0..4).all(|robot| barrier(&world, robot).passed()));

    cross(&mut world, &[0, 1, 3]);
    let from = RobotId(2);
    for payload in late {
        let message = Message {
            from,
            port,
            payload,
        };
        for robot in [0, 1, 3] {
            world.input(robot, &Input::Message(message.clone()));
        }
    }
    world.run_for(SECOND * 10);
    assert!(
        [0, 1, 3]
            .into_iter()
            .all(|robot| barrier(&world, robot).is_waiting())
    );
    cross(&mut world, &[2]);
    assert!((0..4).all(|robot| barrier(&world, robot).passed()));
    crossings(&world, &crashes);
}

#[test]
fn a_late_copy_from_before_a_total_restart_is_not_an_arrival() {
    let make = Crosser::boxed(None, None);
    let mut world = World::new(3, 1, Wire::perfect(), None, make);
    let mut crashes = Vec::new();
    cross(&mut world, &[0, 1, 2]);
    cross(&mut world, &[2]);

    // The present life of robot 0 hears from robot 2 that it has come to generation 2, and does not learn that it comes
    // next, as robot 1 is down.
    for robot in [0, 1] {
        world.crash(robot);
        crashes.push((world.records.len(), robot as u32));
    }
    world.start(0);
    let before = world.records.len();
    cross(&mut world, &[0]);
    let late = world.payloads_from(before);
    world.crash(2);
    crashes.push((world.records.len(), 2));
    world.start(1);
    world.start(2);

    cross(&mut world, &[0, 1, 2]);
    assert!((0..3).all(|robot| barrier(&world, robot).generation() == 2));
    cross(&mut world, &[0, 1]);
    let port = Port::named("gate");
    for payload in late {
        let from = RobotId(2);
        let copy = Message {
            from,
            port,
            payload,
        };
        world.input(0, &Input::Message(copy));
    }
    world.run_for(SECOND * 10);
    assert!((0..2).all(|robot| barrier(&world, robot).is_waiting()));
    cross(&mut world, &[2]);
    assert!((0..3).all(|robot| barrier(&world, robot).passed()));
    crossings(&world, &crashes);
}
