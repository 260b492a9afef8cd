//! Programs for the tests of primitives, and the fleets that run them.

pub mod counter;
pub mod crosser;
pub mod elector;
pub mod keeper;
pub mod late;
pub mod locker;
pub mod pilot;
pub mod registrar;
pub mod sharer;
pub mod storm;
pub mod talker;
pub mod teller;
pub mod watcher;

use starl_core::effect::Effects;
use starl_core::event::Value;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{
    Agent, Destination, Duration, Effect, Estimate, Event, Input, Payload, Port, Program, Random,
    Robot, RobotId, Sensors, Time, Timer, TimerKey, View,
};
use starl_host::testing::Unit;
pub use starl_host::testing::{Fleet, Wire};
use starl_host::{Clock, Store};
use std::ops::{Deref, DerefMut};

/// A fleet of robots that run the same program and move along straight lines.
pub struct World {
    fleet: Fleet,
    seed: u64,
    make: Box<dyn Fn() -> Box<dyn Program>>,
    period: Duration,
    has_storage: bool,
}

impl Deref for World {
    type Target = Fleet;

    fn deref(&self) -> &Fleet {
        &self.fleet
    }
}

impl DerefMut for World {
    fn deref_mut(&mut self) -> &mut Fleet {
        &mut self.fleet
    }
}

impl World {
    /// Of five robots two fail for ever, at a moment soon after the start and as the seed says; gives the others.
    pub fn lose_two_early(&mut self, seed: u64) -> Vec<usize> {
        let lost = [0, seed as usize % 4 + 1];
        self.run_for(Duration::from_millis(20 + 37 * seed));
        for robot in lost {
            self.crash(robot);
        }
        self.run_for(Duration::from_seconds(20));
        (0..5).filter(|robot| !lost.contains(robot)).collect()
    }

    /// A fleet that starts at once at the origin; `period` is that of activations, if any.
    pub fn new(
        count: usize,
        seed: u64,
        wire: Wire,
        period: Option<Duration>,
        make: impl Fn() -> Box<dyn Program> + 'static,
    ) -> World {
        World::made(count, seed, wire, period, Box::new(make), false)
    }

    /// The same with storage, which takes five milliseconds for a write.
    pub fn with_storage(
        count: usize,
        seed: u64,
        wire: Wire,
        period: Option<Duration>,
        make: impl Fn() -> Box<dyn Program> + 'static,
    ) -> World {
        let mut world = World::made(count, seed, wire, period, Box::new(make), true);
        world.write_time = Duration::from_millis(5);
        world
    }

    fn made(
        count: usize,
        seed: u64,
        wire: Wire,
        period: Option<Duration>,
        make: Box<dyn Fn() -> Box<dyn Program>>,
        has_storage: bool,
    ) -> World {
        let mut world = World {
            fleet: Fleet::new(seed, wire),
            seed,
            make,
            period: period.unwrap_or_default(),
            has_storage,
        };
        for _ in 0..count {
            world.add();
        }
        (0..count).for_each(|robot| world.begin(robot));
        world
    }

    fn agent(&self, robot: usize) -> Agent {
        let random = Random::keyed(self.seed, &[1, robot as u64]);
        Agent::new((self.make)(), random)
    }

    /// One more robot joins the fleet.
    pub fn add(&mut self) -> usize {
        let robot = self.robots.len();
        let store = self.has_storage.then(Store::default);
        let saved = store.as_ref().map(Store::saved);
        let agent = self.agent(robot).with_saved(saved);
        let mut unit = Unit::new(RobotId(robot as u32), agent);
        unit.store = store;
        let speed = 0.3 + 0.1 * robot as f64;
        self.fleet
            .add(unit.with_speed(speed).with_period(self.period))
    }

    /// A robot of the fleet starts for the first time.
    pub fn begin(&mut self, robot: usize) {
        self.fleet.start(robot);
    }

    /// One more robot joins the fleet and starts.
    pub fn join(&mut self) {
        let robot = self.add();
        self.begin(robot);
    }

    /// Starts a robot again: with a fresh program and its random stream from the start.
    pub fn start(&mut self, robot: usize) {
        let agent = self.agent(robot);
        self.fleet.restart(robot, agent);
    }

    /// Erases the storage of a robot that is down.
    pub fn lose_storage(&mut self, robot: usize) {
        if let Some(store) = &mut self.robots[robot].store {
            store.crash(true);
        }
    }

