//! An operator's connection to a fleet.

use super::file::Fleet;
use super::link;
use crate::failure::Failure;
use starl_node::Operator;
use starl_node::operator::fresh_member;
use std::sync::mpsc;

/// Connects to all robots of a fleet.
pub fn connect(fleet: &Fleet) -> Result<Operator, Failure> {
    let keys = fleet.keys()?;
    link::check_router(fleet)?;
    let (sender, inbox) = mpsc::channel();
    let me = fresh_member();
    let transport = link::open(fleet, None, me, move |arrival| sender.send(arrival).is_ok())?;
    Ok(Operator::new(
        me,
        &fleet.name,
        keys,
        fleet.numbers(),
        transport,
        inbox,
    ))
}
