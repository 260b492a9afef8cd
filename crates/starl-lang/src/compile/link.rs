//! The whole program: compiles what there is and puts it together.

use alloc::format;
use alloc::vec::Vec;

use super::call::shared_kind;
use super::computed::computed;
use super::join::join;
use super::problem::{Compiled, Problem};
use super::unit::{Finished, Routine, Unit};
use crate::check::CheckedFile;
use crate::diagnostic;
use crate::ir::{self, FunctionId, Program, SharedId};
use crate::machine::{
    self, Action, Binding, Bytecode, Handler, Parameter, Range, SourceFile, Value, Variable,
};
use starl_core::Duration;

/// Compiles a program without errors.
pub(super) fn link(program: &Program, files: &[CheckedFile]) -> Result<Bytecode, Vec<Problem>> {
    let mut unit = Unit::new(program);
    let mut bytecode = Bytecode {
        name: program.name.clone(),
        files: files.iter().enumerate().map(source_file).collect(),
        ..Bytecode::default()
    };
    // Of a library all functions can be called.
    for (number, function) in program.functions.iter().enumerate() {
        if program.is_library && function.site.file == 0 {
            unit.routine(Routine::Function(FunctionId(number as u32)));
        }
    }
    if !program.is_library {
        behaviour(&mut unit, &mut bytecode);
        let variables = variables(&mut unit);
        unit.note(variables, |found| bytecode.variables = found);
    }
    unit.compile_routines();
    for binding in &program.bindings {
        bytecode.primitives.push(Binding {
            name: binding.name.clone(),
            kind: binding.primitive.map_or("", |kind| kind.name()).into(),
        });
    }
    bytecode.models = (program.models.iter())
        .map(|model| machine::Model {
            path: model.path.clone(),
            bytes: model.bytes.clone(),
        })
        .collect();
    for shared in &program.shared {
        bytecode.primitives.push(Binding {
            name: shared.name.clone(),
            kind: shared_kind(shared).into(),
        });
    }
    join(unit, bytecode)
}

impl Unit<'_> {
    /// Compiles the requested routines, and those that they need.
    pub fn compile_routines(&mut self) {
        while let Some((routine, number)) = self.next_routine() {
            let function = self.compile_routine(routine);
            self.define(number, function);
        }
    }

    /// Uses what was made, or notes why it could not be.
    fn note<T>(&mut self, made: Compiled<T>, then: impl FnOnce(T)) {
        match made {
            Ok(made) => then(made),
            Err(problem) => self.problems.push(*problem),
        }
    }

    /// Adds a function; gives its number.
    fn add(&mut self, made: Compiled<Finished>) -> u32 {
        let number = self.reserve();
        self.define(number, made);
        number
    }
}

/// The start, actions, handlers and properties.
fn behaviour<'p>(unit: &mut Unit<'p>, bytecode: &mut Bytecode) {
    let program: &'p Program = unit.program;
    match unit.defaults() {
        Ok(None) => {}
        Ok(Some(defaults)) => bytecode.defaults = Some(unit.add(Ok(defaults))),
        Err(problem) => unit.problems.push(*problem),
    }
    let start = unit.start();
    bytecode.start = Some(unit.add(start));
    if !program.checks.is_empty() {
        let reset = unit.reset();
        let effect = unit.add(reset);
        for check in &program.checks {
            let guard = unit.check(check);
            let guard = unit.add(guard);
            bytecode.actions.push(Action {
                name: "reset".into(),
                guard,
                effect,
                atomic: Vec::new(),
                is_check: true,
                hold: None,
                every: None,
            });
        }
    }
    for action in &program.actions {
        let mut time = |time: &'p Option<ir::Expression>, word| {
            let time = time.as_ref()?;
            let function = unit.time(action, time, word);
            Some(unit.add(function))
        };
        let hold = time(&action.hold, "hold");
        let every = time(&action.every, "every");
        let guard = unit.guard(action);
        let guard = unit.add(guard);
        let effect = unit.effect(action);
        let effect = unit.add(effect);
        bytecode.actions.push(Action {
            name: unit.action_name(action),
            guard,
            effect,
            atomic: instances(program, &action.atomic),
            is_check: false,
            hold,
            every,
        });
    }
    for handler in &program.handlers {
        match unit.handler(handler) {
            Ok((event, origin, function)) => {
                let function = unit.add(Ok(function));
                bytecode.handlers.push(Handler {
                    event,
                    origin,
                    function,
                });
            }
            Err(problem) => unit.problems.push(*problem),
        }
    }
    for (number, property) in program.properties.iter().enumerate() {
        let name = property.name.clone();
        let name = name.unwrap_or_else(|| format!("property_{}", number + 1));
        let property = unit.property(property, name);
        unit.note(property, |property| bytecode.properties.push(property));
    }
}

