//! Linearizable registers by majority quorum.
//!
//! The algorithm is that of Attiya, Bar-Noy and Dolev (1995, "Sharing Memory Robustly in Message-Passing Systems") for
//! many writers (Lynch and Shvartsman 1997, "Robust Emulation of Shared Memory Using Dynamic Quorum-Acknowledged
//! Broadcasts"). Each participant keeps a copy of each register with a [`Tag`]. A read asks for the copies of a
//! majority, has the latest of them stored by a majority, and then returns it; the second part is omitted if the
//! majority agrees. A write asks a majority for their tags, and has its value stored by a majority under a greater one.
//!
//! A register can also be claimed, to read and write it as one step ([`Register::claim`],
//! [`Register::write_claimed`]; the module `claiming`).
//!
//! Without storage, a restarted robot has lost its copies, and its earlier acknowledgements must no longer count. It
//! answers nothing until it has the copies of a majority from the others (the module `recovery`), and answers of its
//! earlier lives are identified by crash vectors (Michael, Ports, Sharma, Szekeres 2017, "Recovering Shared Objects
//! Without Stable Storage"; a nonce alone, as in Viewstamped Replication Revisited, does not do, as they show). With
//! storage, it continues where it was (the module `saving`).
//!
//! Properties, for robots that name the same participants:
//! - linearizability: each operation takes effect at one moment between its call and its end, whatever the network
//!   does. This holds as long as at no time a majority of the participants has forgotten, that is, is down or
//!   recovering without storage, or has lost it. If that happens the remaining robots block rather than forget, unless
//!   no robot that is heard has any state left;
//! - no lost update: a write to a claimed register replaces the value that the claim has read, or is reported as lost,
//!   under the same condition, independent of clocks, locks and suspicions;
//! - progress: an operation ends if a majority is up and can be reached;
//! - failures are visible: otherwise [`Status::NoQuorum`] is returned, and the operation continues to try
//!   until it is done or withdrawn.
//!
//! An operation that was withdrawn, or whose robot has crashed, may still take effect later; an update only until the
//! next one of its register is done.
//!
//! Messages among n participants: 2(n - 1) for a read if all agree, for a claim and for its write; else 4(n - 1). The
//! n - 1 questions are one datagram to all. Copies that missed a write are repaired in the background (the module
//! `gossip`), so that [`Register::known`] eventually shows it.
//!
//! Self-stabilising: whatever copies, tags and lives a corruption leaves behind, once a write is done all later reads
//! of its register return it or a later one.

mod answering;
mod asking;
mod claiming;
mod corrupt;
mod entering;
mod gossip;
mod lives;
mod operating;
mod operation;
mod options;
mod packet;
mod recovery;
mod replica;
mod report;
mod saving;
mod serving;
mod tag;
mod version;

pub use options::Options;
pub use tag::Tag;

use crate::founders::Founders;
use crate::incarnation::Incarnation;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use answering::Said;
use claiming::Claimed;
use entering::Standing;
use gossip::Gossip;
use lives::Lives;
use operation::Operation;
use packet::{Content, Datagram};
use replica::Replica;
use starl_core::{
    Destination, Input, Message, Payload, Port, Primitive, Robot, RobotId, TimerKey, timers,
};
use thiserror::Error;

timers! {
    enum Alarm {
        /// The questions of an operation must be repeated, by its number.
        Operation(u32),
        /// A restarted robot must repeat its recovery questions.
        Enter,
        /// The registers must be announced.
        Gossip,
    }
}

/// Longer names of registers are refused, bytes.
const LONGEST_NAME: usize = 255;

/// The number of results that are kept for the program.
const MOST_RESULTS: usize = 256;

