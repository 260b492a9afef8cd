//! Shared variables in programs: each is an instance of one of two kinds, and all of a program lie in
//! one memory.
//!
//! The writes of other robots arrive from the network. A value that does not have the variable's type counts as never
//! written.

use super::kind::{Kind, Member, method, query};
use crate::machine::{Block, Body, HostCall, Layout, List, Map, Object, ObjectType, Program, Type};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Payload, Random, Robot, RobotId};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::WriteError;

/// A shared variable. If `OF_EACH`, each robot writes an element of its own; otherwise all robots write one value.
#[derive(Clone)]
pub struct Shared<const OF_EACH: bool>;

/// A variable of which each robot writes an element of its own.
pub type SingleWriter = Shared<true>;

/// A variable that all robots write.
pub type MultiWriter = Shared<false>;

/// The consistency, none for the memory's own.
pub(super) const CONSISTENCY: &[Shape] = &[Shape::Optional(&Shape::Text)];

/// Has the memory do what the consistency asks for.
fn set_consistency(
    context: &mut Context<'_, '_>,
    arguments: &mut Arguments<'_>,
) -> Result<(), Cow<'static, str>> {
    match arguments.optional(Arguments::text) {
        None | Some("eventual") => Ok(()),
        Some("causal") => {
            let (memory, robot, variable) = memory(context)?;
            memory.make_causal(robot, variable);
            Ok(())
        }
        Some(other) => Err(alloc::format!("shared variables have no consistency `{other}`").into()),
    }
}

/// The memory, the robot, and the name of the variable that the call is about.
fn memory<'c, 'r>(
    context: &'c mut Context<'_, 'r>,
) -> Result<(&'c mut SharedMemory, &'c mut Robot<'r>, &'c str), Cow<'static, str>> {
    match (context.services.memory.as_deref_mut(), context.instance) {
        (Some(memory), Some(instance)) => Ok((memory, context.robot, &instance.variable)),
        _ => Err("the shared variable is not bound yet".into()),
    }
}

/// The last argument, a value of the variable's type, as bytes.
pub(super) fn value(
    context: &Context<'_, '_>,
    call: &HostCall<'_>,
) -> Result<Payload, Cow<'static, str>> {
    let kinds = call.import.arguments.get(1..).unwrap_or_default();
    let (scalars, objects) = Arguments::after_instance(call).rest();
    let bytes = context.code.program().encode(kinds, scalars, objects);
    bytes.ok_or("the value is of another type".into())
}

fn written<T>(result: Result<T, WriteError>) -> Called {
    match result {
        Ok(_) => Ok(10),
        Err(error) => Err(error.to_string().into()),
    }
}

/// Gives a value that was read, which is an optional: its scalars and objects.
pub(in crate::robot) fn give(
    program: &Program,
    call: &mut HostCall<'_>,
    bytes: &[Option<&[u8]>],
) -> Called {
    let [Type::Optional(kind)] = &call.import.results[..] else {
        return Err("what may be missing is read as an optional".into());
    };
    let kinds = core::slice::from_ref(&**kind);
    let mut candidates = bytes.iter().flatten();
    let found = candidates.find_map(|bytes| program.decode(kinds, bytes));
    call.scalars.fill(0);
    call.objects.fill(Object::EMPTY);
    let Some((scalars, objects)) = found else {
        return Ok(1);
    };
    let cost = 1 + (scalars.len() + objects.len()) as u64;
    call.set_bool(0, true);
    for (index, scalar) in scalars.into_iter().enumerate() {
        call.set_scalar(1 + index, scalar);
    }
    for (index, object) in objects.into_iter().enumerate() {
        call.set_object(index, object);
    }
    Ok(cost)
}

/// The written value of a multi-writer variable and the initial one: the first that is of the variable's type counts.
pub(in crate::robot) fn candidates<'m>(
    memory: &'m SharedMemory,
    variable: &str,
) -> [Option<&'m [u8]>; 2] {
    [memory.read(variable), memory.initial(variable)]
}

