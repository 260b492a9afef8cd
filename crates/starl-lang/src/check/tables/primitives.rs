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

macro_rules! primitives {
    ($(
        $constructor:literal $documentation:literal
        { $($member:literal $purity:ident $about:literal)+ }
        $(reports { $($event:literal $when:literal)+ })?
    )+) => {
        /// All primitives.
        pub const PRIMITIVES: &[Primitive] = &[$(Primitive {
            constructor: $constructor,
            members: &[$(Member { text: $member, purity: $purity, documentation: $about },)+],
            events: &[$($(Event { text: $event, documentation: $when },)+)?],
            documentation: $documentation,
        },)+];
    };
}

primitives! {
    "ReachAvoid(vicinity?: Float, pass_radius?: Float, off_path?: Float, stuck_after?: Duration, most_replans?: Int, planner?: Planner, most_nodes?: Int, gap?: Float)"
    "Drives to targets, around unsafe sets (thesis, section 3.2)." {
        "reach_avoid(target: Point, unsafe: Obstacles)" Effect "Drives to the target and keeps out of the unsafe set."
        "follow(points: List[Point], unsafe: Obstacles)" Effect "Drives through the points to the last one and keeps out of the unsafe set; it does not stop before or between."
        "drive_lane(line: List[Point], until: Float)" Effect "Drives along a line until it is `until` metres from its start; stops before robots in sight less than `gap` from the line ahead, and continues when there is room. A new command with the same line moves the limit without a stop."
        "along: Float" Query "How far along the lane the robot is, metres; 0 before it has one."
        "free(standing?: Duration) -> Float" Query "How far along the lane no robot in sight is in the way, metres; if a time is given, no robot that has stood for it, or was never seen to move."
        "stood: Duration" Query "How long the robot has been standing in its lane."
        "stop()" Effect "Stops the robot; all flags become false."
        "active: Bool" Query "Whether a command is in progress."
        "target: Point?" Query "The target of the command in progress, as given."
        "done: Bool" Query "Whether the last command brought the robot to its target."
        "failed: Bool" Query "Whether the robot has entered the unsafe set, or the wind is too strong for it."
        "reason: MotionTrouble?" Query "The reason why the last command failed or was given up."
    }
    "Broadcast(name?: String, order?: Order)"
    "Messages to all other robots, unordered or in an order (thesis, section 3.3.1)." {
        "broadcast(message: Message) -> Int" Effect "Sends a message to every other robot, and in total order to this one; returns the message's number."
        "outstanding(number: Int) -> Bool" Query "Whether the message still waits for the acknowledgement of some robot; in total order, for its position."
        "backlog: Int" Query "The number of outstanding messages; with more than 4096, the oldest fails."
        "failed: Bool" Query "In total order, whether no message can be ordered now, because no majority of the fleet is reachable."
    } reports {
        "failed(number: Int, unreached: List[RobotId])" "Some robots did not acknowledge the message with this number; in total order, it has waited too long for its position."
        "gap(from: RobotId?)" "This robot has missed messages that others may have received; `from` is their sender, if known."
    }
    "Geocast(name?: String)"
    "Messages to the robots in an area (thesis, section 3.3.1)." {
        "geocast(message: Message, area: Area) -> Int" Effect "Sends a message to the robots in an area; returns the message's number."
        "outstanding(number: Int) -> Bool" Query "Whether the message still waits for the acknowledgement of some robot."
        "backlog: Int" Query "The number of outstanding messages; with more than 4096, the oldest fails."
    } reports {
        "failed(number: Int, unreached: List[RobotId])" "Some robots did not acknowledge the message with this number."
    }
    "Unicast(name?: String)"
    "Messages to single robots (thesis, section 3.3.1)." {
        "send(to: RobotId, message: Message) -> Int" Effect "Sends a message to one robot; returns the message's number."
        "outstanding(number: Int) -> Bool" Query "Whether the message still waits for its acknowledgement."
        "backlog: Int" Query "The number of outstanding messages; with more than 4096, the oldest fails."
    } reports {
        "failed(number: Int, unreached: List[RobotId])" "Some robots did not acknowledge the message with this number."
    }
    "LocalBroadcast(name?: String)"
    "Messages to all robots in radio range, without acknowledgement." {
        "broadcast(message: Message)" Effect "Sends a message once to all robots in radio range; it may be lost."
    }
    "FailureDetector()"
    "Detects failed robots by their heartbeats." {
        "suspects: Set[RobotId]" Query "The robots that are suspected to have failed; a suspicion may be wrong."
        "live: Set[RobotId]" Query "The robots of the fleet that are not suspected, including this one."
    } reports {
        "suspected(robot: RobotId)" "A robot is suspected to have failed."
        "trusted(robot: RobotId)" "A suspected robot is heard again."
    }
    "Mutex(id: String, participants?: Set[RobotId], algorithm?: MutexAlgorithm, lease?: Duration, repeat?: Duration, places?: Map[String, Area], patience?: Duration)"
    "Mutual exclusion on named resources (thesis, section 3.4.3)." {
        "acquire(resources: Set[String], participants?: Set[RobotId])" Effect "Requests all resources at once (the thesis's do_mutex)."
        "release(resources?: Set[String])" Effect "Releases these resources, or all, and withdraws requests for them."
        "held(resources: Set[String]) -> Bool" Query "Whether this robot holds them, exclusively (the thesis's crit); places only while no other robot is seen there."
        "waiting: Bool" Query "Whether a request is waiting for its resources."
        "fencing: Int?" Query "With leases, the fencing number: greater than the number of every earlier holder of any of these resources."
        "failed: Bool" Query "Whether a robot that this one waits for is suspected to have failed."
    }
    "Registration(id: String)"
    "Agreement on the participants (thesis, section 3.4.1)." {
        "register(area?: Area)" Effect "Registers with the robots in the area, or with the whole fleet (the thesis's do_register)."
        "unregister()" Effect "Leaves (the thesis's undo_register)."
        "members: Set[RobotId]?" Query "The robots that take part (the thesis's rList); none until they have agreed."
        "agreed_at: Time?" Query "The time at which the list was computed, the same on all its members (the thesis's ts)."
        "failed: Bool" Query "Whether the agreement takes too long; it continues nevertheless."
    }
    "LeaderElection(id: String, participants?: Set[RobotId], algorithm?: ElectionAlgorithm)"
    "Election of one robot (thesis, section 3.4.2)." {
        "elect()" Effect "Becomes a candidate, and starts an election if there is none (the thesis's do_election)."
        "resign()" Effect "Stops being a candidate; a leader that resigns is replaced."
        "leader: RobotId?" Query "The leader; none until the election ends, and if it failed."
        "epoch: Int?" Query "The number of the leader's term, greater than those before; with `leases` only."
        "failed: Bool" Query "Whether the election takes too long; it continues nevertheless."
    } reports {
        "elected(leader: RobotId)" "The robot `leader` leads from now on, or has a new epoch."
        "lost(leader: RobotId)" "The robot `leader` no longer leads, and there is no leader now."
    }
    "Barrier(id: String, participants?: Set[RobotId])"
    "Lets robots wait for each other at a point of the program." {
        "arrive()" Effect "Declares that this robot has arrived at the barrier."
        "passed: Bool" Query "Whether all robots have arrived since this robot did."
        "failed: Bool" Query "Whether some robot cannot arrive."
    }
    "Policy(model: Model)"
    "A trained network, from an ONNX file beside the program." {
        "evaluate(input: List[Float]) -> List[Float]" Query "The output of the network for these numbers, in 32-bit arithmetic; a run-time error if their number is not that of the network's inputs."
    }
}

impl Primitive {
    /// The one with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        PRIMITIVES.iter().find(|primitive| primitive.name() == name)
    }

    /// Those that have a method or flag with this name.
    pub fn with_member(name: &str) -> impl Iterator<Item = &'static Self> {
        PRIMITIVES
            .iter()
            .filter(move |primitive| primitive.member(name).is_some())
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
