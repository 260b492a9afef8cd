//! Broadcast, Geocast and Unicast in programs.
//!
//! A program identifies its messages by its own numbers, which count from 1 over all receivers; the protocol counts
//! separately for each receiver. Only outstanding messages are stored.

use super::kind::{Attention, Event, Kind, Member, Report, method, query};
use crate::machine::HostCall;
use crate::robot::arguments::{Arguments, Called};
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::shape::{ORDERS, Shape};
use crate::robot::workbench::robots;
use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;
use serde::ser::{Serialize, SerializeTuple, Serializer};
use starl_core::{Input, Payload, Primitive, Random, Robot};
use starl_primitives::broadcast::{Gap, Order};
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

const FAILED: Event = Event {
    name: "failed",
    parameters: &[Shape::Int, Shape::List(&Shape::Robot)],
};

const GAP: Event = Event {
    name: "gap",
    parameters: &[Shape::Optional(&Shape::Robot)],
};

/// The number of remembered messages at which settled ones are removed.
const FEW: u32 = 8;

/// The interface common to the three.
pub trait Channel: Primitive + Clone + fmt::Debug + Send + Sync + Sized + 'static {
    /// Its name.
    const NAME: &'static str;
    /// How a message is sent.
    const SEND: Member<Sender<Self>>;
    /// All members.
    const MEMBERS: &'static [Member<Sender<Self>>];

    /// Its constructor: a name by which instances find each other, in place of the name in the program, and parameters
    /// of its own.
    const CONSTRUCTOR: &'static [Shape] = &[Shape::Optional(&Shape::Text)];
    /// The events that it reports.
    const EVENTS: &'static [Event] = &[FAILED];

    /// An instance with this name, and with what the constructor has besides.
    fn bind(
        name: &str,
        robot: &mut Robot<'_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Self, Cow<'static, str>>;
    /// Whether the message is on its way to someone.
    fn is_outstanding(&self, message: MessageId) -> bool;
    /// How many messages are on their way to someone.
    fn backlog(&self) -> usize;
    /// The messages that were given up since the last call.
    fn take_failures(&mut self) -> Vec<Failure>;
    /// Overwrites its state at random.
    fn corrupt(&mut self, random: &mut Random);
    /// The gaps since the last call.
    fn take_gaps(&mut self) -> Vec<Gap> {
        Vec::new()
    }
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

    const BACKLOG: Member<Sender<C>> = query("backlog", &[], Shape::Int, |sender, _, call| {
        call.set_int(0, sender.channel.backlog() as i64);
        Ok(0)
    });
}

impl<C: Channel> Kind for Sender<C> {
    const NAME: &'static str = C::NAME;

    const CONSTRUCTOR: &'static [Shape] = C::CONSTRUCTOR;

    const MEMBERS: &'static [Member<Sender<C>>] = C::MEMBERS;

    const EVENTS: &'static [Event] = C::EVENTS;

    const ATTENTION: Attention = Attention::NONE;

    fn bind(
        instance: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Sender<C>, Cow<'static, str>> {
        let name = arguments.optional(Arguments::text);
        Ok(Sender {
            channel: C::bind(name.unwrap_or(&instance.name), context.robot, arguments)?,
            last: 0,
            most: FEW,
            outstanding: Vec::new(),
        })
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(&mut self.channel)
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.channel.corrupt(random);
        self.outstanding.retain(|_| random.chance(0.5));
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
        for gap in self.channel.take_gaps() {
            let (present, from) = gap.from.map_or((0, 0), |from| (1, u64::from(from.0)));
            take(Report {
                event: 1,
                scalars: Vec::from([present, from]),
                objects: Vec::new(),
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
    () => {
        fn is_outstanding(&self, message: MessageId) -> bool {
            Self::is_outstanding(self, message)
        }

        fn backlog(&self) -> usize {
            Self::backlog(self)
        }

        fn take_failures(&mut self) -> Vec<Failure> {
            Self::take_failures(self)
        }
    };
}

/// The part of a [`Channel`] that is written alike for those that have no order.
macro_rules! unordered {
    ($name:literal) => {
        const NAME: &'static str = $name;
        const MEMBERS: &'static [Member<Sender<Self>>] = &[
            <Self as Channel>::SEND,
            Sender::<Self>::OUTSTANDING,
            Sender::<Self>::BACKLOG,
        ];

        fn bind(
            name: &str,
            _: &mut Robot<'_>,
            _: &mut Arguments<'_>,
        ) -> Result<Self, Cow<'static, str>> {
            Ok(Self::new(name, Options::default()))
        }

        /// Nothing to corrupt: a false record of sent and received messages would look the same as a true one.
        fn corrupt(&mut self, _: &mut Random) {}
    };
}

impl Channel for Broadcast {
    channel!();

    const NAME: &'static str = "Broadcast";
    const CONSTRUCTOR: &'static [Shape] = &[
        Shape::Optional(&Shape::Text),
        Shape::Optional(&Shape::Order),
    ];
    const EVENTS: &'static [Event] = &[FAILED, GAP];
    const MEMBERS: &'static [Member<Sender<Self>>] = &[
        <Self as Channel>::SEND,
        Sender::<Self>::OUTSTANDING,
        Sender::<Self>::BACKLOG,
        query("failed", &[], Shape::Bool, |sender, _, call| {
            call.set_bool(0, sender.channel.failed());
            Ok(0)
        }),
    ];

    fn bind(
        name: &str,
        robot: &mut Robot<'_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Self, Cow<'static, str>> {
        let order = arguments.choice("order", &ORDERS, Order::Unordered)?;
        let mut broadcast = Broadcast::in_order(name, order, Options::default());
        broadcast.handle(robot, &Input::Start);
        Ok(broadcast)
    }

    fn take_gaps(&mut self) -> Vec<Gap> {
        Broadcast::take_gaps(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        Broadcast::corrupt(self, random);
    }

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
    channel!();
    unordered!("Geocast");

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
    channel!();
    unordered!("Unicast");

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
