//! One robot in an exploration: its software, timers and clock, and the effect of an input.
//!
//! Invariant: [`Local::write`] writes everything that the robot's future depends on, so that two robots of one number
//! that write the same text answer every input alike.

use crate::bounds::Clocks;
use crate::model::{Member, Model};
use crate::step::Datagram;
use crate::texts::fingerprint;
use starl_core::event::Fault;
use starl_core::random::hash_key;
use starl_core::{
    Agent, Destination, Duration, Estimate, Event, Input, Message, MotionRequest, Port, Random,
    RobotId, Saved, Sensors, Time, TimerKey,
};
use starl_host::{
    Clock, Hardware, Node, NodeInput as Call, Outlet, PlanJob, Snapshot, StoreJob, Workspace,
};
use starl_motion::Neighbour;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::sync::Arc;

/// A robot's state.
#[derive(Clone)]
pub(crate) struct Local {
    pub node: Node,
    /// Ticks of its clock.
    pub clock: u64,
    /// Counts its starts.
    life: u64,
    /// The content of its storage, if it has one. A write takes no time: a crash before its end undoes the input that caused
    /// it, so it is a crash before this input.
    saved: Option<Arc<Saved>>,
    /// The hash of its history in this life, if its program does not write its state.
    history: u128,
}

/// An input of one robot.
#[derive(Clone, Debug)]
pub(crate) enum RobotInput {
    Activate,
    Timer(TimerKey),
    Message(Message),
    Tick,
    Crash,
    Restart,
    Suspect(RobotId),
    Trust(RobotId),
}

/// The result of a turn.
pub(crate) struct Turn {
    pub local: Local,
    pub sent: Vec<Datagram>,
    pub events: Vec<Event>,
    /// How often it asked to move. Motion requests are ignored here.
    pub motions: u64,
}

/// The inputs of a robot's turn besides its own state.
#[derive(Clone)]
pub(crate) struct Surroundings {
    pub model: Model,
    pub fleet: Vec<RobotId>,
    pub clocks: Clocks,
    /// By robot.
    hardware: Vec<Hardware>,
}

impl Surroundings {
    pub fn new(model: Model, clocks: Clocks) -> Surroundings {
        let fleet = model.fleet();
        let hardware = |member: &Member| Hardware {
            body: member.body,
            control_period: Duration::ZERO,
            drive: None,
        };
        let hardware = model.members.iter().map(hardware).collect();
        Surroundings {
            model,
            fleet,
            clocks,
            hardware,
        }
    }

    fn tick(&self) -> Duration {
        match self.clocks {
            Clocks::Still => Duration::ZERO,
            Clocks::Ticking { tick, .. } => tick,
        }
    }

    /// The time of a clock after this number of ticks.
    pub fn time(&self, ticks: u64) -> Time {
        Time::ZERO + self.tick() * ticks
    }

    /// The tick at which a clock that shows this time or later has got there; 0 where clocks stand still.
    fn ticks(&self, at: Time) -> u64 {
        match self.tick().0 {
            0 => 0,
            tick => at.0.div_ceil(tick),
        }
    }

    /// The software of a robot for one of its lives.
    fn agent(&self, robot: RobotId, life: u64) -> Agent {
        let program = self.model.members[robot.index()].program.clone();
        Agent::new(
            program,
            Random::keyed(self.model.seed, &[u64::from(robot.0), life]),
        )
    }
}

impl Local {
    /// A robot that starts for the first time.
    pub fn start(robot: RobotId, surroundings: &Surroundings) -> Turn {
        let agent = surroundings.agent(robot, 0);
        let mut local = Local {
            node: Node::new(robot, Clock::default(), agent, Time::ZERO),
            clock: 0,
            life: 0,
            saved: surroundings.model.keeps_storage.then(Arc::default),
            history: 0,
        };
        local.node.crash();
        local.turn(&RobotInput::Restart, surroundings)
    }

    /// The result of an event.
    pub fn turn(&self, happening: &RobotInput, surroundings: &Surroundings) -> Turn {
        let mut turn = Turn {
            local: self.clone(),
            sent: Vec::new(),
            events: Vec::new(),
            motions: 0,
        };
        match happening {
            RobotInput::Activate => turn.feed(Input::Activate, surroundings),
            RobotInput::Timer(key) => turn.feed(Input::Timer(*key), surroundings),
            RobotInput::Message(message) => {
                turn.feed(Input::Message(message.clone()), surroundings);
            }
            RobotInput::Suspect(peer) => turn.feed(Input::Suspected(*peer), surroundings),
            RobotInput::Trust(peer) => turn.feed(Input::Trusted(*peer), surroundings),
            RobotInput::Tick => turn.local.clock += 1,
            RobotInput::Crash => turn.crash(),
            RobotInput::Restart => turn.start(surroundings),
        }
        turn
    }

    /// The robot's number.
    pub fn robot(&self) -> RobotId {
        self.node.id()
    }

    /// Whether it is up.
    pub fn is_up(&self) -> bool {
        !self.node.condition().down
    }

    /// Whether it is up and its program can continue.
    pub fn runs(&self) -> bool {
        self.node.runs()
    }

    /// Whether it runs and its program has not reached its goal.
    pub fn is_waiting(&self) -> bool {
        self.runs() && !self.node.condition().finished
    }

