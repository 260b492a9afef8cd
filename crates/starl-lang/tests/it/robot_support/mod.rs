//! What the tests of programs on robots share: a small world of robots whose programs are driven by
//! hand, and whose network can be told what to do.

pub mod race;

use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::sensor::{Detection, Ray};
use starl_core::{
    Agent, Destination, Duration, Effect, Estimate, Event, Input, Message, MotionRequest, Payload,
    Point, Port, Pose, Random, RobotId, Sensors, Time, TimerKey, Value, View, WayPoint,
};
use starl_lang::machine::{self, assemble};
use starl_lang::robot::{Code, RobotProgram};
use std::collections::{BTreeMap, BTreeSet};

/// A program in the machine's text form, joined to robots.
pub fn load(text: &str) -> Code {
    let bytecode = assemble(text).unwrap_or_else(|error| panic!("{error}"));
    Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"))
}

/// A robot of the world.
pub struct Node {
    pub agent: Agent,
    pub position: Point,
    pub down: bool,
    pub finished: bool,
    pub failed: Option<String>,
    /// How often it was told to stop where it is.
    pub halts: u32,
    pub rays: Vec<Ray>,
    pub detections: Vec<Detection>,
    pub bumper: Option<starl_core::sensor::Contact>,
    timers: BTreeMap<TimerKey, Time>,
}

/// Robots on a floor, which are where they are told to go at once, and a network that delivers in a
/// millisecond.
pub struct World {
    pub now: Time,
    pub nodes: Vec<Node>,
    pub way_points: Vec<WayPoint>,
    pub obstacles: Obstacles,
    /// All events of all robots.
    pub records: Vec<(Time, RobotId, Event)>,
    /// Whether what is sent from the first robot to the second gets lost.
    pub loses: fn(u32, u32) -> bool,
    /// Nothing passes between robots of which these are the numbers.
    pub cut: BTreeSet<(u32, u32)>,
    /// How often datagrams are lost, and how often they arrive twice; both at random.
    pub loss: f64,
    pub duplication: f64,
    /// How long datagrams take, milliseconds; unequal ones reorder.
    pub delay_ms: (f64, f64),
    pub random: Random,
    /// How much faster than true time robots' own clocks run, as a share of it; 0 where nothing is said.
    pub clocks_drift: BTreeMap<usize, f64>,
    /// Everything that was handed to the network.
    pub sent: Vec<(RobotId, Destination, Port, Payload)>,
    fleet: Vec<RobotId>,
    /// Datagrams on their way, by their time and number.
    wire: BTreeMap<(Time, usize), (RobotId, Message)>,
    posted: usize,
    effects: Effects,
}

/// Between activations.
pub const PERIOD: Duration = Duration::from_millis(100);

impl World {
    /// Robots that run these programs, started.
    pub fn new(programs: Vec<RobotProgram>) -> World {
        let mut world = World::unstarted(programs);
        world.start();
        world
    }

    /// Robots that run this code with its parameters' defaults, started.
    pub fn of(code: &Code, robots: u32) -> World {
        World::new((0..robots).map(|_| program(code)).collect())
    }

    /// The same, where messages get lost, come twice, and take from 1 ms to this long.
    pub fn over_bad_network(code: &Code, robots: u32, seed: u64, longest_ms: f64) -> World {
        let mut world = World::of(code, robots);
        world.random = Random::keyed(seed, &[3]);
        world.loss = 0.2;
        world.duplication = 0.2;
        world.delay_ms = (1.0, longest_ms);
        world
    }

    pub fn unstarted(programs: Vec<RobotProgram>) -> World {
        let fleet: Vec<RobotId> = (0..programs.len() as u32).map(RobotId).collect();
        let nodes = programs.into_iter().zip(&fleet).map(|(program, id)| Node {
            agent: Agent::new(Box::new(program), Random::keyed(7, &[u64::from(id.0)])),
            position: Point::ZERO,
            down: false,
            finished: false,
            failed: None,
            halts: 0,
            rays: Vec::new(),
            detections: Vec::new(),
            bumper: None,
            timers: BTreeMap::new(),
        });
        World {
            now: Time::ZERO,
            nodes: nodes.collect(),
            way_points: Vec::new(),
            obstacles: [].into(),
            records: Vec::new(),
            loses: |_, _| false,
            cut: BTreeSet::new(),
            loss: 0.0,
            duplication: 0.0,
            delay_ms: (1.0, 1.0),
            random: Random::keyed(1, &[]),
            clocks_drift: BTreeMap::new(),
            sent: Vec::new(),
            fleet,
            wire: BTreeMap::new(),
            posted: 0,
            effects: Effects::default(),
        }
    }

