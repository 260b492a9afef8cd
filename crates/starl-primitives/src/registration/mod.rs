//! Registration: robots of a neighbourhood agree on the participants (thesis, section 3.4.1).
//!
//! A robot registers and leaves at any time. The participants eventually show the same list and the time
//! at which it was computed, (rList, ts); during an agreement they show none. A new list is made when a
//! robot registers, leaves, crashes or restarts.
//!
//! It is the agreement on views of group membership (Birman and Joseph 1987; Ricciardi and Birman 1991;
//! Chockler, Keidar and Vitenberg 2001). One of the participants, the coordinator, proposes a list to all
//! in it. Each accepts unless it has accepted a later one, and from then on shows no earlier list; when all
//! have accepted, the list is shown. Lists have unique names in one order, by their times. If a coordinator
//! falls silent the next one takes over. Two at once do no harm, because the later of their lists prevails
//! (as with the ballots of Lamport's Paxos, 1998).
//!
//! These guarantees hold whatever the network does and whichever robots crash and restart, as long as
//! state is not corrupted:
//! - agreement: lists with the same name are equal. The times of any two lists with a
//!   robot in common, in one life of it, are at least [`Options::settle`] apart (the thesis's d). Lists of
//!   different coordinators never have the same time;
//! - exclusion: two robots that list each other, both still in the life in which they are listed, show the
//!   same list or one of them shows none;
//! - soundness: a robot is in a list only if it was registered when it accepted that list, which is after
//!   the coordinator computed it and before anyone shows it;
//! - order: the times of the lists that a robot shows rise, through all its registrations of one life.
//!
//! These hold if not all datagrams are lost, for robots that are up and reach each other: a registered
//! robot shows a list with itself, and all robots of a neighbourhood show the same one
//! ([`Options::agreement_bound`]). The parts of a partition agree separately, and together again when
//! it is healed. Without a list for [`Options::patience`], [`Registration::failed`] is true, while the
//! robot continues to try.
//!
//! Neighbourhoods. A robot that registers announces itself like a geocast: the announcement goes to all
//! with its area, and each receiver decides by its own position. Two participants belong together if one is
//! in the other's area at one announcement, until one leaves, wherever they go. Membership is transitive,
//! because all must agree.
//!
//! Messages for n robots that register together: 2n + 1, of which n + 2 are datagrams to all; each that
//! comes later to n - 1 others, n + 2; when one of n leaves, n + 1, when one crashes, n. While nothing
//! changes one of them announces the list in each [`Options::longest_interval`].

mod accepting;
mod announcing;
mod corrupt;
mod options;
mod packet;
mod proposing;
mod repairing;
mod roster;
mod stage;
mod ticket;

pub use options::Options;
pub use packet::ViewId;

use crate::incarnation::Incarnation;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use packet::NO_VIEW;
use roster::{Peer, Shunned};
use stage::{Leaving, Own, Stage};
use starl_core::event::RegistrationEvent;
use starl_core::random::hash_key;
use starl_core::{Area, Duration, Input, Port, Primitive, Robot, RobotId, Time, TimerKey, timers};
use ticket::{Past, Ticket};

/// Times beyond this, 146 years, are not valid.
const LATEST: Time = Time(u64::MAX >> 2);

/// Agreement on the participants. See the [module](self).
#[derive(Clone, Debug)]
pub struct Registration {
    port: Port,
    options: Options,
    incarnation: Incarnation,
    /// Counts this life's registrations.
    registrations: u32,
    /// How often others took a registration for over that was not.
    renewals: u32,
    /// The robot's own registration.
    own: Option<Own>,
    /// Its last registration, as long as others may not know that it is over.
    leaving: Option<Leaving>,
    /// Other participants that it knows of.
    peers: BTreeMap<RobotId, Peer>,
    /// The registrations of others that are over for certain.
    past: Past,
    /// Those that did not answer.
    shunned: BTreeMap<RobotId, Shunned>,
    suspects: BTreeSet<RobotId>,
    stage: Stage,
    /// The latest list that it has proposed or accepted: it shows no earlier one.
    promised: ViewId,
    /// The latest time of a list that it has heard of.
    latest: Time,
    /// When something is to be done for the agreement.
    due: Option<Time>,
    /// When it announces itself next.
    announces_at: Time,
    failed: bool,
}

timers! {
    enum Alarm {
        /// A step of the agreement is due.
        Agreement,
        /// The robot must announce itself again.
        Announcement,
        /// There has been no list for long.
        Patience,
    }
}

impl Registration {
    /// An instance (the thesis's Register); those of the same name on all robots agree with each other.
    pub fn new(name: &str, options: Options) -> Registration {
        Registration {
            port: Port::named(name),
            options,
            incarnation: Incarnation::default(),
            registrations: 0,
            renewals: 0,
            own: None,
            leaving: None,
            peers: BTreeMap::new(),
            past: Past::default(),
            shunned: BTreeMap::new(),
            suspects: BTreeSet::new(),
            stage: Stage::Open,
            promised: NO_VIEW,
            latest: Time::ZERO,
            due: None,
            announces_at: Time::ZERO,
            failed: false,
        }
    }

