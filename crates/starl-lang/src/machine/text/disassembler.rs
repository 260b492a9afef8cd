//! Writes a program in the machine's text form, which a person can read and
//! [`assemble`](crate::machine::assemble) reads back.

use crate::machine::bytecode::{Bytecode, Claim, Function, FunctionKind, Origin, Parameter};
use crate::machine::instruction::Instruction;
use crate::machine::operand::Use;
use crate::machine::types::Type;
use alloc::collections::BTreeSet;
use alloc::string::String;
use core::fmt::{self, Write};

/// The text form of bytecode.
pub fn disassemble(bytecode: &Bytecode) -> String {
    let mut out = String::new();
    let written = declarations(&mut out, bytecode).and_then(|()| {
        bytecode
            .functions
            .iter()
            .try_for_each(|f| function(&mut out, bytecode, f))
    });
    debug_assert!(written.is_ok(), "writing into a String does not fail");
    out
}

fn declarations(out: &mut String, bytecode: &Bytecode) -> fmt::Result {
    if !bytecode.name.is_empty() {
        writeln!(out, "program {}", bytecode.name)?;
    }
    for file in &bytecode.files {
        write!(out, "file {:?}", file.name)?;
        file.lines
            .iter()
            .try_for_each(|line| write!(out, " {line}"))?;
        writeln!(out)?;
    }
    for declared in &bytecode.enums {
        write!(out, "enum {}", declared.name)?;
        words(out, &declared.variants)?;
    }
    for (index, kind) in bytecode.types.iter().enumerate() {
        writeln!(out, "type {kind} // type{index}")?;
    }
    for (index, &bits) in bytecode.constants.iter().enumerate() {
        constant(out, bits)?;
        writeln!(out, " // c{index}")?;
    }
    for text in &bytecode.texts {
        writeln!(out, "text {text:?}")?;
    }
    for variable in &bytecode.variables {
        let declared = match variable.parameter {
            Parameter::No if variable.is_stable => "stable",
            Parameter::No => "variable",
            Parameter::Optional => "parameter",
            Parameter::Required => "required",
        };
        write!(out, "{declared} {} {}", variable.name, variable.kind)?;
        if let Some(range) = variable.range {
            write!(out, " in {:#x} {:#x}", range.from, range.before)?;
        }
        writeln!(out)?;
    }
    for import in &bytecode.imports {
        let query = if import.query { " query" } else { "" };
        write!(out, "import {}{query} ", import.name)?;
        types(out, &import.arguments)?;
        out.write_str(" ")?;
        types(out, &import.results)?;
        if !import.labels.is_empty() {
            out.write_str(" labels")?;
        }
        words(out, &import.labels)?;
    }
    for primitive in &bytecode.primitives {
        writeln!(out, "primitive {} {}", primitive.name, primitive.kind)?;
    }
    entry_points(out, bytecode)
}

