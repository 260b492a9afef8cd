//! The fleet file: what all robots of a real fleet share, and where each of them is.

use crate::args::ChangeArguments;
use crate::args::RunArguments;
use crate::failure::Failure;
use crate::target;
use serde::Deserialize;
use starl_catalog::Application;
use starl_catalog::examples;
use starl_catalog::programs::Registry;
use starl_core::{Duration, RobotId};
use starl_create::Generation;
use starl_node::link::{Impairment, Key};
use starl_sim::read::suggest;
use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

/// The port of the first robot, where no robot has an address of its own.
const FIRST_PORT: u16 = 7400;

/// A fleet file as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// A scenario file, by its path from the fleet file's folder, or an example's name.
    scenario: String,
    /// The fleet's name; default the file's.
    name: Option<String>,
    /// Fields of the scenario that are other than in it, as for `--set`.
    #[serde(default)]
    set: Vec<String>,
    #[serde(default)]
    link: Link,
    #[serde(default)]
    safety: Safety,
    positions: Option<Positions>,
    /// The address of a world in which simulated robots have their bodies together with emulated ones; default none: each
    /// is alone.
    world: Option<SocketAddr>,
    /// A robot's trace ends at this many MiB; default 1024.
    trace_limit_mib: Option<NonZeroU32>,
    #[serde(default)]
    robots: BTreeMap<String, Robot>,
}

/// How robots reach each other.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Link {
    /// A file with the fleet's key; default the fleet file's name with `.key`.
    key: Option<PathBuf>,
    /// Whether packets are protected; default true.
    protected: Option<bool>,
    /// The port of the first robot that has no address of its own, those of the others follow; default 7400.
    first_port: Option<u16>,
    /// The network; default UDP.
    #[serde(default)]
    kind: LinkKind,
    /// With Zenoh: a router that all robots are clients of, e.g. `tcp/192.168.0.1:7447`; default none, robots connect
    /// to each other.
    router: Option<String>,
    /// With Zenoh: certificates.
    tls: Option<Tls>,
    /// Makes the network worse than it is, for a rehearsal.
    rehearse: Option<Rehearsal>,
}

/// The impairment of packets that robots send.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rehearsal {
    /// The part of packets that is lost, 0 to 1.
    #[serde(default)]
    loss: f64,
    /// The part of packets that arrives twice, 0 to 1.
    #[serde(default)]
    duplication: f64,
    /// How long a packet takes, at least.
    delay: Option<String>,
    /// How much longer it may take.
    jitter: Option<String>,
}

/// The network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LinkKind {
    /// UDP.
    #[default]
    Udp,
    /// Zenoh.
    Zenoh,
}

/// Certificates in PEM, by their paths from the fleet file's folder. `NAME` stands for the robot's name, or `operator`.
#[cfg_attr(
    not(feature = "zenoh"),
    expect(dead_code, reason = "read by Zenoh alone")
)]
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tls {
    /// Of the authority that has signed all others.
    pub authority: PathBuf,
    /// Of the robot.
    pub certificate: PathBuf,
    /// The key to that.
    pub key: PathBuf,
}

/// How robots reach each other, checked.
#[cfg_attr(
    not(feature = "zenoh"),
    expect(dead_code, reason = "read by Zenoh alone")
)]
#[derive(Clone, Debug)]
pub struct Network {
    /// The network.
    pub kind: LinkKind,
    /// The router.
    pub router: Option<String>,
    /// Certificates.
    pub tls: Option<Tls>,
    /// The impairment that makes the network worse than it is.
    pub impairment: Option<Impairment>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Safety {
    /// Motors stop after this without a position; default 1 s, or three periods of positioning if that is longer.
    position_timeout: Option<String>,
    /// Motors stop after this without hearing another robot; default never.
    link_timeout: Option<String>,
}

/// One robot.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Robot {
    /// Where others reach it; default on this machine.
    address: Option<SocketAddr>,
    /// The device that it drives; default a simulated body.
    device: Option<Device>,
    /// Its name at the source of positions; default its name.
    body: Option<String>,
}

