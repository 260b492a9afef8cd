//! Calls of the host.

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine;
use crate::machine::operand::ImportIndex;
use crate::machine::{Import, Instruction};

/// Arguments by parameters; none for one that is omitted.
pub(in crate::compile) type Arguments<'p> = &'p [Option<Expression>];

/// An argument of a call of the host.
pub(in crate::compile) enum Argument<'p> {
    /// An Int that is known.
    Int(u32),
    /// A value.
    Value(&'p Expression),
    /// A value of an optional parameter of this type, or nothing.
    Maybe(Option<&'p Expression>, Type),
    /// A constant text, or nothing.
    MaybeText(Option<&'p str>),
}

/// A function of the host, without its types.
pub(in crate::compile) struct HostFunction {
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

impl<'p> Body<'_, 'p> {
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
        let import = Import {
            name: import.name,
            query: import.is_query,
            labels: import.labels,
            arguments: kinds,
            results,
        };
        // The window has to have room for the results too.
        let mark = self.mark();
        self.release(Size::new(window.base.scalar, window.base.object));
        self.take(size)?;
        self.release(mark);
        self.call_host(import, window.base);
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

    /// Calls a function of the host whose arguments are in these registers.
    pub fn call_host(&mut self, import: Import, window: Slot) {
        let import = ImportIndex(self.unit.import(import));
        self.emit(Instruction::CallHost {
            scalars: window.block(),
            objects: window.objects(),
            import,
        });
    }

    /// Calls a function of the host that returns nothing.
    pub fn tell(&mut self, function: HostFunction, arguments: &[Argument<'p>]) -> Compiled {
        let nowhere = self.take(Size::NONE)?;
        self.host(function, arguments, &Type::Nothing, nowhere, false)
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
}
