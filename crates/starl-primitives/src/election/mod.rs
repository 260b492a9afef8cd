//! Election of a leader among participants (thesis, section 3.4.2).
//!
//! A robot that calls [`LeaderElection::elect`] is a candidate from then on. [`LeaderElection::leader`] returns the
//! leader: none during an election. A leader that fails or resigns is replaced automatically. The option [`Algorithm`]
//! selects the algorithm:
//!
//! - `Leases` (default, `leases/`): by votes of a majority of the participants, for an epoch and for the time of
//!   a lease. Each epoch has one leader whatever the network does and whichever robots crash and restart. Epochs
//!   grow, so they serve as fencing numbers. Two robots never lead at the same time if clocks keep to the
//!   allowed drift. A robot that is disconnected from a majority shows no leader.
//! - `Ballots` (`ballots.rs`): each draws a number, the greatest wins, as in the thesis. In each part of a partitioned
//!   network there is a leader.
//! - `Bully` (`bully.rs`): the greatest robot wins as well.
//!
//! Connected robots show the same leader within a time that the reference gives. The leader is a
//! participant that has called `elect`. An election that takes too long has
//! [failed](LeaderElection::failed), and continues.
//!
//! Self-stabilising: impossible values are repaired at the next activation, and the rest is overwritten by the leaders'
//! repeated announcements.

mod ballots;
mod bully;
mod epoch;
mod leases;
mod options;
mod packet;
mod rules;
mod running;

pub use options::{Algorithm, Options};

use alloc::boxed::Box;
use alloc::collections::{BTreeSet, VecDeque};
use alloc::vec::Vec;
use ballots::Ballots;
use bully::Bully;
use leases::Leases;
use packet::Packet;
use rules::{Leadership, Rules};
use starl_core::event::ElectionEvent;
use starl_core::{Input, Port, Primitive, Random, Robot, RobotId, Time};

/// The latest changes are kept up to this number.
const MOST_CHANGES: usize = 16;

/// Elects a leader. See the [module](self).
#[derive(Clone, Debug)]
pub struct LeaderElection {
    port: Port,
    options: Options,
    /// None for all of the fleet.
    participants: Option<BTreeSet<RobotId>>,
    rules: Algorithms,
    has_begun: bool,
    /// Whether this robot has called for an election and not resigned.
    called: bool,
    /// Since when it has been without a leader.
    leaderless: Option<Time>,
    failed: bool,
    shown: Option<Leadership>,
    changes: VecDeque<Change>,
    suspects: BTreeSet<RobotId>,
    /// The participants but this robot, and the size of the fleet that they are from.
    others: Vec<RobotId>,
    fleet_size: usize,
    takes_part: bool,
    /// When the timer fires.
    armed: Option<Time>,
}

/// A change of the leader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// This robot leads from now on; or it did before, and does in a later epoch.
    Elected(RobotId),
    /// This robot was the leader, and there is none any more.
    Lost(RobotId),
}

#[derive(Clone, Debug)]
enum Algorithms {
    Ballots(Ballots),
    Bully(Bully),
    Leases(Box<Leases>),
}

impl Algorithms {
    fn rules(&self) -> &dyn Rules {
        match self {
            Algorithms::Ballots(rules) => rules,
            Algorithms::Bully(rules) => rules,
            Algorithms::Leases(rules) => &**rules,
        }
    }

    fn rules_mut(&mut self) -> &mut dyn Rules {
        match self {
            Algorithms::Ballots(rules) => rules,
            Algorithms::Bully(rules) => rules,
            Algorithms::Leases(rules) => &mut **rules,
        }
    }
}

impl LeaderElection {
    /// An instance; those of the same name on all robots elect together. `participants` vote and may
    /// be elected: all of the fleet, if none are given. All robots must be given the same.
    pub fn new(
        name: &str,
        participants: Option<BTreeSet<RobotId>>,
        options: Options,
    ) -> LeaderElection {
        LeaderElection {
            port: Port::named(name),
            participants,
            rules: match options.algorithm {
                Algorithm::Ballots => Algorithms::Ballots(Ballots::default()),
                Algorithm::Bully => Algorithms::Bully(Bully::default()),
                Algorithm::Leases => Algorithms::Leases(Box::default()),
            },
            options,
            has_begun: false,
            called: false,
            leaderless: None,
            failed: false,
            shown: None,
            changes: VecDeque::new(),
            suspects: BTreeSet::new(),
            others: Vec::new(),
            fleet_size: 0,
            takes_part: false,
            armed: None,
        }
    }

    /// Makes the robot a candidate (the thesis's do_election), until [`LeaderElection::resign`]. With Ballots and Bully
    /// this starts an election if there is none; with Leases an existing leader stays.
    pub fn elect(&mut self, robot: &mut Robot<'_>) {
        self.begin(robot);
        self.called = true;
        robot.report(self.port, ElectionEvent::Elect);
        if self.takes_part {
            self.run(robot, |rules, scene| rules.elect(scene));
        }
        self.settle(robot);
    }

    /// No longer stands. If this robot leads, it announces that it no longer does, and the others elect
    /// again.
    pub fn resign(&mut self, robot: &mut Robot<'_>) {
        self.begin(robot);
        if self.called {
            self.called = false;
            robot.report(self.port, ElectionEvent::Resign);
            self.run(robot, |rules, scene| rules.resign(scene));
        }
        self.settle(robot);
    }

    /// The leader known to this robot; none during an election.
    pub fn leader(&self) -> Option<RobotId> {
        Some(self.shown?.leader)
    }

    /// The epoch of that leader: greater than those of all leaders before. None without a leader, and with
    /// algorithms that have no epochs.
    pub fn epoch(&self) -> Option<u64> {
        self.shown?.epoch
    }

    /// Whether this robot is a candidate but has had no leader for [`Options::give_up`], or is not a participant. The
    /// election continues nevertheless, and the flag becomes false when there is a leader.
    pub fn failed(&self) -> bool {
        self.failed
    }

    /// Whether this robot is a candidate.
    pub fn stands(&self) -> bool {
        self.called && self.takes_part
    }

    /// The changes of the leader since the last call, the latest 16.
    pub fn take_changes(&mut self) -> impl Iterator<Item = Change> + use<> {
        core::mem::take(&mut self.changes).into_iter()
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        self.rules.rules_mut().corrupt(random);
        self.suspects.retain(|_| random.chance(0.5));
        self.leaderless = random.chance(0.5).then(|| Time(random.bits().into()));
    }
}

impl Primitive for LeaderElection {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Estimate | Input::Planned { .. } => return,
            Input::Timer(key) if *key == self.timer() => self.armed = None,
            _ => {}
        }
        self.begin(robot);
        if *input == Input::Start {
            self.run(robot, |rules, scene| rules.recall(scene));
        }
        // Expired state must not be taken for valid.
        self.run(robot, |rules, scene| rules.settle(scene));
        match input {
            Input::Message(message) if message.port == self.port => {
                if let Some(packet) = message.read::<Packet>()
                    && self.others.contains(&message.from)
                {
                    self.run(robot, |rules, scene| {
                        rules.receive(scene, message.from, packet);
                    });
                }
            }
            Input::Suspected(peer) if self.others.contains(peer) => {
                self.suspects.insert(*peer);
                self.run(robot, |rules, scene| rules.suspect(scene, *peer));
            }
            Input::Trusted(peer) => {
                self.suspects.remove(peer);
            }
            _ => {}
        }
        self.settle(robot);
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        self.rules.rules_mut().save(robot, self.port);
    }
}
