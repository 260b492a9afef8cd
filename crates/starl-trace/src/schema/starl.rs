//! The schemas of StarL's own topics, format version 1.

use super::{
    Member, always, array, boolean, count, described, maybe, number, object, point, root, string,
    word,
};
use crate::Topic;

/// The name of a topic's schema.
pub(crate) fn name(topic: Topic) -> &'static str {
    match topic {
        Topic::Pose | Topic::Estimate => "starl.Pose",
        Topic::Sent => "starl.Sent",
        Topic::Delivered => "starl.Delivered",
        Topic::Dropped => "starl.Dropped",
        Topic::Collision => "starl.Collision",
        Topic::Action => "starl.Action",
        Topic::Program => "starl.Program",
        Topic::Primitive => "starl.Primitive",
        Topic::Log => "starl.Log",
        Topic::Mark => "starl.Mark",
        Topic::Fault => "starl.Fault",
        Topic::Discovered => "starl.Discovered",
        Topic::Status => "starl.Status",
        Topic::Violation => "starl.Violation",
        Topic::Thing => "starl.Thing",
        Topic::Intervention => "starl.Intervention",
        Topic::Summary => "starl.Summary",
    }
}

/// The text of a topic's schema.
pub(crate) fn text(topic: Topic) -> String {
    let mut members = Vec::new();
    if topic != Topic::Summary {
        members.push(maybe(
            "robot",
            count("number of the robot; absent where the event is the world's"),
        ));
    }
    members.extend(own_members(topic));
    root(name(topic), description(topic), &members)
}

fn description(topic: Topic) -> &'static str {
    match topic {
        Topic::Pose | Topic::Estimate => {
            "A robot's pose in the world frame: intrinsic yaw, pitch, roll. The centre of the body's base, true on /starl/pose, as the positioning system reported it on /starl/estimate"
        }
        Topic::Sent => "A robot passed a datagram to the network",
        Topic::Delivered => "A datagram reached the robot",
        Topic::Dropped => "A datagram did not reach a robot",
        Topic::Collision => "The robot's body met something and was stopped",
        Topic::Action => "A guarded action of the robot's program fired",
        Topic::Program => "The robot's program reports an event of its own",
        Topic::Primitive => "A primitive was given a command, or reports an outcome",
        Topic::Log => "A line of the program's log",
        Topic::Mark => {
            "The program draws; a mark replaces the one its robot drew under the same label"
        }
        Topic::Fault => "A fault set in or was healed",
        Topic::Discovered => "The robot met an obstacle that it did not know",
        Topic::Status => "The program has reached its goal, or cannot continue",
        Topic::Violation => "A property does not hold",
        Topic::Thing => "The robot took hold of a thing, or put it down",
        Topic::Intervention => "The run is steered from outside",
        Topic::Summary => "How the run ended; the last message of a whole trace",
    }
}

