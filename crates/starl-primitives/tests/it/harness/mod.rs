//! A small deterministic host for tests: virtual time, robots that move along straight lines, and a
//! wire that loses, delays, duplicates and reorders datagrams. Everything follows from one seed.

pub mod counter;
pub mod crosser;
pub mod elector;
pub mod keeper;
pub mod locker;
pub mod pilot;
pub mod registrar;
pub mod sharer;
pub mod talker;
pub mod teller;
pub mod watcher;

use starl_core::effect::Effects;
use starl_core::event::{Name, Value};
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{
    Agent, Destination, Duration, Effect, Estimate, Event, Input, Message, MotionRequest, Payload,
    Point, Port, Pose, Program, Random, Robot, RobotId, Sensors, Time, Timer, TimerKey, View,
    WayPoint,
};
use std::collections::{BTreeMap, BTreeSet};

/// What the wire does to datagrams.
#[derive(Clone, Debug)]
pub struct Wire {
    pub loss: f64,
    pub duplication: f64,
    /// Uniform between these, milliseconds; unequal ones reorder.
    pub delay_ms: (u64, u64),
    /// Longer payloads are lost, bytes.
    pub longest: usize,
    /// Nothing passes from the first robot to the second.
    pub cut: BTreeSet<(u32, u32)>,
}

impl Wire {
    pub fn perfect() -> Wire {
        let cut = BTreeSet::new();
        Wire {
            loss: 0.0,
            duplication: 0.0,
            delay_ms: (1, 1),
            longest: usize::MAX,
            cut,
        }
    }

    /// Every datagram takes just so long.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn delayed(delay_ms: u64) -> Wire {
        Wire {
            delay_ms: (delay_ms, delay_ms),
            ..Wire::perfect()
        }
    }

    /// 30 % lost, 30 % twice, delays that reorder.
    pub fn bad() -> Wire {
        Wire {
            loss: 0.3,
            duplication: 0.3,
            delay_ms: (5, 400),
            ..Wire::perfect()
        }
    }

    pub fn longest_delay(&self) -> Duration {
        Duration::from_millis(self.delay_ms.1)
    }
}

/// Something that is to happen.
enum Occasion {
    Datagram {
        to: usize,
        message: Message,
    },
    Timer {
        robot: usize,
        key: TimerKey,
    },
    Activation {
        robot: usize,
    },
    Arrival {
        robot: usize,
        target: Point,
        trip: u32,
    },
}

struct Node {
    agent: Option<Agent>,
    position: Point,
    /// Metres per second.
    speed: f64,
    /// Where it goes.
    target: Option<Point>,
    /// When it was at `position`.
    since: Time,
    /// Counts changes of the target.
    trip: u32,
    timers: BTreeMap<TimerKey, Time>,
}

impl Node {
    fn new(id: usize) -> Node {
        Node {
            agent: None,
            position: Point::ZERO,
            speed: 0.3 + 0.1 * id as f64,
            target: None,
            since: Time::ZERO,
            trip: 0,
            timers: BTreeMap::new(),
        }
    }

    fn head_for(&mut self, target: Option<Point>) {
        self.target = target;
        self.trip += 1;
    }

    fn move_until(&mut self, now: Time) {
        if let Some(target) = self.target {
            let way = now.since(self.since).seconds() * self.speed;
            let left = self.position.distance(target);
            self.position = self
                .position
                .lerp(target, if way < left { way / left } else { 1.0 });
        }
        self.since = now;
    }
}

pub struct World {
    pub wire: Wire,
    pub now: Time,
    pub records: Vec<(Time, RobotId, Event)>,
    pub way_points: Vec<WayPoint>,
    /// How far robots' own clocks are ahead, nanoseconds.
    pub clocks_ahead: BTreeMap<u32, i64>,
    /// How much faster than true time robots' own clocks run, as a share of it.
    pub clocks_drift: BTreeMap<u32, f64>,
    /// Handed to the network.
    pub sent: usize,
    /// By port: how many datagrams, and to how many robots these went in all.
    pub traffic: BTreeMap<Port, (usize, usize)>,
    /// How long these were in all, and the longest, bytes.
    pub sent_bytes: usize,
    pub longest_sent: usize,
    /// All that is sent, if it is to be kept.
    pub payloads: Vec<Payload>,
    pub keep_payloads: bool,
    seed: u64,
    random: Random,
    queue: BTreeMap<(Time, u64), Occasion>,
    queued: u64,
    nodes: Vec<Node>,
    fleet: Vec<RobotId>,
    make: Box<dyn Fn() -> Box<dyn Program>>,
    period: Option<Duration>,
}

