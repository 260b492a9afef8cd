//! Broadcast, Geocast and Unicast in programs.
//!
//! A program knows its messages by numbers of its own, which count from 1 whatever their receivers:
//! those of the protocol count for each receiver by itself. Only messages on their way are remembered.

use super::{Arguments, Context, Event, Instance, Kind, Member, Report, method, query};
use crate::machine::HostCall;
use crate::robot::arguments::Called;
use crate::robot::shape::Shape;
use crate::robot::workbench::robots;
use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;
use serde::ser::{Serialize, SerializeTuple, Serializer};
use starl_core::{Payload, Primitive};
use starl_primitives::reliable::{MessageId, Options};
use starl_primitives::{Broadcast, Failure, Geocast, Unicast};

/// A primitive that sends messages, with the program's numbers of those on their way.
#[derive(Clone, Debug)]
pub struct Sender<C> {
    channel: C,
    /// The number of the last message.
    last: u32,
    /// Those are forgotten that are settled when there are as many as this.
    most: u32,
    /// Messages that may be on their way, in ascending order of their numbers.
    outstanding: Vec<(u32, MessageId)>,
}

/// So many messages are remembered before it is seen which of them are settled.
const FEW: u32 = 8;

/// What the three have in common.
pub trait Channel: Primitive + Clone + fmt::Debug + Send + Sync + Sized + 'static {
    /// Its name.
    const NAME: &'static str;
    /// How a message is sent.
    const SEND: Member<Sender<Self>>;
    /// All members.
    const MEMBERS: &'static [Member<Sender<Self>>];

    /// An instance with this name.
    fn named(name: &str) -> Self;
    /// Whether the message is on its way to someone.
    fn is_outstanding(&self, message: MessageId) -> bool;
    /// The messages that were given up since the last call.
    fn take_failures(&mut self) -> Vec<Failure>;
}

impl<C: Channel> Sender<C> {
    /// Gives a message that was sent its number.
    fn sent(&mut self, message: MessageId, call: &mut HostCall<'_>) -> Called {
        self.last = self.last.saturating_add(1);
        self.outstanding.push((self.last, message));
        call.set_int(0, i64::from(self.last));
        Ok(10)
    }

    const OUTSTANDING: Member<Sender<C>> = query(
        "outstanding",
        &[Shape::Int],
        Shape::Bool,
        |sender, _, call| {
            let number = Arguments::after_instance(call).int();
            let messages = &sender.outstanding;
            let place = messages.binary_search_by_key(&number, |(known, _)| i64::from(*known));
            let message = place.ok().and_then(|place| messages.get(place));
            let is_outstanding =
                message.is_some_and(|(_, message)| sender.channel.is_outstanding(*message));
            call.set_bool(0, is_outstanding);
            Ok(1)
        },
    );
}

impl<C: Channel> Kind for Sender<C> {
    const NAME: &'static str = C::NAME;

    /// A name by which instances find each other instead of the one that the program gives.
    const CONSTRUCTOR: &'static [Shape] = &[Shape::Optional(&Shape::Text)];

    const MEMBERS: &'static [Member<Sender<C>>] = C::MEMBERS;

    const EVENTS: &'static [Event] = &[Event {
        name: "failed",
        parameters: &[Shape::Int, Shape::List(&Shape::Robot)],
    }];

    fn bind(
        instance: &Instance,
        _: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Sender<C>, Cow<'static, str>> {
        let name = arguments.optional(Arguments::text);
        Ok(Sender {
            channel: C::named(name.unwrap_or(&instance.name)),
            last: 0,
            most: FEW,
            outstanding: Vec::new(),
        })
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(&mut self.channel)
    }

    fn take_reports(&mut self, take: &mut dyn FnMut(Report)) {
        for failure in self.channel.take_failures() {
            let mut known = self.outstanding.iter();
            let Some(place) = known.position(|(_, message)| *message == failure.message) else {
                continue;
            };
            let (number, _) = self.outstanding.remove(place);
            take(Report {
                event: 0,
                scalars: Vec::from([u64::from(number)]),
                objects: Vec::from([robots(failure.unreached)]),
            });
        }
        if self.outstanding.len() >= self.most as usize {
            let channel = &self.channel;
            (self.outstanding).retain(|(_, message)| channel.is_outstanding(*message));
            self.most = FEW.max(2 * self.outstanding.len() as u32);
        }
    }
}

/// Bytes that are written as they are.
struct Raw<'a>(&'a Payload);

impl Serialize for Raw<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut bytes = serializer.serialize_tuple(self.0.len())?;
        self.0
            .iter()
            .try_for_each(|byte| bytes.serialize_element(byte))?;
        bytes.end()
    }
}

/// The part of a [`Channel`] that is written alike for all three.
macro_rules! channel {
    ($name:literal) => {
        const NAME: &'static str = $name;
        const MEMBERS: &'static [Member<Sender<Self>>] =
            &[<Self as Channel>::SEND, Sender::<Self>::OUTSTANDING];

        fn named(name: &str) -> Self {
            Self::new(name, Options::default())
        }

        fn is_outstanding(&self, message: MessageId) -> bool {
            Self::is_outstanding(self, message)
        }

        fn take_failures(&mut self) -> Vec<Failure> {
            Self::take_failures(self)
        }
    };
}

impl Channel for Broadcast {
    channel!("Broadcast");

    const SEND: Member<Sender<Broadcast>> = method(
        "broadcast",
        &[Shape::Message],
        Some(Shape::Int),
        |sender, context, call| {
            let payload = context.message(&mut Arguments::after_instance(call))?;
            let message = sender.channel.broadcast(context.robot, &Raw(&payload));
            sender.sent(message, call)
        },
    );
}

impl Channel for Geocast {
    channel!("Geocast");

    const SEND: Member<Sender<Geocast>> = method(
        "geocast",
        &[Shape::Message, Shape::Area],
        Some(Shape::Int),
        |sender, context, call| {
            let mut arguments = Arguments::after_instance(call);
            let payload = context.message(&mut arguments)?;
            let area = arguments.area()?;
            let message = (sender.channel).geocast(context.robot, &Raw(&payload), area);
            sender.sent(message, call)
        },
    );
}

impl Channel for Unicast {
    channel!("Unicast");

    const SEND: Member<Sender<Unicast>> = method(
        "send",
        &[Shape::Robot, Shape::Message],
        Some(Shape::Int),
        |sender, context, call| {
            let mut arguments = Arguments::after_instance(call);
            let to = arguments.robot();
            let payload = context.message(&mut arguments)?;
            let message = sender.channel.send(context.robot, to, &Raw(&payload));
            sender.sent(message, call)
        },
    );
}
