//! The trace of a robot shows where the robot was when its program acted.

use starl_core::event::Event;
use starl_core::motion::{Body, Workspace};
use starl_core::{
    Command, Duration, Estimate, Point, Pose, Program, Random, Robot, RobotId, Saved, Time,
};
use starl_host::{Hardware, Observed, PlanJob, StoreJob};
use starl_motion::Neighbour;
use starl_motion::sensing::SensorSuite;
use starl_node::Safety;
use starl_node::link::{Channel, Member, Origin};
use starl_node::motors::Report;
use starl_node::robot::{Core, Equipment, Incoming, Recorder, Setup};
use std::sync::Arc;

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

/// Does nothing; the positions come from outside.
struct Idle;

impl Equipment for Idle {
    fn saved(&self) -> Option<Arc<Saved>> {
        None
    }

    fn has_fixes(&self) -> bool {
        true
    }

    fn drive(&mut self, _: Command, _: &Estimate) {}

    fn stop(&mut self) {}

    fn end(&mut self) {}

    fn find(&mut self, _: PlanJob, _: Vec<Neighbour>) {}

    fn write(&mut self, _: StoreJob) {}

    fn send(&mut self, _: Member, _: &[u8]) -> std::io::Result<()> {
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

#[derive(Default)]
struct Notes(Vec<(Time, Event)>);

impl Recorder for Notes {
    fn record(&mut self, at: Time, event: Event) {
        self.0.push((at, event));
    }

    fn observe(&mut self, _: Time, _: Observed<'_>) {}

    fn advance(&mut self, _: Time) {}

    fn notice(&mut self, _: Time, _: &str) {}
}

fn at(ms: u64) -> Time {
    Time::ZERO + Duration::from_millis(ms)
}

/// Cameras that say nothing for most of a second, as on a machine with too much to do, and then see the robot far ahead.
#[test]
fn a_program_that_acts_on_a_jump_of_the_position_has_the_jump_on_record() {
    let body = Body {
        radius: 0.2,
        height: 0.1,
        workspace: Workspace::Ground,
    };
    let setup = Setup {
        id: RobotId(0),
        bodies: vec![body],
        program: Box::new(Arriving),
        random: Random::keyed(1, &[]),
        hardware: Hardware {
            body,
            control_period: Duration::from_millis(10),
            drive: None,
        },
        sensors: SensorSuite::default(),
        things: Vec::new(),
        way_points: Vec::new(),
        obstacles: [].into(),
        positioning_period: Duration::from_millis(10),
        accuracy: Default::default(),
        start: Some(Pose::default()),
        safety: Safety::default(),
    };
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(at(0), setup, channel, Idle, Notes::default());
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
