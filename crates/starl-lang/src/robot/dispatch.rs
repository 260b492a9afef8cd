//! Calls of a program on a robot: what the program asks for, the robot and its primitives give.

use super::arguments::{Arguments, Called};
use super::atomic;
use super::builtins::BUILTINS;
use super::host::RobotHost;
use super::joint::OnRobot;
use super::primitives::{BoundPrimitive, KINDS};
use crate::machine::{Host, HostCall};
use starl_core::{Input, Port};

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

    /// Does what a function is for.
    fn run(&mut self, function: u32, call: &mut HostCall<'_>) -> Called {
        let code = self.context.code;
        let Some(joint) = code.joint(function) else {
            return Err("there is no such function".into());
        };
        self.context.message = joint.message.as_ref();
        match joint.on_robot {
            Some(OnRobot::Builtin(number)) => (BUILTINS[usize::from(number)].run)(self, call),
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
