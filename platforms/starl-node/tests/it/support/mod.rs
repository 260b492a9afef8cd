//! A robot without threads whose device, network and storage do nothing.

use starl_core::event::Event;
use starl_core::motion::{Body, Workspace};
use starl_core::{Command, Duration, Estimate, Pose, Program, Random, RobotId, Saved, Time};
use starl_host::{Hardware, Observed, PlanJob, StoreJob};
use starl_motion::Neighbour;
use starl_motion::sensing::SensorSuite;
use starl_node::Safety;
use starl_node::link::channel::Opened;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, OPERATORS, Origin};
use starl_node::robot::{Equipment, Incoming, Recorder, Setup};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

/// A packet with its receiver.
pub type Sent = (Member, Vec<u8>);

/// Only notes the packets that are sent; the positions come from outside. Copies share the notes.
#[derive(Clone, Default)]
pub struct Idle {
    pub sent: Rc<RefCell<Vec<Sent>>>,
}

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

    fn send(&mut self, to: Member, packet: &[u8]) -> std::io::Result<()> {
        self.sent.borrow_mut().push((to, packet.to_vec()));
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

/// The events in the order in which they were recorded.
#[derive(Default)]
pub struct Notes(pub Vec<(Time, Event)>);

impl Recorder for Notes {
    fn record(&mut self, at: Time, event: Event) {
        self.0.push((at, event));
    }

    fn observe(&mut self, _: Time, _: Observed<'_>) {}

    fn advance(&mut self, _: Time) {}

    fn notice(&mut self, _: Time, _: &str) {}
}

/// The operator of a fleet without a key.
pub const OPERATOR: Member = OPERATORS | 1;

/// A frame of the operator to the robot.
pub fn from_operator(frame: &Frame) -> Incoming {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    operator.want(0);
    let content = starl_core::message::encode(frame);
    Incoming::Packet(Arrival {
        at: Instant::now(),
        origin: Origin::Named,
        packet: operator.seal(0, &content).expect("it is not encrypted"),
    })
}

/// The frames that the robot has sent, all of them to the operator.
pub fn to_operator(idle: &Idle) -> Vec<Frame> {
    let mut operator = Channel::new(OPERATOR, "fleet", Vec::new());
    let open = |(to, packet): &Sent| match operator.open(at(0), packet) {
        _ if *to != OPERATOR => panic!("a packet to {to}"),
        Opened::Content { content, .. } => starl_core::message::decode(&content),
        _ => None,
    };
    idle.sent.borrow().iter().filter_map(open).collect()
}

pub fn at(ms: u64) -> Time {
    Time::ZERO + Duration::from_millis(ms)
}

/// A robot of radius 0.2 m that runs this program, alone in an empty world, with a position every 10 ms.
pub fn setup(program: impl Program + 'static) -> Setup {
    let body = Body {
        radius: 0.2,
        height: 0.1,
        workspace: Workspace::Ground,
    };
    Setup {
        id: RobotId(0),
        bodies: vec![body],
        program: Box::new(program),
        random: Random::keyed(1, &[]),
        hardware: Hardware {
            body,
            control_period: Duration::from_millis(10),
            drive: None,
        },
        sensors: SensorSuite::default(),
        things: Vec::new(),
        way_points: Vec::new(),
        obstacles: Vec::new(),
        positioning_period: Duration::from_millis(10),
        accuracy: Default::default(),
        start: Some(Pose::default()),
        safety: Safety::default(),
    }
}
