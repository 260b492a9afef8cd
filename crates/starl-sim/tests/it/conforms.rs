//! The simulator passes the suite of all hosts.

use crate::engine_support::{exact_delay, scenario};
use starl_core::{Duration, FaultKind, Program, Record, RobotId, Time};
use starl_host::Clock;
use starl_host::testing::conformance::{DELAY, Fleet, Host, Need, PERIOD, Probe, TICK, WRITE_TIME};
use starl_sim::engine::Complaint;
use starl_sim::scenario::{self, Fault, Group, Scenario};
use starl_sim::{Simulation, scenario::Positioning};

/// A simulation has its faults in its scenario. So this notes what is done to it, and runs when it is asked what has
/// happened.
struct Simulator {
    robots: Vec<Probe>,
    clock: Clock,
    has_storage: bool,
    faults: Vec<Fault>,
    now: Time,
}

impl Simulator {
    fn fault(&mut self, kind: FaultKind) {
        let at = self.now;
        self.faults.push(Fault { at, kind });
    }

    fn scenario(&self) -> Scenario {
        let places: Vec<(f64, f64)> = (0..self.robots.len())
            .map(|robot| (0.0, 5.0 * robot as f64))
            .collect();
        let mut scenario = scenario("create", &places);
        exact_delay(&mut scenario, DELAY.0 / 1_000_000);
        let all = scenario.fleet.groups.remove(0);
        let group = |(robot, start)| Group {
            program: format!("{robot}"),
            starts: vec![start],
            control_period: PERIOD,
            clock: scenario::Clock {
                offset: Duration(self.clock.offset as u64),
                drift_ppm: (self.clock.rate - 1.0) * 1e6,
            },
            ..all.clone()
        };
        scenario.fleet.groups = all.starts.iter().copied().enumerate().map(group).collect();
        scenario.physics.step = TICK;
        scenario.positioning = Positioning {
            period: PERIOD,
            ..scenario.positioning
        };
        scenario.storage = scenario::Storage {
            kept: self.has_storage,
            write_time: WRITE_TIME,
            loss: 0.0,
        };
        scenario.faults.schedule = self.faults.clone();
        scenario
    }
}

impl Host for Simulator {
    const LACKS: &'static [(Need, &'static str)] = &[(Need::Stalls, "a simulator is never late")];

    fn start(fleet: Fleet) -> Simulator {
        let Fleet {
            robots,
            clock,
            has_storage,
        } = fleet;
        Simulator {
            robots,
            clock,
            has_storage,
            faults: Vec::new(),
            now: Time::ZERO,
        }
    }

    fn run_before(&mut self, end: Time) {
        self.now = end;
    }

    fn crash(&mut self, robot: RobotId) {
        self.fault(FaultKind::Crash(vec![robot]));
    }

    fn restart(&mut self, robot: RobotId) {
        self.fault(FaultKind::Restart(vec![robot]));
    }

    fn corrupt(&mut self, robot: RobotId) {
        self.fault(FaultKind::CorruptState(vec![robot]));
    }

    fn stall(&mut self, _: Time) {
        unreachable!("a simulator is never late");
    }

    fn records(&self) -> Vec<Record> {
        let program = |group: &Group| -> Result<Box<dyn Program>, Complaint> {
            let robot: usize = group.program.parse().expect("a number");
            Ok(self.robots[robot].clone().boxed())
        };
        let mut simulation = Simulation::new(self.scenario(), &program).expect("it starts");
        simulation.set_recording(true);
        let mut records = Vec::new();
        while simulation.now() < self.now {
            simulation.step();
            records.extend_from_slice(simulation.records());
        }
        records
    }
}

starl_host::conformance!(
    Simulator,
    skip a_late_host_activates_once = "a simulator is never late",
);
