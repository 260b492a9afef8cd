//! Primitives (thesis, chapter 3): their constructors, flags, methods and events.
//!
//! A primitive is one entry here and its implementation at the host; the checker and the compiler do not refer to
//! primitives by name. The compiler calls a member as `Primitive.member` with the instance's number.

use super::Purity::{self, Effect, Query};
use super::Signature;

/// A kind of primitive.
#[derive(Debug, PartialEq)]
pub struct Primitive {
    /// How it is bound: its name and the parameters of its constructor.
    pub constructor: &'static str,
    /// Its methods and status flags.
    pub members: &'static [Member],
    /// The events that it reports to handlers.
    pub events: &'static [Event],
    /// The documentation shown to users.
    pub documentation: &'static str,
}

/// A method or a status flag of a primitive.
#[derive(Debug, PartialEq)]
pub struct Member {
    /// Its signature.
    pub text: &'static str,
    /// Whether it has an effect or is a query.
    pub purity: Purity,
    /// The documentation shown to users.
    pub documentation: &'static str,
}

/// Something that a primitive reports.
#[derive(Debug, PartialEq)]
pub struct Event {
    /// Its name and fields.
    pub text: &'static str,
    /// The documentation shown to users.
    pub documentation: &'static str,
}

const fn member(text: &'static str, purity: Purity, documentation: &'static str) -> Member {
    Member {
        text,
        purity,
        documentation,
    }
}

const FAILED: &[Event] = &[Event {
    text: "failed(number: Int, unreached: List[RobotId])",
    documentation: "Some robots did not acknowledge the message with this number.",
}];