fn own_members(topic: Topic) -> Vec<Member<'static>> {
    match topic {
        Topic::Pose | Topic::Estimate => vec![
            always("x", number("metres")),
            always("y", number("metres")),
            always("z", number("metres above the floor")),
            always(
                "yaw",
                number("heading, radians from the x axis, left positive"),
            ),
            always("pitch", number("nose-down angle, radians")),
            always("roll", number("right-side-down angle, radians")),
        ],
        Topic::Sent => vec![
            always("sequence", count("counts the robot's datagrams")),
            maybe(
                "to",
                count("number of the receiving robot; absent for all robots in range"),
            ),
            always(
                "port",
                count("endpoint on the receiver: 0 the program, else a primitive's"),
            ),
            always(
                "payload",
                "{\"type\":\"string\",\"contentEncoding\":\"base64\",\"description\":\"content\"}",
            ),
        ],
        Topic::Delivered => datagram(),
        Topic::Dropped => {
            let reasons = ["loss", "range", "partition", "down", "bandwidth", "size"];
            let mut members = datagram();
            members.push(maybe(
                "to",
                count(
                    "number of the robot that does not receive it; absent if there is no receiver",
                ),
            ));
            members.push(always("reason", word("why", &reasons)));
            members
        }
        Topic::Collision => vec![
            maybe("with_robot", count("number of the other robot")),
            maybe(
                "with_obstacle",
                count("index of the obstacle in starl/world.json"),
            ),
        ],
        Topic::Action => vec![always("name", string("the action"))],
        Topic::Program => vec![always("name", string("the event")), fields()],
        Topic::Primitive => vec![
            always("primitive", string("type of the primitive")),
            always("port", count("endpoint of the instance")),
            always("name", string("what happened")),
            fields(),
        ],
        Topic::Log => vec![
            always(
                "level",
                word(
                    "how much it matters",
                    &["debug", "info", "warning", "error"],
                ),
            ),
            always("text", string("one line")),
        ],
        Topic::Mark => {
            let shapes = ["nothing", "dot", "circle", "line", "text"];
            vec![
                always("label", string("identifies the mark on its robot")),
                always(
                    "shape",
                    word("what to draw; nothing takes the mark away", &shapes),
                ),
                maybe("points", array(point())),
                maybe("radius", number("of a circle, metres")),
            ]
        }
        Topic::Fault => vec![always("text", string("which fault"))],
        Topic::Discovered => vec![always("obstacle", obstacle())],
        Topic::Status => vec![
            always(
                "status",
                word("whether the goal was reached", &["finished", "failed"]),
            ),
            maybe("reason", string("why the program cannot continue")),
        ],
        Topic::Violation => vec![
            always("property", string("which property")),
            always("text", string("how it is violated")),
        ],
        Topic::Thing => vec![
            always("thing", count("index of the thing in the world")),
            maybe("put_down", point()),
        ],
        Topic::Intervention => vec![always(
            "intervention",
            "{\"type\":\"string\",\"contentMediaType\":\"application/json\",\"description\":\"the kind of intervention, with its details\"}",
        )],
        Topic::Summary => vec![
            always("outcome", string("how the run ended")),
            always("digest", string("hash of all events, hexadecimal")),
            always(
                "end_ns",
                count("when it ended, nanoseconds since the start"),
            ),
            always(
                "records",
                count("how many messages with records there are, this one left out"),
            ),
            always(
                "counts",
                array(object(
                    "",
                    &[
                        always("topic", string("the topic without /starl/")),
                        always("records", count("how many messages it has")),
                    ],
                )),
            ),
            maybe(
                "inputs",
                count("how many messages there are on /starl/inputs; absent if none"),
            ),
        ],
    }
}

fn datagram() -> Vec<Member<'static>> {
    vec![
        always("from", count("number of the sending robot")),
        always("sequence", count("the sender's number for it")),
    ]
}

/// Details of an event: a name and exactly one other member.
fn fields() -> Member<'static> {
    let field = object(
        "\"minProperties\":2,\"maxProperties\":2,",
        &[
            always("name", string("which detail")),
            maybe("bool", boolean("yes or no")),
            maybe("int", described("integer", "a whole number")),
            maybe("float", number("a number")),
            maybe(
                "not_finite",
                word("a number that JSON cannot write", &["nan", "inf", "-inf"]),
            ),
            maybe("text", string("a text")),
            maybe("time_ns", count("a moment, nanoseconds since the start")),
            maybe("point", point()),
            maybe("path", array(point())),
            maybe("robot", count("number of a robot")),
            maybe("robots", array(count("number of a robot"))),
            maybe("obstacles", array(obstacle())),
            maybe("area", object(ONE, &base())),
        ],
    );
    always("fields", array(field))
}

const ONE: &str = "\"minProperties\":1,\"maxProperties\":1,";

/// A shape in the floor plane, or a box in space: exactly one of these.
fn base() -> Vec<Member<'static>> {
    let circle = [
        always("center", point()),
        always("radius", number("metres")),
    ];
    let corners = [always("low", point()), always("high", point())];
    vec![
        maybe("circle", object("", &circle)),
        maybe("polygon", array(point())),
        maybe("box", object("", &corners)),
    ]
}

/// An area, and unless it is a box its heights; without them it reaches from the floor to the sky.
fn obstacle() -> String {
    let mut members = base();
    let height = [
        always("low", number("metres")),
        always("high", number("metres")),
    ];
    members.push(maybe("height", object("", &height)));
    object("\"minProperties\":1,\"maxProperties\":2,", &members)
}