/// All elements that are known as a map.
pub(in crate::robot) fn give_all(
    program: &Program,
    memory: &SharedMemory,
    variable: &str,
    call: &mut HostCall<'_>,
) -> Called {
    let [Type::Object(index)] = call.import.results[..] else {
        return Err("all elements are read as a map".into());
    };
    let kind = program.bytecode().types.get(usize::from(index));
    let Some(ObjectType::Map(_, kind)) = kind else {
        return Err("all elements are read as a map".into());
    };
    let kinds = core::slice::from_ref(kind);
    let mut owners: Vec<RobotId> = Vec::new();
    let mut values = List::new(&Layout::of(kinds));
    for (owner, bytes) in memory.all(variable) {
        let Some((scalars, objects)) = program.decode(kinds, bytes) else {
            continue;
        };
        let block = Block {
            scalars: &scalars,
            objects: &objects,
        };
        if values.push(block) {
            owners.push(owner);
        }
    }
    let cost = 10 * owners.len() as u64;
    let map = match owners.is_empty() {
        true => Object::EMPTY,
        false => {
            let owners = owners.iter().map(|owner| u64::from(owner.0));
            Body::Map(Map::new(&List::of_scalars(owners.collect()), &values)).into()
        }
    };
    call.set_object(0, map);
    Ok(cost)
}

/// Shows its kind: the values lie in the services.
impl<const OF_EACH: bool> fmt::Debug for Shared<OF_EACH> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAME)
    }
}

impl<const OF_EACH: bool> Shared<OF_EACH> {
    const MEMBERS_OF_EACH: &[Member<Self>] = &[
        method("initialize", &[Shape::Any], None, |_, context, call| {
            let value = value(context, call)?;
            let (memory, robot, variable) = memory(context)?;
            memory.initialize_elements(robot, variable, value);
            Ok(10)
        }),
        method("write", &[Shape::Any], None, |_, context, call| {
            let value = value(context, call)?;
            let (memory, robot, variable) = memory(context)?;
            written(memory.write_own(robot, variable, value))
        }),
        query(
            "element",
            &[Shape::Robot],
            Shape::Optional(&Shape::Any),
            |_, context, call| {
                let robot = Arguments::after_instance(call).robot();
                let program = context.code.program();
                let (memory, _, variable) = memory(context)?;
                give(program, call, &[memory.read_of(variable, robot)])
            },
        ),
        query(
            "all",
            &[],
            Shape::Map(&Shape::Robot, &Shape::Any),
            |_, context, call| {
                let program = context.code.program();
                let (memory, _, variable) = memory(context)?;
                give_all(program, memory, variable, call)
            },
        ),
    ];

    const MEMBERS_OF_ALL: &[Member<Self>] = &[
        method("initialize", &[Shape::Any], None, |_, context, call| {
            let value = value(context, call)?;
            let (memory, robot, variable) = memory(context)?;
            memory.initialize(robot, variable, value);
            Ok(10)
        }),
        method("write", &[Shape::Any], None, |_, context, call| {
            let value = value(context, call)?;
            let (memory, robot, variable) = memory(context)?;
            written(memory.write(robot, variable, value))
        }),
        query(
            "read",
            &[],
            Shape::Optional(&Shape::Any),
            |_, context, call| {
                let program = context.code.program();
                let (memory, _, variable) = memory(context)?;
                give(program, call, &candidates(memory, variable))
            },
        ),
    ];
}

impl<const OF_EACH: bool> Kind for Shared<OF_EACH> {
    const NAME: &'static str = match OF_EACH {
        true => "SingleWriter",
        false => "MultiWriter",
    };
    const CONSTRUCTOR: &'static [Shape] = CONSISTENCY;
    const MEMBERS: &'static [Member<Self>] = match OF_EACH {
        true => Self::MEMBERS_OF_EACH,
        false => Self::MEMBERS_OF_ALL,
    };

    fn bind(
        _: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Self, Cow<'static, str>> {
        set_consistency(context, arguments)?;
        Ok(Shared)
    }

    const NEEDS: Needs = Needs {
        memory: true,
        ..Needs::NOTHING
    };

    /// Its values lie in the services.
    fn corrupt(&mut self, _: &mut Random) {}
}
