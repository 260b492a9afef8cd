//! A warm-up that is not explored: all datagrams arrive at once, in the order of sending.
//!
//! In many protocols robots ask each other at their start for lost state. This has more orders than everything that
//! follows. Explorations of what follows begin after the warm-up.

use crate::bounds::Clocks;
use crate::moves::ready;
use crate::step::Step;
use crate::walk::{Impossible, Moment, Walk};

/// Robots that are never silent are not waited for any longer than for so many steps.
const LONGEST: usize = 10_000;

impl Walk {
    /// Delivers all datagrams in transit, fires all due timers, and ticks the clocks this number of times. Programs are
    /// not activated, and without ticking clocks no timer fires. Returns the steps with their events.
    ///
    /// # Errors
    /// The robots do not become quiet, or the clocks cannot tick this number of times.
    pub fn warm_up(&mut self, ticks: u16) -> Result<Vec<(Step, Moment)>, Impossible> {
        let mut taken = Vec::new();
        let mut left = ticks;
        while let Some(step) = self.next_of_warm_up(&mut left) {
            if taken.len() >= LONGEST {
                let text = format!("robots are still active after {LONGEST} steps");
                return Err(Impossible(text));
            }
            let moment = self.step(&step)?;
            taken.push((step, moment));
        }
        Ok(taken)
    }

    fn next_of_warm_up(&self, ticks: &mut u16) -> Option<Step> {
        let is_up = |datagram: &&crate::Datagram| self.scene().is_up(datagram.to);
        if let Some(datagram) = self.flight().find(is_up) {
            return Some(Step::Deliver(datagram.clone()));
        }
        let Clocks::Ticking { skew, .. } = self.bounds.clocks else {
            return None;
        };
        for local in &self.locals {
            let ready = ready(local, &self.surroundings);
            let armed = local.timers(&self.surroundings);
            let first = ready.first().map(|&place| armed[place as usize].0);
            if let Some(key) = first.filter(|_| local.runs()) {
                return Some(Step::Timer(local.robot(), key));
            }
        }
        if skew > 0 {
            let slowest = self.locals.iter().min_by_key(|local| local.clock)?;
            let is_ahead = self.locals.iter().any(|local| local.clock > slowest.clock);
            if *ticks == 0 && !is_ahead {
                return None;
            }
            *ticks -= u16::from(!is_ahead);
            return Some(Step::Tick(slowest.robot()));
        }
        *ticks = ticks.checked_sub(1)?;
        Some(Step::TickAll)
    }
}