    /// Puts way-points at these places, named `w0`, `w1` and so on.
    pub fn with_way_points(mut self, places: &[(f64, f64)]) -> World {
        let places = places.iter().enumerate();
        let way_points = places.map(|(index, &(x, y))| WayPoint {
            name: format!("w{index}"),
            position: Point::planar(x, y),
            group: 0,
        });
        self.way_points = way_points.collect();
        self
    }

    pub fn start(&mut self) {
        for robot in 0..self.nodes.len() {
            self.feed(robot, &Input::Start);
        }
    }

    /// The program of a robot.
    pub fn program(&self, robot: usize) -> &RobotProgram {
        let shown = self.nodes[robot].agent.program().inspect();
        shown
            .and_then(|any| any.downcast_ref())
            .expect("a StarL program")
    }

    /// A variable of a robot.
    pub fn get(&self, robot: usize, variable: &str) -> machine::Value {
        let program = self.program(robot);
        let value = program.code().program().get(program.state(), variable);
        value.unwrap_or_else(|| panic!("no variable {variable}"))
    }

    pub fn int(&self, robot: usize, variable: &str) -> i64 {
        match self.get(robot, variable) {
            machine::Value::Int(number) => number,
            other => panic!("{variable} is {other}"),
        }
    }

    /// Activates all robots once, and lets time go by until the next activation.
    pub fn step(&mut self) {
        let next = self.now + PERIOD;
        for robot in 0..self.nodes.len() {
            self.feed(robot, &Input::Estimate);
            self.feed(robot, &Input::Activate);
        }
        self.let_pass_until(next);
    }

    pub fn steps(&mut self, count: u32) {
        (0..count).for_each(|_| self.step());
    }

    /// Delivers and rings what is due before a time, which it becomes.
    pub fn let_pass_until(&mut self, until: Time) {
        loop {
            let mail = self.wire.keys().next().map_or(Time::NEVER, |key| key.0);
            let timers = self.nodes.iter().enumerate().flat_map(|(robot, node)| {
                node.timers.iter().map(move |(key, at)| (*at, robot, *key))
            });
            let timer = timers.min();
            let ring = timer.map_or(Time::NEVER, |(at, ..)| at);
            if mail.min(ring) >= until {
                break;
            }
            self.now = self.now.max(mail.min(ring));
            if mail <= ring {
                if let Some((_, (to, message))) = self.wire.pop_first() {
                    self.feed(to.index(), &Input::Message(message));
                }
            } else if let Some((_, robot, key)) = timer {
                self.nodes[robot].timers.remove(&key);
                self.feed(robot, &Input::Timer(key));
            }
        }
        self.now = until;
    }

    /// What a robot's own clock shows.
    fn own_time(&self, robot: usize) -> Time {
        match self.clocks_drift.get(&robot) {
            Some(drift) => Time((self.now.0 as f64 * (1.0 + drift)) as u64),
            None => self.now,
        }
    }

    /// Hands an input to a robot, if it is up, and does what it asks for.
    pub fn feed(&mut self, robot: usize, input: &Input) {
        let mut inputs = vec![input.clone()];
        while let Some(input) = inputs.pop() {
            let now = self.own_time(robot);
            let node = &mut self.nodes[robot];
            if node.down || node.failed.is_some() {
                return;
            }
            let view = View {
                id: self.fleet[robot],
                now,
                estimate: Estimate {
                    pose: Pose {
                        position: node.position,
                        ..Pose::default()
                    },
                    ..Estimate::default()
                },
                body: Body {
                    radius: 0.1,
                    height: 0.1,
                    workspace: Workspace::Ground,
                },
                sensors: Sensors {
                    bumper: node.bumper,
                    proximity: &node.rays,
                    detections: &node.detections,
                },
                fleet: &self.fleet,
                way_points: &self.way_points,
                obstacles: &self.obstacles,
            };
            node.agent.handle(&input, &view, &mut self.effects);
            for effect in std::mem::take(&mut self.effects.list) {
                self.carry_out(robot, effect, &mut inputs);
            }
        }
    }

