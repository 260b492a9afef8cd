//! The node: the inputs of a robot, and the order in which its software handles them.

use crate::{Clock, Datagram, Observed, Outlet, Snapshot, Timers};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::mem;
use starl_core::event::DropReason;
use starl_core::motion::Path;
use starl_core::{
    Agent, Command, Duration, Effect, Estimate, Event, Input, Message, Program, Random, RobotId,
    Time, View,
};
use starl_motion::Pilot;
use storing::Waiting;

mod driving;
mod storing;

/// Timers are never shorter, so that a moment holds only so many of them.
const SHORTEST_TIMER: Duration = Duration::from_millis(1);

/// The node of one robot. A clone continues exactly as the original would.
#[derive(Clone)]
pub struct Node {
    id: RobotId,
    agent: Agent,
    clock: Clock,
    condition: Condition,
    /// Whether the host was shown that the software is fresh.
    is_observed: bool,
    /// Since when the robot is up, or when it is to start.
    up_since: Time,
    next_activation: Time,
    timers: Timers,
    estimate: Estimate,
    command: Command,
    pilot: Option<Box<Pilot>>,
    /// Plans that are being made: the node's number of each, and the program's.
    plans: Vec<(u32, u32)>,
    next_job: u32,
    /// Counts datagrams.
    sequence: u32,
    /// The effects that wait for storage; none if there are none.
    waiting: Option<Box<Waiting>>,
    /// Counts writes to storage.
    writes: u32,
}

/// Whether a robot's software runs, and how far it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Condition {
    /// It has been started in its present life.
    pub started: bool,
    /// It has crashed and has not restarted since.
    pub down: bool,
    /// Its program has reached its goal. It still answers.
    pub finished: bool,
    /// Its program cannot continue, and is not called any more.
    pub failed: bool,
}

impl Condition {
    /// Whether the robot is up and its program has reached its goal.
    pub fn has_finished(&self) -> bool {
        !self.down && self.finished && !self.failed
    }
}

/// An input of a node.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeInput {
    /// The robot's software starts. Due once in each life, at [`Node::next_timeout`].
    Start,
    /// The estimate given by [`Node::locate`] is new.
    Located,
    /// A datagram arrives.
    Datagram {
        /// The sender's number for it.
        sequence: u32,
        /// Sender, endpoint and content.
        message: Message,
    },
    /// A [`crate::PlanJob`] is done.
    Planned {
        /// Which one. A job of an earlier life is ignored.
        job: u32,
        /// Waypoints from the robot to the target; none where no path was found.
        path: Option<Path>,
    },
    /// A [`crate::StoreJob`] is done: what it was to write is on storage permanently.
    Stored {
        /// Which one. A job of an earlier life is ignored.
        job: u32,
    },
    /// The time returned by [`Node::next_timeout`] has been reached.
    Timeout,
    /// An input that the host chooses itself, for hosts that try out orders: a timer fires early, the
    /// program is activated, a robot is suspected.
    Input(Input),
}

impl Node {
    /// A node whose robot is up and starts at `at`.
    pub fn new(id: RobotId, clock: Clock, agent: Agent, at: Time) -> Node {
        Node {
            id,
            agent,
            clock,
            condition: Condition::default(),
            is_observed: false,
            up_since: at,
            next_activation: at,
            timers: Timers::default(),
            estimate: Estimate::default(),
            command: Command::Stop,
            pilot: None,
            plans: Vec::new(),
            next_job: 0,
            sequence: 0,
            waiting: None,
            writes: 0,
        }
    }

    /// The same node with datagrams numbered from `sequence` on, so that a restarted process does not reuse the numbers
    /// of the one before.
    pub fn with_sequence(self, sequence: u32) -> Node {
        Node { sequence, ..self }
    }

    /// The robot's number.
    #[inline]
    pub fn id(&self) -> RobotId {
        self.id
    }

    /// The robot's clock.
    #[inline]
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// Sets the robot's clock: a restart may set a clock without a battery back to 0. The due times of armed timers do
    /// not change.
    pub fn set_clock(&mut self, clock: Clock) {
        self.clock = clock;
    }

    /// Whether the robot's software runs.
    #[inline]
    pub fn condition(&self) -> Condition {
        self.condition
    }

    /// Whether the robot is up and its program can continue.
    #[inline]
    pub fn runs(&self) -> bool {
        !self.condition.down && !self.condition.failed
    }

    /// The program; of a robot that is down as it was at the crash.
    pub fn program(&self) -> &dyn Program {
        self.agent.program()
    }

