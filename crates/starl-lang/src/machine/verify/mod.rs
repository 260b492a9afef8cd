//! The verifier: bytecode that passes is safe to run, whatever its origin.
//!
//! It checks that all indices are in range and that functions are called with the registers that they need. It also
//! checks that every register is written before it is read, that every object has the type that the instruction needs
//! ([`flow`]), and that guards and properties change nothing. The meaning of scalars is not checked: any 64 bits are a
//! valid Int, Float or Bool.

mod collections;
mod flow;
mod objects;
mod rules;

use crate::machine::bytecode::{Bytecode, Claim, Function, FunctionKind, Origin};
use crate::machine::error::LoadError;
use crate::machine::interpreter::workspace::{OBJECT_WINDOW, WINDOW};
use crate::machine::operand::FIRST_STATE_OPERAND;
use crate::machine::types::{DEEPEST_TYPE, Layout, ObjectType, Parts, Type};
use alloc::vec::Vec;

/// The deepest that records and optionals may be nested within a type.
const DEEPEST_VALUE: u32 = 32;

/// Facts from the verifier that the machine needs.
pub(in crate::machine) struct Tables {
    pub parts: Vec<Parts>,
    pub state: Layout,
    pub arguments: Vec<Layout>,
    pub results: Vec<Layout>,
    pub imports: Vec<(Layout, Layout)>,
}

/// A rule that is broken somewhere outside the code.
pub(in crate::machine) fn invalid(reason: &'static str) -> LoadError {
    LoadError::Invalid {
        position: None,
        reason,
    }
}

fn check(holds: bool, reason: &'static str) -> Result<(), LoadError> {
    if holds { Ok(()) } else { Err(invalid(reason)) }
}

/// Checks all of a program.
pub(in crate::machine) fn verify(bytecode: &Bytecode) -> Result<Tables, LoadError> {
    check(
        bytecode.code.len() < u32::MAX as usize,
        "there are too many instructions",
    )?;
    let starts = bytecode.spans.iter().map(|(first, _)| *first);
    check(
        starts.clone().is_sorted_by(|left, right| left < right)
            && starts
                .max()
                .is_none_or(|last| (last as usize) < bytecode.code.len()),
        "spans are not in ascending order or beyond the code",
    )?;
    check(
        (bytecode.files.iter()).all(|file| file.lines.is_sorted_by(|left, right| left < right)),
        "the lines of a file are not in ascending order",
    )?;
    object_types(bytecode)?;
    for variable in &bytecode.variables {
        value_type(bytecode, &variable.kind, bytecode.types.len(), 0)?;
    }
    let tables = Tables {
        parts: (bytecode.types.iter())
            .map(|object| Parts::of(object, &bytecode.types))
            .collect(),
        state: Layout::of(bytecode.variables.iter().map(|v| &v.kind)),
        arguments: layouts(bytecode, bytecode.functions.iter().map(|f| &f.arguments))?,
        results: layouts(bytecode, bytecode.functions.iter().map(|f| &f.results))?,
        imports: layouts(bytecode, bytecode.imports.iter().map(|i| &i.arguments))?
            .into_iter()
            .zip(layouts(
                bytecode,
                bytecode.imports.iter().map(|i| &i.results),
            )?)
            .collect(),
    };
    functions(bytecode, &tables)?;
    entry_points(bytecode)?;
    for function in &bytecode.functions {
        flow::check(bytecode, &tables, function)?;
    }
    Ok(tables)
}

/// Object types refer to earlier ones and are not nested too deeply; blocks fit into windows.
fn object_types(bytecode: &Bytecode) -> Result<(), LoadError> {
    check(
        bytecode.types.len() < usize::from(u16::MAX),
        "there are too many types",
    )?;
    let mut depths: Vec<u32> = Vec::new();
    for (index, object) in bytecode.types.iter().enumerate() {
        let parts: Vec<&Type> = match object {
            ObjectType::Text | ObjectType::Area | ObjectType::Obstacles => Vec::new(),
            ObjectType::List(element) | ObjectType::Set(element) => Vec::from([element]),
            ObjectType::Map(key, value) => Vec::from([key, value]),
        };
        for part in &parts {
            value_type(bytecode, part, index, 0)?;
        }
        let layout = Layout::of(parts.iter().copied());
        check_width(&layout)?;
        let deepest = layout.objects.iter().map(|&part| depths[usize::from(part)]);
        let depth = 1 + deepest.max().unwrap_or(0);
        check(depth <= DEEPEST_TYPE, "a type is nested too deeply")?;
        depths.push(depth);
    }
    Ok(())
}

/// A type of values: its enums exist and its objects are among the first `objects`.
fn value_type(
    bytecode: &Bytecode,
    kind: &Type,
    objects: usize,
    depth: u32,
) -> Result<(), LoadError> {
    check(depth < DEEPEST_VALUE, "a type is nested too deeply")?;
    match kind {
        Type::Enum(index) => check(
            usize::from(*index) < bytecode.enums.len(),
            "there is no such enum",
        ),
        Type::Object(index) => check(
            usize::from(*index) < objects,
            "an object type refers to itself, a later one or none",
        ),
        Type::Optional(value) => value_type(bytecode, value, objects, depth + 1),
        Type::Record(fields) => fields
            .iter()
            .try_for_each(|(_, field)| value_type(bytecode, field, objects, depth + 1)),
        _ => Ok(()),
    }
}