/// Registers, any number by name, that all robots read and write as if there were one of each. See the
/// [module](self).
#[derive(Clone, Debug)]
pub struct Register {
    port: Port,
    options: Options,
    /// The robots that keep copies; none for the whole fleet.
    participants: Option<BTreeSet<RobotId>>,
    incarnation: Incarnation,
    standing: Standing,
    /// Those with which the fleet began, if this robot is one of them.
    founders: Founders,
    /// Crash vector: the latest life of each robot that is known.
    lives: Lives,
    /// Stands for the lives that are on storage; none if none are.
    saved_lives: Option<u64>,
    replica: Replica,
    /// Counts operations.
    last_number: u32,
    operations: BTreeMap<u32, Operation>,
    results: BTreeMap<u32, Status>,
    /// The registers that have been claimed and not been written since.
    claimed: BTreeMap<Box<str>, Claimed>,
    /// The greatest ballot that this robot has used since it started.
    last_ballot: Option<Tag>,
    gossip: Gossip,
    suspects: BTreeSet<RobotId>,
}

/// Names an operation of this robot since it started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OperationId(u32);

/// How far an operation is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// It is under way.
    Pending,
    /// It is pending, but no majority has answered for [`Options::patience`], or too many participants are suspected.
    /// It continues to try: [`Register::withdraw`] ends it.
    NoQuorum,
    /// It has taken effect. The value read, none if nothing was ever written; or the value written.
    Done(Option<Payload>),
    /// It has not taken effect and never will: another robot's claim came before it. Of
    /// [`Register::write_claimed`].
    Lost,
    /// It has ended because the register was claimed. It may take effect or not. Of [`Register::write`]: a
    /// register that is claimed should be written no other way.
    Refused,
    /// It was withdrawn, never begun, or ended so long ago that its result was dropped.
    Unknown,
}

/// Why an operation was not begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum OperationError {
    /// The register's name is longer than 255 bytes.
    #[error("the register's name is too long")]
    NameTooLong,
    /// The value is longer than [`Options::longest_value`].
    #[error("the value is too long for a datagram")]
    ValueTooLong,
    /// [`Options::most_operations`] are under way already.
    #[error("as many operations as there may be are under way")]
    TooMany,
    /// This robot already claims the register, or writes it after a claim.
    #[error("the register is being claimed or written already")]
    UnderWay,
    /// The register was not claimed, or has been written since.
    #[error("the register was not claimed before")]
    NotClaimed,
}

impl Register {
    /// An instance; those of the same name on all robots are one set of registers. `participants` keep the copies: all
    /// of the fleet, if none are given. They must be the same on all robots and must not change; other robots may read
    /// and write too.
    pub fn new(name: &str, participants: Option<BTreeSet<RobotId>>, options: Options) -> Register {
        Register {
            port: Port::named(name),
            options,
            participants,
            incarnation: Incarnation::default(),
            standing: Standing::default(),
            founders: Founders::default(),
            lives: Lives::default(),
            saved_lives: None,
            replica: Replica::default(),
            last_number: 0,
            operations: BTreeMap::new(),
            results: BTreeMap::new(),
            claimed: BTreeMap::new(),
            last_ballot: None,
            gossip: Gossip::default(),
            suspects: BTreeSet::new(),
        }
    }

    /// How far an operation is. The result of one that is done can be looked at again and again, until
    /// many others are done too.
    pub fn status(&self, operation: OperationId) -> Status {
        if let Some(result) = self.results.get(&operation.0) {
            return result.clone();
        }
        match self.operations.get(&operation.0) {
            Some(operation) if operation.is_stuck => Status::NoQuorum,
            Some(_) => Status::Pending,
            None => Status::Unknown,
        }
    }

    /// The value of this robot's own copy, without asking others: a written value, but possibly not the latest; none if
    /// this robot does not know a write.
    pub fn known(&self, register: &str) -> Option<&[u8]> {
        self.replica.get(register)?.value.as_deref()
    }

    /// Whether this robot answers others: it is a participant, and has recovered if it had to.
    pub fn is_up(&self) -> bool {
        matches!(self.standing, Standing::Up(_))
    }

    /// How many operations are under way.
    pub fn pending(&self) -> usize {
        self.operations.len()
    }

