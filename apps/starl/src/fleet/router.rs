//! `starl fleet router`: the Zenoh router by which the robots of a fleet reach each other.

use super::file::{Fleet, LinkKind};
use super::link;
use crate::args::FleetRouterArguments;
use crate::console;
use crate::failure::Failure;
use crate::run::stop_on_interrupt;
use starl_catalog::programs::Registry;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Routes packets until someone presses Ctrl-C.
pub fn run(arguments: &FleetRouterArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let Some(endpoint) = &fleet.network.router else {
        let fix = match fleet.network.kind {
            LinkKind::Udp => "a router is for `kind = \"zenoh\"`; robots with UDP need none",
            LinkKind::Zenoh => {
                "give the place of the router, such as `router = \"tcp/192.168.0.1:7447\"`"
            }
        };
        return Err(Failure::file(&fleet.path, format!("link.router: {fix}")));
    };
    let stop = stop_on_interrupt();
    let _router = link::route(&fleet, endpoint)?;
    console::print(&format!("routing at {endpoint}\nready\n"))?;
    while !stop.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(50));
    }
    Ok(true)
}
