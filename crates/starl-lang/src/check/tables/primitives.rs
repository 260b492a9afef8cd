//! Primitives (thesis, chapter 3): how they are bound, asked and told, and what they report.
//!
//! A primitive is one entry here and its implementation at the host; the checker and the compiler know
//! no primitive by name. The compiler calls a member as `Primitive.member` with the instance's number.

use super::Purity::{self, Effect, Query};
use super::Signature;

/// A kind of primitive.
#[derive(Debug, PartialEq)]
pub struct Primitive {
    /// How it is bound: its name and the parameters of its constructor.
    pub constructor: &'static str,
    /// Its methods and status flags.
    pub members: &'static [Member],
    /// What it reports by itself, for handlers.
    pub events: &'static [Event],
    /// What it is, as one tells a person.
    pub documentation: &'static str,
}

/// A method or a status flag of a primitive.
#[derive(Debug, PartialEq)]
pub struct Member {
    /// Its signature.
    pub text: &'static str,
    /// Whether it does something or only tells.
    pub purity: Purity,
    /// What it does, as one tells a person.
    pub documentation: &'static str,
}

/// Something that a primitive reports.
#[derive(Debug, PartialEq)]
pub struct Event {
    /// Its name and what it carries.
    pub text: &'static str,
    /// When it comes, as one tells a person.
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
                "Goes to the target and keeps out of the unsafe set.",
            ),
            member(
                "follow(points: List[Point], unsafe: Obstacles)",
                Effect,
                "Goes to the last point by way of the others and keeps out of the unsafe set; does not stop in between, nor before it sets out.",
            ),
            member(
                "drive_lane(line: List[Point], until: Float)",
                Effect,
                "Drives along a line until it is `until` metres from its start; stops before robots in sight less than `gap` from the line ahead, and goes on when there is room. Given again it moves the limit, without a stop.",
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
                "For how long the robot has stood, since it drives in a lane.",
            ),
            member("stop()", Effect, "Stops and stays; all flags become false."),
            member("active: Bool", Query, "Whether a command is under way."),
            member(
                "target: Point?",
                Query,
                "Where the command under way leads, as it was given.",
            ),
            member(
                "done: Bool",
                Query,
                "Whether the last command brought the robot to its target.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether the robot entered the unsafe set, or the wind is stronger than it can hold against.",
            ),
            member(
                "reason: MotionTrouble?",
                Query,
                "Why the last command failed or was given up.",
            ),
        ],
        events: &[],
        documentation: "Goes to targets, around unsafe sets (thesis, section 3.2).",
    },
    Primitive {
        constructor: "Broadcast(name?: String, order?: Order)",
        members: &[
            member(
                "broadcast(message: Message) -> Int",
                Effect,
                "Sends a message to every other robot, in total order to this one too; gives the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether some robot has neither acknowledged the message nor been given up; in total order, whether it has no place yet.",
            ),
            member(
                "backlog: Int",
                Query,
                "How many messages are outstanding; of more than 4096 the oldest fails.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether nothing can be ordered at present: in total order, without a majority of the fleet in reach.",
            ),
        ],
        events: &[
            Event {
                text: "failed(number: Int, unreached: List[RobotId])",
                documentation: "Some robots did not acknowledge the message with this number; in total order, it has waited too long for its place.",
            },
            Event {
                text: "gap(from: RobotId?)",
                documentation: "Messages that others may have received, of this robot if it is known, will not reach this one.",
            },
        ],
        documentation: "Messages to all other robots, in any order or in a certain one (thesis, section 3.3.1).",
    },
    Primitive {
        constructor: "Geocast(name?: String)",
        members: &[
            member(
                "geocast(message: Message, area: Area) -> Int",
                Effect,
                "Sends a message to the robots in an area; gives the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether some robot has neither acknowledged the message nor been given up.",
            ),
            member(
                "backlog: Int",
                Query,
                "How many messages are outstanding; of more than 4096 the oldest fails.",
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
                "Sends a message to one robot; gives the message's number.",
            ),
            member(
                "outstanding(number: Int) -> Bool",
                Query,
                "Whether the message has neither been acknowledged nor given up.",
            ),
            member(
                "backlog: Int",
                Query,
                "How many messages are outstanding; of more than 4096 the oldest fails.",
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
            "Sends a message to all robots in reach of the radio, once: it may be lost.",
        )],
        events: &[],
        documentation: "Messages to all robots in reach of the radio, without acknowledgement.",
    },
    Primitive {
        constructor: "FailureDetector()",
        members: &[
            member(
                "suspects: Set[RobotId]",
                Query,
                "The robots that are believed to have failed; it may be wrong.",
            ),
            member(
                "live: Set[RobotId]",
                Query,
                "All other robots of the fleet, and this one.",
            ),
        ],
        events: &[
            Event {
                text: "suspected(robot: RobotId)",
                documentation: "A robot is believed to have failed.",
            },
            Event {
                text: "trusted(robot: RobotId)",
                documentation: "It is heard again.",
            },
        ],
        documentation: "Notices which robots have failed, by their heartbeats.",
    },
    Primitive {
        constructor: "Mutex(id: String, participants?: Set[RobotId], algorithm?: MutexAlgorithm, lease?: Duration, repeat?: Duration, places?: Map[String, Area], patience?: Duration)",
        members: &[
            member(
                "acquire(resources: Set[String], participants?: Set[RobotId])",
                Effect,
                "Asks for all resources at once (the thesis's do_mutex).",
            ),
            member(
                "release(resources?: Set[String])",
                Effect,
                "Gives back these resources, or all; those that are still waited for are no longer asked for.",
            ),
            member(
                "held(resources: Set[String]) -> Bool",
                Query,
                "Whether this robot alone holds them (the thesis's crit); places only while no other robot is seen there.",
            ),
            member(
                "waiting: Bool",
                Query,
                "Whether resources are asked for and not held yet.",
            ),
            member(
                "fencing: Int?",
                Query,
                "With leases, the number of what is held: greater than those of all who held any of it before.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether somebody who is waited for is believed to have failed.",
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
                "Joins those in the area, or the whole fleet (the thesis's do_register).",
            ),
            member(
                "unregister()",
                Effect,
                "Leaves (the thesis's undo_register).",
            ),
            member(
                "members: Set[RobotId]?",
                Query,
                "Those who agreed on taking part (the thesis's rList); none while that is open.",
            ),
            member(
                "agreed_at: Time?",
                Query,
                "When that list was computed, the same for all in it (the thesis's ts).",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether there has been no agreement for long; it is still tried.",
            ),
        ],
        events: &[],
        documentation: "Agreement on who takes part (thesis, section 3.4.1).",
    },
    Primitive {
        constructor: "LeaderElection(id: String, participants?: Set[RobotId], algorithm?: ElectionAlgorithm)",
        members: &[
            member(
                "elect()",
                Effect,
                "Stands for election from now on, and has one if there is none (the thesis's do_election).",
            ),
            member(
                "resign()",
                Effect,
                "No longer stands; a leader that resigns is replaced.",
            ),
            member(
                "leader: RobotId?",
                Query,
                "Who leads; none while that is open and if the election failed.",
            ),
            member(
                "epoch: Int?",
                Query,
                "The number of its leadership, greater than those before; with `leases` only.",
            ),
            member(
                "failed: Bool",
                Query,
                "Whether the election takes too long; it goes on all the same.",
            ),
        ],
        events: &[
            Event {
                text: "elected(leader: RobotId)",
                documentation: "This robot leads from now on, or in a new epoch.",
            },
            Event {
                text: "lost(leader: RobotId)",
                documentation: "This robot led, and nobody does now.",
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
                "Says that this robot has come to the barrier.",
            ),
            member(
                "passed: Bool",
                Query,
                "Whether all have come since this robot did.",
            ),
            member("failed: Bool", Query, "Whether some robot cannot come."),
        ],
        events: &[],
        documentation: "Waits until all robots have come to the same point.",
    },
    Primitive {
        constructor: "Policy(model: Model)",
        members: &[member(
            "evaluate(input: List[Float]) -> List[Float]",
            Query,
            "What the network gives for these numbers, in 32-bit arithmetic; another number of them than the network takes is a run-time error.",
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
