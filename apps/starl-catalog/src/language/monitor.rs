//! Monitors the properties that a program declares during a simulation.

use starl_core::event::Name;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, Time, WayPoint};
use starl_lang::machine::State;
use starl_lang::robot::properties::{Excuse, Fleet, Judge, Standing};
use starl_lang::robot::{Code, RobotProgram};
use starl_primitives::SharedMemory;
use starl_properties::{Monitor, Violation, Witness};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The fleet and the waypoints that programs know.
type Known = (Arc<[RobotId]>, Arc<[WayPoint]>);

/// Watches the properties of one program on the robots that run it.
#[derive(Clone)]
pub struct ProgramMonitor {
    judge: Judge,
    /// The properties, as `Race.in_order`; the last one is that of the checks, if there are any.
    names: Arc<[Name]>,
    robots: Arc<[RobotId]>,
    /// The robots of which a check was false although no fault had overwritten variables.
    unsound: BTreeSet<RobotId>,
    /// The fleet and its waypoints at the start. Where an operator changes them checks may be false.
    first: Option<Known>,
}

impl ProgramMonitor {
    /// A monitor of a program that is called `qualifier` and that `robots` run, in ascending order;
    /// none if it has no properties.
    pub fn new(qualifier: &str, code: &Code, robots: Vec<RobotId>) -> Option<ProgramMonitor> {
        let judge = Judge::new(code);
        let properties = judge.properties().iter();
        let mut names: Vec<Name> = properties
            .map(|property| format!("{qualifier}.{}", property.name).into())
            .collect();
        if code.has_checks() {
            names.push(format!("{qualifier}.checks").into());
        }
        (!names.is_empty()).then(|| ProgramMonitor {
            names: names.into(),
            robots: robots.into(),
            judge,
            unsound: BTreeSet::new(),
            first: None,
        })
    }

    /// A monitor of the one property of `code`, which says when the goal of a run is reached; its name is `goal`, after
    /// the qualifier if there is one.
    pub fn of_goal(qualifier: Option<&str>, code: &Code, robots: Vec<RobotId>) -> ProgramMonitor {
        let name: Name = match qualifier {
            Some(qualifier) => format!("{qualifier}.goal").into(),
            None => "goal".into(),
        };
        ProgramMonitor {
            judge: Judge::new(code),
            names: [name].into(),
            robots: robots.into(),
            unsound: BTreeSet::new(),
            first: None,
        }
    }

    /// As long as no fault has overwritten variables, no check is false.
    fn judge_checks(&mut self, members: &Members<'_>, violations: &mut Vec<Violation>) {
        let now = members.witness.now();
        let has_checks = self.names.len() > self.judge.properties().len();
        let is_corrupted = members.witness.uncorrupted() < now.since(Time::ZERO);
        let Some(property) = self.names.last().filter(|_| has_checks && !is_corrupted) else {
            return;
        };
        let witness = members.witness;
        let (robots, way_points) = self
            .first
            .get_or_insert_with(|| (witness.robots().into(), witness.way_points().into()));
        for robot in self.robots.iter().copied() {
            let program = members.program(robot);
            if !self.unsound.contains(&robot)
                && let Some(place) = program.and_then(RobotProgram::failed_check)
                && **robots == *witness.robots()
                && **way_points == *witness.way_points()
            {
                self.unsound.insert(robot);
                violations.push(Violation {
                    property: property.clone(),
                    at: now,
                    robots: Vec::from([robot]),
                    text: format!(
                        "robot {robot}: the check at {place} was false although no fault had overwritten \
                         variables, and the program started again"
                    ),
                });
            }
        }
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
        let robots = Arc::clone(&self.robots);
        let members = Members {
            witness,
            robots: &robots,
        };
        self.judge_checks(&members, violations);
    }

    fn is_open(&self, property: usize) -> bool {
        self.judge.standing(property) == Standing::Open
    }

    fn excused(&self, property: usize) -> Vec<(starl_properties::Excuse, u64)> {
        let excused = self.judge.excused(property);
        let named = |(excuse, count)| match excuse {
            Excuse::Down => (starl_properties::Excuse::Down, count),
            Excuse::Corruption => (starl_properties::Excuse::Corruption, count),
            Excuse::Recovery => (starl_properties::Excuse::Recovery, count),
            Excuse::Assumption => (starl_properties::Excuse::Assumption, count),
        };
        excused.map(named).collect()
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

    fn memory(&self, robot: RobotId) -> Option<&SharedMemory> {
        self.program(robot).and_then(RobotProgram::memory)
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

    fn target(&self, robot: RobotId) -> Option<Point> {
        self.program(robot).and_then(RobotProgram::target)
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
