//! How the node waits for storage before it does what its software asks for.
//!
//! One write is in progress at a time. Values saved meanwhile become part of the next one, so that many small
//! writes do not slow a robot down. Effects keep their order: those of an input wait for the last write that
//! this input, or an earlier one, has caused.

use super::Node;
use crate::{Outlet, Snapshot, StoreJob};
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use core::mem;
use starl_core::{Effect, Save, Time};

/// The effects that wait during a write.
#[derive(Clone, Debug, Default)]
pub(super) struct Waiting {
    /// The write that is under way.
    write: u32,
    /// To be written next.
    next: Vec<Save>,
    /// Effects, each with the write that must be done before.
    effects: VecDeque<(u32, Effect)>,
}

impl Node {
    /// Passes saved values to storage, and holds back the effects that must wait for the write.
    pub(super) fn commit(&mut self, at: Time, list: &mut Vec<Effect>, outlet: &mut impl Outlet) {
        let has_saved = list.iter().any(|effect| matches!(effect, Effect::Save(_)));
        if !has_saved && self.waiting.is_none() {
            return;
        }
        let is_idle = self.waiting.is_none();
        let waiting = self.waiting.get_or_insert_default();
        let (mut saves, mut others) = (Vec::new(), Vec::new());
        for effect in list.drain(..) {
            match effect {
                Effect::Save(save) => saves.push(save),
                effect => others.push(effect),
            }
        }
        if is_idle {
            self.writes = self.writes.wrapping_add(1);
            waiting.write = self.writes;
            let job = self.writes;
            outlet.store(at, StoreJob { job, saves });
        } else {
            waiting.next.append(&mut saves);
        }
        let is_for_next = !waiting.next.is_empty();
        let write = waiting.write.wrapping_add(u32::from(is_for_next));
        let others = others.into_iter().map(|effect| (write, effect));
        waiting.effects.extend(others);
    }

    /// A write is done: what waited for it takes place, and the next write begins.
    pub(super) fn stored(
        &mut self,
        at: Time,
        job: u32,
        snapshot: &Snapshot<'_>,
        outlet: &mut impl Outlet,
    ) {
        let Some(mut waiting) = self.waiting.take_if(|waiting| waiting.write == job) else {
            return;
        };
        let later = waiting.effects.iter().position(|&(write, _)| write != job);
        let later = waiting
            .effects
            .split_off(later.unwrap_or(waiting.effects.len()));
        let due = mem::replace(&mut waiting.effects, later);
        if !waiting.next.is_empty() {
            self.writes = self.writes.wrapping_add(1);
            waiting.write = self.writes;
            let saves = mem::take(&mut waiting.next);
            self.waiting = Some(waiting);
            outlet.store(
                at,
                StoreJob {
                    job: self.writes,
                    saves,
                },
            );
        }
        for (_, effect) in due {
            self.carry_out(at, effect, snapshot, outlet);
        }
    }
}
