//! Follows one path through the states, step by step, and reports all events on it.
//!
//! It runs the robots themselves, not their numbers, and is independent of the search: a path to a violation here is a
//! behaviour of the real programs.

use crate::Setup;
use crate::bounds::{Bounds, Clocks, Left};
use crate::code::OLDEST;
use crate::moves::ready;
use crate::robot::{Local, RobotInput, Surroundings, Turn};
use crate::scene::{Invariant, Scene};
use crate::step::{Datagram, Step};
use crate::watch::{self, Checkers};
use starl_core::event::DropReason;
use starl_core::{Destination, Event, Payload, Record, RobotId, Time, TimerKey};
use starl_properties::Violation;
use std::cmp::Reverse;
use thiserror::Error;

/// A fleet on its way.
#[derive(Clone)]
pub struct Walk {
    pub(crate) surroundings: Surroundings,
    pub(crate) bounds: Bounds,
    pub(crate) left: Left,
    pub(crate) locals: Vec<Local>,
    /// The datagrams in transit.
    flight: Vec<Flying>,
    /// Counts each robot's datagrams.
    sent: Vec<u32>,
    pub(crate) checkers: Checkers,
    pub(crate) invariants: Vec<Box<dyn Invariant>>,
    steps: u64,
}

/// A datagram on its way.
#[derive(Clone, Debug)]
struct Flying {
    datagram: Datagram,
    /// The sender's number for it.
    sequence: u32,
    /// Ticks that it has been under way.
    age: u8,
}

/// The events of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The events, in order, as a trace has them. The time is the number of the step, as seconds: 0 for
    /// the start.
    pub records: Vec<Record>,
    /// The properties that are violated after it.
    pub violations: Vec<Violation>,
}

/// A step that cannot be taken.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Impossible(pub String);

impl Walk {
    /// All robots start.
    pub fn start(setup: Setup) -> (Walk, Moment) {
        let Setup {
            model,
            bounds,
            checkers,
            invariants,
        } = setup;
        let surroundings = Surroundings::new(model, bounds.clocks);
        let turns: Vec<Turn> = surroundings
            .fleet
            .iter()
            .map(|&robot| Local::start(robot, &surroundings))
            .collect();
        let mut walk = Walk {
            locals: turns.iter().map(|turn| turn.local.clone()).collect(),
            flight: Vec::new(),
            sent: vec![0; turns.len()],
            left: Left::of(&bounds),
            surroundings,
            bounds,
            checkers,
            invariants,
            steps: 0,
        };
        let moment = walk.settle(Vec::new(), turns);
        (walk, moment)
    }

    /// Takes a step.
    ///
    /// # Errors
    /// If it is not possible in this state.
    pub fn step(&mut self, step: &Step) -> Result<Moment, Impossible> {
        self.steps += 1;
        let mut records = Vec::new();
        let turns = match step {
            Step::Activate(robot) => vec![self.turn(*robot, RobotInput::Activate)?],
            Step::Timer(robot, key) => {
                let local = self.running(*robot)?;
                let mut armed = local.timers(&self.surroundings).into_iter();
                let place = armed.position(|(armed, _)| armed == *key);
                let ready = ready(local, &self.surroundings);
                if !place.is_some_and(|place| ready.contains(&(place as u32))) {
                    return Err(Impossible("the timer cannot fire".into()));
                }
                let is_counted = self.bounds.timers != Bounds::ANY_NUMBER;
                if self.bounds.clocks == Clocks::Still && is_counted {
                    spend(&mut self.left.timers, "timers")?;
                }
                vec![self.turn(*robot, RobotInput::Timer(*key))?]
            }
            Step::Deliver(datagram) => vec![self.deliver(datagram, true, &mut records)?],
            Step::Duplicate(datagram) => {
                if !self.bounds.any_copies {
                    spend(&mut self.left.duplicates, "duplicates")?;
                }
                vec![self.deliver(datagram, false, &mut records)?]
            }
            Step::Lose(datagram) => {
                spend(&mut self.left.losses, "losses")?;
                let place = self.find(datagram)?;
                let flying = self.flight.remove(place);
                records.push(self.lost(&flying, DropReason::Loss));
                Vec::new()
            }
            Step::Crash(robot) => {
                spend(&mut self.left.crashes, "crashes")?;
                vec![self.turn(*robot, RobotInput::Crash)?]
            }
            Step::Restart(robot) => vec![self.restart(*robot)?],
            Step::RestartDeaf(robot) => {
                let is_missed = |flying: &Flying| flying.datagram.to == *robot;
                records.extend(self.lose_all(is_missed, DropReason::Down));
                vec![self.restart(*robot)?]
            }
            Step::Suspect(robot, peer) => {
                spend(&mut self.left.suspicions, "suspicions")?;
                vec![self.turn(*robot, RobotInput::Suspect(*peer))?]
            }
            Step::Trust(robot, peer) => {
                spend(&mut self.left.suspicions, "suspicions")?;
                vec![self.turn(*robot, RobotInput::Trust(*peer))?]
            }
            Step::Tick(robot) => vec![self.tick(*robot)?],
            Step::TickAll => {
                let fleet = self.surroundings.fleet.clone();
                let turns = fleet.into_iter().map(|robot| self.tick(robot));
                let turns = turns.collect::<Result<_, _>>()?;
                records.extend(self.grow_old());
                turns
            }
        };
        Ok(self.settle(records, turns))
    }