    /// The robot's software.
    pub fn agent(&self) -> &Agent {
        &self.agent
    }

    /// The latest estimate, in the robot's own time.
    #[inline]
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// The command for the robot's model until the next call.
    #[inline]
    pub fn command(&self) -> Command {
        self.command
    }

    /// The armed timers.
    #[inline]
    pub fn timers(&self) -> &Timers {
        &self.timers
    }

    /// When the node wants to be called next: with [`NodeInput::Start`] if it has not started in this life,
    /// else with [`NodeInput::Timeout`]. [`Time::NEVER`] if the robot is down or its program has failed.
    #[inline]
    pub fn next_timeout(&self) -> Time {
        if !self.runs() {
            Time::NEVER
        } else if self.condition.started {
            self.timers.next().min(self.next_activation)
        } else {
            self.up_since
        }
    }

    /// When the program is activated next; [`Time::NEVER`] if it does not run.
    #[inline]
    pub fn next_activation(&self) -> Time {
        if self.runs() {
            self.next_activation
        } else {
            Time::NEVER
        }
    }

    /// The robot crashes: it forgets everything except its number, its clock and how many datagrams it has sent.
    pub fn crash(&mut self) {
        self.condition = Condition {
            down: true,
            ..Condition::default()
        };
        self.pilot = None;
        self.command = Command::Stop;
        self.timers.clear();
        self.plans.clear();
        self.waiting = None;
    }

    /// Restarts a robot that is down, with fresh software that starts at `at`.
    pub fn restart(&mut self, at: Time, agent: Agent) {
        self.crash();
        self.agent = agent;
        self.is_observed = false;
        self.condition.down = false;
        self.up_since = at;
        self.next_activation = at;
    }

    /// Overwrites the program's state at random: see [`Program::corrupt`].
    pub fn corrupt(&mut self, at: Time, random: &mut Random, outlet: &mut impl Outlet) {
        // The state of a robot that is down is lost already.
        if !self.condition.down {
            self.show_fresh(at, outlet);
            outlet.observe(at, Observed::Corrupted { random });
        }
        self.agent.corrupt(random);
    }

    /// Shows the host fresh software before anything is done to it.
    fn show_fresh(&mut self, at: Time, outlet: &mut impl Outlet) {
        if !mem::replace(&mut self.is_observed, true) {
            let (random, saved) = (self.agent.random(), self.agent.saved());
            outlet.observe(at, Observed::Started { random, saved });
        }
    }

    /// Sets the robot's position estimate, with the time of the robot's own clock. The software receives it by
    /// [`NodeInput::Located`] or [`NodeInput::Start`].
    #[inline]
    pub fn locate(&mut self, at: Time, estimate: Estimate, outlet: &mut impl Outlet) {
        self.estimate = Estimate {
            at: self.clock.read(at),
            ..estimate
        };
        outlet.record(at, Event::Estimated(estimate.pose));
    }

    /// Passes an input at `at` to the robot's software. Calls must be in the order of their times. At one time the
    /// order is: start, plans, locations, completed writes, datagrams, timers, activation.
    #[inline(always)]
    pub fn handle(
        &mut self,
        at: Time,
        happening: NodeInput,
        snapshot: &Snapshot<'_>,
        outlet: &mut impl Outlet,
    ) {
        match happening {
            NodeInput::Start => {
                if !self.condition.started && !self.condition.down {
                    self.condition.started = true;
                    self.show_fresh(at, outlet);
                    self.feed(at, &Input::Start, snapshot, outlet);
                }
            }
            NodeInput::Located => {
                self.feed(at, &Input::Estimate, snapshot, outlet);
                if self.pilot.is_some() {
                    self.steer(at, snapshot, outlet);
                    if self.is_overpowered(snapshot) {
                        self.feed(at, &Input::Overpowered, snapshot, outlet);
                    }
                }
            }
            NodeInput::Datagram { sequence, message } => {
                self.receive(at, sequence, message, snapshot, outlet);
            }
            NodeInput::Planned { job, path } => {
                if let Some(place) = self.plans.iter().position(|plan| plan.0 == job) {
                    let (_, ticket) = self.plans.remove(place);
                    self.feed(at, &Input::Planned { ticket, path }, snapshot, outlet);
                }
            }
            NodeInput::Stored { job } => self.stored(at, job, snapshot, outlet),
            NodeInput::Timeout => self.time_out(at, snapshot, outlet),
            NodeInput::Input(input) => {
                if let Input::Timer(key) = input {
                    self.timers.cancel(key);
                }
                self.feed(at, &input, snapshot, outlet);
            }
        }
    }

