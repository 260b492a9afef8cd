//! A command that a robot's model does not accept stops the robot, and cancels the previous command.

use starl_core::{
    Agent, Command, Duration, Estimate, Event, Point, Program, Random, Robot, RobotId, Sensors,
    Time,
};
use starl_host::hardware::Drive;
use starl_host::{
    Clock, Datagram, Hardware, Node, NodeInput, Outlet, PlanJob, Snapshot, StoreJob, Workspace,
};
use starl_motion::{Neighbour, models};

/// Goes to a point, and wants to take off one second later.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Confused;

impl Program for Confused {
    fn start(&mut self, robot: &mut Robot<'_>) {
        robot.track(Point::planar(5.0, 0.0), None);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.now() == at(1000) {
            robot.drive(Command::TakeOff);
        }
    }
}

fn at(ms: u64) -> Time {
    Time::ZERO + Duration::from_millis(ms)
}

/// Keeps the records.
#[derive(Default)]
struct Notes {
    workspace: Workspace,
    records: Vec<Event>,
}

impl Outlet for Notes {
    fn workspace(&mut self) -> &mut Workspace {
        &mut self.workspace
    }

    fn record(&mut self, _: Time, event: Event) {
        self.records.push(event);
    }

    fn transmit(&mut self, _: Time, _: Datagram) {}

    fn plan(&mut self, _: Time, _: PlanJob) {}

    fn neighbours(&mut self, _: f64, _: &mut Vec<Neighbour>) {}

    fn store(&mut self, _: Time, _: StoreJob) {}
}

#[test]
fn a_robot_whose_command_is_refused_stands_still_at_later_estimates() {
    let model = models::by_name("create").expect("there is such a model");
    let hardware = Hardware {
        body: model.body(),
        control_period: Duration::from_millis(100),
        drive: Some(Drive {
            model,
            avoidance: None,
            position_error: 0.0,
            seed: 1,
        }),
    };
    let snapshot = Snapshot {
        hardware: &hardware,
        sensors: Sensors::default(),
        fleet: &[RobotId(0)],
        way_points: &[],
        obstacles: &[].into(),
    };
    let agent = Agent::new(Box::new(Confused), Random::keyed(1, &[]));
    let mut node = Node::new(RobotId(0), Clock::default(), agent, Time::ZERO);
    let mut notes = Notes::default();
    node.handle(Time::ZERO, NodeInput::Start, &snapshot, &mut notes);
    for ms in (0..=2000).step_by(50) {
        node.locate(at(ms), Estimate::default(), &mut notes);
        node.handle(at(ms), NodeInput::Located, &snapshot, &mut notes);
        while node.next_timeout() <= at(ms) {
            node.handle(at(ms), NodeInput::Timeout, &snapshot, &mut notes);
        }
        let stands = node.command() == Command::Stop;
        assert_eq!(stands, ms >= 1000, "after {ms} ms: {:?}", node.command());
    }
    let refused =
        |event: &Event| matches!(event, Event::Log { text, .. } if text.contains("does not take"));
    assert_eq!(notes.records.into_iter().filter(refused).count(), 1);
}
