//! Opens the network of a fleet, for a robot or for an operator.

use super::file::{Fleet, LinkKind, Member};
use crate::console;
use crate::failure::Failure;
use starl_catalog::disk::reason;
use starl_node::WallClock;
use starl_node::link::udp::Udp;
use starl_node::link::{Arrival, Impaired, Transport};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpStream, ToSocketAddrs};
use std::time::Duration;

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

/// How often the router is looked for.
const PROBE: Duration = Duration::from_millis(200);

/// Waits until the fleet's router can be reached, if it has one, and reports that as `who`; whether it can be, before `is_over`.
pub fn await_router(fleet: &Fleet, who: &str, is_over: impl Fn() -> bool) -> bool {
    let Some(router) = &fleet.network.router else {
        return true;
    };
    let mut is_told = false;
    while !is_reachable(router) {
        if is_over() {
            return false;
        }
        if !std::mem::replace(&mut is_told, true) {
            console::complain(&format!("{who}: waits for the router at {router}\n"));
        }
        std::thread::sleep(PROBE);
    }
    true
}

/// Refuses if the fleet has a router that does not answer: an operator has nothing to wait for.
pub fn check_router(fleet: &Fleet) -> Result<(), Failure> {
    match &fleet.network.router {
        Some(router) if !is_reachable(router) => {
            let file = fleet.path.display();
            let what = format!(
                "link.router: no router answers at {router}; `starl fleet router {file}` runs one there"
            );
            Err(Failure::file(&fleet.path, what))
        }
        _ => Ok(()),
    }
}

/// Whether something listens at an endpoint of Zenoh, such as `tcp/192.168.0.1:7447`. Only TCP can be tried.
fn is_reachable(endpoint: &str) -> bool {
    let (scheme, address) = parts(endpoint);
    let mut places = address.to_socket_addrs().into_iter().flatten();
    !["tcp", "tls"].contains(&scheme)
        || places.any(|place| TcpStream::connect_timeout(&place, Duration::from_secs(1)).is_ok())
}

/// The scheme and the address of an endpoint, without its options.
fn parts(endpoint: &str) -> (&str, &str) {
    let (scheme, rest) = endpoint.split_once('/').unwrap_or(("", endpoint));
    (scheme, rest.split(['?', '#']).next().unwrap_or(rest))
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
        let why = reason(&error);
        match robot {
            Some(robot) => Failure::file(
                &fleet.path,
                format!(
                    "robots.{}.address: {address} cannot be used: {why}; if the fleet runs already, `starl fleet stop` ends it, else give another `address` or `link.first_port`",
                    robot.name
                ),
            ),
            None => Failure(format!("no socket can be opened at {address}: {why}")),
        }
    })?;
    Ok(Box::new(udp))
}

/// Refuses certificates that the other members would not accept, and a network that this build does not have.
#[cfg(feature = "zenoh")]
pub fn check(fleet: &Fleet, robot: Option<&Member>) -> Result<(), Failure> {
    let Some(tls) = certificates(fleet, name_of(robot)) else {
        return Ok(());
    };
    let listens = fleet.network.router.is_none();
    let address = robot.filter(|_| listens).map(|robot| robot.address.ip());
    let checked = tls.check(address);
    checked.map_err(|error| Failure::file(&fleet.path, format!("link.tls.{error}")))
}

/// The name of a member in the paths of certificates.
#[cfg(feature = "zenoh")]
fn name_of(robot: Option<&Member>) -> &str {
    robot.map_or("operator", |robot| &robot.name)
}

/// The files of the member with this name; none if the fleet has no certificates.
#[cfg(feature = "zenoh")]
fn certificates(fleet: &Fleet, name: &str) -> Option<starl_zenoh::Tls> {
    use std::path::Path;

    let tls = fleet.network.tls.as_ref()?;
    let folder = fleet.path.parent().unwrap_or(Path::new(""));
    let file = |path: &Path| folder.join(path.display().to_string().replace("NAME", name));
    Some(starl_zenoh::Tls {
        authority: file(&tls.authority),
        certificate: file(&tls.certificate),
        key: file(&tls.key),
    })
}

