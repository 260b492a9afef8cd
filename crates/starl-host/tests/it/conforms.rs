//! The host in memory passes the suite of all hosts.

use starl_core::{Agent, Program, Random, Record, RobotId, Time};
use starl_host::Store;
use starl_host::testing::conformance::{DELAY, Fleet, Host, Need, PERIOD, TICK, WRITE_TIME};
use starl_host::testing::{self, Unit, Wire};

struct Memory {
    fleet: testing::Fleet,
    programs: Vec<Box<dyn Program>>,
}

impl Memory {
    fn agent(&self, robot: usize) -> Agent {
        Agent::new(
            self.programs[robot].clone(),
            Random::keyed(1, &[robot as u64]),
        )
    }
}

impl Host for Memory {
    const LACKS: &'static [(Need, &'static str)] = &[];

    fn start(wanted: Fleet) -> Memory {
        let Fleet {
            robots,
            clock,
            has_storage,
        } = wanted;
        let mut fleet = testing::Fleet::new(1, Wire::delayed(DELAY.0 / 1_000_000));
        fleet.positioning = Some(PERIOD);
        fleet.planning = TICK;
        fleet.write_time = WRITE_TIME;
        let programs = robots.into_iter().map(|probe| probe.boxed()).collect();
        let mut host = Memory { fleet, programs };
        for robot in 0..host.programs.len() {
            let store = has_storage.then(Store::default);
            let saved = store.as_ref().map(Store::saved);
            let agent = host.agent(robot).with_saved(saved);
            let mut unit = Unit::new(RobotId(robot as u32), agent);
            unit.store = store;
            host.fleet.add(unit.with_period(PERIOD).with_clock(clock));
        }
        host
    }

    fn run_before(&mut self, end: Time) {
        self.fleet.run_before(end);
    }

    fn crash(&mut self, robot: RobotId) {
        self.fleet.crash(robot.index());
    }

    fn restart(&mut self, robot: RobotId) {
        let agent = self.agent(robot.index());
        self.fleet.restart(robot.index(), agent);
    }

    fn corrupt(&mut self, robot: RobotId) {
        self.fleet
            .corrupt(robot.index(), &mut Random::keyed(1, &[7]));
    }

    fn stall(&mut self, end: Time) {
        self.fleet.stall(end.since(self.fleet.now));
    }

    fn records(&self) -> Vec<Record> {
        let records = self.fleet.records.iter();
        let record = |(at, robot, event): &(Time, RobotId, _)| Record {
            at: *at,
            robot: Some(*robot),
            event: Clone::clone(event),
        };
        records.map(record).collect()
    }
}

starl_host::conformance!(Memory);