impl World {
    /// A fleet that starts at once at the origin; `period` is that of activations, if any.
    pub fn new(
        count: usize,
        seed: u64,
        wire: Wire,
        period: Option<Duration>,
        make: impl Fn() -> Box<dyn Program> + 'static,
    ) -> World {
        let mut world = World {
            wire,
            now: Time::ZERO,
            records: Vec::new(),
            way_points: Vec::new(),
            clocks_ahead: BTreeMap::new(),
            clocks_drift: BTreeMap::new(),
            sent: 0,
            traffic: BTreeMap::new(),
            sent_bytes: 0,
            longest_sent: 0,
            payloads: Vec::new(),
            keep_payloads: false,
            seed,
            random: Random::keyed(seed, &[0]),
            queue: BTreeMap::new(),
            queued: 0,
            nodes: Vec::new(),
            fleet: Vec::new(),
            make: Box::new(make),
            period,
        };
        world.nodes = (0..count).map(Node::new).collect();
        world.fleet = (0..count as u32).map(RobotId).collect();
        (0..count).for_each(|robot| world.start(robot));
        world
    }

    /// One more robot joins the fleet and starts.
    pub fn join(&mut self) {
        let robot = self.nodes.len();
        self.nodes.push(Node::new(robot));
        self.fleet.push(RobotId(robot as u32));
        self.start(robot);
    }

    /// Starts a robot, or starts it again: with a fresh program and its random stream from the start.
    pub fn start(&mut self, robot: usize) {
        let random = Random::keyed(self.seed, &[1, robot as u64]);
        self.nodes[robot].agent = Some(Agent::new((self.make)(), random));
        self.input(robot, &Input::Start);
        if self.period.is_some() {
            self.queue(Duration::ZERO, Occasion::Activation { robot });
        }
    }

    pub fn crash(&mut self, robot: usize) {
        self.nodes[robot].agent = None;
        self.nodes[robot].timers.clear();
    }

    /// For this span the network is in two parts, drawn at random.
    pub fn fall_apart(&mut self, random: &mut Random, span: Duration) {
        let side: Vec<bool> = self.fleet.iter().map(|_| random.chance(0.5)).collect();
        for from in 0..side.len() {
            for to in 0..side.len() {
                if side[from] != side[to] {
                    self.wire.cut.insert((from as u32, to as u32));
                }
            }
        }
        self.run_for(span);
        self.wire.cut.clear();
    }

    pub fn place(&mut self, robot: usize, position: Point) {
        self.nodes[robot].head_for(None);
        self.nodes[robot].position = position;
        self.input(robot, &Input::Estimate);
    }

    pub fn position(&self, robot: u32) -> Point {
        self.nodes[robot as usize].position
    }

    /// The program of a robot that is up.
    pub fn program(&self, robot: usize) -> Option<&dyn Program> {
        Some(self.nodes[robot].agent.as_ref()?.program())
    }

