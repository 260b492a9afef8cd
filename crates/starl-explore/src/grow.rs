//! With any copies, a step that only adds datagrams in transit is the only step of its state.
//!
//! The state that it leads to covers the one before ([`crate::cover`]): robots, checkers and bounds are the same, and
//! all datagrams are still in transit. So whatever can happen before the step can also happen after it, and no other
//! step needs to be explored before. Of several such steps one order is explored, not all.
//!
//! The first violation found may thus have such steps on its way that it does not need. They are dropped.

use crate::actors::{Actors, HEAD};
use crate::code::{Code, Flying, Kind};
use std::collections::BTreeSet;

/// Drops the steps that only add datagrams which no later step delivers. `rows` are the states before the steps, and
/// the one after them unless the last step itself violates something.
pub(crate) fn drop_needless<T>(steps: &mut Vec<(T, Code)>, rows: &[&[u32]], actors: &Actors) {
    let mut delivered = BTreeSet::new();
    for place in (0..steps.len()).rev() {
        let after = rows.get(place + 1);
        let is_needless = after.is_some_and(|after| {
            let added = added(rows[place], after, actors);
            added.is_some_and(|added| added.is_disjoint(&delivered))
        });
        let code = steps[place].1;
        if is_needless {
            steps.remove(place);
        } else if matches!(code.kind(), Kind::Deliver | Kind::Duplicate) {
            delivered.insert(code.number());
        }
    }
}

/// The datagrams that a step adds, if it changes nothing else.
fn added(before: &[u32], after: &[u32], actors: &Actors) -> Option<BTreeSet<u32>> {
    let mut added = BTreeSet::new();
    for (&before, &after) in before[HEAD..].iter().zip(&after[HEAD..]) {
        if actors.local(before) != actors.local(after) {
            return None;
        }
        let old = actors.mailbox(before);
        let new = actors.mailbox(after).iter();
        added.extend(
            new.filter(|word| !old.contains(word))
                .map(|&word| Flying(word).number()),
        );
    }
    (before[0] == after[0]).then_some(added)
}