    /// Whether a pending operation cannot continue, as far as this robot knows.
    pub fn failed(&self) -> bool {
        self.operations.values().any(|operation| operation.is_stuck)
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// All that keep copies.
    fn members(&self, robot: &Robot<'_>) -> Vec<RobotId> {
        match &self.participants {
            Some(participants) => participants.iter().copied().collect(),
            None => robot.fleet().to_vec(),
        }
    }

    fn is_member(&self, robot: &Robot<'_>, who: RobotId) -> bool {
        match &self.participants {
            Some(participants) => participants.contains(&who),
            None => robot.fleet().binary_search(&who).is_ok(),
        }
    }

    /// The size of a majority.
    fn majority(&self, robot: &Robot<'_>) -> usize {
        let members = self.participants.as_ref().map(BTreeSet::len);
        members.unwrap_or(robot.fleet().len()) / 2 + 1
    }

    fn send(&mut self, robot: &mut Robot<'_>, to: Destination, content: Content) {
        let datagram = Datagram {
            incarnation: self.incarnation.of(robot),
            life: self.standing.life(),
            lives: self.lives.list(),
            content,
        };
        robot.transmit(to, self.port, &datagram);
    }

    /// Sends to these: in one datagram to all if they are most of the fleet, because others ignore it.
    fn send_each(&mut self, robot: &mut Robot<'_>, to: &[RobotId], content: &Content) {
        if 2 * to.len() > robot.peers().count() {
            self.send(robot, Destination::All, content.clone());
        } else {
            for &peer in to {
                self.send(robot, Destination::Robot(peer), content.clone());
            }
        }
    }

    fn timer(&self, alarm: Alarm) -> TimerKey {
        TimerKey::new(self.port, alarm)
    }

    /// Handles a datagram. Unknown datagrams are ignored.
    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        let is_peer = robot.is_peer(from);
        let Some(datagram) = message.read::<Datagram>().filter(|_| is_peer) else {
            return;
        };
        self.learn_lives(robot, from, &datagram);
        if let Standing::New(entering) = &mut self.standing
            && datagram.life > 0
        {
            entering.heard_up = Some(robot.now());
        }
        let is_past = self.is_member(robot, from) && datagram.life < self.lives.of(from);
        match datagram.content {
            Content::Hello { id, life, after } => self.welcome(robot, from, id, life, after),
            Content::Told {
                id,
                life,
                is_up,
                hears_up,
                founders,
            } if self.asks(id) => {
                let standing = (is_up, hears_up);
                self.told(robot, from, datagram.incarnation, life, standing, founders);
            }
            Content::State { id, page } if !is_past && self.asks(id) => {
                self.take_page(robot, from, datagram.life, page);
            }
            Content::Query { .. } | Content::Claim { .. } | Content::Store { .. } => {
                self.serve(robot, from, datagram.content);
            }
            Content::Value {
                id,
                claimed,
                promised,
                version,
            } if !is_past => {
                let shown = Said::Shown {
                    claimed,
                    promised,
                    version,
                };
                self.answered(robot, from, datagram.life, id, shown);
            }
            Content::Stored { id, tag } if !is_past => {
                self.answered(robot, from, datagram.life, id, Said::Stored(tag));
            }
            Content::Refused { id, tag, promised } if !is_past => {
                let refused = Said::Refused { tag, promised };
                self.answered(robot, from, datagram.life, id, refused);
            }
            Content::Announcement(_)
            | Content::Comparison { .. }
            | Content::Entries(_)
            | Content::Wanted(_) => self.gossip(robot, from, datagram.content),
            // Too late.
            Content::Told { .. }
            | Content::State { .. }
            | Content::Value { .. }
            | Content::Stored { .. }
            | Content::Refused { .. } => {}
        }
    }
}

impl Primitive for Register {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => self.recall(robot),
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if key.port == self.port => match key.read() {
                Some(Alarm::Operation(number)) => self.ask_again(robot, number),
                Some(Alarm::Enter) => self.enter_again(robot),
                Some(Alarm::Gossip) => self.announce(robot),
                None => {}
            },
            Input::Suspected(peer) => self.suspect(robot, *peer),
            Input::Trusted(peer) => self.trust(robot, *peer),
            _ => {}
        }
        self.keep_time(robot);
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        self.save_changes(robot);
    }
}