/// The device of a robot.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Device {
    /// A body of the scenario's model, computed in the robot's own process.
    #[default]
    Simulated,
    /// An iRobot Create on a serial line.
    Create {
        /// The line, e.g. `/dev/ttyUSB0`.
        port: PathBuf,
        /// 1 for the Create of 2007, 2 for the Create 2; default 2.
        generation: Option<u8>,
        /// Bits per second of the line; default as the robot was sold.
        baud: Option<u32>,
    },
    /// An AR.Drone 2.
    Ardrone {
        /// Where it takes commands; default `192.168.1.1:5556`.
        commands: Option<SocketAddr>,
        /// Where it gives navdata; default `192.168.1.1:5554`.
        navdata: Option<SocketAddr>,
    },
    /// A Crazyflie, over UDP.
    Crazyflie {
        /// Where it is, e.g. `127.0.0.1:19850`.
        address: SocketAddr,
    },
    /// A multicopter with PX4 or ArduPilot, over UDP.
    Mavlink {
        /// The address of this computer that the vehicle sends to; default port 14540 of all networks.
        listen: Option<SocketAddr>,
        /// The vehicle's address, if it waits for the first message.
        vehicle: Option<SocketAddr>,
    },
    /// A ROS 2 robot on two wheels, over Zenoh.
    Ros2 {
        /// The robot's Zenoh router; default `tcp/127.0.0.1:7447`.
        router: Option<String>,
        /// The domain of its nodes; default 0.
        domain: Option<u32>,
        /// The namespace of its topics, e.g. `/r1`; default none.
        namespace: Option<String>,
    },
}

impl Device {
    /// The problem of the device for a robot of this model, behind the name of its field.
    fn check(&self, model: &str) -> Result<(), String> {
        let (kind, models): (_, &[&str]) = match self {
            Device::Simulated => return Ok(()),
            Device::Create { generation, .. } => {
                if let Some(other) = generation.filter(|number| !(1..=2).contains(number)) {
                    return Err(format!(
                        ".generation = {other}: give 1 for the Create of 2007, or 2 for the Create 2"
                    ));
                }
                ("create", &["create"])
            }
            Device::Ardrone { .. } => ("ardrone", &["drone"]),
            Device::Crazyflie { .. } => ("crazyflie", &["drone"]),
            Device::Mavlink { .. } => ("mavlink", &["drone"]),
            Device::Ros2 { .. } => ("ros2", &["create", "differential"]),
        };
        match models.contains(&model) {
            true => Ok(()),
            false => Err(format!(
                ": kind = \"{kind}\" is for the model {}, and the scenario's robot is a {model}",
                models.join(" or ")
            )),
        }
    }
}

/// The source of positions. Without it robots have only their odometry, from the scenario's starts.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Positions {
    /// OptiTrack's Motive, or whatever speaks NatNet.
    Natnet {
        /// Its command port, e.g. `192.168.0.5:1510`.
        server: SocketAddr,
        /// Which axis points up, `z` or `y`; default `z`.
        #[serde(default)]
        up: Up,
    },
    /// Vicon and others that speak VRPN.
    Vrpn {
        /// Its address, e.g. `192.168.0.5:3883`.
        server: SocketAddr,
    },
    /// The own localisation of each robot, for ROS 2 robots.
    Ros2 {
        /// The frame that is the scenario's world; default `map`.
        map: Option<String>,
    },
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// The third.
    #[default]
    Z,
    /// The second.
    Y,
}

/// A fleet, read and checked.
pub struct Fleet {
    /// The file.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
    /// The scenario and its programs.
    pub application: Application,
    /// The robots, by number.
    pub robots: Vec<Member>,
    /// When motors are stopped.
    pub safety: starl_node::Safety,
    /// The file with the key; none if packets are not protected.
    pub key: Option<PathBuf>,
    /// How robots reach each other.
    pub network: Network,
    /// The source of positions.
    pub positions: Option<Positions>,
    /// The world of the bodies of simulated robots; none if each is alone.
    pub world: Option<SocketAddr>,
    /// The largest size of a robot's trace in bytes; the trace ends there.
    pub trace_limit: u64,
}

