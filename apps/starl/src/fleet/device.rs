//! Connects a robot's process to its hardware, and to the source of positions.

use super::file::{Device, Fleet, Member, Positions, Up};
use super::hardware::Hardware;
use super::ros2;
use crate::failure::Failure;
use starl_ardrone::{Ardrone, ArdroneOptions};
use starl_core::{Pose, RobotId};
use starl_crazyflie::{Crazyflie, CrazyflieOptions};
use starl_create::{Create, CreateOptions};
use starl_mavlink::{MavlinkOptions, MavlinkVehicle};
use starl_motion::Model;
use starl_motion::models::ArdroneParameters;
use starl_natnet::{NatNet, NatNetOptions, UpAxis};
use starl_node::DeviceError;
use starl_node::motors::PositionSource;
use starl_node::simulated::SimulatedBody;
use starl_node::world_body::WorldBody;
use starl_sim::scenario::Group;
use starl_vrpn::{Vrpn, VrpnOptions};
use std::net::{IpAddr, Ipv4Addr};
use std::time::Instant;

/// Where an AR.Drone is that makes its own network.
const DRONE: IpAddr = IpAddr::V4(Ipv4Addr::new(192, 168, 1, 1));

/// Connects to the robot's device and to its positions.
pub fn connect(
    fleet: &Fleet,
    member: &Member,
    group: &Group,
    start: Pose,
) -> Result<Hardware, Failure> {
    let cannot = |error: DeviceError| Failure(format!("{}: its device: {error}", member.name));
    let device: Box<dyn starl_node::Device> = match &member.device {
        Device::Simulated => {
            let period = fleet.application.scenario().positioning.period;
            if let Some(world) = fleet.world {
                let body = WorldBody::new(world, &member.body, group.model.clone());
                let body = body.map_err(cannot)?;
                let positions = body.positions(period);
                return Ok((Box::new(body.device()), Some(Box::new(positions))));
            }
            let body = SimulatedBody::new(group.model.clone(), start);
            return Ok((
                Box::new(body.device()),
                Some(Box::new(body.positions(period))),
            ));
        }
        Device::Ros2 {
            router,
            domain,
            namespace,
        } => {
            let place = ros2::Place::of(router.as_deref(), *domain, namespace.as_deref());
            let (device, own) = ros2::connect(fleet, member, group, &place)?;
            if own.is_some() {
                return Ok((device, own));
            }
            device
        }
        _ if matches!(fleet.positions, Some(Positions::Ros2 { .. })) => {
            return Err(ros2::no_localisation(member));
        }
        Device::Create { port, baud, .. } => {
            let mut options = CreateOptions::new(member.device.generation());
            options.baud = baud.unwrap_or(options.baud);
            let create = Create::open(port, &options);
            Box::new(create.map_err(|error| {
                let what = format!(
                    "robots.{}.device.port: {} cannot be opened: {error}; check that the robot is connected, or emulate it with --emulate",
                    member.name,
                    port.display()
                );
                Failure::file(&fleet.path, what)
            })?)
        }
        Device::Ardrone { commands, navdata } => {
            let mut options = ArdroneOptions::new(DRONE);
            options.commands = commands.unwrap_or(options.commands);
            options.navdata = navdata.unwrap_or(options.navdata);
            Box::new(Ardrone::connect(&options).map_err(cannot)?)
        }
        Device::Crazyflie { address } => {
            let options = CrazyflieOptions::new(*address);
            Box::new(Crazyflie::connect(&options).map_err(cannot)?)
        }
        Device::Mavlink { listen, vehicle } => {
            let usual = MavlinkOptions::default();
            let options = MavlinkOptions {
                listen: listen.unwrap_or(usual.listen),
                vehicle: *vehicle,
                drag: drag(&*group.model),
                ..usual
            };
            Box::new(MavlinkVehicle::connect(&options).map_err(cannot)?)
        }
    };
    let positions = fleet
        .positions
        .as_ref()
        .map(|source| follow(source, fleet, member));
    Ok((device, positions.transpose()?))
}

/// Drag per mass of a drone, 1/s.
fn drag(model: &dyn Model) -> f64 {
    let usual = ArdroneParameters::default();
    let changed = model.parameters();
    let value = |name: &str, usual: f64| {
        let set = changed.iter().find(|(field, _)| field.name == name);
        set.map_or(usual, |(_, value)| *value)
    };
    value("drag", usual.drag) / value("mass", usual.mass)
}

/// Follows the robot by motion capture, and the others that it may see.
fn follow(
    source: &Positions,
    fleet: &Fleet,
    member: &Member,
) -> Result<Box<dyn PositionSource>, Failure> {
    let others = fleet.robots.iter().filter(|other| other.id != member.id);
    let (others, names): (Vec<RobotId>, Vec<String>) =
        others.map(|other| (other.id, other.body.clone())).unzip();
    match source {
        Positions::Natnet { server, up } => {
            let mut options = NatNetOptions::new(server.ip(), &member.body);
            options.server = *server;
            options.others = names;
            options.up = match up {
                Up::Z => UpAxis::Z,
                Up::Y => UpAxis::Y,
            };
            let client = NatNet::connect(options)
                .map_err(|error| Failure(format!("{}: positions: {error}", member.name)))?;
            Ok(Box::new(Cameras(client, others)))
        }
        Positions::Vrpn { server } => {
            let client = Vrpn::connect(VrpnOptions {
                server: *server,
                tracker: member.body.clone(),
                others: names,
            });
            Ok(Box::new(Trackers(client, others)))
        }
        Positions::Ros2 { .. } => Err(ros2::no_localisation(member)),
    }
}

/// Trackers as a source of positions, with the other robots that they follow.
struct Trackers(Vrpn, Vec<RobotId>);

impl PositionSource for Trackers {
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError> {
        let polled = self.0.poll();
        polled.map_err(|error| DeviceError::Fault(format!("positions: {error}")))
    }

    fn others(&mut self) -> Vec<(RobotId, Instant, Pose)> {
        let others = self.0.others().into_iter();
        others
            .map(|(index, at, pose)| (self.1[index], at, pose))
            .collect()
    }
}

/// Motion capture as a source of positions, with the other robots that it follows.
struct Cameras(NatNet, Vec<RobotId>);

impl PositionSource for Cameras {
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError> {
        let polled = self.0.poll();
        polled.map_err(|error| DeviceError::Fault(format!("positions: {error}")))
    }

    fn others(&mut self) -> Vec<(RobotId, Instant, Pose)> {
        let others = self.0.others();
        others
            .map(|(index, at, pose)| (self.1[index], at, pose))
            .collect()
    }
}