    /// The state of the fleet.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            locals: self.locals.iter().collect(),
            surroundings: &self.surroundings,
        }
    }

    /// The timers of a robot that may fire now, in the order of their keys.
    pub fn ready(&self, robot: RobotId) -> Vec<TimerKey> {
        let Some(local) = self.locals.get(robot.index()).filter(|local| local.runs()) else {
            return Vec::new();
        };
        let timers = local.timers(&self.surroundings);
        let ready = ready(local, &self.surroundings).into_iter();
        ready.map(|place| timers[place as usize].0).collect()
    }

    /// The datagrams in transit, in the order of sending.
    pub fn flight(&self) -> impl Iterator<Item = &Datagram> {
        self.flight.iter().map(|flying| &flying.datagram)
    }

    /// The datagrams in transit, each with its age in ticks.
    pub(crate) fn flying(&self) -> impl Iterator<Item = (&Datagram, u8)> {
        self.flight
            .iter()
            .map(|flying| (&flying.datagram, flying.age))
    }

    /// Robots that wait for ever, if nothing can happen any more in this state. Whether something can is
    /// for the search to say.
    pub fn stuck(&self) -> Option<Violation> {
        let waiting = self.locals.iter().filter(|local| local.is_waiting());
        crate::stuck(waiting.map(|local| local.robot()).collect(), Time::ZERO)
    }

    /// Where records of this step are in time.
    fn at(&self) -> Time {
        Time(self.steps.saturating_mul(1_000_000_000))
    }

    fn local(&self, robot: RobotId) -> Result<&Local, Impossible> {
        let local = self.locals.get(robot.index());
        local.ok_or_else(|| Impossible(format!("there is no robot {robot}")))
    }

    fn running(&self, robot: RobotId) -> Result<&Local, Impossible> {
        let local = self.local(robot)?;
        match local.is_up() {
            true => Ok(local),
            false => Err(Impossible(format!("robot {robot} is down"))),
        }
    }

    fn turn(&self, robot: RobotId, happening: RobotInput) -> Result<Turn, Impossible> {
        let local = self.running(robot)?;
        Ok(local.turn(&happening, &self.surroundings))
    }

    fn restart(&self, robot: RobotId) -> Result<Turn, Impossible> {
        let local = self.local(robot)?;
        match local.is_up() {
            false => Ok(local.turn(&RobotInput::Restart, &self.surroundings)),
            true => Err(Impossible(format!("robot {robot} is not down"))),
        }
    }

    fn tick(&self, robot: RobotId) -> Result<Turn, Impossible> {
        let local = self.local(robot)?;
        let Clocks::Ticking { ticks, .. } = self.bounds.clocks else {
            return Err(Impossible("clocks stand still".into()));
        };
        if local.is_due(&self.surroundings) || local.clock >= u64::from(ticks) {
            return Err(Impossible(format!(
                "the clock of robot {robot} cannot tick"
            )));
        }
        Ok(local.turn(&RobotInput::Tick, &self.surroundings))
    }

    fn find(&self, wanted: &Datagram) -> Result<usize, Impossible> {
        let flight = self.flight.iter().enumerate();
        let same = flight.filter(|(_, flying)| flying.datagram == *wanted);
        let oldest = same.max_by_key(|(place, flying)| (flying.age, Reverse(*place)));
        let place = oldest.map(|(place, _)| place);
        place.ok_or_else(|| Impossible("no such datagram is on its way".into()))
    }

    fn deliver(
        &mut self,
        datagram: &Datagram,
        is_last: bool,
        records: &mut Vec<Record>,
    ) -> Result<Turn, Impossible> {
        let place = self.find(datagram)?;
        let turn = self.turn(datagram.to, RobotInput::Message(datagram.message()))?;
        let (from, sequence) = (datagram.from, self.flight[place].sequence);
        if is_last {
            self.flight.remove(place);
        }
        records.push(Record {
            at: self.at(),
            robot: Some(datagram.to),
            event: Event::Delivered { from, sequence },
        });
        Ok(turn)
    }

    fn lost(&self, flying: &Flying, reason: DropReason) -> Record {
        let Datagram { from, to, .. } = flying.datagram;
        Record {
            at: self.at(),
            robot: Some(to),
            event: Event::Dropped {
                from,
                to: Some(to),
                sequence: flying.sequence,
                reason,
            },
        }
    }

    /// Everything that is on its way has been so for a tick more.
    fn grow_old(&mut self) -> Vec<Record> {
        let Clocks::Ticking {
            delay: Some(delay), ..
        } = self.bounds.clocks
        else {
            return Vec::new();
        };
        self.flight.iter_mut().for_each(|flying| flying.age += 1);
        self.lose_all(|flying| flying.age > delay.min(OLDEST), DropReason::Loss)
    }

    /// Takes these out of the network.
    fn lose_all(&mut self, which: impl Fn(&Flying) -> bool, reason: DropReason) -> Vec<Record> {
        let flight = std::mem::take(&mut self.flight);
        let (gone, kept): (Vec<Flying>, Vec<Flying>) = flight.into_iter().partition(which);
        self.flight = kept;
        let lost = gone.iter().map(|flying| self.lost(flying, reason));
        lost.collect()
    }

    /// Takes in what has come of turns.
    fn settle(&mut self, mut records: Vec<Record>, turns: Vec<Turn>) -> Moment {
        let mut violations = Vec::new();
        let at = self.at();
        for turn in turns {
            let robot = turn.local.robot();
            self.locals[robot.index()] = turn.local;
            let ticks = self.locals.iter().map(|local| local.clock).max();
            let now = self.surroundings.time(ticks.unwrap_or_default());
            let record = |event: Event| Record {
                at,
                robot: Some(robot),
                event,
            };
            for datagram in turn.sent {
                let sequence = self.sent[robot.index()];
                self.sent[robot.index()] += 1;
                records.push(record(Event::Sent {
                    sequence,
                    destination: Destination::Robot(datagram.to),
                    port: datagram.port,
                    payload: Payload::from_slice(&datagram.payload),
                }));
                if self.bounds.any_copies {
                    self.flight.retain(|flying| flying.datagram != datagram);
                }
                self.flight.push(Flying {
                    datagram,
                    sequence,
                    age: 0,
                });
            }
            records.extend(turn.events.iter().cloned().map(record));
            let events = turn.events.into_iter().filter(watch::is_shown);
            let events: Vec<(RobotId, Event)> = events.map(|event| (robot, event)).collect();
            if !events.is_empty() {
                let (checkers, found) = watch::observe(&self.checkers, &events, now);
                self.checkers = checkers;
                violations.extend(found);
                violations.extend(crate::failure(&events, now));
            }
        }
        let scene = Scene {
            locals: self.locals.iter().collect(),
            surroundings: &self.surroundings,
        };
        for invariant in &self.invariants {
            invariant.judge(&scene, &mut violations);
        }
        Moment {
            records,
            violations,
        }
    }
}

fn spend(budget: &mut u8, what: &str) -> Result<(), Impossible> {
    match budget.checked_sub(1) {
        Some(left) => {
            *budget = left;
            Ok(())
        }
        None => Err(Impossible(format!(
            "there are no {what} left within the bounds"
        ))),
    }
}
