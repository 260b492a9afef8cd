//! `starl emulate`: emulates hardware. Emulated robots are the simulator's models in one world, behind the wire
//! protocols of the devices.

use super::file::{Device, Fleet, Member, Positions};
use super::hardware::Emulated;
use super::ros2::{self, Manner, Place, Routers};
use super::when_abandoned;
use crate::args::{EmulateArguments, EmulateFleet};
use crate::console;
use crate::failure::Failure;
use crate::run::stop_on_interrupt;
use starl_catalog::disk::reason;
use starl_catalog::programs::Registry;
use starl_core::{Pose, RobotId};
use starl_create::Generation;
use starl_emulate::ardrone::EmulatedArdrone;
use starl_emulate::bodies::EmulatedBodies;
use starl_emulate::crazyflie::EmulatedCrazyflie;
use starl_emulate::create::{EmulatedCreate, model};
use starl_emulate::mavlink::EmulatedVehicle;
use starl_emulate::natnet::{Cameras, EmulatedNatNet};
use starl_emulate::vrpn::EmulatedVrpn;
use starl_emulate::{BodyHandle, Noise, World};
use starl_mavlink::{Autopilot, MavlinkOptions};
use starl_motion::{Model, models};
use starl_sim::Scenario;
use starl_sim::read::suggest;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Emulates devices until someone presses Ctrl-C.
pub fn run(arguments: &EmulateArguments, registry: &Registry) -> Result<bool, Failure> {
    let stop = stop_on_interrupt();
    let mut shared = None;
    let devices = match arguments {
        EmulateArguments::Fleet(arguments) => {
            if arguments.supervised {
                let stop = stop.clone();
                when_abandoned(move || stop.store(true, Ordering::Relaxed));
            }
            let (world, devices) = fleet(arguments, registry)?;
            shared = Some(world);
            devices
        }
        EmulateArguments::Create { link, generation } => {
            let generation = if *generation == 1 {
                Generation::Create1
            } else {
                Generation::Create2
            };
            let world = World::new(Vec::new(), Noise::NONE);
            let body = add(&world, "create", Pose::default(), model(generation))?;
            vec![create(body, link.as_deref())?]
        }
        EmulateArguments::Drone { commands, navdata } => {
            let world = World::new(Vec::new(), Noise::NONE);
            let body = add(&world, "drone", Pose::default(), drone()?)?;
            vec![ardrone(body, *commands, *navdata)?]
        }
        EmulateArguments::Crazyflie { address } => {
            let world = World::new(Vec::new(), Noise::NONE);
            let body = add(&world, "crazyflie", Pose::default(), drone()?)?;
            vec![crazyflie(body, *address)?]
        }
        EmulateArguments::Ros2 {
            router,
            domain,
            namespace,
            model,
            stamped,
        } => {
            let place = Place::of(Some(router), Some(*domain), Some(namespace));
            let world = World::new(Vec::new(), Noise::NONE);
            let body = add(&world, "robot", Pose::default(), named_model(model)?)?;
            let manner = Manner {
                stamped: *stamped,
                ..Manner::default()
            };
            vec![ros2::emulate(
                body,
                &mut Routers::default(),
                &place,
                &manner,
            )?]
        }
        EmulateArguments::Mavlink { address, client } => {
            let world = World::new(Vec::new(), Noise::NONE);
            let body = add(&world, "vehicle", Pose::default(), drone()?)?;
            vec![mavlink(body, *address, *client)?]
        }
    };
    for device in &devices {
        console::print(&format!("{}\n", device.text))?;
    }
    console::print("ready\n")?;
    while !stop.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(50));
        for touch in shared.iter().flat_map(World::take_touches) {
            let with = touch.with.as_deref().unwrap_or("an obstacle");
            let (at, body, place) = (touch.at.seconds(), touch.body, touch.place);
            console::print(&format!("{at:10.3} {body} ran into {with} near {place}\n"))?;
        }
    }
    Ok(true)
}

