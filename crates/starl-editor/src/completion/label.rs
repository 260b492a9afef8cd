//! How things are written where they are used.

use super::Call;
use super::candidates::Candidates;
use starl_lang::check::{PRIMITIVES, Signature, Symbol};

impl Candidates<'_> {
    /// The name of a symbol and the form of its call; none if it has no name.
    pub fn named(&self, symbol: Symbol) -> Option<(String, Call)> {
        let program = &self.checked.program;
        let calls = |parameters: usize| match parameters {
            0 => Call::Empty,
            _ => Call::Arguments,
        };
        let signed = |signature: Signature| match signature.is_call {
            true if signature.takes_values || signature.takes_fields => Call::Arguments,
            true => calls(signature.parameters.len()),
            false => Call::No,
        };
        Some(match symbol {
            Symbol::Enum(id) => (program[id].name.clone()?, Call::No),
            Symbol::Variant(id, number) => {
                let variant = program[id].variants.get(number as usize)?;
                (variant.name.clone(), Call::No)
            }
            Symbol::Record(id) => {
                let record = &program[id];
                (record.name.clone(), calls(record.fields.len()))
            }
            Symbol::Field(id, number) => {
                let field = program[id].fields.get(number as usize)?;
                (field.name.clone(), Call::No)
            }
            Symbol::Parameter(id) => (program[id].name.clone(), Call::No),
            Symbol::Constant(id) => (program[id].name.clone(), Call::No),
            Symbol::Variable(id) => (program[id].name.clone(), Call::No),
            Symbol::Shared(id) => (program[id].name.clone(), Call::No),
            Symbol::Binding(id) => (program[id].name.clone(), Call::No),
            Symbol::Function(id) => {
                let function = &program[id];
                (function.name.clone(), calls(function.parameters as usize))
            }
            Symbol::File(file) => (
                self.checked.files.get(file as usize)?.name.clone(),
                Call::No,
            ),
            Symbol::Builtin(builtin) => (builtin.name().into(), signed(builtin.signature())),
            Symbol::Type(name) | Symbol::Coordinate(name) | Symbol::RobotMember(name) => {
                (name.into(), Call::No)
            }
            Symbol::Method(method) => (method.name().into(), signed(method.signature())),
            Symbol::Primitive(number) => (PRIMITIVES.get(number)?.name().into(), Call::Arguments),
            Symbol::Member(primitive, number) => {
                let member = PRIMITIVES.get(primitive)?.members.get(number)?;
                (member.name().into(), signed(member.signature()))
            }
            Symbol::Event(primitive, number) => {
                let event = PRIMITIVES.get(primitive)?.events.get(number)?;
                (event.name().into(), Call::Arguments)
            }
            Symbol::Argument(..)
            | Symbol::Local(_)
            | Symbol::Action(_)
            | Symbol::Property(_)
            | Symbol::Input(_) => {
                return None;
            }
        })
    }
}