    /// Participates (the thesis's do_register), together with the robots in this area, or with the whole
    /// fleet if there is none. A robot that has registered already stays so, with this area from now on.
    /// An invalid area contains no robot.
    pub fn register(&mut self, robot: &mut Robot<'_>, area: Option<Area>) {
        if let Some(own) = &mut self.own {
            if own.area != area {
                own.area = area;
                own.announcements = 0;
                self.announce(robot);
            }
            return;
        }
        let register = RegistrationEvent::Register {
            apart: self.options.settle,
            area: area.clone().map(Box::new),
        };
        robot.report(self.port, register);
        self.leaving = None;
        self.stage = Stage::Open;
        self.own = Some(Own {
            ticket: self.draw_ticket(robot),
            area,
            gathers_until: robot.now() + self.options.gather,
            announcements: 0,
        });
        self.set(robot, Alarm::Patience, self.options.patience);
        self.announce(robot);
        self.rest(robot);
        self.look_within(robot, self.options.gather);
    }

    /// No longer participates (the thesis's undo_register): the others agree on a new list.
    pub fn unregister(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = self.own.take() else { return };
        robot.report(self.port, RegistrationEvent::Unregister);
        self.stage = Stage::Open;
        self.peers.clear();
        self.shunned.clear();
        self.failed = false;
        for alarm in [Alarm::Announcement, Alarm::Patience] {
            robot.cancel_timer(self.timer(alarm));
        }
        self.rest(robot);
        self.leaving = Some(Leaving {
            ticket: own.ticket,
            repetitions: 0,
        });
        self.say_farewell(robot);
    }

    /// The participants, this robot among them (the thesis's rList); none while they are not agreed on, and
    /// while this robot is not registered.
    pub fn members(&self) -> Option<&BTreeSet<RobotId>> {
        match (&self.own, &self.stage) {
            (Some(_), Stage::Agreed { members, .. }) => Some(members),
            _ => None,
        }
    }

    /// When the list was computed (the thesis's ts), by the clock of the robot that did, or later; the same
    /// for all that show it, and later than that of each earlier list.
    pub fn agreed_at(&self) -> Option<Time> {
        self.view_id().map(|id| id.time)
    }

    /// The name of the list: of two the greater is the later one.
    pub fn view_id(&self) -> Option<ViewId> {
        match (&self.own, &self.stage) {
            (Some(_), Stage::Agreed { view, .. }) => Some(view.id),
            _ => None,
        }
    }

    /// Whether this robot takes part.
    pub fn is_registered(&self) -> bool {
        self.own.is_some()
    }

    /// Whether this robot is registered and has had no list for [`Options::patience`]. It continues to try.
    pub fn failed(&self) -> bool {
        self.failed
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// A ticket that this robot never had.
    fn draw_ticket(&mut self, robot: &mut Robot<'_>) -> Ticket {
        self.registrations = self.registrations.saturating_add(1);
        let incarnation = u64::from(self.incarnation.of(robot));
        Ticket {
            life: hash_key(incarnation, &[u64::from(self.renewals)]) as u32,
            number: self.registrations,
        }
    }

    fn timer(&self, alarm: Alarm) -> TimerKey {
        TimerKey::new(self.port, alarm)
    }

    fn set(&self, robot: &mut Robot<'_>, alarm: Alarm, after: Duration) {
        robot.set_timer(self.timer(alarm), after);
    }

    /// There has been no list for long.
    fn fail(&mut self, robot: &mut Robot<'_>) {
        if self.own.is_some() && self.members().is_none() && !self.failed {
            self.failed = true;
            robot.report(self.port, RegistrationEvent::Fail);
        }
    }

    /// Sees to it that the agreement is looked after no later than this.
    fn look_within(&mut self, robot: &mut Robot<'_>, after: Duration) {
        let at = robot.now() + after;
        if self.due.is_none_or(|due| due > at) {
            self.due = Some(at);
            self.set(robot, Alarm::Agreement, after);
        }
    }

    /// Nothing is to be done for the agreement.
    fn rest(&mut self, robot: &mut Robot<'_>) {
        if self.due.take().is_some() {
            robot.cancel_timer(self.timer(Alarm::Agreement));
        }
    }

    /// Something is to be done for the agreement now.
    fn act(&mut self, robot: &mut Robot<'_>) {
        self.due = None;
        match &self.stage {
            _ if self.own.is_none() => self.say_farewell(robot),
            Stage::Open | Stage::Agreed { .. } => self.look(robot),
            Stage::Proposed { .. } => self.propose_again(robot),
            Stage::Accepted { .. } => self.accept_again(robot),
        }
    }
}

impl Primitive for Registration {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if key.port == self.port => match key.read() {
                Some(Alarm::Agreement) => self.act(robot),
                Some(Alarm::Announcement) => self.announce_again(robot),
                Some(Alarm::Patience) => self.fail(robot),
                None => {}
            },
            Input::Activate => self.set_right(robot),
            Input::Suspected(peer) => {
                self.suspects.insert(*peer);
                self.drop_peer(robot, *peer);
            }
            Input::Trusted(peer) => {
                self.suspects.remove(peer);
            }
            _ => {}
        }
    }
}