    /// The same, as what it is: tests look into their own programs.
    pub fn inspect<P: 'static>(&self, robot: usize) -> &P {
        let program = self.program(robot).expect("the robot is up");
        let program = program.inspect().and_then(|any| any.downcast_ref());
        program.expect("all robots run the same program")
    }

    pub fn corrupt(&mut self, robot: usize) {
        let mut random = Random::keyed(self.seed, &[2, robot as u64, self.now.0]);
        if let Some(agent) = &mut self.nodes[robot].agent {
            agent.corrupt(&mut random);
        }
    }

    /// Hands an input to a robot now.
    pub fn input(&mut self, robot: usize, input: &Input) {
        let node = &mut self.nodes[robot];
        node.move_until(self.now);
        let Some(agent) = &mut node.agent else { return };
        let obstacles: Obstacles = [].into();
        let ahead = self.clocks_ahead.get(&(robot as u32)).copied();
        let ahead = ahead.unwrap_or_default();
        let drift = self.clocks_drift.get(&(robot as u32)).copied();
        let own_time = match drift {
            None => self.now.0,
            Some(drift) => (self.now.0 as f64 * (1.0 + drift)) as u64,
        };
        let view = View {
            id: RobotId(robot as u32),
            now: Time(own_time.saturating_add_signed(ahead)),
            estimate: Estimate {
                pose: Pose::level(node.position, 0.0),
                ..Estimate::default()
            },
            body: Body {
                radius: 0.1,
                height: 0.2,
                workspace: Workspace::Ground,
            },
            sensors: Sensors::default(),
            fleet: &self.fleet,
            way_points: &self.way_points,
            obstacles: &obstacles,
        };
        let mut effects = Effects::default();
        agent.handle(input, &view, &mut effects);
        for effect in effects.list {
            self.effect(robot, effect);
        }
    }

    /// Tells the program of a robot to do something: see [`Talker`].
    pub fn command(&mut self, robot: usize, command: impl Timer) {
        let key = TimerKey::new(Port::PROGRAM, command);
        self.input(robot, &Input::Timer(key));
    }

    /// The first armed timer of a primitive fires now.
    pub fn time_out(&mut self, robot: usize, port: Port) {
        let mut armed = self.nodes[robot].timers.keys();
        let key = *armed.find(|key| key.port == port).expect("one is armed");
        self.nodes[robot].timers.remove(&key);
        self.input(robot, &Input::Timer(key));
    }

    pub fn run_for(&mut self, span: Duration) {
        let end = self.now + span;
        while let Some(entry) = self.queue.first_entry() {
            if entry.key().0 > end {
                break;
            }
            self.now = entry.key().0;
            let occasion = entry.remove();
            self.happen(occasion);
        }
        self.now = end;
    }

    /// Runs until this is so, and gives how long that took; none if it took longer than `most`. It is looked at
    /// when everything of a moment has happened.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn run_until(&mut self, most: Duration, done: impl Fn(&World) -> bool) -> Option<Duration> {
        let begun = self.now;
        while !done(self) {
            let (next, _) = *self.queue.first_key_value()?.0;
            if next > begun + most {
                return None;
            }
            self.run_for(next.since(self.now));
        }
        Some(self.now.since(begun))
    }

    /// How many datagrams the instances of this name have sent.
    pub fn sent_on(&self, name: &str) -> usize {
        self.traffic_on(name).0
    }

    /// How many datagrams these were, and to how many robots they went in all.
    pub fn traffic_on(&self, name: &str) -> (usize, usize) {
        let traffic = self.traffic.get(&Port::named(name));
        traffic.copied().unwrap_or_default()
    }

    /// How many robots there are, up or not.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// The number of timers that are armed on a robot.
    pub fn timers(&self, robot: usize) -> usize {
        self.nodes[robot].timers.len()
    }

    /// Events of primitives and programs under this name: when, where, and their fields.
    pub fn events(&self, wanted: &str) -> Vec<(Time, RobotId, BTreeMap<String, Value>)> {
        let matching = |(at, robot, event): &(Time, RobotId, Event)| match event {
            Event::Program { name, fields } | Event::Primitive { name, fields, .. }
                if name == wanted =>
            {
                let named = |(name, value): &(Name, Value)| (name.to_string(), value.clone());
                Some((*at, *robot, fields.iter().map(named).collect()))
            }
            _ => None,
        };
        self.records.iter().filter_map(matching).collect()
    }

    /// [`World::events`] with their places among the records instead of their times.
    pub fn indexed_events(&self, wanted: &str) -> Vec<(usize, RobotId, BTreeMap<String, Value>)> {
        let matching = |(index, (_, robot, event)): (usize, &(Time, RobotId, Event))| match event {
            Event::Program { name, fields } | Event::Primitive { name, fields, .. }
                if name == wanted =>
            {
                let named = |(name, value): &(Name, Value)| (name.to_string(), value.clone());
                Some((index, *robot, fields.iter().map(named).collect()))
            }
            _ => None,
        };
        self.records
            .iter()
            .enumerate()
            .filter_map(matching)
            .collect()
    }

    /// What [`Talker`]s received: sender, receiver and value, in the order of time.
    pub fn received(&self) -> Vec<(u32, u32, i64)> {
        let got = self.events("got");
        got.iter()
            .map(|(_, to, fields)| (robot(&fields["from"]), to.0, int(&fields["value"])))
            .collect()
    }

    fn happen(&mut self, occasion: Occasion) {
        match occasion {
            Occasion::Datagram { to, message } => self.input(to, &Input::Message(message)),
            Occasion::Timer { robot, key } => {
                if self.nodes[robot].timers.get(&key) == Some(&self.now) {
                    self.nodes[robot].timers.remove(&key);
                    self.input(robot, &Input::Timer(key));
                }
            }
            Occasion::Activation { robot } => {
                if self.nodes[robot].agent.is_some() {
                    self.input(robot, &Input::Activate);
                    self.queue(self.period.unwrap(), Occasion::Activation { robot });
                }
            }
            Occasion::Arrival {
                robot,
                target,
                trip,
            } => {
                if self.nodes[robot].trip == trip {
                    self.place(robot, target);
                }
            }
        }
    }

    fn effect(&mut self, robot: usize, effect: Effect) {
        match effect {
            Effect::Transmit {
                destination,
                port,
                payload,
            } => {
                self.sent += 1;
                self.sent_bytes += payload.len();
                self.longest_sent = self.longest_sent.max(payload.len());
                if self.keep_payloads {
                    self.payloads.push(payload.clone());
                }
                let from = RobotId(robot as u32);
                let traffic = self.traffic.entry(port).or_default();
                traffic.0 += 1;
                traffic.1 += match destination {
                    Destination::All => self.nodes.len() - 1,
                    Destination::Robot(_) => 1,
                };
                let message = Message {
                    from,
                    port,
                    payload,
                };
                match destination {
                    Destination::All => {
                        for to in (0..self.nodes.len()).filter(|&to| to != robot) {
                            self.carry(to, message.clone());
                        }
                    }
                    Destination::Robot(to) => self.carry(to.index(), message),
                }
            }
            Effect::SetTimer { key, after } => {
                let drift = self.clocks_drift.get(&(robot as u32)).copied();
                let after = match drift {
                    None => after,
                    Some(drift) => Duration::from_seconds_f64(after.seconds() / (1.0 + drift)),
                };
                self.nodes[robot].timers.insert(key, self.now + after);
                self.queue(after, Occasion::Timer { robot, key });
            }
            Effect::CancelTimer(key) => {
                self.nodes[robot].timers.remove(&key);
            }
            Effect::Move(MotionRequest::Plan(request)) => {
                let path = Some(vec![request.target]);
                self.input(
                    robot,
                    &Input::Planned {
                        ticket: request.ticket,
                        path,
                    },
                );
            }
            Effect::Move(MotionRequest::Track { target, .. }) => {
                let node = &mut self.nodes[robot];
                node.head_for(Some(target));
                let trip = node.trip;
                let after = Duration::from_seconds_f64(node.position.distance(target) / node.speed);
                self.queue(
                    after,
                    Occasion::Arrival {
                        robot,
                        target,
                        trip,
                    },
                );
            }
            Effect::Move(_) => self.nodes[robot].head_for(None),
            Effect::Record(event) => self.records.push((self.now, RobotId(robot as u32), event)),
            Effect::Finish => {
                self.records
                    .push((self.now, RobotId(robot as u32), Event::Finished));
            }
            Effect::Fail(reason) => panic!("robot {robot} failed: {reason}"),
        }
    }

    fn carry(&mut self, to: usize, message: Message) {
        let copies = 1 + u32::from(self.random.chance(self.wire.duplication));
        for _ in 0..copies {
            let lost = self.random.chance(self.wire.loss)
                || self.wire.cut.contains(&(message.from.0, to as u32))
                || message.payload.len() > self.wire.longest
                || to >= self.nodes.len();
            let (low, high) = self.wire.delay_ms;
            let delay = self.random.between(low as f64, high as f64) / 1000.0;
            if !lost {
                let message = message.clone();
                self.queue(
                    Duration::from_seconds_f64(delay),
                    Occasion::Datagram { to, message },
                );
            }
        }
    }

    fn queue(&mut self, after: Duration, occasion: Occasion) {
        self.queued += 1;
        self.queue.insert((self.now + after, self.queued), occasion);
    }
}

/// Calls a primitive on a robot of a fleet of two, at time 0 and at the origin; gives the effects.
pub fn alone(id: u32, call: impl FnOnce(&mut Robot<'_>)) -> Vec<Effect> {
    let obstacles: Obstacles = [].into();
    let view = View {
        id: RobotId(id),
        now: Time::ZERO,
        estimate: Estimate::default(),
        body: Body {
            radius: 0.1,
            height: 0.2,
            workspace: Workspace::Ground,
        },
        sensors: Sensors::default(),
        fleet: &[RobotId(0), RobotId(1)],
        way_points: &[],
        obstacles: &obstacles,
    };
    let (mut effects, mut random) = (Effects::default(), Random::keyed(0, &[]));
    call(&mut Robot::new(&view, &mut effects, &mut random));
    effects.list
}

pub fn int(value: &Value) -> i64 {
    match value {
        Value::Int(number) => *number,
        other => panic!("{other:?} is not a whole number"),
    }
}

pub fn robot(value: &Value) -> u32 {
    match value {
        Value::Robot(id) => id.0,
        other => panic!("{other:?} is not a robot"),
    }
}