fn entry_points(out: &mut String, bytecode: &Bytecode) -> fmt::Result {
    if let Some(defaults) = bytecode.defaults {
        writeln!(out, "defaults f{defaults}")?;
    }
    if let Some(start) = bytecode.start {
        writeln!(out, "start f{start}")?;
    }
    for action in &bytecode.actions {
        let (name, guard, effect) = (&action.name, action.guard, action.effect);
        let word = if action.is_check { "check" } else { "action" };
        write!(out, "{word} {name} f{guard} f{effect}")?;
        for (word, time) in [("hold", action.hold), ("every", action.every)] {
            if let Some(time) = time {
                write!(out, " {word} f{time}")?;
            }
        }
        for (number, instance) in action.atomic.iter().enumerate() {
            write!(
                out,
                "{} {instance}",
                if number == 0 { " atomic" } else { "" }
            )?;
        }
        writeln!(out)?;
    }
    for handler in &bytecode.handlers {
        write!(out, "handler {}", handler.event)?;
        let function = handler.function;
        match &handler.origin {
            Origin::Message => writeln!(out, " f{function}")?,
            Origin::Primitive(primitive) => {
                writeln!(out, " primitive {primitive} f{function}")?;
            }
            Origin::Input(fields) => {
                write!(out, " input f{function}")?;
                for field in fields {
                    write!(out, " {field}")?;
                }
                writeln!(out)?;
            }
        }
    }
    for property in &bytecode.properties {
        write!(out, "property {} {} ", property.name, property.robots)?;
        let within = match property.claim {
            Claim::Always(holds) => {
                write!(out, "always f{holds}")?;
                None
            }
            Claim::Eventually { holds, within } => {
                write!(out, "eventually f{holds}")?;
                within
            }
            Claim::EventuallyAlways { holds, within } => {
                write!(out, "eventually_always f{holds}")?;
                within
            }
            Claim::LeadsTo {
                cause,
                consequence,
                within,
            } => {
                write!(out, "leads_to f{cause} f{consequence}")?;
                within
            }
        };
        if let Some(within) = within {
            write!(out, " within {within}")?;
        }
        if let Some(assumption) = property.assumption {
            write!(out, " assuming f{assumption}")?;
        }
        if let Some(recovery) = property.recovery {
            write!(out, " recovers {recovery}")?;
        }
        if property.is_despite_crashes {
            write!(out, " despite_crashes")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn function(out: &mut String, bytecode: &Bytecode, function: &Function) -> fmt::Result {
    let kind = match function.kind {
        FunctionKind::Function => "function",
        FunctionKind::Guard => "guard",
        FunctionKind::Procedure => "procedure",
        FunctionKind::Property => "property",
    };
    write!(out, "\nfunction {} {kind} ", function.name)?;
    types(out, &function.arguments)?;
    out.write_str(" ")?;
    types(out, &function.results)?;
    let (registers, objects) = (function.registers, function.object_registers);
    writeln!(out, " registers {registers} objects {objects}")?;

    let range = function.entry as usize..function.end as usize;
    let code = bytecode.code.get(range).unwrap_or_default();
    let targets = targets(code);
    for (position, instruction) in (function.entry..).zip(code) {
        if targets.contains(&position) {
            writeln!(out, "{position}:")?;
        }
        let spans = bytecode
            .spans
            .iter()
            .filter(|(first, _)| *first == position);
        for (_, span) in spans {
            writeln!(out, "span {} {} {}", span.file, span.start, span.end)?;
        }
        out.write_str("    ")?;
        instruction.write(out)?;
        comment(out, bytecode, instruction)?;
        writeln!(out)?;
    }
    Ok(())
}

fn targets(code: &[Instruction]) -> BTreeSet<u32> {
    let mut targets = BTreeSet::new();
    for instruction in code {
        instruction.uses(&mut |used| {
            if let Use::JumpsTo(target) = used {
                targets.insert(target);
            }
        });
    }
    targets
}

/// The names of what an instruction refers to by number.
fn comment(out: &mut String, bytecode: &Bytecode, instruction: &Instruction) -> fmt::Result {
    match instruction {
        Instruction::Call { function, .. } => {
            let called = bytecode.functions.get(function.0 as usize);
            called.map_or(Ok(()), |called| write!(out, " // {}", called.name))
        }
        Instruction::CallHost { import, .. } => {
            let called = bytecode.imports.get(import.0 as usize);
            called.map_or(Ok(()), |called| write!(out, " // {}", called.name))
        }
        Instruction::Text { constant, .. } => {
            let text = bytecode.texts.get(constant.0 as usize);
            text.map_or(Ok(()), |text| write!(out, " // {text:?}"))
        }
        Instruction::Load { variable, .. }
        | Instruction::LoadPoint { variable, .. }
        | Instruction::Store { variable, .. }
        | Instruction::StorePoint { variable, .. }
        | Instruction::LoadOther { variable, .. }
        | Instruction::LoadOtherPoint { variable, .. } => named(out, bytecode, variable.0),
        Instruction::JumpIfStateNot { variable, .. } => named(out, bytecode, u32::from(variable.0)),
        _ => Ok(()),
    }
}

/// The name of the variable that a scalar of the state belongs to.
fn named(out: &mut String, bytecode: &Bytecode, scalar: u32) -> fmt::Result {
    let mut first = 0;
    for variable in &bytecode.variables {
        first += crate::machine::Layout::of([&variable.kind]).scalars.len();
        if (scalar as usize) < first {
            return write!(out, " // {}", variable.name);
        }
    }
    Ok(())
}

fn words(out: &mut String, words: &[String]) -> fmt::Result {
    words.iter().try_for_each(|word| write!(out, " {word}"))?;
    writeln!(out)
}

fn types(out: &mut String, types: &[Type]) -> fmt::Result {
    out.write_str("(")?;
    for (index, kind) in types.iter().enumerate() {
        let comma = if index == 0 { "" } else { ", " };
        write!(out, "{comma}{kind}")?;
    }
    out.write_str(")")
}

/// A scalar constant: as an Int if it is small, else as a Float if that reads back the same.
fn constant(out: &mut String, bits: u64) -> fmt::Result {
    let number = f64::from_bits(bits);
    if (-1 << 48..1 << 48).contains(&(bits as i64)) {
        write!(out, "constant {}", bits as i64)
    } else if number.is_finite() {
        write!(out, "constant {number:?}")
    } else {
        write!(out, "constant {bits:#x}")
    }
}