    /// The timer that is due, or else the activation.
    fn time_out(&mut self, at: Time, snapshot: &Snapshot<'_>, outlet: &mut impl Outlet) {
        let timer = self.timers.next();
        if timer <= at && timer <= self.next_activation {
            if let Some(key) = self.timers.take() {
                self.feed(at, &Input::Timer(key), snapshot, outlet);
            }
        } else if self.next_activation <= at {
            let period = snapshot.hardware.control_period;
            if period.is_zero() {
                self.next_activation = Time::NEVER;
                return;
            }
            // Activations that a host is late for by more than a period are left out.
            let next = self.next_activation + period;
            self.next_activation = if next > at { next } else { at + period };
            self.feed(at, &Input::Activate, snapshot, outlet);
        }
    }

    /// A datagram that comes before the robot is up is lost.
    fn receive(
        &mut self,
        at: Time,
        sequence: u32,
        message: Message,
        snapshot: &Snapshot<'_>,
        outlet: &mut impl Outlet,
    ) {
        let from = message.from;
        if self.condition.down || !self.condition.started || at < self.up_since {
            let event = Event::Dropped {
                from,
                to: Some(self.id),
                sequence,
                reason: DropReason::Down,
            };
            return outlet.record(at, event);
        }
        outlet.record(at, Event::Delivered { from, sequence });
        self.feed(at, &Input::Message(message), snapshot, outlet);
    }

    /// Hands an input to the robot's software and carries out what it asks for.
    fn feed(&mut self, at: Time, input: &Input, snapshot: &Snapshot<'_>, outlet: &mut impl Outlet) {
        if !self.runs() || !self.condition.started {
            return;
        }
        let view = View {
            id: self.id,
            now: self.clock.read(at),
            estimate: self.estimate,
            body: snapshot.hardware.body,
            sensors: snapshot.sensors,
            fleet: snapshot.fleet,
            way_points: snapshot.way_points,
            obstacles: snapshot.obstacles,
        };
        let effects = &mut outlet.workspace().effects;
        self.agent.handle(input, &view, effects);
        // Most inputs ask for nothing, so that no list is moved for them.
        let mut list = match effects.list.is_empty() {
            true => Vec::new(),
            false => mem::take(&mut effects.list),
        };
        let observed = Observed::Input {
            input,
            view: &view,
            effects: &list,
        };
        outlet.observe(at, observed);
        if list.is_empty() {
            return;
        }
        if self.agent.saved().is_some() {
            self.commit(at, &mut list, outlet);
        }
        for effect in list.drain(..) {
            self.carry_out(at, effect, snapshot, outlet);
        }
        outlet.workspace().effects.list = list;
    }

    fn carry_out(
        &mut self,
        at: Time,
        effect: Effect,
        snapshot: &Snapshot<'_>,
        outlet: &mut impl Outlet,
    ) {
        match effect {
            Effect::Transmit {
                destination,
                port,
                payload,
            } => {
                let sequence = self.sequence;
                self.sequence = sequence.wrapping_add(1);
                let event = Event::Sent {
                    sequence,
                    destination,
                    port,
                    payload: payload.clone(),
                };
                outlet.record(at, event);
                let message = Message {
                    from: self.id,
                    port,
                    payload,
                };
                let datagram = Datagram {
                    sequence,
                    destination,
                    message,
                };
                outlet.transmit(at, datagram);
            }
            Effect::SetTimer { key, after } => {
                let after = self.clock.real(after).max(SHORTEST_TIMER);
                self.timers.set(at + after, key);
            }
            Effect::CancelTimer(key) => self.timers.cancel(key),
            Effect::Move(request) => self.request_motion(at, request, snapshot, outlet),
            Effect::Record(event) => outlet.record(at, event),
            // Storage was asked already, or there is none.
            Effect::Save(_) => {}
            Effect::Take(thing) => outlet.take(at, thing),
            Effect::PutDown => outlet.put_down(at),
            Effect::Finish => {
                if !mem::replace(&mut self.condition.finished, true) {
                    outlet.record(at, Event::Finished);
                }
            }
            Effect::Fail(reason) => {
                self.condition.failed = true;
                self.pilot = None;
                self.command = Command::Stop;
                outlet.record(at, Event::Failed(reason));
            }
        }
    }
}
