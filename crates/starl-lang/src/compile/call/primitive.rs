//! Members of primitives, and the types that signatures name.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::check::{Member, Purity, Shape, Signature};
use crate::compile::body::{Body, Slot};
use crate::compile::call::{Argument, Arguments, HostFunction};
use crate::compile::problem::Compiled;
use crate::ir;
use crate::ir::{BindingId, Expression, Type};

/// The number of the prelude's file.
const PRELUDE_FILE: u32 = 1;

impl<'p> Body<'_, 'p> {
    /// A method or flag of a primitive.
    pub fn member(
        &mut self,
        binding: BindingId,
        member: &'static Member,
        arguments: Arguments<'p>,
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

    /// The arguments of a signature's parameters: what may be left out is an optional.
    pub fn arguments(
        &self,
        signature: &Signature,
        values: Arguments<'p>,
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

    /// The type of a shape of the tables.
    pub fn shape(&self, shape: &Shape) -> Option<Type> {
        let boxed = |part: &Shape| self.shape(part).map(Box::new);
        Some(match shape {
            Shape::Named(name) => Type::built_in(name).or_else(|| self.prelude_type(name))?,
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
}
