//! A node shows its host the beginning of each life of its software, before anything is done to it.

use starl_core::motion::{Body, Workspace as Place};
use starl_core::{
    Agent, Duration, Event, Primitives, Program, Random, Robot, RobotId, Sensors, Time,
};
use starl_host::{
    Clock, Datagram, Hardware, Node, NodeInput, Observed, Outlet, PlanJob, Snapshot, Workspace,
};

#[derive(Clone, Primitives)]
struct Idle;

impl Program for Idle {
    fn activate(&mut self, _: &mut Robot<'_>) {}
}

/// Keeps the kinds of what is shown, with the random streams.
#[derive(Default)]
struct Host {
    workspace: Workspace,
    seen: Vec<(Time, String)>,
}

impl Outlet for Host {
    fn workspace(&mut self) -> &mut Workspace {
        &mut self.workspace
    }
    fn record(&mut self, _: Time, _: Event) {}
    fn transmit(&mut self, _: Time, _: Datagram) {}
    fn plan(&mut self, _: Time, _: PlanJob) {}
    fn neighbours(&mut self, _: f64, _: &mut Vec<starl_motion::Neighbour>) {}
    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        let text = match observed {
            Observed::Started { random, .. } => format!("started {:x}", random.preview()),
            Observed::Corrupted { random } => format!("corrupted {:x}", random.preview()),
            Observed::Input { input, .. } => format!("{input:?}"),
        };
        self.seen.push((at, text));
    }
}

fn stream(key: u64) -> Random {
    Random::keyed(1, &[key])
}

fn agent(key: u64) -> Agent {
    Agent::new(Box::new(Idle), stream(key))
}

fn handle(node: &mut Node, host: &mut Host, at: u64, happening: NodeInput) {
    let hardware = Hardware {
        body: Body {
            radius: 0.1,
            height: 0.1,
            workspace: Place::Ground,
        },
        control_period: Duration::from_millis(100),
        drive: None,
    };
    let snapshot = Snapshot {
        hardware: &hardware,
        sensors: Sensors::default(),
        fleet: &[RobotId(0)],
        way_points: &[],
        obstacles: &[].into(),
    };
    node.handle(Time(at), happening, &snapshot, host);
}

#[test]
fn starts_corruption_and_restarts() {
    let mut host = Host::default();
    let mut node = Node::new(RobotId(0), Clock::default(), agent(1), Time::ZERO);
    handle(&mut node, &mut host, 0, NodeInput::Start);
    handle(&mut node, &mut host, 0, NodeInput::Timeout);
    node.corrupt(Time(5), &mut stream(2), &mut host);
    node.crash();
    // A robot that is down has no state that could be corrupted.
    node.corrupt(Time(6), &mut stream(3), &mut host);
    node.restart(Time(7), agent(4));
    // It is corrupted before it has started.
    node.corrupt(Time(8), &mut stream(5), &mut host);
    handle(&mut node, &mut host, 9, NodeInput::Start);
    let show = |what: &str, key: u64| format!("{what} {:x}", stream(key).preview());
    let expected = [
        (0, show("started", 1)),
        (0, "Start".into()),
        (0, "Activate".into()),
        (5, show("corrupted", 2)),
        (8, show("started", 4)),
        (8, show("corrupted", 5)),
        (9, "Start".into()),
    ];
    let seen: Vec<(u64, String)> = host
        .seen
        .into_iter()
        .map(|(at, text)| (at.0, text))
        .collect();
    assert_eq!(seen, expected);
}
