//! Calls: of functions, of the host, of primitives.
//!
//! A call's window begins above all registers that are in use. Where the result is wanted in fresh
//! registers on top of the stack, the window begins there, and nothing has to be moved.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::body::{Body, Slot};
use super::problem::Compiled;
use super::types::Size;
use crate::check::{Member, Purity, Shape, Signature};
use crate::ir::{self, BindingId, Expression, SharedId, Type};
use crate::machine::operand::{FunctionIndex, ImportIndex};
use crate::machine::{self, Import, Instruction};

/// The number of the prelude's file.
const PRELUDE_FILE: u32 = 1;

/// An argument of a call of the host.
pub(super) enum Argument<'p> {
    /// An Int that is known.
    Int(u32),
    /// A value.
    Value(&'p Expression),
    /// A value of an optional parameter of this type, or nothing.
    Maybe(Option<&'p Expression>, Type),
    /// A constant text, or nothing.
    MaybeText(Option<&'p str>),
}

/// A call's window, while it is filled.
struct Window {
    /// Its first registers.
    base: Slot,
    /// What was in use before.
    mark: Size,
}

impl<'p> Body<'_, 'p> {
    fn open(&mut self, to: Slot, result: Size, is_fresh: bool) -> Compiled<Window> {
        let mark = self.mark();
        if is_fresh && self.is_on_top(to, result) {
            self.release(Size::new(to.scalar, to.object));
        }
        let base = self.take(Size::NONE)?;
        Ok(Window { base, mark })
    }

    /// Takes the result of a call that was made.
    fn close(&mut self, window: &Window, to: Slot, result: Size) -> Compiled {
        self.release(Size::new(window.base.scalar, window.base.object));
        self.take(result)?;
        if window.base != to {
            self.move_value(to, window.base, result);
        }
        self.release(window.mark);
        Ok(())
    }

    /// A call of a function of the program.
    pub fn call_function(
        &mut self,
        function: u32,
        arguments: &'p [Expression],
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let result = self.size(ty);
        let window = self.open(to, result, is_fresh)?;
        for argument in arguments {
            let slot = self.take_for(&argument.ty)?;
            self.into(argument, slot, true)?;
        }
        self.emit(Instruction::Call {
            scalars: window.base.block(),
            objects: window.base.objects(),
            function: FunctionIndex(function),
        });
        self.close(&window, to, result)
    }

    /// A call of the host.
    pub fn host(
        &mut self,
        import: HostFunction,
        arguments: &[Argument<'p>],
        result: &Type,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let size = self.size(result);
        let window = self.open(to, size, is_fresh)?;
        let mut kinds = Vec::new();
        for argument in arguments {
            kinds.push(self.argument(argument)?);
        }
        let results = match result {
            Type::Nothing => Vec::new(),
            _ => Vec::from([self.machine_type(result)?]),
        };
        let import = self.unit.import(Import {
            name: import.name,
            query: import.is_query,
            labels: import.labels,
            arguments: kinds,
            results,
        });
        // The window has to have room for the results too.
        let mark = self.mark();
        self.release(Size::new(window.base.scalar, window.base.object));
        self.take(size)?;
        self.release(mark);
        self.emit(Instruction::CallHost {
            scalars: window.base.block(),
            objects: window.base.objects(),
            import: ImportIndex(import),
        });
        self.close(&window, to, size)
    }

    /// Puts an argument on top; gives its type.
    fn argument(&mut self, argument: &Argument<'p>) -> Compiled<machine::Type> {
        match argument {
            Argument::Int(number) => {
                let slot = self.take(Size::SCALAR)?;
                self.scalar(slot, u64::from(*number));
                Ok(machine::Type::Int)
            }
            Argument::Value(value) => {
                let slot = self.take_for(&value.ty)?;
                self.into(value, slot, true)?;
                self.machine_type(&value.ty)
            }
            Argument::Maybe(value, ty) => {
                let optional = Type::Optional(Box::new(ty.clone()));
                let slot = self.take_for(&optional)?;
                match value {
                    Some(value) => {
                        self.scalar(slot, 1);
                        self.into(value, slot.at(Size::SCALAR), true)?;
                    }
                    None => self.zeros(slot, &optional)?,
                }
                self.machine_type(&optional)
            }
            Argument::MaybeText(text) => {
                let optional = Type::Optional(Box::new(Type::String));
                let slot = self.take_for(&optional)?;
                match text {
                    Some(text) => {
                        self.scalar(slot, 1);
                        self.text(slot, text);
                    }
                    None => self.zeros(slot, &optional)?,
                }
                self.machine_type(&optional)
            }
        }
    }

    /// Asks the host for a value.
    pub fn ask(
        &mut self,
        name: &str,
        arguments: &[&'p Expression],
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let arguments: Vec<Argument<'p>> =
            (arguments.iter().copied()).map(Argument::Value).collect();
        self.host(HostFunction::query(name), &arguments, ty, to, is_fresh)
    }

    /// All robots, in a list.
    pub fn all_robots(&mut self, to: Slot) -> Compiled {
        let ty = Type::list(Type::Robot);
        self.host(HostFunction::query("robot.all"), &[], &ty, to, true)
    }

    /// The arguments of a signature's parameters: what may be left out is an optional.
    pub fn arguments(
        &self,
        signature: &Signature,
        values: &'p [Option<Expression>],
    ) -> Compiled<Vec<Argument<'p>>> {
        let parameters = signature.parameters.iter().enumerate();
        let arguments = parameters.map(|(index, parameter)| {
            let value = values.get(index).and_then(Option::as_ref);
            match (value, parameter.is_optional) {
                (value, true) => {
                    let ty = self.shape(&parameter.shape).ok_or_else(|| self.broken())?;
                    Ok(Argument::Maybe(value, ty))
                }
                (Some(value), false) => Ok(Argument::Value(value)),
                (None, false) => Err(self.broken()),
            }
        });
        arguments.collect()
    }

    /// The type that a shape of the tables stands for.
    pub fn shape(&self, shape: &Shape) -> Option<Type> {
        let boxed = |part: &Shape| self.shape(part).map(Box::new);
        Some(match shape {
            Shape::Named(name) => match *name {
                "Bool" => Type::Bool,
                "Int" => Type::Int,
                "Float" => Type::Float,
                "String" => Type::String,
                "Point" => Type::Point,
                "Time" => Type::Time,
                "Duration" => Type::Duration,
                "RobotId" => Type::Robot,
                "Area" => Type::Area,
                "Obstacles" => Type::Obstacles,
                name => self.prelude_type(name)?,
            },
            Shape::List(part) => Type::List(boxed(part)?),
            Shape::Set(part) => Type::Set(boxed(part)?),
            Shape::Map(key, value) => Type::Map(boxed(key)?, boxed(value)?),
            Shape::Optional(part) => Type::optional(*boxed(part)?),
            _ => return None,
        })
    }

    /// The enum or record with this name that every program has.
    fn prelude_type(&self, name: &str) -> Option<Type> {
        let program = self.unit.program;
        let is_it = |declared: Option<&str>, site: ir::Site| {
            site.file == PRELUDE_FILE && declared == Some(name)
        };
        let enums = program.enums.iter();
        let mut enums = enums.map(|declared| is_it(declared.name.as_deref(), declared.site));
        if let Some(number) = enums.position(|found| found) {
            return Some(Type::Enum(ir::EnumId(number as u32)));
        }
        let records = program.records.iter();
        let mut records = records.map(|declared| is_it(Some(&declared.name), declared.site));
        let number = records.position(|found| found)?;
        Some(Type::Record(ir::RecordId(number as u32)))
    }

    /// A method or flag of a primitive.
    pub fn member(
        &mut self,
        binding: BindingId,
        member: &'static Member,
        arguments: &'p [Option<Expression>],
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let Some(kind) = self.unit.program[binding].primitive else {
            return Err(self.broken());
        };
        let signature = member.signature();
        let mut values = Vec::from([Argument::Int(binding.0)]);
        values.extend(self.arguments(&signature, arguments)?);
        let labels = (signature.parameters.iter().zip(arguments))
            .filter(|(parameter, _)| parameter.shape == Shape::Message)
            .filter_map(|(_, value)| self.message_name(value.as_ref()?));
        let import = HostFunction {
            name: format!("{}.{}", kind.name(), member.name()),
            is_query: member.purity != Purity::Effect,
            labels: labels.collect(),
        };
        self.host(import, &values, ty, to, is_fresh)
    }

    fn message_name(&self, value: &Expression) -> Option<String> {
        match value.ty {
            Type::Record(id) => Some(self.unit.program.message_name(id)),
            _ => None,
        }
    }

    // Shared variables: instances of two primitives, after those of the program.

    fn shared_function(&self, id: SharedId, member: &str, is_query: bool) -> HostFunction {
        let kind = shared_kind(&self.unit.program[id]);
        HostFunction {
            name: format!("{kind}.{member}"),
            is_query,
            labels: Vec::new(),
        }
    }

    fn shared_instance(&self, id: SharedId) -> Argument<'p> {
        Argument::Int((self.unit.program.bindings.len() + id.index()) as u32)
    }

    /// `name[robot]` of a single-writer variable.
    pub fn shared_element(
        &mut self,
        id: SharedId,
        robot: &'p Expression,
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let import = self.shared_function(id, "element", true);
        let arguments = [self.shared_instance(id), Argument::Value(robot)];
        self.read_optional(
            import,
            &arguments,
            &self.unit.program[id].ty,
            to,
            ty,
            is_fresh,
        )
    }

    /// Asks for an optional of a type. If that is an optional itself, the two are one to the program.
    fn read_optional(
        &mut self,
        import: HostFunction,
        arguments: &[Argument<'p>],
        inner: &Type,
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let optional = Type::Optional(Box::new(inner.clone()));
        if *ty == optional {
            return self.host(import, arguments, &optional, to, is_fresh);
        }
        let mark = self.mark();
        let whole = self.take_for(&optional)?;
        self.host(import, arguments, &optional, whole, true)?;
        if inner != ty {
            return Err(self.broken());
        }
        let size = self.size(ty);
        self.move_value(to, whole.at(Size::SCALAR), size);
        self.release(mark);
        Ok(())
    }

    /// All of a single-writer variable.
    pub fn shared_map(&mut self, id: SharedId, to: Slot, ty: &Type, is_fresh: bool) -> Compiled {
        let import = self.shared_function(id, "all", true);
        let arguments = [self.shared_instance(id)];
        self.host(import, &arguments, ty, to, is_fresh)
    }

    /// A multi-writer variable. With an initial value it has one always.
    pub fn shared(&mut self, id: SharedId, to: Slot, ty: &Type, is_fresh: bool) -> Compiled {
        let shared: &'p ir::Shared = &self.unit.program[id];
        let import = self.shared_function(id, "read", true);
        let arguments = [self.shared_instance(id)];
        if shared.initial.is_none() {
            return self.read_optional(import, &arguments, &shared.ty, to, ty, is_fresh);
        }
        let mark = self.mark();
        let optional = Type::Optional(Box::new(shared.ty.clone()));
        let whole = self.take_for(&optional)?;
        self.host(import, &arguments, &optional, whole, true)?;
        self.emit(Instruction::Require {
            present: whole.input(),
        });
        let size = self.size(ty);
        self.move_value(to, whole.at(Size::SCALAR), size);
        self.release(mark);
        Ok(())
    }

    /// Tells the host the value of a shared variable, by one of its members.
    pub fn write_shared(&mut self, id: SharedId, member: &str, value: &'p Expression) -> Compiled {
        let import = self.shared_function(id, member, false);
        let arguments = [self.shared_instance(id), Argument::Value(value)];
        let nowhere = self.take(Size::NONE)?;
        self.host(import, &arguments, &Type::Nothing, nowhere, false)
    }

    /// Tells the host the value of a shared variable that was changed in registers.
    pub fn write_back_shared(&mut self, id: SharedId, value: Slot) -> Compiled {
        let ty = &self.unit.program[id].ty;
        let import = self.shared_function(id, "write", false);
        let mark = self.mark();
        let size = self.size(ty);
        let first = self.take(Size::SCALAR.plus(size))?;
        let Argument::Int(instance) = self.shared_instance(id) else {
            return Err(self.broken());
        };
        self.scalar(first, u64::from(instance));
        self.copy(first.at(Size::SCALAR), value, size);
        let kind = self.machine_type(ty)?;
        let import = self.unit.import(Import {
            name: import.name,
            query: false,
            labels: Vec::new(),
            arguments: Vec::from([machine::Type::Int, kind]),
            results: Vec::new(),
        });
        self.emit(Instruction::CallHost {
            scalars: first.block(),
            objects: first.objects(),
            import: ImportIndex(import),
        });
        self.release(mark);
        Ok(())
    }
}

/// The kind of primitive that a shared variable is.
pub(super) fn shared_kind(shared: &ir::Shared) -> &'static str {
    match shared.is_single_writer {
        true => "SingleWriter",
        false => "MultiWriter",
    }
}

/// A function of the host, without its types.
pub(super) struct HostFunction {
    pub name: String,
    pub is_query: bool,
    pub labels: Vec<String>,
}

impl HostFunction {
    pub fn query(name: &str) -> Self {
        Self::named(name, true)
    }

    pub fn effect(name: &str) -> Self {
        Self::named(name, false)
    }

    fn named(name: &str, is_query: bool) -> Self {
        Self {
            name: name.to_string(),
            is_query,
            labels: Vec::new(),
        }
    }
}
