//! What can happen next in a state.

use crate::bounds::{Clocks, Left};
use crate::code::{Code, Flying, Kind};
use crate::robot::{Local, Surroundings};
use crate::robots::Outcome;
use crate::search::{HEAD, Search};
use starl_core::RobotId;
use starl_properties::Violation;

/// The property that is violated where nothing can happen any more and not all robots have finished.
pub const STUCK: &str = "explore.stuck";

/// A state that is expanded.
struct Site {
    number: u32,
    row: Vec<u32>,
    left: Left,
    robots: usize,
    /// Whether some step leads to another state.
    moves: bool,
    /// Whether a bound kept a timer from firing, or a clock from ticking.
    held: bool,
}

impl Site {
    fn local(&self, robot: RobotId) -> u32 {
        self.row[HEAD + robot.index()]
    }

    fn flight(&self) -> &[u32] {
        &self.row[HEAD + self.robots..]
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

impl Search {
    /// Takes every step that is possible in a state.
    pub(crate) fn expand(&mut self, number: u32) {
        let row = self.states.row(number).to_vec();
        let mut site = Site {
            number,
            left: Left::read(&row[1..]),
            row,
            robots: self.robots.surroundings.fleet.len(),
            moves: false,
            held: false,
        };
        self.arrivals(&mut site);
        for robot in self.robots.surroundings.fleet.clone() {
            let local = self.robots.state(site.local(robot));
            match (local.is_up(), local.runs()) {
                (true, true) => self.turns(&mut site, robot),
                (true, false) => {}
                (false, _) => self.restarts(&mut site, robot),
            }
            if local_is_up(&self.robots, &site, robot) && site.left.crashes > 0 {
                let left = Left {
                    crashes: site.left.crashes - 1,
                    ..site.left
                };
                self.happen(&mut site, Code::robot(Kind::Crash, robot, 0), robot, left);
            }
        }
        self.ticks(&mut site);
        if !site.moves {
            let stuck = (!site.held).then(|| self.stuck(&site)).flatten();
            self.is_terminal(number, stuck);
        }
    }

    /// Datagrams arrive, twice perhaps, or get lost.
    fn arrivals(&mut self, site: &mut Site) {
        // Of equal ones the oldest, which comes last, goes first: those that stay may stay for longer.
        let mut flight: Vec<Flying> = site.flight().iter().copied().map(Flying).collect();
        flight.sort_by_key(|flying| (flying.number(), flying.0));
        flight.reverse();
        flight.dedup_by_key(|flying| flying.number());
        flight.sort_by_key(|flying| flying.number());
        for flying in flight {
            let datagram = flying.number();
            let to = self.robots.datagram(datagram).to;
            let local = site.local(to);
            if !self.robots.state(local).is_up() {
                continue;
            }
            let deliver = Code::datagram(Kind::Deliver, datagram);
            let outcome = self.robots.turn(local, deliver);
            let is_idle = outcome.is_idle(local);
            let outcomes = [(to, outcome)];
            self.take(site, deliver, site.left, Some(flying), &outcomes);
            if site.left.duplicates > 0 && !is_idle {
                let left = Left {
                    duplicates: site.left.duplicates - 1,
                    ..site.left
                };
                let code = Code::datagram(Kind::Duplicate, datagram);
                self.take(site, code, left, None, &outcomes);
            }
            if site.left.losses > 0 {
                let left = Left {
                    losses: site.left.losses - 1,
                    ..site.left
                };
                let code = Code::datagram(Kind::Lose, datagram);
                self.take(site, code, left, Some(flying), &[]);
            }
        }
    }

    /// What happens to a robot that runs.
    fn turns(&mut self, site: &mut Site, robot: RobotId) {
        self.happen(
            site,
            Code::robot(Kind::Activate, robot, 0),
            robot,
            site.left,
        );
        let local = self.robots.state(site.local(robot));
        let ready = ready(local, &self.robots.surroundings);
        let is_still = self.bounds.clocks == Clocks::Still;
        site.held |= is_still && site.left.timers == 0 && !ready.is_empty();
        if !is_still || site.left.timers > 0 {
            let left = Left {
                timers: site.left.timers - u8::from(is_still),
                ..site.left
            };
            for place in ready {
                self.happen(site, Code::robot(Kind::Timer, robot, place), robot, left);
            }
        }
        if site.left.suspicions > 0 {
            let left = Left {
                suspicions: site.left.suspicions - 1,
                ..site.left
            };
            for peer in self.robots.surroundings.fleet.clone() {
                for kind in [Kind::Suspect, Kind::Trust] {
                    if peer != robot {
                        self.happen(site, Code::robot(kind, robot, peer.0), robot, left);
                    }
                }
            }
        }
    }

    /// A robot that is down starts again, and may have missed what was on its way to it.
    fn restarts(&mut self, site: &mut Site, robot: RobotId) {
        self.happen(site, Code::robot(Kind::Restart, robot, 0), robot, site.left);
        let is_missed = |word: &u32| self.robots.datagram(Flying(*word).number()).to == robot;
        if !site.flight().iter().any(is_missed) {
            return;
        }
        let kept: Vec<u32> = site
            .flight()
            .iter()
            .copied()
            .filter(|d| !is_missed(d))
            .collect();
        let local = site.local(robot);
        let outcome = self
            .robots
            .turn(local, Code::robot(Kind::Restart, robot, 0));
        self.begin(&site.row, site.left);
        self.keep(&kept);
        let code = Code::robot(Kind::RestartDeaf, robot, 0);
        let next = self.finish((site.number, code), None, &[(robot, outcome)]);
        site.moves |= next != Some(site.number);
    }

    /// Clocks advance where no timer is due.
    fn ticks(&mut self, site: &mut Site) {
        let Clocks::Ticking {
            ticks, skew, delay, ..
        } = self.bounds.clocks
        else {
            return;
        };
        let fleet = self.robots.surroundings.fleet.clone();
        let clock = |search: &Search, robot: RobotId| search.robots.state(site.local(robot)).clock;
        let slowest = fleet
            .iter()
            .map(|&robot| clock(self, robot))
            .min()
            .unwrap_or_default();
        let may_tick = |search: &Search, robot: RobotId| {
            let local = search.robots.state(site.local(robot));
            !local.is_due(&search.robots.surroundings) && local.clock < u64::from(ticks)
        };
        let able: Vec<RobotId> = fleet
            .iter()
            .copied()
            .filter(|&robot| may_tick(self, robot))
            .collect();
        let is_over = |&robot: &RobotId| clock(self, robot) >= u64::from(ticks);
        let held = fleet.iter().any(is_over);
        if skew > 0 {
            let near = |robot: &RobotId| clock(self, *robot) - slowest < u64::from(skew);
            let able: Vec<RobotId> = able.into_iter().filter(near).collect();
            for robot in able {
                self.happen(site, Code::robot(Kind::Tick, robot, 0), robot, site.left);
            }
        } else if able.len() == fleet.len() {
            let outcomes: Vec<(RobotId, Outcome)> = able
                .into_iter()
                .map(|robot| {
                    let code = Code::robot(Kind::Tick, robot, 0);
                    (robot, self.robots.turn(site.local(robot), code))
                })
                .collect();
            let code = Code::robot(Kind::TickAll, RobotId(0), 0);
            self.begin(&site.row, site.left);
            if let Some(delay) = delay {
                let older = site.flight().iter();
                let mut older: Vec<u32> = older
                    .filter_map(|&word| Some(Flying(word).age(delay)?.0))
                    .collect();
                older.sort_unstable();
                self.keep(&older);
            }
            let next = self.finish((site.number, code), None, &outcomes);
            site.moves |= next != Some(site.number);
        }
        site.held |= held;
    }

    /// Something happens to one robot; it is no step if nothing comes of it.
    fn happen(&mut self, site: &mut Site, code: Code, robot: RobotId, left: Left) {
        let local = site.local(robot);
        let outcome = self.robots.turn(local, code);
        if !outcome.is_idle(local) {
            self.take(site, code, left, None, &[(robot, outcome)]);
        }
    }

    fn take(
        &mut self,
        site: &mut Site,
        code: Code,
        left: Left,
        taken: Option<Flying>,
        outcomes: &[(RobotId, Outcome)],
    ) {
        self.begin(&site.row, left);
        let next = self.finish((site.number, code), taken, outcomes);
        site.moves |= next != Some(site.number);
    }

    /// What is wrong with a state in which nothing can happen any more.
    fn stuck(&self, site: &Site) -> Option<Violation> {
        if !self.robots.surroundings.model.all_finish {
            return None;
        }
        let fleet = &self.robots.surroundings.fleet;
        let waits = |robot: &RobotId| {
            let local = self.robots.state(site.local(*robot));
            local.is_waiting()
        };
        let waiting: Vec<RobotId> = fleet.iter().copied().filter(waits).collect();
        let at = self.robots.surroundings.time(0);
        crate::stuck(waiting, at)
    }
}

fn local_is_up(robots: &crate::robots::Robots, site: &Site, robot: RobotId) -> bool {
    robots.state(site.local(robot)).is_up()
}
