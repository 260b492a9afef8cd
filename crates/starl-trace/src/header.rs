//! The header of a trace: everything needed to understand and to repeat a run.

use crate::error::Malformed;
use crate::json::Json;
use crate::{decode, encode, wire};
use serde::Deserialize;
use starl_core::{Obstacle, Point, RobotId, WayPoint};
use std::collections::BTreeMap;

/// The version of the format that this crate writes, and the only one that it reads.
pub const FORMAT_VERSION: u32 = 1;

/// The description of the run as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// The version of StarL that made it.
    pub starl_version: String,
    /// The program that the robots ran, e.g. `race`.
    pub program: String,
    /// The seed of all random streams.
    pub seed: u64,
    /// The complete scenario, as TOML, with the changes of the command line applied: together with `files`, enough to
    /// run it again.
    pub scenario: String,
    /// The texts of files that the scenario names, by the names it has for them.
    pub files: BTreeMap<String, String>,
    /// The setting by which properties of the run are judged, as JSON; empty if the host does not
    /// give it.
    pub setting: String,
    /// The robots, in the order of their numbers.
    pub robots: Vec<RobotEntry>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The world's obstacles: [`starl_core::event::Hit::Obstacle`] is an index into this list.
    pub obstacles: Vec<Obstacle>,
}

/// A robot of the fleet.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RobotEntry {
    /// Its number.
    pub id: RobotId,
    /// Its name, which views use in their topics.
    pub name: String,
    /// Its model, e.g. `create`.
    pub model: String,
    /// Radius of its body, metres.
    pub radius: f64,
    /// Height of its body, metres.
    pub height: f64,
    /// Whether it flies.
    pub flies: bool,
}

/// Writes the fleet and the world: the attachment `world.json`.
pub(crate) fn encode_world(json: &mut Json, header: &Header) {
    json.mark(b'{').key("robots").mark(b'[');
    for robot in &header.robots {
        json.item().mark(b'{').key("id").integer(robot.id.0);
        json.key("name")
            .string(&robot.name)
            .key("model")
            .string(&robot.model);
        json.key("radius")
            .number(robot.radius)
            .key("height")
            .number(robot.height);
        json.key("flies").boolean(robot.flies).mark(b'}');
    }
    json.mark(b']').key("way_points");
    encode::way_points(json, &header.way_points);
    json.key("obstacles");
    encode::obstacles(json, &header.obstacles);
    json.mark(b'}');
}

/// Reads what [`encode_world`] wrote into the header.
pub(crate) fn decode_world(text: &[u8], header: &mut Header) -> Result<(), Malformed> {
    #[derive(Deserialize)]
    struct Place {
        name: String,
        position: Point,
        group: u32,
    }
    #[derive(Deserialize)]
    struct World {
        robots: Vec<RobotEntry>,
        way_points: Vec<Place>,
        obstacles: Vec<wire::Obstacle>,
    }
    let world: World = decode::parse(text)?;
    header.robots = world.robots;
    header.way_points = (world.way_points.into_iter())
        .map(
            |Place {
                 name,
                 position,
                 group,
             }| WayPoint {
                name,
                position,
                group,
            },
        )
        .collect();
    header.obstacles = wire::obstacles(world.obstacles)?;
    Ok(())
}
