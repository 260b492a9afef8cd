//! The trace of a robot shows where the robot was when its program acted.

use crate::support::{Idle, Notes, at, setup};
use starl_core::event::Event;
use starl_core::{Point, Pose, Program, Robot};
use starl_node::link::Channel;
use starl_node::motors::Report;
use starl_node::robot::{Core, Incoming};

/// Finishes where it is to be.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Arriving;

impl Program for Arriving {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.position().x > 0.9 {
            robot.finish();
        }
    }
}

/// Cameras that say nothing for most of a second, as on a machine with too much to do, and then see the robot far ahead.
#[test]
fn a_program_that_acts_on_a_jump_of_the_position_has_the_jump_on_record() {
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(
        at(0),
        setup(Arriving),
        channel,
        Idle::default(),
        Notes::default(),
    );
    for ms in 0..=950 {
        let mut incoming = Vec::new();
        // The latest pose was recorded at 900 ms.
        if ms == 940 {
            let pose = Pose::level(Point::planar(1.0, 0.0), 0.0);
            incoming.push(Incoming::Device(Report::Seen(at(ms), pose)));
        }
        core.step(at(ms), &mut incoming);
    }
    let records = core.end(at(950)).0;
    let finished = records
        .iter()
        .position(|(_, event)| *event == Event::Finished);
    let before = &records[..finished.expect("it is there")];
    let mut moves = before.iter().filter_map(|(_, event)| match event {
        Event::Moved(pose) => Some(pose.position.x),
        _ => None,
    });
    assert_eq!(moves.next_back(), Some(1.0));
}