/// A robot of a fleet.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its number.
    pub id: RobotId,
    /// Its name in the scenario.
    pub name: String,
    /// Where others reach it.
    pub address: SocketAddr,
    /// The device that it drives.
    pub device: Device,
    /// Its name at the source of positions.
    pub body: String,
}

impl Fleet {
    /// Reads a fleet file, its scenario and its programs; `program` takes the place of the scenario's own. Warnings about
    /// programs are printed unless it is `quiet`.
    pub fn read(
        path: &Path,
        program: Option<&str>,
        quiet: bool,
        registry: &Registry,
    ) -> Result<Fleet, Failure> {
        let text = target::text(path)?;
        let written: Written =
            toml::from_str(&text).map_err(|error| malformed(path, &text, &error))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let scenario = match examples::find(&written.scenario) {
            Some(_) => written.scenario.clone(),
            None => folder.join(&written.scenario).display().to_string(),
        };
        if examples::find(&scenario).is_none() && !Path::new(&scenario).exists() {
            let what = format!(
                "scenario = \"{}\": there is no example and no file called this; a path is meant from the fleet file's folder",
                written.scenario
            );
            return Err(Failure::file(path, what));
        }
        let arguments = arguments(scenario, program, &written.set, quiet);
        let read = target::read(&arguments, registry);
        let application = read.map_err(|error| of_field(path, error))?.application;
        let network = network(path, &written.link)?;
        let stem = path.file_stem().unwrap_or_default().display().to_string();
        let is_protected = written.link.protected.unwrap_or(true);
        if !is_protected && written.link.key.is_some() {
            return Err(Failure::file(
                path,
                "link: a `key` is given, and `protected = false`; leave one out",
            ));
        }
        let members = members(path, &written, &application)?;
        if let Some(member) = members
            .iter()
            .find(|member| Some(member.address) == written.world)
        {
            let (name, address) = (&member.name, member.address);
            let what = format!("world: is {address}, as {name}'s address; take another port");
            return Err(Failure::file(path, what));
        }
        let key = is_protected.then(|| match &written.link.key {
            Some(key) => folder.join(key),
            None => path.with_extension("key"),
        });
        Ok(Fleet {
            robots: members,
            safety: safety(
                path,
                &written.safety,
                application.scenario().positioning.period,
            )?,
            path: path.to_path_buf(),
            name: written.name.unwrap_or(stem),
            application,
            key,
            network,
            positions: written.positions,
            world: written.world,
            trace_limit: u64::from(written.trace_limit_mib.map_or(1024, NonZeroU32::get)) << 20,
        })
    }

    /// The robot with this name.
    pub fn member(&self, name: &str) -> Result<&Member, Failure> {
        let found = self.robots.iter().find(|robot| robot.name == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = self
                .robots
                .iter()
                .map(|robot| robot.name.as_str())
                .collect();
            Failure(format!(
                "--id {name}: no robot of {} is called this; {}",
                self.path.display(),
                suggest::help(name, &names, "the robots are").unwrap_or_default()
            ))
        })
    }

    /// The numbers of all robots.
    pub fn numbers(&self) -> Vec<u32> {
        self.robots.iter().map(|robot| robot.id.0).collect()
    }

    /// The names of the robots that were asked and did not answer, by number.
    pub fn silent(&self, asked: &[u32], answered: &[u32]) -> Vec<&str> {
        let silent = asked.iter().filter(|robot| !answered.contains(robot));
        silent
            .map(|robot| self.robots[*robot as usize].name.as_str())
            .collect()
    }

    /// Where all robots are.
    pub fn places(&self) -> BTreeMap<u32, SocketAddr> {
        let places = self.robots.iter();
        places.map(|robot| (robot.id.0, robot.address)).collect()
    }

    /// Whether all robots are on this machine, by their addresses.
    pub fn is_local(&self) -> bool {
        self.robots
            .iter()
            .all(|robot| robot.address.ip().is_loopback())
    }

    /// The keys that packets are protected by; none if they are not.
    pub fn keys(&self) -> Result<Vec<Key>, Failure> {
        match &self.key {
            Some(path) => super::key::read(path, &self.path),
            None => Ok(Vec::new()),
        }
    }
}

