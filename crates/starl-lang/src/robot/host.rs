//! The machine's host on a robot: what a running program asks for, the robot and its primitives give.

use super::arguments::{Arguments, Called};
use super::atomic::{self, Script};
use super::code::Code;
use super::failure::Failure;
use super::instance::Instance;
use super::joint::OnRobot;
use super::messages::Outgoing;
use super::primitives::{BoundPrimitive, KINDS, Slot};
use super::services::Services;
use super::workbench::Memo;
use crate::machine::{Host, HostCall};
use alloc::borrow::Cow;
use starl_core::{Input, Payload, Port, Robot};

/// The context of host functions.
pub struct Context<'a, 'r> {
    /// The program.
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
    message: Option<&'a Outgoing>,
}

/// A robot as the machine sees it.
pub struct RobotHost<'a, 'r> {
    /// The context of functions.
    pub context: Context<'a, 'r>,
    /// The bound primitives.
    pub bound: &'a mut [Slot],
    /// Why the program cannot continue, once it has said so.
    pub failure: Option<Failure>,
    /// Whether an action has fired.
    pub has_fired: bool,
    /// The treatment of calls.
    pub script: Script,
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

impl RobotHost<'_, '_> {
    fn bind(&mut self, kind: u16, call: &HostCall<'_>) -> Called {
        let instance = Arguments::of(call).int() as usize;
        let forms = self.context.code.instances();
        let (Some(form), Some(kind_of)) = (forms.get(instance), KINDS.get(usize::from(kind)))
        else {
            return Err("there is no such primitive".into());
        };
        if form.kind != kind {
            return Err("the primitive is of another kind".into());
        }
        self.context.instance = Some(form);
        let mut arguments = Arguments::after_instance(call);
        let mut created =
            BoundPrimitive::new((kind_of.bind)(form, &mut self.context, &mut arguments)?);
        if created
            .port
            .is_some_and(|port| self.is_taken(port, instance))
        {
            return Err("another primitive of the program has this name".into());
        }
        if let Some(primitive) = created.bound.primitive() {
            // It receives the start, as the primitives before it did.
            primitive.handle(self.context.robot, &Input::Start);
        }
        if let Some(slot) = self.bound.get_mut(instance) {
            *slot = Some(created);
        }
        Ok(1)
    }

    /// Whether another primitive than this instance listens at the port.
    fn is_taken(&mut self, port: Port, instance: usize) -> bool {
        let mut others = self.bound.iter().enumerate();
        self.context
            .services
            .listen_at(self.context.code.groups(), port)
            || others.any(|(other, slot)| {
                let slot = slot.as_ref().filter(|_| other != instance);
                slot.is_some_and(|slot| slot.port == Some(port))
            })
    }

    fn member(&mut self, kind: u16, member: u16, call: &mut HostCall<'_>) -> Called {
        let instance = Arguments::of(call).int() as usize;
        let form = self.context.code.instances().get(instance);
        if form.is_none_or(|form| form.kind != kind) {
            return Err("there is no such primitive".into());
        }
        self.context.instance = form;
        match self.bound.get_mut(instance) {
            Some(Some(slot)) => {
                slot.is_stirred |= !call.import.query;
                slot.bound
                    .call(usize::from(member), &mut self.context, call)
            }
            _ => Err("the primitive is not bound yet".into()),
        }
    }
}

impl RobotHost<'_, '_> {
    /// Does what a function is for.
    fn run(&mut self, function: u32, call: &mut HostCall<'_>) -> Called {
        let code = self.context.code;
        let Some(joint) = code.joint(function) else {
            return Err("there is no such function".into());
        };
        self.context.message = joint.message.as_ref();
        match joint.on_robot {
            Some(OnRobot::Builtin(builtin)) => (builtin.run)(self, call),
            Some(OnRobot::Bind(kind)) => self.bind(kind, call),
            Some(OnRobot::Member { kind, member }) => self.member(kind, member, call),
            None => Err("only properties ask this of robots".into()),
        }
    }

    /// Whether a function writes a linearizable variable. When an action takes place that is done.
    fn is_stored(&self, function: u32) -> bool {
        let joint = self.context.code.joint(function);
        let kind = match joint.and_then(|joint| joint.on_robot) {
            Some(OnRobot::Member { kind, .. }) => KINDS.get(usize::from(kind)),
            _ => None,
        };
        kind.is_some_and(|kind| kind.name == atomic::KIND)
    }
}

impl Host for RobotHost<'_, '_> {
    fn call(&mut self, function: u32, call: &mut HostCall<'_>) -> Called {
        if let Some(given) = self.script.next(function) {
            if !call.import.query && !self.is_stored(function) {
                self.run(function, call)?;
            }
            return given.give(call);
        }
        let called = self.run(function, call);
        self.script.note(function, call, &called);
        called
    }

    fn fires(&mut self, action: u32) {
        self.has_fired = true;
        let actions = &self.context.code.program().bytecode().actions;
        if let Some(action) = actions.get(action as usize) {
            self.context.robot.action(action.name.clone());
        }
    }
}
