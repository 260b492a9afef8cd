//! Descriptions of built-in names.

use crate::description::Description;
use crate::words::{Word, word};
use starl_lang::check::{PRIMITIVES, Symbol};

/// Built-in types with their documentation.
pub(crate) const TYPES: &[Word] = &[
    word("Bool", "Bool", "`true` or `false`."),
    word(
        "Int",
        "Int",
        "A whole number of 64 bits; overflow is a run-time error.",
    ),
    word(
        "Float",
        "Float",
        "A number with a fraction; lengths are in metres, angles in radians.",
    ),
    word("String", "String", "A text."),
    word(
        "Point",
        "Point",
        "A position or a vector: `x`, `y` and `z`, metres.",
    ),
    word("Time", "Time", "A time on this robot's clock."),
    word(
        "Duration",
        "Duration",
        "A time span, such as `500ms`; never negative.",
    ),
    word("RobotId", "RobotId", "A robot of the fleet."),
    word("Area", "Area", "A part of the floor plane."),
    word("Obstacles", "Obstacles", "A set of obstacles."),
    word("List", "List[T]", "Elements in order, by index from 0."),
    word("Set", "Set[T]", "Distinct elements, in ascending order."),
    word(
        "Map",
        "Map[K, V]",
        "A value for each key, in ascending order of the keys.",
    ),
];

/// The attributes that properties may read of every robot.
pub(crate) const ROBOT_MEMBERS: &[Word] = &[
    word(
        "position",
        "position: Point",
        "The position of the robot, metres: the true one if the host knows it.",
    ),
    word(
        "heading",
        "heading: Float",
        "The heading of the robot, radians from the x axis.",
    ),
    word(
        "velocity",
        "velocity: Point",
        "The velocity of the robot, metres per second.",
    ),
    word(
        "finished",
        "finished: Bool",
        "Whether the robot's program has declared that it reached its goal.",
    ),
    word(
        "up",
        "up: Bool",
        "Whether the robot is running and has not crashed.",
    ),
    word("id", "id: RobotId", "The robot's number."),
];

/// The description of a built-in name.
pub(crate) fn built_in(symbol: Symbol) -> Description {
    let of_table = |table: &[Word], name: &str| {
        let found = table.iter().find(|own| own.word == name);
        found.map(Word::description).unwrap_or_default()
    };
    match symbol {
        Symbol::Builtin(builtin) => Description::new(builtin.text(), builtin.documentation()),
        Symbol::Type(name) => of_table(TYPES, name),
        Symbol::Method(method) => Description::new(method.text(), method.documentation()),
        Symbol::Primitive(number) => {
            let primitive = &PRIMITIVES[number];
            Description::new(primitive.constructor, primitive.documentation)
        }
        Symbol::Member(primitive, number) => {
            let primitive = &PRIMITIVES[primitive];
            let member = &primitive.members[number];
            let text = format!("{}.{}", primitive.name(), member.text);
            Description::new(text, member.documentation)
        }
        Symbol::Event(primitive, number) => {
            let primitive = &PRIMITIVES[primitive];
            let event = &primitive.events[number];
            let text = format!("on {}.{}", primitive.name(), event.text);
            Description::new(text, event.documentation)
        }
        Symbol::Coordinate(axis) => {
            Description::new(format!("Point.{axis}: Float"), "A coordinate, metres.")
        }
        Symbol::Argument(signature, name) => argument(signature, name),
        Symbol::RobotMember(name) => of_table(ROBOT_MEMBERS, name),
        _ => Description::default(),
    }
}

/// A parameter, by the signature that it is of.
fn argument(signature: &str, name: &str) -> Description {
    let inside = signature.split_once('(').map_or("", |(_, inside)| inside);
    let is_own = |part: &&str| part.trim_start().starts_with(name);
    let found = inside.split(", ").find(is_own).unwrap_or(name);
    let text = found.split(')').next().unwrap_or(found);
    Description::new(text.trim(), format!("`{signature}`"))
}
