//! Handlers of messages and of what primitives report.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::compile::body::Body;
use crate::compile::problem::Compiled;
use crate::compile::unit::{Finished, Unit};
use crate::ir;
use crate::ir::Type;
use crate::machine::FunctionKind;

impl<'p> Unit<'p> {
    /// A handler; gives the name of its event and its primitive too.
    pub fn handler(
        &mut self,
        handler: &'p ir::Handler,
    ) -> Compiled<(String, Option<u32>, Finished)> {
        let program = self.program;
        let mut body = Body::new(self, FunctionKind::Procedure, &handler.locals, handler.site);
        let (event, primitive, types) = match &handler.event {
            ir::Event::Error => return Err(body.broken()),
            ir::Event::Message(id) => {
                let message = &program[*id];
                let fields = message.fields.iter().map(|field| field.ty.clone());
                let types: Vec<Type> = core::iter::once(Type::Robot).chain(fields).collect();
                (program.message_name(*id), None, types)
            }
            ir::Event::Primitive { binding, event } => {
                let shapes = event.signature().parameters;
                let types = shapes.iter().map(|part| body.shape(&part.shape));
                let types = types.collect::<Option<Vec<Type>>>();
                let types = types.ok_or_else(|| body.broken())?;
                (event.name().into(), Some(binding.0), types)
            }
        };
        let mut arguments = Vec::new();
        for (number, ty) in types.iter().enumerate() {
            let slot = body.take_for(ty)?;
            arguments.push(body.machine_type(ty)?);
            if let Some(Some(local)) = handler.parameters.get(number) {
                body.bind(*local, slot);
            }
        }
        body.block(&handler.body)?;
        body.end();
        let name = match primitive {
            Some(number) => format!("on.{}.{event}", program.bindings[number as usize].name),
            None => format!("on.{event}"),
        };
        Ok((event, primitive, body.finish(&name, arguments, Vec::new())))
    }
}