    /// The armed timers in the order of their keys, with the ticks at which they are due.
    pub fn timers(&self, surroundings: &Surroundings) -> Vec<(TimerKey, u64)> {
        let armed = self.node.timers().iter();
        let mut timers: Vec<_> = armed
            .map(|(at, key)| (key, surroundings.ticks(at)))
            .collect();
        timers.sort_unstable();
        timers
    }

    /// Whether a timer is due that must fire before the clock advances.
    pub fn is_due(&self, surroundings: &Surroundings) -> bool {
        let silent: &BTreeSet<Port> = &surroundings.model.silent;
        let is_due = |(at, key): (Time, TimerKey)| {
            !silent.contains(&key.port) && surroundings.ticks(at) <= self.clock
        };
        self.runs() && self.node.timers().iter().any(is_due)
    }

    /// Writes everything that its future depends on.
    pub fn write(&self, surroundings: &Surroundings, text: &mut String) {
        let Local {
            node,
            clock,
            life,
            saved,
            history,
        } = self;
        let (robot, timers) = (node.id(), self.timers(surroundings));
        let condition = node.condition();
        // Writing to a text cannot fail.
        let _ = write!(text, "{robot} {clock} {life} {condition:?} {timers:?} ");
        if let Some(saved) = saved {
            let _ = write!(text, "{saved:?} ");
        }
        if self.is_up() && !node.agent().write_state(text) {
            let _ = write!(text, "{history:x}");
        }
    }
}

impl Turn {
    fn start(&mut self, surroundings: &Surroundings) {
        let local = &mut self.local;
        if local.life > 0 {
            self.events.push(Event::Fault(Fault::Restart));
        }
        let agent = surroundings.agent(local.robot(), local.life);
        let agent = agent.with_saved(local.saved.clone());
        let now = surroundings.time(local.clock);
        local.node.restart(now, agent);
        local.life += 1;
        local.history = u128::from(hash_key(local.life, &[local.clock]));
        self.call(Call::Start, &Input::Start, surroundings);
        self.call(Call::Located, &Input::Estimate, surroundings);
    }

    fn crash(&mut self) {
        self.local.node.crash();
        self.local.history = 0;
        self.events.push(Event::Fault(Fault::Crash));
    }

    fn feed(&mut self, input: Input, surroundings: &Surroundings) {
        self.call(Call::Input(input.clone()), &input, surroundings);
    }

    /// Calls the robot's node, which hands its software this input.
    fn call(&mut self, call: Call, input: &Input, surroundings: &Surroundings) {
        let Local {
            node,
            clock,
            saved,
            history,
            ..
        } = &mut self.local;
        let model = &surroundings.model;
        let robot = node.id();
        let mut wire = Wire {
            robot,
            fleet: &surroundings.fleet,
            sent: &mut self.sent,
            events: &mut self.events,
            motions: &mut self.motions,
            saved,
            written: None,
            workspace: Workspace::default(),
        };
        if node.runs() {
            *history = fingerprint(&format!("{history:x} {clock} {input:?}"));
        }
        let now = surroundings.time(*clock);
        let estimate = Estimate {
            pose: model.members[robot.index()].pose,
            ..Estimate::default()
        };
        let snapshot = Snapshot {
            hardware: &surroundings.hardware[robot.index()],
            sensors: Sensors::default(),
            fleet: &surroundings.fleet,
            way_points: &model.way_points,
            obstacles: &model.obstacles,
        };
        node.locate(now, estimate, &mut wire);
        node.handle(now, call, &snapshot, &mut wire);
        while let Some(job) = wire.written.take() {
            node.handle(now, Call::Stored { job }, &snapshot, &mut wire);
        }
    }
}

/// Where a robot's node leaves what comes of a turn.
struct Wire<'a> {
    robot: RobotId,
    fleet: &'a [RobotId],
    sent: &'a mut Vec<Datagram>,
    events: &'a mut Vec<Event>,
    motions: &'a mut u64,
    saved: &'a mut Option<Arc<Saved>>,
    /// The write that was just done.
    written: Option<u32>,
    workspace: Workspace,
}

impl Outlet for Wire<'_> {
    fn workspace(&mut self) -> &mut Workspace {
        &mut self.workspace
    }

    /// Robots stand still and know their positions; the network records datagrams.
    fn record(&mut self, _: Time, event: Event) {
        if !matches!(event, Event::Estimated(_) | Event::Sent { .. }) {
            self.events.push(event);
        }
    }

    fn transmit(&mut self, _: Time, datagram: starl_host::Datagram) {
        let starl_host::Datagram {
            destination,
            message,
            ..
        } = datagram;
        let is_meant = |to: &RobotId| match destination {
            Destination::All => *to != self.robot,
            Destination::Robot(robot) => *to == robot,
        };
        let receivers = self.fleet.iter().copied().filter(is_meant);
        self.sent.extend(receivers.map(|to| Datagram {
            from: message.from,
            to,
            port: message.port,
            payload: message.payload.to_vec(),
        }));
    }

    fn store(&mut self, _: Time, job: StoreJob) {
        let saved = Arc::make_mut(self.saved.get_or_insert_default());
        job.saves.into_iter().for_each(|save| saved.apply(save));
        self.written = Some(job.job);
    }

    fn plan(&mut self, _: Time, _: PlanJob) {
        *self.motions += 1;
    }

    fn neighbours(&mut self, _: f64, _: &mut Vec<Neighbour>) {}

    fn request_motion(&mut self, _: Time, _: &MotionRequest) {
        *self.motions += 1;
    }
}
