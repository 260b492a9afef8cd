//! Monitors the properties that a program declares during a simulation.

use starl_core::event::Name;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, WayPoint};
use starl_lang::machine::State;
use starl_lang::robot::properties::{Fleet, Judge, Standing};
use starl_lang::robot::{Code, RobotProgram};
use starl_properties::{Monitor, Violation, Witness};
use std::sync::Arc;

/// Watches the properties of one program on the robots that run it.
#[derive(Clone)]
pub struct ProgramMonitor {
    judge: Judge,
    /// The properties, as `Race.in_order`.
    names: Arc<[Name]>,
    robots: Arc<[RobotId]>,
}

impl ProgramMonitor {
    /// A monitor of a program that is called `qualifier` and that `robots` run, in ascending order;
    /// none if it has no properties.
    pub fn new(qualifier: &str, code: &Code, robots: Vec<RobotId>) -> Option<ProgramMonitor> {
        let judge = Judge::new(code);
        let properties = judge.properties().iter();
        let names: Vec<Name> = properties
            .map(|property| format!("{qualifier}.{}", property.name).into())
            .collect();
        (!names.is_empty()).then(|| ProgramMonitor {
            names: names.into(),
            robots: robots.into(),
            judge,
        })
    }
}

impl Monitor for ProgramMonitor {
    fn properties(&self) -> Vec<Name> {
        self.names.to_vec()
    }

    fn observe(&mut self, witness: &dyn Witness, violations: &mut Vec<Violation>) {
        let members = Members {
            witness,
            robots: &self.robots,
        };
        for mut found in self.judge.observe(witness.now(), &members) {
            found.robots.dedup();
            let place = found.place.iter().map(|place| format!("{place}: "));
            let text = place.chain([found.to_string()]).collect();
            violations.push(Violation {
                property: self.names[found.property].clone(),
                at: found.at,
                robots: found.robots,
                text,
            });
        }
    }

    fn is_open(&self, property: usize) -> bool {
        self.judge.standing(property) == Standing::Open
    }
}

/// The robots that run the program, in the simulation.
pub struct Members<'a> {
    pub witness: &'a dyn Witness,
    pub robots: &'a [RobotId],
}

impl Members<'_> {
    fn program(&self, robot: RobotId) -> Option<&RobotProgram> {
        self.witness.program(robot)?.downcast_ref()
    }
}

impl Fleet for Members<'_> {
    fn robots(&self) -> &[RobotId] {
        self.robots
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        let program = self.program(robot)?;
        program.has_started().then(|| program.state())
    }

    fn version(&self, robot: RobotId) -> Option<u64> {
        self.program(robot).map(RobotProgram::version)
    }

    fn pose(&self, robot: RobotId) -> Option<Pose> {
        self.witness.pose(robot)
    }

    fn velocity(&self, robot: RobotId) -> Option<Point> {
        self.witness.velocity(robot)
    }

    fn has_finished(&self, robot: RobotId) -> bool {
        self.witness.has_finished(robot)
    }

    fn is_up(&self, robot: RobotId) -> bool {
        self.witness.is_up(robot)
    }

    fn undisturbed(&self) -> Duration {
        self.witness.undisturbed()
    }

    fn uncorrupted(&self) -> Duration {
        self.witness.uncorrupted()
    }

    fn everyone(&self) -> Option<&[RobotId]> {
        Some(self.witness.robots())
    }

    fn way_points(&self) -> Option<&[WayPoint]> {
        Some(self.witness.way_points())
    }

    fn obstacles(&self) -> Option<Obstacles> {
        Some(self.witness.obstacles())
    }
}