#[cfg(feature = "zenoh")]
fn zenoh(
    fleet: &Fleet,
    robot: Option<&Member>,
    me: u32,
    deliver: impl Fn(Arrival) -> bool + Send + Sync + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    use starl_zenoh::{Mode, Zenoh, ZenohOptions};

    check(fleet, robot)?;
    let network = &fleet.network;
    let scheme = if network.tls.is_some() { "tls" } else { "tcp" };
    let endpoint = |place: SocketAddr| format!("{scheme}/{place}");
    let name = name_of(robot);
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
        is_complete: network.router.is_none(),
        // An operator is a guest: others need not connect to it.
        mode: match network.router {
            Some(_) => Mode::Client,
            None => Mode::Peer,
        },
        tls: certificates(fleet, name),
    };
    // First, because a client waits for its router.
    let probes = probes(fleet, robot)?;
    let joined = Zenoh::open(&fleet.name, me, &options, deliver);
    let joined = joined.map_err(|error| {
        let what = format!(
            "{name} cannot join the Zenoh network: {error}; check its `address` and `link`, and whether the fleet runs already"
        );
        Failure::file(&fleet.path, what)
    })?;
    Ok(Box::new(joined.with_probes(probes)))
}

/// Runs the fleet's router until what is returned is dropped.
#[cfg(feature = "zenoh")]
pub fn route(fleet: &Fleet, endpoint: &str) -> Result<impl Sized + use<>, Failure> {
    use starl_zenoh::{Mode, ZenohOptions};

    let options = ZenohOptions {
        listen: vec![endpoint.to_string()],
        mode: Mode::Router,
        tls: certificates(fleet, "router"),
        ..ZenohOptions::default()
    };
    starl_zenoh::session(&options).map_err(|error| {
        let what = format!(
            "link.router: no router can run at {endpoint}: {error}; check that this machine has the address, and that no router runs there already"
        );
        Failure::file(&fleet.path, what)
    })
}

/// Reports the members that refuse this one, or that have no TLS; none if the fleet has no certificates.
#[cfg(feature = "zenoh")]
fn probes(fleet: &Fleet, robot: Option<&Member>) -> Result<Option<starl_zenoh::Probes>, Failure> {
    use starl_zenoh::{Probed, Probes};

    let Some(tls) = certificates(fleet, name_of(robot)) else {
        return Ok(None);
    };
    let others = fleet.robots.iter();
    let others = others.filter(|other| robot.is_none_or(|robot| robot.id != other.id));
    let members = match &fleet.network.router {
        Some(router) => vec![Probed {
            name: "the router".to_string(),
            address: parts(router).1.to_string(),
        }],
        None => others
            .map(|other| Probed {
                name: other.name.clone(),
                address: other.address.to_string(),
            })
            .collect(),
    };
    let path = fleet.path.display().to_string();
    let name = name_of(robot).to_string();
    let tell = move |problem: &str| {
        crate::console::complain(&format!("{name}: {path}: link.tls: {problem}\n"));
    };
    let started = Probes::start(&tls, members, tell);
    let probes =
        started.map_err(|error| Failure::file(&fleet.path, format!("link.tls.{error}")))?;
    Ok(Some(probes))
}

#[cfg(not(feature = "zenoh"))]
pub fn check(fleet: &Fleet, _: Option<&Member>) -> Result<(), Failure> {
    match fleet.network.kind {
        LinkKind::Udp => Ok(()),
        LinkKind::Zenoh => Err(no_zenoh(fleet)),
    }
}

#[cfg(not(feature = "zenoh"))]
fn zenoh(
    fleet: &Fleet,
    _: Option<&Member>,
    _: u32,
    _: impl Fn(Arrival) -> bool + Send + Sync + 'static,
) -> Result<Box<dyn Transport>, Failure> {
    Err(no_zenoh(fleet))
}

#[cfg(not(feature = "zenoh"))]
pub fn route(fleet: &Fleet, _: &str) -> Result<(), Failure> {
    Err(no_zenoh(fleet))
}

#[cfg(not(feature = "zenoh"))]
fn no_zenoh(fleet: &Fleet) -> Failure {
    Failure::file(
        &fleet.path,
        "link.kind: this build has no Zenoh; build it with the feature `zenoh`, or take `kind = \"udp\"`",
    )
}
