//! Registration in programs.

use super::kind::{Kind, Member, flag, method, query};
use crate::machine::{HostCall, Object};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::Shape;
use crate::robot::workbench::robots;
use alloc::borrow::Cow;
use alloc::format;
use starl_core::{Primitive, Random, Robot};
use starl_primitives::Registration;
use starl_primitives::registration::Options;

impl Kind for Registration {
    const NAME: &'static str = "Registration";

    /// The name by which instances find each other.
    const CONSTRUCTOR: &'static [Shape] = &[Shape::Text];

    const MEMBERS: &'static [Member<Registration>] = &[
        method(
            "register",
            &[Shape::Optional(&Shape::Area)],
            None,
            |registration, context, call| {
                let area = Arguments::after_instance(call).optional(Arguments::area);
                let area = area.transpose()?.cloned();
                registration.register(context.robot, area);
                Ok(10)
            },
        ),
        method("unregister", &[], None, |registration, context, _| {
            registration.unregister(context.robot);
            Ok(10)
        }),
        query(
            "members",
            &[],
            Shape::Optional(&Shape::Set(&Shape::Robot)),
            |registration, _, call| give_members(registration, call),
        ),
        query(
            "agreed_at",
            &[],
            Shape::Optional(&Shape::Time),
            |registration, _, call| {
                call.set_optional(0, registration.agreed_at().map(|time| time.0));
                Ok(0)
            },
        ),
        flag!("failed", Registration::failed),
    ];

    const NEEDS: Needs = Needs::DETECTOR;

    fn bind(
        _: &Instance,
        _: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Registration, Cow<'static, str>> {
        let name = format!("registration/{}", arguments.text());
        Ok(Registration::new(&name, Options::default()))
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        Registration::corrupt(self, random);
    }

    fn reset(&mut self, robot: &mut Robot<'_>) {
        self.unregister(robot);
    }
}

fn give_members(registration: &Registration, call: &mut HostCall<'_>) -> Called {
    let members = registration.members();
    call.set_bool(0, members.is_some());
    let Some(members) = members else {
        call.set_object(0, Object::EMPTY);
        return Ok(1);
    };
    call.set_object(0, robots(members.iter().copied()));
    Ok(1 + members.len() as u64)
}