/// All primitives.
pub const PRIMITIVES: &[Primitive] = &[
    Primitive {
        constructor: "ReachAvoid(vicinity?: Float, pass_radius?: Float, off_path?: Float, stuck_after?: Duration, most_replans?: Int, planner?: Planner, most_nodes?: Int, gap?: Float)",
        members: &[
            member(
                "reach_avoid(target: Point, unsafe: Obstacles)",
                Effect,
                "Drives to the target and keeps out of the unsafe set.",
            ),
            member(
                "follow(points: List[Point], unsafe: Obstacles)",
                Effect,
                "Drives through the points to the last one and keeps out of the unsafe set; it does not stop before or between.",
            ),
            member(
                "drive_lane(line: List[Point], until: Float)",
                Effect,
                "Drives along a line until it is `until` metres from its start; stops before robots in sight less than `gap` from the line ahead, and continues when there is room. A new command with the same line moves the limit without a stop.",
            ),
            member(
                "along: Float",
                Query,
                "How far along the lane the robot is, metres; 0 before it has one.",
            ),
            member(
                "free(standing?: Duration) -> Float",
                Query,
                "How far along the lane no robot in sight is in the way, metres; if a time is given, no robot that has stood for it, or was never seen to move.",
            ),
            member(
                "stood: Duration",
                Query,
                "How long the robot has been standing in its lane.",
            ),
            member("stop()", Effect, "Stops the robot; all flags become false."),
            member("active: Bool", Query, "Whether a command is in progress."),
            member(
                "target: Point?",
                Query,
                "The target of the command in progress, as given.",
            ),
            member(
                "done: Bool",
                Query,
                "Whether the last command brought the robot to its target.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether the robot has entered the unsafe set, or the wind is too strong for it.",
            ),
            member(
                "reason: MotionTrouble?",
                Query,
                "The reason why the last command failed or was given up.",
            ),
        ],
        events: &[],
        documentation: "Drives to targets, around unsafe sets (thesis, section 3.2).",
    },
    Primitive {
        constructor: "Broadcast(name?: String, order?: Order)",
        members: &[
            member(
                "broadcast(message: Message) -> Int",
                Effect,
                "Sends a message to every other robot, and in total order to this one; returns the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether the message still waits for the acknowledgement of some robot; in total order, for its position.",
            ),
            member(
                "backlog: Int",
                Query,
                "The number of outstanding messages; with more than 4096, the oldest fails.",
            ),
            member(
                "failed: Bool",
                Query,
                "In total order, whether no message can be ordered now, because no majority of the fleet is reachable.",
            ),
        ],
        events: &[
            Event {
                text: "failed(number: Int, unreached: List[RobotId])",
                documentation: "Some robots did not acknowledge the message with this number; in total order, it has waited too long for its position.",
            },
            Event {
                text: "gap(from: RobotId?)",
                documentation: "This robot has missed messages that others may have received; `from` is their sender, if known.",
            },
        ],
        documentation: "Messages to all other robots, unordered or in an order (thesis, section 3.3.1).",
    },
    Primitive {
        constructor: "Geocast(name?: String)",
        members: &[
            member(
                "geocast(message: Message, area: Area) -> Int",
                Effect,
                "Sends a message to the robots in an area; returns the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether the message still waits for the acknowledgement of some robot.",
            ),
            member(
                "backlog: Int",
                Query,
                "The number of outstanding messages; with more than 4096, the oldest fails.",
            ),
        ],
        events: FAILED,
        documentation: "Messages to the robots in an area (thesis, section 3.3.1).",
    },
    Primitive {
        constructor: "Unicast(name?: String)",
        members: &[
            member(
                "send(to: RobotId, message: Message) -> Int",
                Effect,
                "Sends a message to one robot; returns the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether the message still waits for its acknowledgement.",
            ),
            member(
                "backlog: Int",
                Query,
                "The number of outstanding messages; with more than 4096, the oldest fails.",
            ),
        ],
        events: FAILED,
        documentation: "Messages to single robots (thesis, section 3.3.1).",
    },
    Primitive {
        constructor: "LocalBroadcast(name?: String)",
        members: &[member(
            "broadcast(message: Message)",
            Effect,
            "Sends a message once to all robots in radio range; it may be lost.",
        )],
        events: &[],
        documentation: "Messages to all robots in radio range, without acknowledgement.",
    },
    Primitive {
        constructor: "FailureDetector()",
        members: &[
            member(
                "suspects: Set[RobotId]",
                Query,
                "The robots that are suspected to have failed; a suspicion may be wrong.",
            ),
            member(
                "live: Set[RobotId]",
                Query,
                "The robots of the fleet that are not suspected, including this one.",
            ),
        ],
        events: &[
            Event {
                text: "suspected(robot: RobotId)",
                documentation: "A robot is suspected to have failed.",
            },
            Event {
                text: "trusted(robot: RobotId)",
                documentation: "A suspected robot is heard again.",
            },
        ],
        documentation: "Detects failed robots by their heartbeats.",
    },
    Primitive {
        constructor: "Mutex(id: String, participants?: Set[RobotId], algorithm?: MutexAlgorithm, lease?: Duration, repeat?: Duration, places?: Map[String, Area], patience?: Duration)",
        members: &[
            member(
                "acquire(resources: Set[String], participants?: Set[RobotId])",
                Effect,
                "Requests all resources at once (the thesis's do_mutex).",
            ),
            member(
                "release(resources?: Set[String])",
                Effect,
                "Releases these resources, or all, and withdraws requests for them.",
            ),
            member(
                "held(resources: Set[String]) -> Bool",
                Query,
                "Whether this robot holds them, exclusively (the thesis's crit); places only while no other robot is seen there.",
            ),
            member(
                "waiting: Bool",
                Query,
                "Whether a request is waiting for its resources.",
            ),
            member(
                "fencing: Int?",
                Query,
                "With leases, the fencing number: greater than the number of every earlier holder of any of these resources.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether a robot that this one waits for is suspected to have failed.",
            ),
        ],
        events: &[],
        documentation: "Mutual exclusion on named resources (thesis, section 3.4.3).",
    },
    Primitive {
        constructor: "Registration(id: String)",
        members: &[
            member(
                "register(area?: Area)",
                Effect,
                "Registers with the robots in the area, or with the whole fleet (the thesis's do_register).",
            ),
            member(
                "unregister()",
                Effect,
                "Leaves (the thesis's undo_register).",
            ),
            member(
                "members: Set[RobotId]?",
                Query,
                "The robots that take part (the thesis's rList); none until they have agreed.",
            ),
            member(
                "agreed_at: Time?",
                Query,
                "The time at which the list was computed, the same on all its members (the thesis's ts).",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether the agreement takes too long; it continues nevertheless.",
            ),
        ],
        events: &[],
        documentation: "Agreement on the participants (thesis, section 3.4.1).",
    },
    Primitive {
        constructor: "LeaderElection(id: String, participants?: Set[RobotId], algorithm?: ElectionAlgorithm)",
        members: &[
            member(
                "elect()",
                Effect,
                "Becomes a candidate, and starts an election if there is none (the thesis's do_election).",
            ),
            member(
                "resign()",
                Effect,
                "Stops being a candidate; a leader that resigns is replaced.",
            ),
            member(
                "leader: RobotId?",
                Query,
                "The leader; none until the election ends, and if it failed.",
            ),
            member(
                "epoch: Int?",
                Query,
                "The number of the leader's term, greater than those before; with `leases` only.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether the election takes too long; it continues nevertheless.",
            ),
        ],
        events: &[
            Event {
                text: "elected(leader: RobotId)",
                documentation: "The robot `leader` leads from now on, or has a new epoch.",
            },
            Event {
                text: "lost(leader: RobotId)",
                documentation: "The robot `leader` no longer leads, and there is no leader now.",
            },
        ],
        documentation: "Election of one robot (thesis, section 3.4.2).",
    },
    Primitive {
        constructor: "Barrier(id: String, participants?: Set[RobotId])",
        members: &[
            member(
                "arrive()",
                Effect,
                "Declares that this robot has arrived at the barrier.",
            ),
            member(
                "passed: Bool",
                Query,
                "Whether all robots have arrived since this robot did.",
            ),
            member("failed: Bool", Query, "Whether some robot cannot arrive."),
        ],
        events: &[],
        documentation: "Lets robots wait for each other at a point of the program.",
    },
    Primitive {
        constructor: "Policy(model: Model)",
        members: &[member(
            "evaluate(input: List[Float]) -> List[Float]",
            Query,
            "The output of the network for these numbers, in 32-bit arithmetic; a run-time error if their number is not that of the network's inputs.",
        )],
        events: &[],
        documentation: "A trained network, from an ONNX file beside the program.",
    },
];

impl Primitive {
    /// The one with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        PRIMITIVES.iter().find(|primitive| primitive.name() == name)
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        Signature::name_of(self.constructor)
    }

    /// Its method or flag with this name.
    #[must_use]
    pub fn member(&self, name: &str) -> Option<&'static Member> {
        self.members.iter().find(|member| member.name() == name)
    }

    /// Its event with this name.
    #[must_use]
    pub fn event(&self, name: &str) -> Option<&'static Event> {
        self.events.iter().find(|event| event.name() == name)
    }
}

impl Member {
    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        Signature::name_of(self.text)
    }

    /// Its signature.
    #[must_use]
    pub fn signature(&self) -> Signature {
        Signature::read(self.text)
    }
}

impl Event {
    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        Signature::name_of(self.text)
    }

    /// Its signature.
    #[must_use]
    pub fn signature(&self) -> Signature {
        Signature::read(self.text)
    }
}