/// All devices that a fleet file names, in the world of its scenario.
fn fleet(arguments: &EmulateFleet, registry: &Registry) -> Result<(World, Vec<Emulated>), Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let scenario = fleet.application.scenario();
    let obstacles = scenario.world.obstacles.iter();
    let noise = Noise {
        speed: scenario.motion.speed_noise,
        turn: scenario.motion.turn_noise,
        seed: scenario.seed,
    };
    let obstacles = obstacles.map(|entry| {
        (
            entry.obstacle.clone(),
            starl_core::Duration(entry.expires.0),
        )
    });
    let walls = scenario.world.walls().into_iter();
    let walls = walls.map(|wall| (wall, starl_core::Duration(u64::MAX)));
    let world = World::with_temporary(obstacles.chain(walls).collect(), noise);
    let mut emulated = Vec::new();
    let mut routers = Routers::default();
    for member in &fleet.robots {
        emulated.extend(member_device(&world, &fleet, member, &mut routers)?);
    }
    if let Some(address) = fleet.world {
        emulated.push(bodies(&world, &fleet, address)?);
    }
    if let Some(source) = &fleet.positions {
        emulated.extend(positions(&world, source, scenario)?);
    }
    match emulated.is_empty() {
        true => Err(Failure::file(
            &fleet.path,
            "names no device that could be emulated: all robots are simulated; with `world = \"127.0.0.1:7500\"` their bodies are",
        )),
        false => Ok((world, emulated)),
    }
}

/// The bodies of the simulated robots.
fn bodies(world: &World, fleet: &Fleet, address: SocketAddr) -> Result<Emulated, Failure> {
    let simulated = fleet.robots.iter();
    let simulated = simulated.filter(|member| member.device == Device::Simulated);
    let added = simulated.filter_map(|member| {
        let (group, index) = fleet.application.scenario().fleet.group_of(member.id)?;
        Some(add(
            world,
            &member.body,
            group.starts[index],
            group.model.clone(),
        ))
    });
    let device = EmulatedBodies::start(added.collect::<Result<_, _>>()?, address)
        .map_err(|error| {
            let why = reason(&error);
            let what = format!("world: {address} cannot be used: {why}; give a free port of this computer, such as \"127.0.0.1:7500\"");
            Failure::file(&fleet.path, what)
        })?;
    Ok(Emulated {
        text: format!("bodies of simulated robots at {}", device.address()),
        _device: Box::new(device),
    })
}

/// The motion capture of a world; none where robots locate themselves.
fn positions(
    world: &World,
    source: &Positions,
    scenario: &Scenario,
) -> Result<Option<Emulated>, Failure> {
    let cannot = |server: &SocketAddr, error: &std::io::Error| {
        Failure(format!("positions.server {server}: {}", reason(error)))
    };
    match source {
        Positions::Natnet { server, .. } => {
            let cameras = Cameras {
                deviation: scenario.positioning.position_noise,
                seed: scenario.seed,
                ..Cameras::default()
            };
            let device = EmulatedNatNet::start(world.clone(), *server, cameras)
                .map_err(|error| cannot(server, &error))?;
            Ok(Some(Emulated {
                text: format!("motion capture at {}", device.address()),
                _device: Box::new(device),
            }))
        }
        Positions::Vrpn { server } => {
            let device = EmulatedVrpn::start(world.clone(), *server)
                .map_err(|error| cannot(server, &error))?;
            Ok(Some(Emulated {
                text: format!("trackers at {}", device.address()),
                _device: Box::new(device),
            }))
        }
        // Each robot's own, which is part of it.
        Positions::Ros2 { .. } => Ok(None),
    }
}

