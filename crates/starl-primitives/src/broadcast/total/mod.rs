//! Total order: all robots deliver the same messages in the same order, by a log on which a majority agrees.
//!
//! Within a group this is Raft (Ongaro and Ousterhout 2014), a relative of Viewstamped Replication (Liskov
//! and Cowling 2012). A leader adds messages to a log. An entry that a majority of the fleet has is
//! decided, and each robot delivers the decided entries in the order of the log.
//!
//! Where ours differs: a robot that stops keeps no state. A robot that restarts is a different voter without state. The
//! leader sends it the necessary state, and removes its earlier life from the list of voters. So no robot votes twice
//! or forgets its acknowledgements, which is the error of replicas that return under their old names (Michael et al.
//! 2017). The list is an entry of the log itself, and also defines the lives that may add messages to the log: see
//! [`roll`]. If so many stop at once that the rest can decide nothing more, the group is dead; its members find this
//! out by asking. Then a majority of the fleet founds the next group, with an empty log.
//!
//! Properties, whatever the network does and whichever robots crash and restart:
//! - order: no two robots deliver two messages in different orders. Logs only grow at their decided end, a message is
//!   proposed in one group only, and robots change only to later groups;
//! - no gaps: a robot delivers every message between two that it delivers, unless it reports a gap: because it was away
//!   for longer than the log is kept, or because a group died.
//!
//! If a majority of the fleet is up and connected, and not all datagrams are lost:
//! - progress: a broadcast of a robot in that majority is delivered by all of it, including the sender.
//!
//! A robot without a majority delivers nothing, and reports it: [`Total::failed`].

mod early;
mod election;
mod feeding;
mod followers;
mod following;
mod founding;
mod hearing;
mod leading;
mod life;
mod log;
mod member;
mod membership;
mod packet;
mod proposing;
mod relaying;
mod roll;
mod snapshots;

use super::{Gap, Gaps};
use crate::Failure;
use crate::incarnation::Incarnation;
use crate::reliable::{MessageId, Options};
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use founding::Idle;
use member::{Member, Role};
use packet::{Body, Generation, Said};
use proposing::Proposal;
use relaying::Detour;
use starl_core::event::BroadcastEvent;
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Duration, Input, Port, Random, Robot, TimerKey, timers};

/// A log of this number of bytes is long: it is no longer kept for absent robots. In addition, it may
/// contain as many undecided bytes.
const MOST_BYTES: usize = 1 << 21;

/// Datagrams are not much longer than this, bytes, unless one message is.
const CHUNK: usize = 1000;

/// The greatest number of bytes that are sent to one robot, or by one to the leader, before it has answered.
const WINDOW: usize = 16 * CHUNK;

/// Robots cannot have counted this far ahead.
const FURTHEST: u32 = 1 << 20;

/// After this many ticks without a leader a robot says that it has failed.
const SILENCE: u32 = 12;

timers! {
    enum Alarm {
        /// A tick has passed.
        Tick,
    }
}

/// One end of a totally ordered broadcast.
#[derive(Clone, Debug)]
pub(super) struct Total {
    pub port: Port,
    options: Options,
    incarnation: Incarnation,
    /// Names this start of the robot.
    start: Option<u64>,
    /// Counts this robot's lives, beyond its starts.
    lives: u32,
    /// The greatest counter of a group that was heard of.
    highest: u32,
    member: Option<Member>,
    idle: Idle,
    /// Counts how often this robot asked to lead.
    ask_number: u32,
    /// The last message that was delivered.
    position: Option<(Generation, u64)>,
    /// The number of this robot's last message.
    last: u32,
    proposals: VecDeque<Proposal>,
    /// The last of those that were sent to the present leader.
    sent: u32,
    /// Ticks since the first of those was sent, or one had its place; and after how many they are sent again.
    waited: u32,
    retry: u32,
    /// Datagrams with entries that the leader has sent to all since then.
    passed: u32,
    failures: VecDeque<Failure>,
    gaps: Gaps,
    detour: Option<Detour>,
    /// Ticks without a leader.
    silence: u32,
    is_ticking: bool,
}

/// After how many ticks without a leader a robot asks to lead.
fn patience(robot: &mut Robot<'_>) -> u32 {
    let spread = robot.fleet().len() as u32 / 4;
    8 + robot.random().below(8 + spread)
}

