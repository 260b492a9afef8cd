//! Every field of a scenario with a value that makes a difference.

use super::Files;
use starl_sim::read::schema::{Dimension, Field, Kind, SCENARIO};

/// A scenario in which every list has an element.
pub const FULL: &str = r#"
program = "race"

[world]
bounds = { low = [-9, -9], high = [19, 19] }
start_area = { low = [-5, -5], high = [10, 10] }

[[world.obstacle]]
polygon = [[3, 3], [4, 3], [4, 4]]

[[world.obstacle]]
circle = { center = [6, 3], radius = "0.5m" }

[[world.obstacle]]
rectangle = { low = [8, 3], high = [8.5, 3.5] }

[[world.obstacle]]
box = { low = [6, 6, 0], high = [6.5, 6.5, 1] }

[[world.occupancy]]
image = "map.pgm"
resolution = "100mm"
origin = [-3, 8]

[[world.way_point]]
name = "A"
position = [1, 0]

[[world.thing]]
name = "cup"
position = [0, 1]

[[robots]]
model = "create"
start = [{ position = [0, 0] }]

[[robots]]
model = "drone"
area = { low = [-4, -4], high = [-1, -1] }

[[robots]]
model = "differential"

[network]
jitter = "1ms"

[[network.link]]

[[fault]]
at = "1s"
kind = "crash"
robots = ["create0"]

[[fault]]
at = "1s"
kind = "partition"
groups = [["create0"], ["drone0"]]
"#;

/// Where a field is set in [`FULL`], and to what; most follow from its path and kind.
pub fn sample(path: &str, field: &Field) -> (String, String) {
    let set = |path: &str, value: &str| (path.to_string(), value.to_string());
    match path {
        "seed" => return set(path, "7"),
        "duration" => return set(path, "33s"),
        "world.files" => return set(path, r#"["w.wpt"]"#),
        "world.bounds.low" => return set(path, "[-8, -8]"),
        "world.bounds.high" => return set(path, "[20, 20]"),
        "world.start_area.low" => return set(path, "[-4, -4]"),
        "world.start_area.high" => return set(path, "[9, 9]"),
        "world.obstacle.0.circle" => {
            return set(
                "world.obstacle.1.circle",
                r#"{ center = [6, 3], radius = "0.4m" }"#,
            );
        }
        "world.obstacle.0.circle.center" => {
            return set("world.obstacle.1.circle.center", "[6.1, 3]");
        }
        "world.obstacle.0.circle.radius" => return set("world.obstacle.1.circle.radius", "0.3m"),
        "world.obstacle.0.rectangle" => {
            return set(
                "world.obstacle.2.rectangle",
                "{ low = [8, 3], high = [9, 4] }",
            );
        }
        "world.obstacle.0.rectangle.low" => {
            return set("world.obstacle.2.rectangle.low", "[8.1, 3]");
        }
        "world.obstacle.0.rectangle.high" => {
            return set("world.obstacle.2.rectangle.high", "[9, 4]");
        }
        "world.obstacle.0.box" => {
            return set(
                "world.obstacle.3.box",
                "{ low = [6, 6, 0], high = [7, 7, 2] }",
            );
        }
        "world.obstacle.0.box.low" => return set("world.obstacle.3.box.low", "[6.1, 6, 0]"),
        "world.obstacle.0.box.high" => return set("world.obstacle.3.box.high", "[7, 7, 2]"),
        "world.occupancy.0.image" => return set(path, "other.pgm"),
        "world.occupancy.0.threshold" => return set(path, "0.3"),
        "robots.0.model" | "robots.0.name" | "robots.0.numbered" | "robots.0.first_number" => {
            let path = path.replace("robots.0", "robots.2");
            let value = match field.kind {
                Kind::Model => "car",
                Kind::Flag => "false",
                Kind::Count(..) => "5",
                _ => "swarm",
            };
            return set(&path, value);
        }
        "robots.0.start" => return set(path, "[{ position = [0.5, 0] }]"),
        "robots.0.spacing" => return set("robots.2.spacing", "5m"),
        "robots.0.area.low" => return set("robots.1.area.low", "[-3, -3]"),
        "robots.0.area.high" => return set("robots.1.area.high", "[-2, -2]"),
        "robots.0.model_parameters" => return set(path, r#"{ radius = "0.2m" }"#),
        "robots.0.sensors.proximity" | "robots.0.sensors.detector" => return set(path, "true"),
        "motion.avoidance" => return set(path, "false"),
        "network.largest" => return set(path, "1000"),
        "network.distribution" | "network.link.0.distribution" => return set(path, "exponential"),
        "network.jitter" | "network.link.0.jitter" => return set(path, "2ms"),
        "network.link.0.from" | "network.link.0.to" | "fault.0.robots" => {
            return set(path, r#"["drone"]"#);
        }
        "fault.0.kind" => return set(path, "stuck_motor"),
        "fault.0.groups" => return set("fault.1.groups", r#"[["drone0"]]"#),
        "goal" => return set(path, "duration"),
        _ => {}
    }
    let value = match field.kind {
        Kind::Text => "another",
        Kind::Flag if field.default.describe() == "true" => "false",
        Kind::Flag => "true",
        Kind::Count(..) => "3",
        Kind::Probability => "0.4",
        Kind::Quantity(Dimension::Time, _) => "33ms",
        Kind::Quantity(Dimension::Length, _) => "0.77m",
        Kind::Quantity(Dimension::Angle, _) => "3deg",
        Kind::Quantity(Dimension::Speed, _) => "0.1m/s",
        Kind::Quantity(Dimension::BitRate, _) => "9kbit/s",
        Kind::Quantity(Dimension::Rate, _) => "0.2/s",
        Kind::Quantity(..) => "2%",
        Kind::Point | Kind::PlanarPoint => "[0.5, 0.5]",
        Kind::Outline => "[[3, 3], [4, 3], [4, 5]]",
        Kind::Velocity => "[1, 2]",
        Kind::Heights => "[0, 0.5]",
        Kind::Parameters => "{ answer = 42 }",
        kind => panic!("{path}: no sample for {kind:?}"),
    };
    set(path, value)
}

/// Calls `visit` for every field with its path, the first element standing for each list.
fn walk_below(path: &str, fields: &'static [Field], visit: &mut dyn FnMut(&str, &Field)) {
    for field in fields {
        let path = if path.is_empty() {
            field.name.to_string()
        } else {
            format!("{path}.{}", field.name)
        };
        match field.kind {
            Kind::Table(fields) => walk_below(&path, fields, visit),
            Kind::Tables(fields) => walk_below(&format!("{path}.0"), fields, visit),
            Kind::Switch(fields) => {
                visit(&path, field);
                walk_below(&path, fields, visit);
            }
            _ => visit(&path, field),
        }
    }
}

/// Calls `visit` for every field of a scenario with its path.
pub fn walk(visit: &mut dyn FnMut(&str, &Field)) {
    walk_below("", SCENARIO, visit);
}

/// The files that [`FULL`] and the samples name.
pub fn files() -> Files {
    let mut files = Files::default();
    let mut file = |name: &str, content: &[u8]| files.0.insert(name.to_string(), content.to_vec());
    file("w.wpt", b"WAY,1000,1000,0,Z");
    file("map.pgm", b"P2 3 1 10 0 5 10");
    file("other.pgm", b"P2 3 1 10 10 5 0");
    files
}
