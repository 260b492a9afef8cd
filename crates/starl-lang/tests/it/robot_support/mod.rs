//! Common code of the tests of programs on robots: a small world of robots whose programs run step by step, with a
//! network under the test's control.

pub mod race;
pub mod seen;

use starl_core::{
    Agent, Duration, Event, Point, Port, Random, RobotId, Save, Saved, Time, Value, WayPoint,
};
use starl_host::testing::{Fleet, Unit, Wire};
use starl_host::{Store, StoreJob};
use starl_lang::machine::{self, assemble};
use starl_lang::robot::{Code, RobotProgram};
use std::ops::{Deref, DerefMut};

/// A program in the machine's text form, joined to robots.
pub fn load(text: &str) -> Code {
    let bytecode = assemble(text).unwrap_or_else(|error| panic!("{error}"));
    Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"))
}

/// Robots on a floor that move instantly, get their estimate before each activation, and have a network that delivers
/// in a millisecond.
#[derive(Clone)]
pub struct World(Fleet);

impl Deref for World {
    type Target = Fleet;

    fn deref(&self) -> &Fleet {
        &self.0
    }
}

impl DerefMut for World {
    fn deref_mut(&mut self) -> &mut Fleet {
        &mut self.0
    }
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

    /// The same with a network that loses and duplicates messages, and delays them from 1 ms to this time.
    pub fn over_bad_network(code: &Code, robots: u32, seed: u64, longest_ms: u64) -> World {
        let mut world = World::of(code, robots);
        world.random = Random::keyed(seed, &[3]);
        world.wire.loss = 0.2;
        world.wire.duplication = 0.2;
        world.wire.delay_ms = (1, longest_ms);
        world
    }

    /// One robot that runs this code, with storage that holds this. A write takes 1 ms.
    pub fn on_storage(code: &Code, saved: Saved) -> World {
        let mut store = Store::default();
        let saves = saved.of(Port::PROGRAM).map(|(key, value)| Save {
            port: Port::PROGRAM,
            key: key.to_string().into(),
            value: Some(value.into()),
        });
        let saves = saves.collect();
        store.begin(Time::ZERO, StoreJob { job: 0, saves }, Duration::ZERO);
        store.finish();
        let mut world = World::with(vec![program(code)], Some(store));
        world.write_time = Duration::from_millis(1);
        world.start();
        world
    }

    pub fn unstarted(programs: Vec<RobotProgram>) -> World {
        World::with(programs, None)
    }

    fn with(programs: Vec<RobotProgram>, store: Option<Store>) -> World {
        let mut fleet = Fleet::new(1, Wire::perfect());
        fleet.positioning = Some(PERIOD);
        for (program, id) in programs.into_iter().zip((0..).map(RobotId)) {
            let saved = store.as_ref().map(Store::saved);
            let agent = agent(program, id.index()).with_saved(saved);
            let mut unit = Unit::new(id, agent).with_period(PERIOD);
            unit.store.clone_from(&store);
            fleet.add(unit);
        }
        World(fleet)
    }

    /// Puts waypoints at these positions, named `w0`, `w1` and so on.
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
        for robot in 0..self.robots.len() {
            self.0.start(robot);
        }
    }

    /// Starts a robot again, with a fresh copy of this program.
    pub fn restart(&mut self, robot: usize, program: RobotProgram) {
        self.0.restart(robot, agent(program, robot));
    }

    /// Moves a robot; it gets its new estimate before its activation.
    pub fn put(&mut self, robot: usize, position: Point) {
        let now = self.now;
        self.robots[robot].travel.place(now, position);
    }

    /// The program of a robot.
    pub fn program(&self, robot: usize) -> &RobotProgram {
        let shown = self.robots[robot].node.program().inspect();
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
        self.run_before(next);
    }

    pub fn steps(&mut self, count: u32) {
        (0..count).for_each(|_| self.step());
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

fn agent(program: RobotProgram, robot: usize) -> Agent {
    Agent::new(Box::new(program), Random::keyed(7, &[robot as u64]))
}

/// A program with its parameters' defaults.
pub fn program(code: &Code) -> RobotProgram {
    RobotProgram::new(code, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// A program from its source text.
pub fn compile(source: &str) -> Code {
    use starl_lang::check::{NoLibraries, check};
    let checked = check(source, &NoLibraries);
    let bytecode = starl_lang::compile::compile(&checked);
    let bytecode = bytecode.unwrap_or_else(|problems| panic!("{problems:#?}"));
    Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"))
}