    /// Sets a robot's clock ahead by this number of nanoseconds.
    pub fn set_clock_ahead(&mut self, robot: usize, nanoseconds: i64) {
        let node = &mut self.robots[robot].node;
        let offset = nanoseconds;
        node.set_clock(Clock {
            offset,
            ..node.clock()
        });
    }

    /// A robot's clock runs faster than true time by this share of it.
    pub fn set_clock_drift(&mut self, robot: usize, drift: f64) {
        let node = &mut self.robots[robot].node;
        let rate = 1.0 + drift;
        node.set_clock(Clock {
            rate,
            ..node.clock()
        });
    }

    /// For this span the network is in two parts, drawn at random.
    pub fn fall_apart(&mut self, random: &mut Random, span: Duration) {
        let side: Vec<bool> = self.robots.iter().map(|_| random.chance(0.5)).collect();
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

    /// Advances time by this span. No program fails.
    pub fn run_for(&mut self, span: Duration) {
        self.fleet.run_for(span);
        for robot in 0..self.size() {
            assert_eq!(self.failure(robot), None, "robot {robot} failed");
        }
    }

    /// The program of a robot that is up.
    pub fn program(&self, robot: usize) -> Option<&dyn Program> {
        let node = &self.robots[robot].node;
        (!node.condition().down).then(|| node.program())
    }

    /// The same with its concrete type, for inspection by tests.
    pub fn inspect<P: 'static>(&self, robot: usize) -> &P {
        let program = self.program(robot).expect("the robot is up");
        let program = program.inspect().and_then(|any| any.downcast_ref());
        program.expect("all robots run the same program")
    }

    pub fn corrupt(&mut self, robot: usize) {
        let mut random = Random::keyed(self.seed, &[2, robot as u64, self.now.0]);
        self.fleet.corrupt(robot, &mut random);
    }

    /// Sends a command to the program of a robot: see [`Talker`].
    pub fn command(&mut self, robot: usize, command: impl Timer) {
        let key = TimerKey::new(Port::PROGRAM, command);
        self.input(robot, &Input::Timer(key));
    }

    /// The first armed timer of a primitive fires now.
    pub fn time_out(&mut self, robot: usize, port: Port) {
        let armed = self.robots[robot].node.timers().iter();
        let key = armed.map(|(_, key)| key).filter(|key| key.port == port);
        let key = key.min().expect("one is armed");
        self.input(robot, &Input::Timer(key));
    }

    /// How many datagrams were sent.
    pub fn sent_count(&self) -> usize {
        self.sent().count()
    }

    /// How long these were in all, bytes.
    pub fn sent_bytes(&self) -> usize {
        self.sent().map(|sent| sent.payload.len()).sum()
    }

    /// The contents of all datagrams that were sent.
    pub fn payloads(&self) -> Vec<Payload> {
        self.payloads_from(0)
    }

    /// The contents of the datagrams sent after this number of records.
    pub fn payloads_from(&self, records: usize) -> Vec<Payload> {
        let records = self.records[records..].iter();
        let payloads = records.filter_map(|(_, _, event)| match event {
            Event::Sent { payload, .. } => Some(payload.clone()),
            _ => None,
        });
        payloads.collect()
    }

    /// How many datagrams the instances of this name have sent.
    pub fn sent_on(&self, name: &str) -> usize {
        self.traffic_on(name).0
    }

    /// How many datagrams these were, and to how many robots they went in all.
    pub fn traffic_on(&self, name: &str) -> (usize, usize) {
        let port = Port::named(name);
        let sent = self.sent().filter(|sent| sent.port == port);
        sent.fold((0, 0), |(datagrams, receivers), sent| {
            let count = match sent.destination {
                Destination::All => self.size() - 1,
                Destination::Robot(_) => 1,
            };
            (datagrams + 1, receivers + count)
        })
    }

    /// How many robots there are, up or not.
    pub fn size(&self) -> usize {
        self.robots.len()
    }

    /// The number of timers that are armed on a robot.
    pub fn timers(&self, robot: usize) -> usize {
        self.robots[robot].node.timers().iter().count()
    }

    /// The values that [`Talker`]s received: sender, receiver and value, in the order of time.
    pub fn received(&self) -> Vec<(u32, u32, i64)> {
        let got = self.events("got");
        got.iter()
            .map(|(_, to, fields)| (robot(&fields["from"]), to.0, int(&fields["value"])))
            .collect()
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