fn check_width(layout: &Layout) -> Result<(), LoadError> {
    check(
        layout.scalars.len() < WINDOW && layout.objects.len() < OBJECT_WINDOW,
        "a value has too many parts for the registers",
    )
}

fn layouts<'a>(
    bytecode: &Bytecode,
    lists: impl Iterator<Item = &'a Vec<Type>>,
) -> Result<Vec<Layout>, LoadError> {
    lists
        .map(|types| {
            for kind in types {
                value_type(bytecode, kind, bytecode.types.len(), 0)?;
            }
            let layout = Layout::of(types);
            check_width(&layout)?;
            Ok(layout)
        })
        .collect()
}

/// Functions cover the code one after the other and have room for arguments and results.
fn functions(bytecode: &Bytecode, tables: &Tables) -> Result<(), LoadError> {
    let mut next = 0;
    for (index, function) in bytecode.functions.iter().enumerate() {
        check(
            function.entry == next && function.end > function.entry,
            "functions do not follow one another",
        )?;
        next = function.end;
        check(
            usize::from(function.registers) <= WINDOW
                && usize::from(function.object_registers) <= OBJECT_WINDOW
                && function.object_registers <= FIRST_STATE_OPERAND,
            "a function has too many registers",
        )?;
        for layout in [&tables.arguments[index], &tables.results[index]] {
            check(
                layout.scalars.len() <= usize::from(function.registers)
                    && layout.objects.len() <= usize::from(function.object_registers),
                "a function has too few registers for its arguments or results",
            )?;
        }
    }
    check(
        next as usize == bytecode.code.len(),
        "functions do not cover the code",
    )
}

/// Entry points are functions of the right kind, arguments and results.
fn entry_points(bytecode: &Bytecode) -> Result<(), LoadError> {
    for start in [bytecode.defaults, bytecode.start].into_iter().flatten() {
        let start = function(bytecode, start, FunctionKind::Procedure)?;
        check(
            start.arguments.is_empty() && start.results.is_empty(),
            "the start has arguments or results",
        )?;
    }
    for action in &bytecode.actions {
        let guard = function(bytecode, action.guard, FunctionKind::Guard)?;
        let effect = function(bytecode, action.effect, FunctionKind::Procedure)?;
        check(guard.arguments.is_empty(), "a guard has arguments")?;
        check(
            guard.results.split_first() == Some((&Type::Bool, &effect.arguments[..])),
            "a guard's bindings are not the effect's arguments",
        )?;
        let mut atomic = action.atomic.iter();
        check(
            atomic.all(|&instance| (instance as usize) < bytecode.primitives.len()),
            "an action waits for a primitive that there is not",
        )?;
        for time in [action.hold, action.every].into_iter().flatten() {
            let time = function(bytecode, time, FunctionKind::Guard)?;
            check(
                time.arguments.is_empty() && time.results == [Type::Bool, Type::Duration],
                "an action's time is not a Duration",
            )?;
        }
    }
    check(
        bytecode.actions.is_sorted_by_key(|action| !action.is_check),
        "a check comes after other actions",
    )?;
    for handler in &bytecode.handlers {
        let procedure = function(bytecode, handler.function, FunctionKind::Procedure)?;
        match &handler.origin {
            Origin::Message => {}
            Origin::Primitive(primitive) => check(
                (*primitive as usize) < bytecode.primitives.len(),
                "there is no such primitive",
            )?,
            Origin::Input(fields) => check(
                fields.len() == procedure.arguments.len(),
                "an input has other fields than its handler",
            )?,
        }
    }
    for property in &bytecode.properties {
        let (first, second) = match property.claim {
            Claim::Always(holds)
            | Claim::Eventually { holds, .. }
            | Claim::EventuallyAlways { holds, .. } => (holds, None),
            Claim::LeadsTo {
                cause, consequence, ..
            } => (cause, Some(consequence)),
        };
        for index in [Some(first), second, property.assumption]
            .into_iter()
            .flatten()
        {
            let claim = function(bytecode, index, FunctionKind::Property)?;
            check(
                claim.arguments.len() == usize::from(property.robots)
                    && claim.arguments.iter().all(|kind| *kind == Type::Robot)
                    && claim.results == [Type::Bool],
                "a property does not take robots and give a Bool",
            )?;
        }
    }
    Ok(())
}

fn function(bytecode: &Bytecode, index: u32, kind: FunctionKind) -> Result<&Function, LoadError> {
    match bytecode.functions.get(index as usize) {
        Some(function) if function.kind == kind => Ok(function),
        Some(_) => Err(invalid("an entry point is of the wrong kind")),
        None => Err(invalid("there is no such function")),
    }
}
