//! Notes about gaps of an exploration: robots wait for something that happens in no behaviour, so the exploration
//! does not test it.
//!
//! A tick of 981 ms suits the primitives' leases of 2 s and 3 s: the holder's lease ends a hundredth earlier for
//! each clock, and so a tick before the lease of its granters.

use starl_core::event::{
    BarrierEvent, ElectionEvent, MutexEvent, PrimitiveEvent, RegistrationEvent,
};
use starl_explore::{Bounds, Clocks};
use std::collections::BTreeSet;

/// The requests of robots to primitives, and the note if none of them is granted in any behaviour.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Request {
    Leader,
    Resource,
    List,
    Passage,
}

impl Request {
    const ALL: [Request; 4] = [
        Request::Leader,
        Request::Resource,
        Request::List,
        Request::Passage,
    ];

    /// The request of an event, and whether the event grants it.
    fn of(event: &PrimitiveEvent) -> Option<(Request, bool)> {
        match event {
            PrimitiveEvent::Election(ElectionEvent::Elect) => Some((Request::Leader, false)),
            PrimitiveEvent::Election(ElectionEvent::Leader { .. }) => Some((Request::Leader, true)),
            PrimitiveEvent::Mutex(MutexEvent::Acquire { .. }) => Some((Request::Resource, false)),
            PrimitiveEvent::Mutex(MutexEvent::Enter { .. }) => Some((Request::Resource, true)),
            PrimitiveEvent::Registration(RegistrationEvent::Register { .. }) => {
                Some((Request::List, false))
            }
            PrimitiveEvent::Registration(RegistrationEvent::Agree { .. }) => {
                Some((Request::List, true))
            }
            PrimitiveEvent::Barrier(BarrierEvent::Arrive { .. }) => Some((Request::Passage, false)),
            PrimitiveEvent::Barrier(BarrierEvent::Pass { .. }) => Some((Request::Passage, true)),
            _ => None,
        }
    }

    fn denied(self) -> &'static str {
        match self {
            Request::Leader => "no robot is ever elected",
            Request::Resource => "no robot ever gets a resource",
            Request::List => "no list is ever agreed on",
            Request::Passage => "no robot ever passes the barrier",
        }
    }
}

/// The note if whether robots finish is not judged.
pub const UNJUDGED: &str = "actions with `every` and `for` wait while clocks stand still, so whether robots finish is \
                            not judged: let clocks tick, e.g. --tick 1s --time 4s --delay 1";

/// The note about properties that are not judged.
pub fn unjudged(properties: &[String]) -> Option<String> {
    let names = properties.join(", ");
    (!properties.is_empty()).then(|| {
        format!(
            "properties with `eventually` or `leads_to` have deadlines and are not judged: {names}"
        )
    })
}

/// The notes, from the events of primitives in all visited behaviours.
pub fn hints<'a>(
    bounds: &Bounds,
    told: impl Iterator<Item = &'a PrimitiveEvent>,
    is_complete: bool,
) -> Vec<String> {
    let requests: BTreeSet<(Request, bool)> = told.filter_map(Request::of).collect();
    let denied = Request::ALL.into_iter().filter(|request| {
        requests.contains(&(*request, false)) && !requests.contains(&(*request, true))
    });
    let advice = match (bounds.clocks, is_complete) {
        (Clocks::Still, true) => {
            "clocks stand still, so leases and other waits do not end: let clocks tick, e.g. --tick \
             981ms --time 4s --delay 1"
        }
        (Clocks::Still, false) => {
            "it may happen later; but leases and other waits do not end while clocks stand still: let clocks \
             tick, e.g. --tick 981ms --time 4s --delay 1"
        }
        (Clocks::Ticking { .. }, true) => "--time may be too short",
        (Clocks::Ticking { .. }, false) => "it may happen later",
    };
    denied
        .map(|request| {
            let words = request.denied();
            format!("in these behaviours {words}, so the exploration does not test that; {advice}")
        })
        .collect()
}
