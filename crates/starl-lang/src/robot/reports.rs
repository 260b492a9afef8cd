//! Events of primitives that wait for their handlers in a program.

use super::atomic::Conflicts;
use super::instance::Instance;
use super::primitives::Report;
use crate::machine::{Machine, RuntimeError};
use alloc::vec::Vec;

/// At most so many messages and orders, and so many events of primitives, wait for an action with `atomic`; beyond that
/// the oldest are dropped.
pub(super) const MOST_WAITING: usize = 1000;

/// Runs the handlers of what primitives have reported, in the order in which it happened.
pub(super) fn handle_reports(
    instances: &[Instance],
    reports: &[(u32, Report)],
    machine: &mut Machine<'_>,
) -> Result<(), RuntimeError> {
    for (instance, report) in reports {
        let handlers = instances
            .get(*instance as usize)
            .map_or(&[][..], |instance| &instance.handlers);
        for (_, handler) in handlers.iter().filter(|(event, _)| *event == report.event) {
            machine.handler(*handler, &report.scalars, &report.objects)?;
        }
    }
    Ok(())
}

/// Splits the reports of primitives: keeps those that can be handled now, and returns those that must wait until an
/// action with `atomic` has taken place.
pub(super) fn hold_back(
    instances: &[Instance],
    reports: &mut Vec<(u32, Report)>,
    held: Option<&Conflicts>,
) -> Vec<(u32, Report)> {
    let Some(held) = held else {
        return Vec::new();
    };
    let waits = |(instance, report): &(u32, Report)| {
        let instance = instances.get(*instance as usize);
        let handlers = instance.map_or(&[][..], |instance| &instance.handlers);
        let mut handlers = handlers.iter();
        handlers.any(|&(event, handler)| event == report.event && held.keeps_handler(handler))
    };
    let first = reports.iter().position(waits).unwrap_or(reports.len());
    let mut later = reports.split_off(first);
    let excess = later.len().saturating_sub(MOST_WAITING);
    later.drain(..excess);
    later
}