impl Total {
    pub fn new(port: Port, options: Options) -> Total {
        Total {
            port,
            options,
            incarnation: Incarnation::default(),
            start: None,
            lives: 0,
            highest: 0,
            member: None,
            idle: Idle::default(),
            ask_number: 0,
            position: None,
            last: 0,
            proposals: VecDeque::new(),
            sent: 0,
            waited: 0,
            retry: 0,
            passed: 0,
            failures: VecDeque::new(),
            gaps: Gaps::default(),
            detour: None,
            silence: 0,
            is_ticking: false,
        }
    }

    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The name of the next message.
    pub fn next(&mut self, robot: &mut Robot<'_>) -> MessageId {
        MessageId {
            incarnation: self.incarnation.of(robot),
            to: None,
            number: self.last.wrapping_add(1),
        }
    }

    /// Whether the message has no place yet and was not given up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        let mut all = self.proposals.iter();
        Some(message.incarnation) == self.incarnation.known()
            && all.any(|proposal| proposal.number == message.number)
    }

    /// How many messages have no place yet and were not given up.
    pub fn backlog(&self) -> usize {
        self.proposals.len()
    }

    /// Whether no leader with a majority has been heard for a while.
    pub fn failed(&self) -> bool {
        self.silence >= SILENCE
    }

    pub fn take_failures(&mut self) -> Vec<Failure> {
        core::mem::take(&mut self.failures).into()
    }

    pub fn take_gaps(&mut self) -> Vec<Gap> {
        self.gaps.take()
    }

    pub fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => self.arm(robot),
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if *key == self.timer() => self.tick_over(robot),
            _ => {}
        }
    }

    fn tick_over(&mut self, robot: &mut Robot<'_>) {
        self.is_ticking = false;
        self.silence = self.silence.saturating_add(1);
        if self.silence == SILENCE {
            robot.report(self.port, BroadcastEvent::Unavailable);
        }
        if self
            .member
            .as_ref()
            .is_some_and(|member| !member.is_sound())
        {
            self.leave(robot, LeaveReason::Corrupt);
        }
        match &mut self.member {
            None => self.wait_for_group(robot),
            Some(member) => {
                member.silence = member.silence.saturating_add(1);
                if member.is_leading() {
                    self.beat(robot);
                } else if member.silence >= member.patience {
                    self.ask(robot, true);
                } else if member.silence % 2 == 0 {
                    self.send_ask(robot);
                }
            }
        }
        self.propose_again(robot);
        self.end_detour();
        self.note_contact(robot);
        self.arm(robot);
    }

    /// Records a leader with a majority.
    fn note_contact(&mut self, robot: &mut Robot<'_>) {
        let is_led = self
            .member
            .as_ref()
            .is_some_and(|member| member.leader.is_some() && member.silence == 0);
        if is_led {
            if self.silence >= SILENCE {
                robot.report(self.port, BroadcastEvent::Available);
            }
            self.silence = 0;
        }
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        if let Some(member) = &mut self.member {
            if random.chance(0.5) {
                member.term = random.bits() >> random.below(32);
            }
            if random.chance(0.5) {
                member.silence = random.bits() >> random.below(32);
            }
            if random.chance(0.5) {
                let last = member.log.last() as u32;
                member.log.truncate(u64::from(random.below(last.max(1))));
            }
            if random.chance(0.5) {
                member.commit = u64::from(random.bits() >> random.below(32));
            }
            member.vote = None;
            member.gone.clear();
        }
        self.silence = random.bits() >> random.below(32);
        self.ask_number = random.bits();
    }

    /// A datagram of this robot with this content.
    fn said(&mut self, robot: &mut Robot<'_>, body: Body) -> Said {
        Said {
            life: self.life(robot).name,
            generation: self.member.as_ref().map(|member| member.generation),
            body,
        }
    }

    fn say(&mut self, robot: &mut Robot<'_>, to: Destination, body: Body) {
        let said = self.said(robot, body);
        robot.transmit(to, self.port, &said);
        self.relay(robot, to, said);
    }

    fn tick(&self) -> Duration {
        self.options.first_timeout.max(Duration::from_millis(1))
    }

    /// Sees to it that the next tick comes.
    fn arm(&mut self, robot: &mut Robot<'_>) {
        let _ = self.incarnation.of(robot);
        if !self.is_ticking {
            self.is_ticking = true;
            robot.set_timer(self.timer(), self.tick());
        }
    }

    fn timer(&self) -> TimerKey {
        TimerKey::new(self.port, Alarm::Tick)
    }
}