    fn carry_out(&mut self, robot: usize, effect: Effect, inputs: &mut Vec<Input>) {
        let node = &mut self.nodes[robot];
        match effect {
            Effect::Transmit {
                destination,
                port,
                payload,
            } => self.transmit(robot, destination, port, payload),
            Effect::SetTimer { key, after } => {
                let pace = 1.0 + self.clocks_drift.get(&robot).unwrap_or(&0.0);
                let after = Duration((after.0 as f64 / pace) as u64);
                node.timers.insert(key, self.now + after);
            }
            Effect::CancelTimer(key) => {
                node.timers.remove(&key);
            }
            Effect::Move(MotionRequest::Plan(request)) => inputs.push(Input::Planned {
                ticket: request.ticket,
                path: Some(vec![request.target]),
            }),
            Effect::Move(MotionRequest::Track { target, .. }) => node.position = target,
            Effect::Move(MotionRequest::Halt) => node.halts += 1,
            Effect::Move(MotionRequest::Drive(_)) => {}
            Effect::Record(event) => self.records.push((self.now, RobotId(robot as u32), event)),
            Effect::Finish => node.finished = true,
            Effect::Fail(reason) => node.failed = Some(reason.into()),
        }
    }

    fn transmit(&mut self, robot: usize, destination: Destination, port: Port, payload: Payload) {
        let from = self.fleet[robot];
        self.sent.push((from, destination, port, payload.clone()));
        for &to in &self.fleet {
            let is_meant = match destination {
                Destination::All => to != from,
                Destination::Robot(robot) => to == robot,
            };
            let is_lost = (self.loses)(from.0, to.0)
                || self.cut.contains(&(from.0, to.0))
                || self.cut.contains(&(to.0, from.0));
            if !is_meant || is_lost {
                continue;
            }
            let copies = 1 + u32::from(self.random.chance(self.duplication));
            for _ in 0..copies {
                if self.random.chance(self.loss) {
                    continue;
                }
                let message = Message {
                    from,
                    port,
                    payload: payload.clone(),
                };
                self.posted += 1;
                let delay = self.random.between(self.delay_ms.0, self.delay_ms.1);
                let at = self.now + Duration::from_seconds_f64(delay / 1000.0);
                self.wire.insert((at, self.posted), (to, message));
            }
        }
    }

    /// The actions that a robot has fired.
    pub fn actions(&self, robot: u32) -> Vec<String> {
        let events = self.events_of(robot);
        events
            .filter_map(|event| match event {
                Event::Action(name) => Some(name.to_string()),
                _ => None,
            })
            .collect()
    }

    /// The events that a robot's program has emitted, with their fields.
    pub fn emitted(&self, robot: u32) -> Vec<(String, Vec<(String, Value)>)> {
        let events = self.events_of(robot);
        events
            .filter_map(|event| match event {
                Event::Program { name, fields } => {
                    let fields = fields.iter();
                    let fields = fields.map(|(name, value)| (name.to_string(), value.clone()));
                    Some((name.to_string(), fields.collect()))
                }
                _ => None,
            })
            .collect()
    }

    pub fn events_of(&self, robot: u32) -> impl Iterator<Item = &Event> {
        let own = self.records.iter().filter(move |(_, id, _)| id.0 == robot);
        own.map(|(_, _, event)| event)
    }
}

/// A program with its parameters' defaults.
pub fn program(code: &Code) -> RobotProgram {
    RobotProgram::new(code, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// A program from its source text.
#[cfg(feature = "compiler")]
pub fn compile(source: &str) -> Code {
    use starl_lang::check::{NoLibraries, check};
    let checked = check(source, &NoLibraries);
    let bytecode = starl_lang::compile::compile(&checked);
    let bytecode = bytecode.unwrap_or_else(|problems| panic!("{problems:#?}"));
    Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"))
}
