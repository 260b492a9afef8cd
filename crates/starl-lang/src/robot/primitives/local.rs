//! LocalBroadcast in programs.

use super::kind::{Attention, Kind, Member, method};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use starl_core::{Primitive, Random};
use starl_primitives::LocalBroadcast;

impl Kind for LocalBroadcast {
    const NAME: &'static str = "LocalBroadcast";

    const CONSTRUCTOR: &'static [Shape] = &[Shape::Optional(&Shape::Text)];

    const MEMBERS: &'static [Member<LocalBroadcast>] = &[method(
        "broadcast",
        &[Shape::Message],
        None,
        |radio, context, call| {
            let payload = context.message(&mut Arguments::after_instance(call))?;
            radio.broadcast(context.robot, payload);
            Ok(1)
        },
    )];

    const ATTENTION: Attention = Attention::NONE;

    fn bind(
        instance: &Instance,
        _: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<LocalBroadcast, Cow<'static, str>> {
        let name = arguments.optional(Arguments::text);
        Ok(LocalBroadcast::new(name.unwrap_or(&instance.name)))
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    /// It keeps nothing.
    fn corrupt(&mut self, _: &mut Random) {}
}
