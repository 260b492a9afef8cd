//! Opens the network of a fleet, for a robot or for an operator.

use super::file::{Fleet, LinkKind, Member};
use crate::failure::Failure;
use starl_catalog::disk::reason;
use starl_node::WallClock;
use starl_node::link::udp::Udp;
use starl_node::link::{Arrival, Impaired, Transport};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};

/// Joins the network as `me`: as this robot, or as an operator if there is none.
pub fn open(
    fleet: &Fleet,
    robot: Option<&Member>,
    me: u32,
    deliver: impl Fn(Arrival) -> bool + Send + Sync + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    let transport = match fleet.network.kind {
        LinkKind::Udp => udp(fleet, robot, deliver),
        LinkKind::Zenoh => zenoh(fleet, robot, me, deliver),
    }?;
    match fleet.network.impairment {
        None => Ok(transport),
        Some(impairment) => {
            let seed = u64::from(me) ^ WallClock::system().as_nanos() as u64;
            let impaired = Impaired::new(transport, impairment, seed);
            Ok(Box::new(impaired.map_err(|error| Failure(reason(&error)))?))
        }
    }
}

fn udp(
    fleet: &Fleet,
    robot: Option<&Member>,
    deliver: impl FnMut(Arrival) -> bool + Send + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    let here = match fleet.is_local() {
        true => Ipv4Addr::LOCALHOST,
        false => Ipv4Addr::UNSPECIFIED,
    };
    let any = SocketAddr::new(IpAddr::V4(here), 0);
    let address = robot.map_or(any, |robot| robot.address);
    let udp = Udp::open(address, fleet.places(), deliver).map_err(|error| {
        let who = robot.map_or("operator", |robot| &robot.name);
        Failure(format!(
            "{who}: the address {address} cannot be used: {}",
            reason(&error)
        ))
    })?;
    Ok(Box::new(udp))
}

#[cfg(feature = "zenoh")]
fn zenoh(
    fleet: &Fleet,
    robot: Option<&Member>,
    me: u32,
    deliver: impl Fn(Arrival) -> bool + Send + Sync + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    use starl_zenoh::{Mode, Tls, Zenoh, ZenohOptions};
    use std::path::Path;

    let network = &fleet.network;
    let scheme = if network.tls.is_some() { "tls" } else { "tcp" };
    let endpoint = |place: SocketAddr| format!("{scheme}/{place}");
    let name = robot.map_or("operator", |robot| &robot.name);
    let folder = fleet.path.parent().unwrap_or(Path::new(""));
    let file = |path: &Path| folder.join(path.display().to_string().replace("NAME", name));
    let before = fleet
        .robots
        .iter()
        .take_while(|other| robot.is_none_or(|robot| robot.id != other.id));
    let options = ZenohOptions {
        listen: match (&network.router, robot) {
            (None, Some(robot)) => vec![endpoint(robot.address)],
            _ => Vec::new(),
        },
        connect: match &network.router {
            Some(router) => vec![router.clone()],
            None => before.map(|other| endpoint(other.address)).collect(),
        },
        // An operator is a guest: others need not connect to it.
        mode: match network.router {
            Some(_) => Mode::Client,
            None => Mode::Peer,
        },
        tls: network.tls.as_ref().map(|tls| Tls {
            authority: file(&tls.authority),
            certificate: file(&tls.certificate),
            key: file(&tls.key),
        }),
    };
    let joined = Zenoh::open(&fleet.name, me, &options, deliver);
    let joined = joined
        .map_err(|error| Failure(format!("{name}: cannot join the Zenoh network: {error}")))?;
    Ok(Box::new(joined))
}

#[cfg(not(feature = "zenoh"))]
fn zenoh(
    fleet: &Fleet,
    _: Option<&Member>,
    _: u32,
    _: impl Fn(Arrival) -> bool + Send + Sync + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    Err(Failure::file(
        &fleet.path,
        "link.kind: this build has no Zenoh; build it with the feature `zenoh`, or take `kind = \"udp\"`",
    ))
}