/// The fleet file has the field `set` for the option `--set`.
fn of_field(path: &Path, error: Failure) -> Failure {
    match error.0.strip_prefix("--set ") {
        Some(problem) => Failure::file(path, format!("set: {problem}")),
        None => error,
    }
}

fn arguments(scenario: String, program: Option<&str>, set: &[String], quiet: bool) -> RunArguments {
    let changes = ChangeArguments {
        set: set.to_vec(),
        scenario: program.is_some().then(|| scenario.clone()),
        ..ChangeArguments::default()
    };
    let target = program.map_or(scenario, str::to_string);
    changes.of(&target, None, quiet)
}

/// All robots of the scenario, with what the fleet file says of them.
fn members(
    path: &Path,
    written: &Written,
    application: &Application,
) -> Result<Vec<Member>, Failure> {
    let fleet = &application.scenario().fleet;
    let names: Vec<String> = (0..fleet.len() as u32)
        .map(|id| fleet.name(RobotId(id)))
        .collect();
    if let Some(stranger) = written.robots.keys().find(|name| !names.contains(name)) {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let help = suggest::help(stranger, &names, "the robots are").unwrap_or_default();
        let what = format!("robots.{stranger}: the scenario has no robot of this name; {help}");
        return Err(Failure::file(path, what));
    }
    let first = written.link.first_port.unwrap_or(FIRST_PORT);
    let mut members: Vec<Member> = Vec::new();
    for (index, name) in names.into_iter().enumerate() {
        let robot = written.robots.get(&name).cloned().unwrap_or_default();
        let port = u16::try_from(index)
            .ok()
            .and_then(|index| first.checked_add(index));
        let address = match (robot.address, port) {
            (Some(address), _) => address,
            (None, Some(port)) => SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port),
            (None, None) => {
                let what = format!("robots.{name}: no free port is left for it; set its `address`");
                return Err(Failure::file(path, what));
            }
        };
        if let Some(other) = members.iter().find(|other| other.address == address) {
            let what = format!(
                "robots.{name}: has the address {address}, as {} has",
                other.name
            );
            return Err(Failure::file(path, what));
        }
        let mut device = robot.device.unwrap_or_default();
        let id = RobotId(index as u32);
        if let Some((group, _)) = fleet.group_of(id) {
            device
                .check(group.model.name())
                .map_err(|problem| Failure::file(path, format!("robots.{name}.device{problem}")))?;
        }
        if let Device::Create { port, .. } = &mut device {
            // As with other files, a path is meant from the fleet file's folder.
            *port = path.parent().unwrap_or(Path::new("")).join(&port);
        }
        let body = robot.body.unwrap_or_else(|| name.clone());
        let same = |other: &&Member| other.device == device && device != Device::Simulated;
        if let Some(other) = members.iter().find(same) {
            let other = &other.name;
            let what = format!("robots.{name}.device: is the same as {other}'s; give each its own");
            return Err(Failure::file(path, what));
        }
        if let Some(other) = members.iter().find(|other| other.body == body) {
            let other = &other.name;
            let what =
                format!("robots.{name}.body: is \"{body}\", as {other}'s; give each its own");
            return Err(Failure::file(path, what));
        }
        members.push(Member {
            id,
            body,
            name,
            address,
            device,
        });
    }
    Ok(members)
}

/// Refuses what the chosen network has no use for.
fn network(path: &Path, link: &Link) -> Result<Network, Failure> {
    let other = [
        ("router", link.router.is_some()),
        ("tls", link.tls.is_some()),
    ];
    if let (LinkKind::Udp, Some((field, _))) = (link.kind, other.iter().find(|(_, given)| *given)) {
        return Err(Failure::file(
            path,
            format!("link.{field}: is for `kind = \"zenoh\"`; this link is UDP"),
        ));
    }
    if let Some(router) = &link.router
        && !router
            .split_once('/')
            .is_some_and(|(scheme, place)| !scheme.is_empty() && place.contains(':'))
    {
        let help = format!("{router:?} is not an endpoint; write it as \"tcp/192.168.0.1:7447\"");
        return Err(Failure::file(path, format!("link.router: {help}")));
    }
    if let (Some(router), tls) = (&link.router, &link.tls)
        && router.starts_with("tls/") != tls.is_some()
    {
        let help = match tls {
            Some(_) => "certificates are given by `tls`; begin the router with \"tls/\"",
            None => "a router that begins with \"tls/\" needs certificates; give them by `tls`",
        };
        return Err(Failure::file(path, format!("link.router: {help}")));
    }
    Ok(Network {
        kind: link.kind,
        router: link.router.clone(),
        tls: link.tls.clone(),
        impairment: link
            .rehearse
            .as_ref()
            .map(|rehearsal| impairment(path, rehearsal))
            .transpose()?,
    })
}

