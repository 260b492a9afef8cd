//! One robot in an exploration: its software, timers and clock, and what an input makes of it.
//!
//! Invariant: [`Local::write`] writes all that the future of the robot depends on, so that two robots
//! of one number that write the same answer every input alike.

use crate::bounds::Clocks;
use crate::model::Model;
use crate::step::Datagram;
use crate::texts::fingerprint;
use starl_core::effect::Effects;
use starl_core::event::Fault;
use starl_core::random::hash_key;
use starl_core::{
    Agent, Destination, Duration, Effect, Estimate, Event, Input, Message, Port, Random, RobotId,
    Sensors, Time, TimerKey, View,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// A robot's state.
#[derive(Clone)]
pub(crate) struct Local {
    pub robot: RobotId,
    /// None while it is down.
    pub agent: Option<Agent>,
    /// Armed timers, with the tick at which they are due.
    pub timers: BTreeMap<TimerKey, u64>,
    /// Ticks of its clock.
    pub clock: u64,
    /// Counts its starts.
    life: u64,
    pub finished: bool,
    pub failed: bool,
    /// What has happened to it in this life, where its program does not write its state.
    history: u128,
}

/// Something that happens to one robot.
#[derive(Clone, Debug)]
pub(crate) enum Happening {
    Activate,
    Timer(TimerKey),
    Message(Message),
    Tick,
    Crash,
    Restart,
    Suspect(RobotId),
    Trust(RobotId),
}

/// What comes of it.
pub(crate) struct Turn {
    pub local: Local,
    pub sent: Vec<Datagram>,
    pub events: Vec<Event>,
    /// How often it asked to move, which nobody does here.
    pub motions: u64,
}

/// What a robot's turn depends on besides its own state.
#[derive(Clone)]
pub(crate) struct Surroundings {
    pub model: Model,
    pub fleet: Vec<RobotId>,
    pub clocks: Clocks,
}

impl Surroundings {
    pub fn new(model: Model, clocks: Clocks) -> Surroundings {
        let fleet = model.fleet();
        Surroundings {
            model,
            fleet,
            clocks,
        }
    }

    fn tick(&self) -> Duration {
        match self.clocks {
            Clocks::Still => Duration::ZERO,
            Clocks::Ticking { tick, .. } => tick,
        }
    }

    /// The time at which a clock has ticked so often.
    pub fn time(&self, ticks: u64) -> Time {
        Time::ZERO + self.tick() * ticks
    }

    /// When a timer that is armed now is due: at a later tick, if clocks tick.
    fn due(&self, now: u64, after: Duration) -> u64 {
        match self.tick().0 {
            0 => 0,
            tick => now.saturating_add(after.0.div_ceil(tick).max(1)),
        }
    }
}

impl Local {
    /// A robot that starts for the first time.
    pub fn start(robot: RobotId, surroundings: &Surroundings) -> Turn {
        let local = Local {
            robot,
            agent: None,
            timers: BTreeMap::new(),
            clock: 0,
            life: 0,
            finished: false,
            failed: false,
            history: 0,
        };
        local.turn(&Happening::Restart, surroundings)
    }

    /// What becomes of it when something happens.
    pub fn turn(&self, happening: &Happening, surroundings: &Surroundings) -> Turn {
        let mut turn = Turn {
            local: self.clone(),
            sent: Vec::new(),
            events: Vec::new(),
            motions: 0,
        };
        match happening {
            Happening::Activate => turn.feed(&Input::Activate, surroundings),
            Happening::Timer(key) => {
                turn.local.timers.remove(key);
                turn.feed(&Input::Timer(*key), surroundings);
            }
            Happening::Message(message) => {
                turn.feed(&Input::Message(message.clone()), surroundings);
            }
            Happening::Suspect(peer) => turn.feed(&Input::Suspected(*peer), surroundings),
            Happening::Trust(peer) => turn.feed(&Input::Trusted(*peer), surroundings),
            Happening::Tick => turn.local.clock += 1,
            Happening::Crash => turn.crash(),
            Happening::Restart => turn.start(surroundings),
        }
        turn
    }

    /// Whether it is up and its program can go on.
    pub fn runs(&self) -> bool {
        self.agent.is_some() && !self.failed
    }

    /// Whether a timer is due that has to fire before the clock goes on.
    pub fn is_due(&self, silent: &BTreeSet<Port>) -> bool {
        let mut heard = self
            .timers
            .iter()
            .filter(|(key, _)| !silent.contains(&key.port));
        self.runs() && heard.any(|(_, &due)| due <= self.clock)
    }

    /// Writes all that its future depends on.
    pub fn write(&self, text: &mut String) {
        let Local {
            robot,
            agent,
            timers,
            clock,
            life,
            finished,
            failed,
            history,
        } = self;
        // Writing to a text cannot fail.
        let _ = write!(
            text,
            "{robot} {clock} {life} {finished} {failed} {timers:?} "
        );
        match agent {
            None => text.push_str("down"),
            Some(agent) => {
                if !agent.write_state(text) {
                    let _ = write!(text, "{history:x}");
                }
            }
        }
    }
}

impl Turn {
    fn start(&mut self, surroundings: &Surroundings) {
        let model = &surroundings.model;
        let local = &mut self.local;
        let Some(member) = model.members.get(local.robot.index()) else {
            return;
        };
        if local.life > 0 {
            self.events.push(Event::Fault(Fault::Restart));
        }
        let random = Random::keyed(model.seed, &[u64::from(local.robot.0), local.life]);
        local.agent = Some(Agent::new(member.program.clone(), random));
        local.life += 1;
        local.history = u128::from(hash_key(local.life, &[local.clock]));
        self.feed(&Input::Start, surroundings);
        self.feed(&Input::Estimate, surroundings);
    }

    fn crash(&mut self) {
        let Local {
            robot, clock, life, ..
        } = self.local;
        self.local = Local {
            robot,
            agent: None,
            timers: BTreeMap::new(),
            clock,
            life,
            finished: false,
            failed: false,
            history: 0,
        };
        self.events.push(Event::Fault(Fault::Crash));
    }

    /// Hands an input to the robot's software and carries out what it asks for.
    fn feed(&mut self, input: &Input, surroundings: &Surroundings) {
        let Local {
            robot,
            agent: Some(agent),
            failed: false,
            clock,
            history,
            ..
        } = &mut self.local
        else {
            return;
        };
        let model = &surroundings.model;
        let Some(member) = model.members.get(robot.index()) else {
            return;
        };
        let now = surroundings.time(*clock);
        let view = View {
            id: *robot,
            now,
            estimate: Estimate {
                at: now,
                pose: member.pose,
                ..Estimate::default()
            },
            body: member.body,
            sensors: Sensors::default(),
            fleet: &surroundings.fleet,
            way_points: &model.way_points,
            obstacles: &model.obstacles,
        };
        *history = fingerprint(&format!("{history:x} {clock} {input:?}"));
        let mut effects = Effects::default();
        agent.handle(input, &view, &mut effects);
        for effect in effects.list {
            self.carry_out(effect, surroundings);
        }
    }

    fn carry_out(&mut self, effect: Effect, surroundings: &Surroundings) {
        match effect {
            Effect::Transmit {
                destination,
                port,
                payload,
            } => {
                let from = self.local.robot;
                let is_meant = |to: &RobotId| match destination {
                    Destination::All => *to != from,
                    Destination::Robot(robot) => *to == robot,
                };
                let receivers = surroundings.fleet.iter().copied().filter(is_meant);
                self.sent.extend(receivers.map(|to| Datagram {
                    from,
                    to,
                    port,
                    payload: payload.to_vec(),
                }));
            }
            Effect::SetTimer { key, after } => {
                let due = surroundings.due(self.local.clock, after);
                self.local.timers.insert(key, due);
            }
            Effect::CancelTimer(key) => {
                self.local.timers.remove(&key);
            }
            Effect::Move(_) => self.motions += 1,
            Effect::Record(event) => self.events.push(event),
            Effect::Finish => {
                if !std::mem::replace(&mut self.local.finished, true) {
                    self.events.push(Event::Finished);
                }
            }
            Effect::Fail(reason) => {
                self.local.failed = true;
                self.events.push(Event::Failed(reason));
            }
        }
    }
}
