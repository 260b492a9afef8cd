//! The table of all kinds of primitives.

use super::bound::Bound;
use super::kind::{Attention, Event, Kind};
use super::{linearizable, messaging, policy, shared, watch};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::{Shape, Signature};
use alloc::borrow::Cow;
use alloc::boxed::Box;

/// The declarations of a [`Kind`], for use without its type.
pub struct Entry {
    pub name: &'static str,
    pub constructor: &'static [Shape],
    /// The signature of the member with this number.
    pub member: fn(usize) -> Option<&'static Signature>,
    pub events: &'static [Event],
    pub needs: Needs,
    pub attention: Attention,
    pub bind: Bind,
}

type Bind = fn(
    &Instance,
    &mut Context<'_, '_>,
    &mut Arguments<'_>,
) -> Result<Box<dyn Bound>, Cow<'static, str>>;

impl Entry {
    const fn of<P: Kind>() -> Entry {
        Entry {
            name: P::NAME,
            constructor: P::CONSTRUCTOR,
            member: |index| P::MEMBERS.get(index).map(|member| &member.signature),
            events: P::EVENTS,
            needs: P::NEEDS,
            attention: P::ATTENTION,
            bind: |instance, context, arguments| {
                Ok(Box::new(P::bind(instance, context, arguments)?))
            },
        }
    }

    /// The signatures of all its members.
    pub fn members(&self) -> impl Iterator<Item = &'static Signature> + use<> {
        (0..).map_while(self.member)
    }
}

/// All kinds of primitives.
pub static KINDS: &[Entry] = &[
    Entry::of::<starl_primitives::ReachAvoid>(),
    Entry::of::<messaging::Sender<starl_primitives::Broadcast>>(),
    Entry::of::<messaging::Sender<starl_primitives::Geocast>>(),
    Entry::of::<messaging::Sender<starl_primitives::Unicast>>(),
    Entry::of::<starl_primitives::LocalBroadcast>(),
    Entry::of::<starl_primitives::Mutex>(),
    Entry::of::<starl_primitives::Registration>(),
    Entry::of::<starl_primitives::Barrier>(),
    Entry::of::<watch::Watch>(),
    Entry::of::<starl_primitives::LeaderElection>(),
    Entry::of::<shared::SingleWriter>(),
    Entry::of::<shared::MultiWriter>(),
    Entry::of::<linearizable::Linearizable>(),
    Entry::of::<policy::Policy>(),
];