fn impairment(path: &Path, rehearsal: &Rehearsal) -> Result<Impairment, Failure> {
    let parts = [
        ("loss", rehearsal.loss),
        ("duplication", rehearsal.duplication),
    ];
    for (field, part) in parts {
        if !(0.0..=1.0).contains(&part) {
            let what = format!("link.rehearse.{field} = {part}: give a number from 0 to 1");
            return Err(Failure::file(path, what));
        }
    }
    let span = |field: &str, text: &Option<String>| {
        let text = text.as_deref().unwrap_or("0s");
        let what = format!("link.rehearse.{field} = \"{text}\": give a time, such as \"40ms\"");
        starl_sim::read::duration(text).ok_or_else(|| Failure::file(path, what))
    };
    Ok(Impairment {
        loss: rehearsal.loss,
        duplication: rehearsal.duplication,
        delay: span("delay", &rehearsal.delay)?,
        jitter: span("jitter", &rehearsal.jitter)?,
    })
}

fn safety(path: &Path, written: &Safety, period: Duration) -> Result<starl_node::Safety, Failure> {
    let span = |field: &str, text: &Option<String>| -> Result<Option<Duration>, Failure> {
        let Some(text) = text else { return Ok(None) };
        let span = starl_sim::read::duration(text).filter(|span| !span.is_zero());
        let what =
            || format!("safety.{field} = \"{text}\": give a time, such as \"1s\" or \"500ms\"");
        span.map(Some).ok_or_else(|| Failure::file(path, what()))
    };
    // Positions that come seldom are not missed at once.
    let usual = starl_node::Safety::default()
        .localisation
        .max(Duration(period.0.saturating_mul(3)));
    Ok(starl_node::Safety {
        localisation: span("position_timeout", &written.position_timeout)?.unwrap_or(usual),
        link: span("link_timeout", &written.link_timeout)?,
    })
}

/// Adds the line of the error.
fn malformed(path: &Path, text: &str, error: &toml::de::Error) -> Failure {
    let before = error
        .span()
        .map_or("", |span| &text[..span.start.min(text.len())]);
    let line = 1 + before.matches('\n').count();
    let message = error.message().trim_end();
    let written = text.lines().nth(line - 1).unwrap_or("").trim();
    let message = match message.contains("socket address") {
        true if written.starts_with("[world") => {
            "[world]: `world` is an address, such as world = \"127.0.0.1:7500\"; the obstacles are the scenario's".to_string()
        }
        true => format!("{written}: give an address with its port, such as \"127.0.0.1:7500\""),
        false if is_scenario(text) => {
            let name = path.file_name().unwrap_or_default().display();
            format!("this is a scenario, which `starl run` runs; a fleet file names it by `scenario = \"{name}\"`")
        }
        false => message.to_string(),
    };
    Failure(format!("{}:{line}: {message}", path.display()))
}

/// Whether this is a scenario instead: it lists groups of robots, or names their program.
fn is_scenario(text: &str) -> bool {
    let table: Option<toml::Table> = toml::from_str(text).ok();
    table.is_some_and(|table| {
        table.contains_key("program") || table.get("robots").is_some_and(toml::Value::is_array)
    })
}

impl Device {
    /// Which Create it is.
    pub fn generation(&self) -> Generation {
        match self {
            Device::Create {
                generation: Some(1),
                ..
            } => Generation::Create1,
            _ => Generation::Create2,
        }
    }
}