fn member_device(
    world: &World,
    fleet: &Fleet,
    member: &Member,
    routers: &mut Routers,
) -> Result<Option<Emulated>, Failure> {
    let robot = |id: RobotId| {
        let (group, index) = fleet.application.scenario().fleet.group_of(id)?;
        Some((group.model.clone(), group.starts[index]))
    };
    let Some((own, start)) = robot(member.id) else {
        return Ok(None);
    };
    let named = |error: Failure| Failure(format!("{}: {}", member.name, error.0));
    let device = match &member.device {
        Device::Simulated => return Ok(None),
        Device::Create { port, .. } => {
            let body = add(
                world,
                &member.body,
                start,
                model(member.device.generation()),
            )?;
            create(body, Some(port)).map_err(named)?
        }
        Device::Ardrone { commands, navdata } => {
            let (Some(commands), Some(navdata)) = (commands, navdata) else {
                let what = "a drone to be emulated needs `commands` and `navdata` addresses of this machine";
                return Err(Failure(format!("{}: {what}", member.name)));
            };
            let body = add(world, &member.body, start, own)?;
            ardrone(body, *commands, *navdata).map_err(named)?
        }
        Device::Crazyflie { address } => {
            let body = add(world, &member.body, start, own)?;
            crazyflie(body, *address).map_err(named)?
        }
        Device::Mavlink { listen, vehicle } => {
            let any = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0);
            let client = listen.unwrap_or(MavlinkOptions::default().listen);
            // It sends to this machine, whatever networks the robot listens on.
            let client = SocketAddr::new(any.ip(), client.port());
            let body = add(world, &member.body, start, own)?;
            mavlink(body, vehicle.unwrap_or(any), client).map_err(named)?
        }
        Device::Ros2 {
            router,
            domain,
            namespace,
        } => {
            let place = Place::of(router.as_deref(), *domain, namespace.as_deref());
            let body = add(world, &member.body, start, own)?;
            ros2::emulate(body, routers, &place, &Manner::of(fleet)).map_err(named)?
        }
    };
    Ok(Some(Emulated {
        text: format!("{}: {}", member.name, device.text),
        ..device
    }))
}

fn add(
    world: &World,
    name: &str,
    start: Pose,
    model: Arc<dyn Model>,
) -> Result<BodyHandle, Failure> {
    world
        .add(name, model, start)
        .map_err(|error| Failure(format!("{name}: {error}")))
}

fn drone() -> Result<Arc<dyn Model>, Failure> {
    named_model("drone")
}

fn named_model(name: &str) -> Result<Arc<dyn Model>, Failure> {
    models::by_name(name).ok_or_else(|| {
        let names = models::NAMES.map(|(name, _)| name);
        let help = suggest::help(name, &names, "the models are").unwrap_or_default();
        Failure(format!("--model {name}: there is no such model; {help}"))
    })
}

fn mavlink(body: BodyHandle, address: SocketAddr, client: SocketAddr) -> Result<Emulated, Failure> {
    let device = EmulatedVehicle::start(body, Autopilot::Px4, address, Some(client))
        .map_err(|error| Failure(format!("{address}: {}", reason(&error))))?;
    let address = device.address().map_err(|error| Failure(reason(&error)))?;
    Ok(Emulated {
        text: format!("a PX4 vehicle at {address}, which sends to {client}"),
        _device: Box::new(device),
    })
}

fn crazyflie(body: BodyHandle, address: SocketAddr) -> Result<Emulated, Failure> {
    let device = EmulatedCrazyflie::start(body, address)
        .map_err(|error| Failure(format!("{address}: {}", reason(&error))))?;
    let address = device.address().map_err(|error| Failure(reason(&error)))?;
    Ok(Emulated {
        text: format!("a Crazyflie at {address}"),
        _device: Box::new(device),
    })
}

fn create(body: BodyHandle, link: Option<&Path>) -> Result<Emulated, Failure> {
    let device = EmulatedCreate::start(body, link)
        .map_err(|error| Failure(format!("no serial line can be made: {}", reason(&error))))?;
    Ok(Emulated {
        text: format!("a Create at {}", device.path().display()),
        _device: Box::new(device),
    })
}

fn ardrone(
    body: BodyHandle,
    commands: SocketAddr,
    navdata: SocketAddr,
) -> Result<Emulated, Failure> {
    let device = EmulatedArdrone::start(body, commands, navdata)
        .map_err(|error| Failure(format!("{commands}, {navdata}: {}", reason(&error))))?;
    let navdata = device.navdata().map_err(|error| Failure(reason(&error)))?;
    Ok(Emulated {
        text: format!("an AR.Drone at {}, navdata at {navdata}", device.commands()),
        _device: Box::new(device),
    })
}