/// The numbers of shared variables among the program's primitives, which they come after.
fn instances(program: &Program, shared: &[SharedId]) -> Vec<u32> {
    let numbers = shared.iter().map(|id| program.bindings.len() + id.index());
    numbers.map(|number| number as u32).collect()
}

/// The variables of the state: those of the program, then the parameters.
fn variables(unit: &mut Unit<'_>) -> Compiled<Vec<Variable>> {
    let program = unit.program;
    let role = program.roles.as_ref().map(|roles| roles.variable.index());
    let mut variables = Vec::new();
    for (number, variable) in program.variables.iter().enumerate() {
        let site = variable.site;
        variables.push(Variable {
            name: variable.name.clone(),
            kind: unit.machine_type(&variable.ty, site.file, site.span)?,
            parameter: match role == Some(number) {
                true => Parameter::Optional,
                false => Parameter::No,
            },
            range: None,
            is_stable: variable.is_stable,
        });
    }
    for parameter in &program.parameters {
        let site = parameter.site;
        variables.push(Variable {
            name: parameter.name.clone(),
            kind: unit.machine_type(&parameter.ty, site.file, site.span)?,
            parameter: match parameter.default {
                Some(_) => Parameter::Optional,
                None => Parameter::Required,
            },
            range: range(unit, parameter)?,
            is_stable: false,
        });
    }
    Ok(variables)
}

/// The values that a parameter may have; its default is among them.
fn range(unit: &Unit<'_>, parameter: &ir::Parameter) -> Compiled<Option<Range>> {
    let Some([least, end]) = &parameter.range else {
        return Ok(None);
    };
    let value = |of| computed(unit, of, &parameter.locals, parameter.site);
    let (from, before) = (value(least)?, value(end)?);
    let range = Range { from, before };
    let typed = |scalar: u64| match parameter.ty {
        ir::Type::Int => Value::Int(scalar as i64),
        ir::Type::Float => Value::Float(f64::from_bits(scalar)),
        _ => Value::Duration(Duration(scalar)),
    };
    let problem = |span, message: &str| {
        let code = diagnostic::Code::InvalidRange;
        Err(Problem::new(code, parameter.site.file, span, message))
    };
    if !range.contains(&typed(from)) {
        return problem(end.span, "there is nothing in this range")
            .map_err(|problem| problem.note("`a..b` is from `a` to before `b`"));
    }
    match &parameter.default {
        Some(default) if !range.contains(&typed(value(default)?)) => {
            problem(default.span, "the default is out of the parameter's range")
        }
        _ => Ok(Some(range)),
    }
}

fn source_file((number, file): (usize, &CheckedFile)) -> SourceFile {
    let name = match number {
        0 => file.name.to_lowercase(),
        _ => file.name.clone(),
    };
    let breaks = file.source.bytes().enumerate();
    let breaks = breaks.filter(|(_, byte)| *byte == b'\n');
    let lines = core::iter::once(0).chain(breaks.map(|(at, _)| at as u32 + 1));
    SourceFile {
        name: format!("{name}.starl"),
        lines: lines.collect(),
    }
}
