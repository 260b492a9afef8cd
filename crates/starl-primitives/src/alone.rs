//! A robot for tests of the parts of primitives.

use alloc::vec::Vec;
use starl_core::effect::{Effect, Effects};
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{Estimate, Random, Robot, RobotId, Sensors, Time, View};

/// Calls a part of a primitive on robot 0 of a fleet of three, at time 0; gives the effects.
pub fn alone(call: impl FnOnce(&mut Robot<'_>)) -> Vec<Effect> {
    let obstacles: Obstacles = [].into();
    let view = View {
        id: RobotId(0),
        now: Time::ZERO,
        estimate: Estimate::default(),
        body: Body {
            radius: 0.1,
            height: 0.2,
            workspace: Workspace::Ground,
        },
        sensors: Sensors::default(),
        fleet: &[RobotId(0), RobotId(1), RobotId(2)],
        way_points: &[],
        obstacles: &obstacles,
    };
    let (mut effects, mut random) = (Effects::default(), Random::keyed(0, &[]));
    call(&mut Robot::new(&view, &mut effects, &mut random));
    effects.list
}
