//! The events of all primitives, as one type.

use super::{
    BarrierEvent, BroadcastEvent, ElectionEvent, FailureDetectorEvent, Fields, GeocastEvent,
    MutexEvent, Name, ReachAvoidEvent, RegisterEvent, RegistrationEvent, SharedMemoryEvent,
    TransferEvent, UnicastEvent, ValueRefs, borrowed,
};
use alloc::boxed::Box;

macro_rules! primitives {
    ($($(#[$about:meta])* $variant:ident($events:ident) = $word:literal),* $(,)?) => {
        /// An event of a primitive.
        #[derive(Clone, Debug, PartialEq)]
        pub enum PrimitiveEvent {
            $($(#[$about])* $variant($events),)*
            /// Of a primitive that is not the platform's.
            Other(Box<OtherEvent>),
        }

        impl PrimitiveEvent {
            /// The primitive's type, e.g. `reach_avoid`.
            pub fn primitive(&self) -> &str {
                match self {
                    $(PrimitiveEvent::$variant(_) => $word,)*
                    PrimitiveEvent::Other(event) => &event.primitive,
                }
            }

            /// The name of the event, for example `done`.
            pub fn name(&self) -> &str {
                match self {
                    $(PrimitiveEvent::$variant(event) => event.name(),)*
                    PrimitiveEvent::Other(event) => &event.name,
                }
            }

            /// Its details by name, in order.
            pub fn fields(&self) -> ValueRefs<'_> {
                let mut shown = ValueRefs::new();
                match self {
                    $(PrimitiveEvent::$variant(event) => event.show(&mut shown),)*
                    PrimitiveEvent::Other(event) => return borrowed(&event.fields),
                }
                shown
            }

            /// The event of these names and details: the platform's own where it is one, as when a trace is read.
            pub fn named(
                primitive: impl Into<Name>,
                name: impl Into<Name>,
                fields: Fields,
            ) -> PrimitiveEvent {
                let (primitive, name) = (primitive.into(), name.into());
                let known = match &*primitive {
                    $($word => $events::read(&name, &fields).map(PrimitiveEvent::$variant),)*
                    _ => None,
                };
                known.unwrap_or_else(|| {
                    PrimitiveEvent::Other(Box::new(OtherEvent { primitive, name, fields }))
                })
            }
        }

        $(
            impl From<$events> for PrimitiveEvent {
                fn from(event: $events) -> PrimitiveEvent {
                    PrimitiveEvent::$variant(event)
                }
            }

            impl<'a> TryFrom<&'a PrimitiveEvent> for &'a $events {
                type Error = ();

                fn try_from(event: &'a PrimitiveEvent) -> Result<&'a $events, ()> {
                    match event {
                        PrimitiveEvent::$variant(event) => Ok(event),
                        _ => Err(()),
                    }
                }
            }
        )*
    };
}

primitives! {
    /// Of a ReachAvoid.
    ReachAvoid(ReachAvoidEvent) = "reach_avoid",
    /// Of a Unicast.
    Unicast(UnicastEvent) = "unicast",
    /// Of a Broadcast.
    Broadcast(BroadcastEvent) = "broadcast",
    /// Of a Geocast.
    Geocast(GeocastEvent) = "geocast",
    /// Of a SharedMemory.
    SharedMemory(SharedMemoryEvent) = "shared_memory",
    /// Of a Register.
    Register(RegisterEvent) = "register",
    /// Of a Mutex.
    Mutex(MutexEvent) = "mutex",
    /// Of a Registration.
    Registration(RegistrationEvent) = "registration",
    /// Of a LeaderElection.
    Election(ElectionEvent) = "election",
    /// Of a Barrier.
    Barrier(BarrierEvent) = "barrier",
    /// Of a failure detector.
    FailureDetector(FailureDetectorEvent) = "failure_detector",
}

/// An event of a primitive that is not the platform's, by names.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherEvent {
    /// The primitive's type.
    pub primitive: Name,
    /// The name of the event.
    pub name: Name,
    /// Its details.
    pub fields: Fields,
}

impl PrimitiveEvent {
    /// The outcome of a message, if this event is one.
    pub fn transfer(&self) -> Option<&TransferEvent> {
        match self {
            PrimitiveEvent::Unicast(UnicastEvent::Transfer(event))
            | PrimitiveEvent::Broadcast(BroadcastEvent::Transfer(event))
            | PrimitiveEvent::Geocast(GeocastEvent::Transfer(event)) => Some(event),
            _ => None,
        }
    }
}

/// The form of [`Event::Primitive`](super::Event::Primitive) in encodings: by names, independent of its type. Digests
/// are computed from this form.
pub(super) mod wire {
    use super::{Fields, Name, PrimitiveEvent};
    use crate::Port;
    use crate::event::ValueRef;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize)]
    struct Shown<'a> {
        primitive: &'a str,
        port: Port,
        name: &'a str,
        fields: &'a [(&'a str, ValueRef<'a>)],
    }

    #[derive(Deserialize)]
    struct Read {
        primitive: Name,
        port: Port,
        name: Name,
        fields: Fields,
    }

    pub fn serialize<S: Serializer>(
        port: &Port,
        event: &PrimitiveEvent,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let shown = Shown {
            primitive: event.primitive(),
            port: *port,
            name: event.name(),
            fields: &event.fields(),
        };
        shown.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<(Port, PrimitiveEvent), D::Error> {
        let Read {
            primitive,
            port,
            name,
            fields,
        } = Read::deserialize(deserializer)?;
        Ok((port, PrimitiveEvent::named(primitive, name, fields)))
    }
}
