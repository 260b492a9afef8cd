//! Handlers of messages, of primitives' events and of inputs.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::compile::body::Body;
use crate::compile::problem::Compiled;
use crate::compile::unit::{Finished, Unit};
use crate::ir;
use crate::ir::Type;
use crate::machine::{FunctionKind, Origin};

impl<'p> Unit<'p> {
    /// A handler; also returns the name and the origin of its event.
    pub fn handler(&mut self, handler: &'p ir::Handler) -> Compiled<(String, Origin, Finished)> {
        let program = self.program;
        let mut body = Body::new(self, FunctionKind::Procedure, &handler.locals, handler.site);
        let (event, origin, types) = match &handler.event {
            ir::Event::Error => return Err(body.broken()),
            ir::Event::Message(id) => {
                let message = &program[*id];
                let fields = message.fields.iter().map(|field| field.ty.clone());
                let types: Vec<Type> = core::iter::once(Type::Robot).chain(fields).collect();
                (program.message_name(*id), Origin::Message, types)
            }
            ir::Event::Primitive { binding, event } => {
                let shapes = event.signature().parameters;
                let types = shapes.iter().map(|part| body.shape(&part.shape));
                let types = types.collect::<Option<Vec<Type>>>();
                let types = types.ok_or_else(|| body.broken())?;
                (event.name().into(), Origin::Primitive(binding.0), types)
            }
            ir::Event::Input { name, fields } => {
                let (fields, types) = fields.iter().cloned().unzip();
                (name.clone(), Origin::Input(fields), types)
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
        let name = match &origin {
            Origin::Primitive(number) => {
                format!("on.{}.{event}", program.bindings[*number as usize].name)
            }
            Origin::Input(_) => format!("on.input.{event}"),
            Origin::Message => format!("on.{event}"),
        };
        Ok((event, origin, body.finish(&name, arguments, Vec::new())))
    }
}
