//! Barrier in programs.

use super::kind::{Kind, Member, flag, method};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use alloc::format;
use starl_core::{Primitive, Random};
use starl_primitives::Barrier;
use starl_primitives::barrier::Options;

impl Kind for Barrier {
    const NAME: &'static str = "Barrier";

    /// The name of the barrier, and the robots that must arrive: all, if none are given.
    const CONSTRUCTOR: &'static [Shape] =
        &[Shape::Text, Shape::Optional(&Shape::Set(&Shape::Robot))];

    const MEMBERS: &'static [Member<Barrier>] = &[
        method("arrive", &[], None, |barrier, context, _| {
            barrier.arrive(context.robot);
            Ok(10)
        }),
        flag!("passed", Barrier::passed),
        flag!("failed", Barrier::failed),
    ];

    const NEEDS: Needs = Needs::DETECTOR;

    fn bind(
        _: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Barrier, Cow<'static, str>> {
        let name = format!("barrier/{}", arguments.text());
        let participants = arguments.participants(context.robot).flatten();
        Ok(Barrier::new(&name, participants, Options::default()))
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        Barrier::corrupt(self, random);
    }
}
