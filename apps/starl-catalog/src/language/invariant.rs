//! Judges a program's invariants in every state of an exploration.

use starl_core::event::Name;
use starl_core::motion::Obstacles;
use starl_core::{Point, Pose, RobotId, WayPoint};
use starl_explore::{Invariant, Scene};
use starl_lang::machine::{Claim, State};
use starl_lang::robot::properties::{Fleet, Judge};
use starl_lang::robot::{Code, RobotProgram};
use starl_primitives::SharedMemory;
use starl_properties::Violation;
use std::sync::Arc;

/// The `always` properties of one program on the robots that run it. Properties with deadlines or
/// responses do not apply to single states.
#[derive(Clone)]
pub struct ProgramInvariant {
    judge: Judge,
    /// The properties, as `Race.in_order`.
    names: Arc<[Name]>,
    robots: Arc<[RobotId]>,
}

impl ProgramInvariant {
    /// The properties of a program with the name `qualifier` on `robots`; none if it has no
    /// property that must always hold.
    pub fn new(qualifier: &str, code: &Code, robots: Vec<RobotId>) -> Option<ProgramInvariant> {
        let judge = Judge::new(code);
        let properties = judge.properties().iter();
        let names = properties
            .clone()
            .map(|property| format!("{qualifier}.{}", property.name).into());
        let names: Arc<[Name]> = names.collect();
        let mut claims = properties.map(|property| property.claim);
        let has_any = claims.any(|claim| matches!(claim, Claim::Always(_)));
        has_any.then(|| ProgramInvariant {
            names,
            robots: robots.into(),
            judge,
        })
    }
}

impl Invariant for ProgramInvariant {
    fn judge(&self, scene: &Scene<'_>, violations: &mut Vec<Violation>) {
        let members = Members {
            scene,
            robots: &self.robots,
        };
        // A judge without history: states are judged independently.
        let mut judge = self.judge.clone();
        for mut found in judge.observe(scene.now(), &members) {
            let claim = self.judge.properties().get(found.property);
            if !claim.is_some_and(|property| matches!(property.claim, Claim::Always(_))) {
                continue;
            }
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
}

/// The robots that run the program.
struct Members<'a> {
    scene: &'a Scene<'a>,
    robots: &'a [RobotId],
}

impl Members<'_> {
    fn program(&self, robot: RobotId) -> Option<&RobotProgram> {
        self.scene.program(robot)?.downcast_ref()
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

    fn pose(&self, robot: RobotId) -> Option<Pose> {
        self.scene.pose(robot)
    }

    fn velocity(&self, robot: RobotId) -> Option<Point> {
        self.scene.pose(robot).map(|_| Point::ZERO)
    }

    fn has_finished(&self, robot: RobotId) -> bool {
        self.scene.has_finished(robot)
    }

    fn is_up(&self, robot: RobotId) -> bool {
        self.scene.is_up(robot)
    }

    fn everyone(&self) -> Option<&[RobotId]> {
        Some(self.scene.robots())
    }

    fn way_points(&self) -> Option<&[WayPoint]> {
        Some(self.scene.way_points())
    }

    fn obstacles(&self) -> Option<Obstacles> {
        Some(self.scene.obstacles())
    }
}
