//! What the one who asked may not have noticed: that something was waited for and came in no behaviour, so that
//! nothing was found out about it.
//!
//! A tick of 981 ms suits the primitives' leases of 2 s and 3 s: what a robot believes to hold ends a hundredth
//! earlier for each clock, and so a tick before what others have granted it.

use starl_explore::{Bounds, Clocks};
use std::collections::BTreeSet;

/// What robots ask a primitive for: the primitive, the event of asking, that of getting, and how it is put.
const WISHES: [(&str, &str, &str, &str); 4] = [
    ("election", "elect", "leader", "nobody is ever elected"),
    ("mutex", "acquire", "enter", "nobody ever gets a resource"),
    (
        "registration",
        "register",
        "agree",
        "nobody is ever agreed on",
    ),
    (
        "barrier",
        "arrive",
        "pass",
        "nobody ever passes the barrier",
    ),
];

/// Hints, by what primitives told of in some behaviour, all of them or those of a part.
pub fn hints(bounds: &Bounds, told: &BTreeSet<(&str, &str)>, is_complete: bool) -> Vec<String> {
    let in_vain = WISHES.iter().filter(|(primitive, asks, gets, _)| {
        told.contains(&(*primitive, *asks)) && !told.contains(&(*primitive, *gets))
    });
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
        .map(|(.., words)| {
            format!("in these behaviours {words}, and nothing is shown about it; {advice}")
        })
        .collect()
}
