//! Notes about unnoticed gaps: robots waited for something that came in no behaviour, so the exploration says
//! nothing about it.
//!
//! A tick of 981 ms suits the primitives' leases of 2 s and 3 s: what a robot believes to hold ends a hundredth
//! earlier for each clock, and so a tick before what others have granted it.

use starl_core::event::{
    BarrierEvent, ElectionEvent, MutexEvent, PrimitiveEvent, RegistrationEvent,
};
use starl_explore::{Bounds, Clocks};
use std::collections::BTreeSet;

/// The requests of robots to primitives, and the note if none of them is granted in any behaviour.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Wish {
    Leader,
    Resource,
    List,
    Passage,
}

impl Wish {
    const ALL: [Wish; 4] = [Wish::Leader, Wish::Resource, Wish::List, Wish::Passage];

    /// The wish that an event tells of, and whether it tells that it has come true.
    fn of(event: &PrimitiveEvent) -> Option<(Wish, bool)> {
        match event {
            PrimitiveEvent::Election(ElectionEvent::Elect) => Some((Wish::Leader, false)),
            PrimitiveEvent::Election(ElectionEvent::Leader { .. }) => Some((Wish::Leader, true)),
            PrimitiveEvent::Mutex(MutexEvent::Acquire { .. }) => Some((Wish::Resource, false)),
            PrimitiveEvent::Mutex(MutexEvent::Enter { .. }) => Some((Wish::Resource, true)),
            PrimitiveEvent::Registration(RegistrationEvent::Register { .. }) => {
                Some((Wish::List, false))
            }
            PrimitiveEvent::Registration(RegistrationEvent::Agree { .. }) => {
                Some((Wish::List, true))
            }
            PrimitiveEvent::Barrier(BarrierEvent::Arrive { .. }) => Some((Wish::Passage, false)),
            PrimitiveEvent::Barrier(BarrierEvent::Pass { .. }) => Some((Wish::Passage, true)),
            _ => None,
        }
    }

    fn in_vain(self) -> &'static str {
        match self {
            Wish::Leader => "no robot is ever elected",
            Wish::Resource => "no robot ever gets a resource",
            Wish::List => "no list is ever agreed on",
            Wish::Passage => "no robot ever passes the barrier",
        }
    }
}

/// Hints, by what primitives told of in some behaviour, all of them or those of a part.
pub fn hints<'a>(
    bounds: &Bounds,
    told: impl Iterator<Item = &'a PrimitiveEvent>,
    is_complete: bool,
) -> Vec<String> {
    let wishes: BTreeSet<(Wish, bool)> = told.filter_map(Wish::of).collect();
    let in_vain = Wish::ALL
        .into_iter()
        .filter(|wish| wishes.contains(&(*wish, false)) && !wishes.contains(&(*wish, true)));
    let advice = match (bounds.clocks, is_complete) {
        (Clocks::Still, true) => {
            "clocks stand still, so leases and other waits do not end: let them tick, e.g. --tick \
             981ms --time 4s --delay 1"
        }
        (Clocks::Still, false) => {
            "it may come later; but leases and other waits do not end while clocks stand still: let them \
             tick, e.g. --tick 981ms --time 4s --delay 1"
        }
        (Clocks::Ticking { .. }, true) => "--time may be too short",
        (Clocks::Ticking { .. }, false) => "it may come later",
    };
    in_vain
        .map(|wish| {
            let words = wish.in_vain();
            format!("in these behaviours {words}, and nothing is shown about it; {advice}")
        })
        .collect()
}
