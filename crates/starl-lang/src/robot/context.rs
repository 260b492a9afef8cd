//! The context of the functions that a program calls: the program, the robot that runs it, and what its primitives share.

use super::arguments::Arguments;
use super::code::Code;
use super::instance::Instance;
use super::messages::Outgoing;
use super::services::Services;
use super::workbench::Memo;
use alloc::borrow::Cow;
use starl_core::{Payload, Robot};

/// The context of host functions.
pub struct Context<'a, 'r> {
    pub code: &'a Code,
    /// The robot that runs it.
    pub robot: &'a mut Robot<'r>,
    /// Values that were made before.
    pub memo: &'a mut Memo,
    /// The services that the program's primitives share.
    pub services: &'a mut Services,
    /// The primitive that the present call is about.
    pub instance: Option<&'a Instance>,
    /// The message that it is about.
    pub message: Option<&'a Outgoing>,
}

impl<'a, 'r> Context<'a, 'r> {
    /// A context without a message.
    pub fn new(
        code: &'a Code,
        robot: &'a mut Robot<'r>,
        memo: &'a mut Memo,
        services: &'a mut Services,
    ) -> Context<'a, 'r> {
        Context {
            code,
            robot,
            memo,
            services,
            instance: None,
            message: None,
        }
    }

    /// Reads a message from arguments, as bytes that travel.
    pub fn message(&self, arguments: &mut Arguments<'_>) -> Result<Payload, Cow<'static, str>> {
        let outgoing = self.message.ok_or("this sends no message")?;
        let (scalars, objects) = outgoing.width();
        let (scalars, objects) = arguments.block(scalars, objects);
        let payload = outgoing.encode(self.code.program(), scalars, objects);
        payload.ok_or("the message's fields are of other types".into())
    }
}
