//! `starl robot`: runs one robot of a fleet until it is stopped.

use super::file::{Fleet, Member};
use super::folder::Folder;
use super::recorder::FleetRecorder;
use super::{device, link, when_abandoned};
use crate::args::RobotArguments;
use crate::failure::Failure;
use crate::run::on_interrupt;
use crate::trace_output::TraceOutput;
use starl_catalog::disk::reason;
use starl_catalog::programs::Registry;
use starl_core::{Pose, Random, RobotId, Time};
use starl_host::Hardware;
use starl_host::hardware::Drive;
use starl_node::link::Channel;
use starl_node::localise::Accuracy;
use starl_node::robot::{Connections, Incoming, MapObstacle, Robot, Setup, Thing, mailbox};
use starl_node::{Storage, WallClock};
use starl_properties::Setting;
use starl_sim::Scenario;
use starl_sim::scenario::{self, Group};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Runs a robot.
pub fn run(arguments: &RobotArguments, registry: &Registry) -> Result<bool, Failure> {
    let program = arguments.program.as_deref();
    // The command that supervises the robots has printed the warnings.
    let quiet = arguments.quiet || arguments.supervised;
    let fleet = Fleet::read(&arguments.fleet, program, quiet, registry)?;
    let member = fleet.member(&arguments.id)?;
    let keys = fleet.keys()?;
    let folder = match &arguments.folder {
        Some(folder) => Folder::open(folder)?,
        None => Folder::of(&arguments.fleet, false)?,
    };
    let clock = WallClock::since(folder.epoch()?);
    let scenario = fleet.application.scenario();
    let (group, start) = place(scenario, member.id)?;
    let storage = scenario.storage.kept.then(|| storage(&folder, member));
    let storage = storage.transpose()?;
    let (post, inbox) = mailbox();
    let is_over = Arc::new(AtomicBool::new(false));
    if arguments.supervised {
        let (halt, is_over) = (post.clone(), is_over.clone());
        when_abandoned(move || {
            is_over.store(true, Ordering::Relaxed);
            let _ = halt.send(Incoming::Halt);
        });
    }
    if !link::await_router(&fleet, &member.name, || is_over.load(Ordering::Relaxed)) {
        return Ok(true);
    }
    let arrivals = post.clone();
    let transport = link::open(&fleet, Some(member), member.id.0, move |arrival| {
        arrivals.send(Incoming::Packet(arrival)).is_ok()
    })?;
    let (device, positions) = device::connect(&fleet, member, group, start)?;
    let connections = Connections {
        device,
        positions,
        storage,
        transport,
        channel: Channel::new(member.id.0, &fleet.name, keys),
    };
    let setup = setup(&fleet, member.id, group, start, clock.now())?;
    let path = folder.next_trace(&member.name);
    let setting = Setting {
        only: Some(member.id),
        simulated: false,
        ..starl_sim::setting(scenario)
    };
    let trace = TraceOutput::create(&path, fleet.application.resolved(), &setting, true);
    let recorder = FleetRecorder::new(
        member.id,
        &member.name,
        trace,
        fleet.trace_limit,
        arguments.quiet,
    );
    let halt = post.clone();
    on_interrupt(move || {
        let _ = halt.send(Incoming::Halt);
    });
    let robot = Robot::start(setup, connections, clock, (post, inbox), recorder)
        .map_err(|error| Failure(format!("{}: cannot start: {}", member.name, reason(&error))))?;
    robot.run().finish();
    Ok(true)
}

/// The group of a robot, and where it starts.
fn place(scenario: &Scenario, id: RobotId) -> Result<(&Group, Pose), Failure> {
    let group = scenario.fleet.group_of(id);
    let (group, index) = group.ok_or_else(|| Failure(format!("there is no robot {id}")))?;
    Ok((group, group.starts[index]))
}

fn storage(folder: &Folder, member: &Member) -> Result<Storage, Failure> {
    let path = folder.storage(&member.name);
    Storage::open(&path).map_err(|error| Failure::file(&path, reason(&error)))
}

fn setup(
    fleet: &Fleet,
    id: RobotId,
    group: &Group,
    start: Pose,
    now: Time,
) -> Result<Setup, Failure> {
    let scenario = fleet.application.scenario();
    let program = fleet.application.program_of(id);
    let program = program.map_err(|complaint| Failure(complaint.message))?;
    let groups = scenario.fleet.groups.iter();
    let bodies = groups.flat_map(|group| vec![group.model.body(); group.starts.len()]);
    let obstacle = |entry: &scenario::WorldObstacle| MapObstacle {
        obstacle: entry.obstacle.clone(),
        hidden: entry.hidden,
        expires: entry.expires,
    };
    let wall = |obstacle| MapObstacle {
        obstacle,
        hidden: false,
        expires: Time::NEVER,
    };
    let obstacles = scenario.world.obstacles.iter().map(obstacle);
    let walls = scenario.world.walls().into_iter().map(wall);
    let things = scenario.world.things.iter();
    let thing = |thing: &scenario::Thing| Thing {
        name: thing.name.clone().into(),
        position: thing.position,
    };
    // A life of a robot draws what no other draws.
    let seed = now.0 ^ scenario.seed;
    let usual = Accuracy::default();
    Ok(Setup {
        id,
        bodies: bodies.collect(),
        program,
        random: Random::keyed(seed, &[u64::from(id.0)]),
        hardware: Hardware {
            body: group.model.body(),
            control_period: group.control_period,
            drive: Some(Drive {
                model: group.model.clone(),
                avoidance: scenario.motion.avoidance.clone(),
                position_error: scenario.positioning.position_noise,
                seed,
            }),
        },
        sensors: group.sensors,
        things: things.map(thing).collect(),
        way_points: scenario.world.way_points.clone(),
        obstacles: obstacles.chain(walls).collect(),
        positioning_period: scenario.positioning.period,
        accuracy: Accuracy {
            position: scenario.positioning.position_noise.max(usual.position),
            heading: scenario.positioning.heading_noise.max(usual.heading),
            ..usual
        },
        start: Some(start),
        safety: fleet.safety,
    })
}
