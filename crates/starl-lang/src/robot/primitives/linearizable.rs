//! Linearizable variables in programs: instances of a kind of their own, whose values lie in registers
//! ([`crate::robot::atomic`]).
//!
//! An action with `atomic` reads the latest values. Its guard is first evaluated on the values that this robot knows,
//! which may be older or missing.

use super::kind::{Kind, Member, method, query};
use super::shared::{CONSISTENCY, give, value};
use crate::robot::arguments::Arguments;
use crate::robot::atomic::{self, Atomic};
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use starl_core::{Payload, Random};

/// A variable that all robots write, one after the other.
#[derive(Clone, Debug)]
pub struct Linearizable {
    /// The value before any write.
    initial: Option<Payload>,
}

/// The values, and the names of the variable's group and of the variable.
fn place<'c>(
    context: &'c mut Context<'_, '_>,
) -> Result<(&'c mut Atomic, &'c str, &'c str), Cow<'static, str>> {
    match (context.services.atomic.as_deref_mut(), context.instance) {
        (Some(atomic), Some(instance)) => Ok((atomic, &instance.group, &instance.variable)),
        _ => Err("the shared variable is not bound yet".into()),
    }
}

impl Kind for Linearizable {
    const NAME: &'static str = atomic::KIND;
    const CONSTRUCTOR: &'static [Shape] = CONSISTENCY;
    const MEMBERS: &'static [Member<Linearizable>] = &[
        method("initialize", &[Shape::Any], None, |own, context, call| {
            own.initial = Some(value(context, call)?);
            Ok(10)
        }),
        method("write", &[Shape::Any], None, |_, context, call| {
            let value = value(context, call)?;
            let (atomic, group, variable) = place(context)?;
            match atomic.set(group, variable, value) {
                true => Ok(10),
                false => Err("a linearizable variable is written by actions with `atomic`".into()),
            }
        }),
        query(
            "read",
            &[],
            Shape::Optional(&Shape::Any),
            |own, context, call| {
                let program = context.code.program();
                let (atomic, group, variable) = place(context)?;
                let written = atomic.value(group, variable);
                give(program, call, &[written.as_deref(), own.initial.as_deref()])
            },
        ),
    ];

    const NEEDS: Needs = Needs {
        atomic: true,
        ..Needs::DETECTOR
    };

    fn bind(
        _: &Instance,
        _: &mut Context<'_, '_>,
        _: &mut Arguments<'_>,
    ) -> Result<Linearizable, Cow<'static, str>> {
        Ok(Linearizable { initial: None })
    }

    /// Its values lie in the services.
    fn corrupt(&mut self, _: &mut Random) {}
}
