//! The possible next events of one robot, independent of the others.

use crate::actors::{Actors, Prospects};
use crate::bounds::Clocks;
use crate::code::{Code, Flying, Kind};
use crate::robot::{Local, Surroundings};
use crate::robots::{NOTHING, Outcome, Robots};

impl Actors {
    /// The steps that are possible for an actor, found at the first call.
    pub fn prospects(&mut self, actor: u32, robots: &mut Robots) -> Prospects {
        if let Some(prospects) = self.prospects[actor as usize] {
            return prospects;
        }
        let begin = self.moves.len() as u32;
        find(self, actor, robots);
        let local = self.local(actor);
        let ticked = may_tick(robots, local).then(|| {
            let outcome = robots.turn(local, Code::robot(Kind::Tick, robots.robot(local), 0));
            let mailbox = self.older(actor);
            self.number(outcome.local, &mailbox)
        });
        let prospects = Prospects {
            begin,
            end: self.moves.len() as u32,
            ticked,
        };
        self.prospects[actor as usize] = Some(prospects);
        prospects
    }
}

/// The timers of a robot that may fire now, by their places among those that are armed.
pub(crate) fn ready(local: &Local, surroundings: &Surroundings) -> Vec<u32> {
    let silent = &surroundings.model.silent;
    let timers = local.timers(surroundings);
    let heard = || {
        timers
            .iter()
            .zip(0..)
            .filter(|((key, _), _)| !silent.contains(&key.port))
    };
    let first = heard().map(|((_, due), _)| *due).min();
    let may_fire = |due: u64| match surroundings.clocks {
        Clocks::Still => true,
        Clocks::Ticking { .. } => due <= local.clock && Some(due) == first,
    };
    let ready = heard().filter(|((_, due), _)| may_fire(*due));
    ready.map(|(_, place)| place).collect()
}

/// Whether the clock of a robot in this state may continue.
fn may_tick(robots: &Robots, local: u32) -> bool {
    let Clocks::Ticking { ticks, .. } = robots.surroundings.clocks else {
        return false;
    };
    let local = robots.state(local);
    !local.is_due(&robots.surroundings) && local.clock < u64::from(ticks)
}

/// Finds all moves of an actor.
fn find(actors: &mut Actors, actor: u32, robots: &mut Robots) {
    let local = actors.local(actor);
    let mailbox = actors.mailbox(actor).to_vec();
    let is_for_safety = !robots.surroundings.model.all_finish || actors.bounds.any_copies;
    let mut finder = Finder {
        actors,
        robots,
        local,
        mailbox,
        is_for_safety,
    };
    let state = finder.robots.state(local);
    let (is_up, runs) = (state.is_up(), state.runs());
    let robot = state.robot();
    if is_up {
        finder.arrivals();
    }
    if runs {
        finder.turns();
    }
    if !is_up {
        finder.restarts();
    } else if finder.actors.bounds.crashes > 0 {
        finder.happen(Code::robot(Kind::Crash, robot, 0));
    }
}

struct Finder<'a> {
    actors: &'a mut Actors,
    robots: &'a mut Robots,
    local: u32,
    mailbox: Vec<u32>,
    /// Whether steps are left out that only take datagrams away: to safety one that never arrives is the same.
    is_for_safety: bool,
}

impl Finder<'_> {
    /// Datagrams arrive, twice perhaps, or get lost.
    fn arrivals(&mut self) {
        // Of equal ones the oldest, which comes last, goes first: those that stay may stay for longer.
        let mut flight: Vec<Flying> = self.mailbox.iter().copied().map(Flying).collect();
        flight.sort_by_key(|flying| (flying.number(), flying.0));
        flight.reverse();
        flight.dedup_by_key(|flying| flying.number());
        flight.sort_by_key(|flying| flying.number());
        let bounds = self.actors.bounds;
        for flying in flight {
            let datagram = flying.number();
            let deliver = Code::datagram(Kind::Deliver, datagram);
            let duplicate = Code::datagram(Kind::Duplicate, datagram);
            let outcome = self.robots.turn(self.local, deliver);
            if self.is_for_safety && outcome.is_idle(self.local) {
                continue;
            }
            let mut rest = self.mailbox.clone();
            rest.remove(rest.partition_point(|&word| word < flying.0));
            if !bounds.any_copies {
                self.actors.add(deliver, &outcome, &rest);
            }
            if (bounds.any_copies || bounds.duplicates > 0) && !outcome.is_idle(self.local) {
                self.actors.add(duplicate, &outcome, &self.mailbox);
            }
            if bounds.losses > 0 && !self.is_for_safety {
                let nothing = Outcome {
                    local: self.local,
                    batch: NOTHING,
                    sent: (0, 0),
                };
                let lose = Code::datagram(Kind::Lose, datagram);
                self.actors.add(lose, &nothing, &rest);
            }
        }
    }

    /// The possible events of a robot that runs.
    fn turns(&mut self) {
        let state = self.robots.state(self.local);
        let robot = state.robot();
        let ready = ready(state, &self.robots.surroundings);
        self.happen(Code::robot(Kind::Activate, robot, 0));
        for place in ready {
            self.happen(Code::robot(Kind::Timer, robot, place));
        }
        if self.actors.bounds.suspicions > 0 {
            for peer in self.robots.surroundings.fleet.clone() {
                for kind in [Kind::Suspect, Kind::Trust] {
                    if peer != robot {
                        self.happen(Code::robot(kind, robot, peer.0));
                    }
                }
            }
        }
    }

    /// A robot that is down starts again, and may have missed what was on its way to it.
    fn restarts(&mut self) {
        let robot = self.robots.robot(self.local);
        let restart = Code::robot(Kind::Restart, robot, 0);
        self.happen(restart);
        if !self.mailbox.is_empty() && !self.is_for_safety {
            let outcome = self.robots.turn(self.local, restart);
            let deaf = Code::robot(Kind::RestartDeaf, robot, 0);
            self.actors.add(deaf, &outcome, &[]);
        }
    }

    /// Something happens to the robot itself; it is not a move if it has no effect.
    fn happen(&mut self, code: Code) {
        let outcome = self.robots.turn(self.local, code);
        if !outcome.is_idle(self.local) {
            self.actors.add(code, &outcome, &self.mailbox);
        }
    }
}
