//! An operator's connection to a fleet.

use super::file::Fleet;
use crate::failure::Failure;
use crate::output::reason;
use starl_node::Operator;
use starl_node::link::udp::Udp;
use starl_node::operator::fresh_member;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::mpsc;

/// Connects to all robots of a fleet.
pub fn connect(fleet: &Fleet) -> Result<Operator, Failure> {
    let keys = fleet.keys()?;
    let here = match fleet.is_local() {
        true => Ipv4Addr::LOCALHOST,
        false => Ipv4Addr::UNSPECIFIED,
    };
    let (sender, inbox) = mpsc::channel();
    let address = SocketAddr::new(IpAddr::V4(here), 0);
    let udp = Udp::open(address, fleet.places(), move |arrival| {
        sender.send(arrival).is_ok()
    });
    let udp =
        udp.map_err(|error| Failure(format!("no socket can be opened: {}", reason(&error))))?;
    let robots = fleet.robots.iter().map(|robot| robot.id.0).collect();
    Ok(Operator::new(
        fresh_member(),
        &fleet.name,
        keys,
        robots,
        Box::new(udp),
        inbox,
    ))
}
