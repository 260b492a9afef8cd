//! The robot's knowledge of the world.

use crate::machine::{Block, HostCall, Layout, List, Object, Type};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::host::RobotHost;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::motion::Obstacles;
use starl_core::sensor::Detected;
use starl_core::{Obstacle, RobotId, WayPoint};

/// A robot's number as a name.
pub fn name_of(robot: RobotId) -> Object {
    (&alloc::format!("robot{robot}")[..]).into()
}

pub fn robot_name(_: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let robot = Arguments::of(call).robot();
    call.set_object(0, name_of(robot));
    Ok(1)
}

/// Which half of the front is pressed; touches from elsewhere are on neither side.
pub fn bumped(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let contact = host.context.robot.sensors().bumper;
    let side = contact.and_then(|contact| match (contact.left(), contact.right()) {
        (true, false) => Some(0),
        (false, true) => Some(1),
        (true, true) => Some(2),
        (false, false) => None,
    });
    call.set_optional(0, side);
    Ok(0)
}

pub fn ranges(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let rays = host.context.robot.sensors().proximity.iter();
    let distances = rays.map(|ray| ray.distance.to_bits());
    call.set_object(0, List::of_scalars(distances.collect()).into());
    Ok(0)
}

pub fn detected(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let optional = |kind| Type::Optional(Box::new(kind));
    let parts = [optional(Type::Robot), optional(Type::Int), Type::Point];
    let mut list = List::new(&Layout::of(&parts));
    for detection in host.context.robot.sensors().detections {
        let [robot, thing] = match detection.what {
            Detected::Robot(robot) => [[1, u64::from(robot.0)], [0, 0]],
            Detected::Thing(thing) => [[0, 0], [1, u64::from(thing)]],
        };
        let p = detection.position;
        let place = [p.x, p.y, p.z].map(f64::to_bits);
        let scalars: Vec<u64> = robot.into_iter().chain(thing).chain(place).collect();
        let _ = list.push(Block {
            scalars: &scalars,
            objects: &[],
        }); // it is as wide as the list's elements
    }
    call.set_object(0, list.into());
    Ok(0)
}

pub fn things(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let sensors = host.context.robot.sensors();
    // A text is an object whatever its number among the program's types.
    let parts = [Type::Int, Type::Object(0), Type::Point];
    let mut list = List::new(&Layout::of(&parts));
    for detection in sensors.detections {
        let Detected::Thing(thing) = detection.what else {
            continue;
        };
        let p = detection.position;
        let place = [p.x, p.y, p.z].map(f64::to_bits);
        let scalars: Vec<u64> = [u64::from(thing)].into_iter().chain(place).collect();
        let name = sensors.thing_names.get(thing as usize);
        let name: &str = name.map_or("", |name| name);
        let _ = list.push(Block {
            scalars: &scalars,
            objects: &[name.into()],
        }); // it is as wide as the list's elements
    }
    call.set_object(0, list.into());
    Ok(sensors.detections.len() as u64)
}

pub fn thing_name(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let names = host.context.robot.sensors().thing_names;
    let thing = usize::try_from(Arguments::of(call).int());
    let name = thing.ok().and_then(|thing| names.get(thing));
    let name: &str = name.map_or("", |name| name);
    call.set_object(0, name.into());
    Ok(1)
}

/// The position of the waypoint that the call names; returns the cost of the search.
pub fn way_point(way_points: &[WayPoint], call: &mut HostCall<'_>) -> u64 {
    let name = String::from(Arguments::of(call).text());
    let found = way_points.iter().find(|way_point| way_point.name == name);
    call.set_bool(0, found.is_some());
    if let Some(found) = found {
        call.set_point(1, found.position);
    }
    way_points.len() as u64 / 8
}

/// The positions of the waypoints in the group that the call names; returns the cost of the search.
pub fn way_point_group(way_points: &[WayPoint], call: &mut HostCall<'_>) -> u64 {
    let group = Arguments::of(call).int();
    let those = way_points
        .iter()
        .filter(|way_point| i64::from(way_point.group) == group);
    let places: Vec<_> = those.map(|way_point| way_point.position).collect();
    call.set_object(0, List::of_points(&places).into());
    (way_points.len() + places.len()) as u64 / 8
}

pub fn areas_of(_: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let obstacles = Arguments::of(call).obstacles();
    let areas = obstacles.iter().map(|obstacle| obstacle.area().into());
    call.set_object(0, List::of_objects(areas.collect()).into());
    Ok(2 * obstacles.len() as u64)
}

pub fn with_area(_: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let obstacles = arguments.obstacles();
    let one_more = Obstacle::from(arguments.area()?.clone());
    let all: Obstacles = obstacles.iter().cloned().chain([one_more]).collect();
    let cost = 2 * all.len() as u64;
    call.set_object(0, all.into());
    Ok(cost)
}
