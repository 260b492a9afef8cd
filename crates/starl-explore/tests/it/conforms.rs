//! The explorer passes the suite of all hosts: the way through the states that a calm network and punctual
//! robots take is one that it can go.

use starl_core::{Destination, Event, Record, RobotId, Time};
use starl_explore::{Bounds, Clocks, Datagram, Model, Moment, Setup, Step, Walk};
use starl_host::testing::conformance::{DELAY, Fleet, Host, Need, PERIOD, TICK};

struct Explorer {
    walk: Walk,
    /// Ticks since the beginning.
    now: u64,
    /// When robots have started last.
    started: Vec<u64>,
    /// The datagrams in transit, in the order of their arrival times.
    flying: Vec<(u64, Datagram)>,
    records: Vec<Record>,
}

const PERIOD_TICKS: u64 = PERIOD.0 / TICK.0;
const DELAY_TICKS: u64 = DELAY.0 / TICK.0;

impl Explorer {
    fn step(&mut self, step: &Step) {
        let moment = self.walk.step(step);
        let moment = moment.unwrap_or_else(|why| panic!("{step:?}: {why}"));
        self.note(moment);
    }

    fn note(&mut self, moment: Moment) {
        let at = Time::ZERO + TICK * self.now;
        for record in moment.records {
            if let Event::Sent {
                destination: Destination::Robot(to),
                port,
                payload,
                ..
            } = &record.event
            {
                let datagram = Datagram {
                    from: record.robot.expect("a robot sends"),
                    to: *to,
                    port: *port,
                    payload: payload.to_vec(),
                };
                self.flying.push((self.now + DELAY_TICKS, datagram));
            }
            self.records.push(Record { at, ..record });
        }
    }

    /// Everything that is due now: first datagrams, then timers, then activations.
    fn moment(&mut self) {
        let is_due = |(at, datagram): &(u64, Datagram), host: &Explorer| {
            *at <= host.now && host.walk.scene().is_up(datagram.to)
        };
        while let Some(place) = self.flying.iter().position(|flying| is_due(flying, self)) {
            let (_, datagram) = self.flying.remove(place);
            self.step(&Step::Deliver(datagram));
        }
        for robot in self.walk.scene().robots().to_vec() {
            while let Some(key) = self.walk.ready(robot).first() {
                self.step(&Step::Timer(robot, *key));
            }
            let since = self.now - self.started[robot.index()];
            if self.walk.scene().is_up(robot) && since.is_multiple_of(PERIOD_TICKS) {
                self.step(&Step::Activate(robot));
            }
        }
    }
}

impl Host for Explorer {
    const LACKS: &'static [(Need, &'static str)] = &[
        (Need::Order, "the explorer tries every order"),
        (
            Need::Clocks,
            "robots in an exploration have no wrong clocks",
        ),
        (Need::Paths, "robots in an exploration stand still"),
        (Need::Milliseconds, "the explorer has no time within a tick"),
        (Need::Corruption, "the explorer corrupts no state"),
        (Need::Stalls, "the explorer is never late"),
        (Need::WriteTime, "a write takes no time in an exploration"),
    ];

    fn start(fleet: Fleet) -> Explorer {
        let Fleet {
            robots,
            has_storage,
            ..
        } = fleet;
        let count = robots.len();
        let programs = robots.into_iter().map(|probe| probe.boxed()).collect();
        let setup = Setup {
            model: Model {
                keeps_storage: has_storage,
                ..Model::new(programs)
            },
            bounds: Bounds {
                crashes: u8::MAX,
                clocks: Clocks::Ticking {
                    tick: TICK,
                    ticks: u16::MAX,
                    skew: 0,
                    delay: None,
                },
                ..Bounds::default()
            },
            checkers: Vec::new(),
            invariants: Vec::new(),
        };
        let (walk, moment) = Walk::start(setup);
        let mut host = Explorer {
            walk,
            now: 0,
            started: vec![0; count],
            flying: Vec::new(),
            records: Vec::new(),
        };
        host.note(moment);
        host
    }

    fn run_before(&mut self, end: Time) {
        while Time::ZERO + TICK * self.now < end {
            self.moment();
            self.step(&Step::TickAll);
            self.now += 1;
        }
    }

    fn crash(&mut self, robot: RobotId) {
        self.step(&Step::Crash(robot));
    }

    fn restart(&mut self, robot: RobotId) {
        self.started[robot.index()] = self.now;
        let is_missed = |(at, datagram): &(u64, Datagram)| *at < self.now && datagram.to == robot;
        if self.flying.iter().any(is_missed) {
            self.flying.retain(|(_, datagram)| datagram.to != robot);
            self.step(&Step::RestartDeaf(robot));
        } else {
            self.step(&Step::Restart(robot));
        }
    }

    fn corrupt(&mut self, _: RobotId) {
        unreachable!("the explorer corrupts no state");
    }

    fn stall(&mut self, _: Time) {
        unreachable!("the explorer is never late");
    }

    fn records(&self) -> Vec<Record> {
        self.records.clone()
    }
}

starl_host::conformance!(
    Explorer,
    skip things_due_at_once_happen_in_order = "the explorer tries every order",
    skip timers_due_at_once_fire_in_the_order_of_their_keys = "the explorer tries every order",
    skip the_shortest_timer_takes_a_millisecond = "the explorer has no time within a tick",
    skip clocks_run_wrong = "robots in an exploration have no wrong clocks",
    skip a_late_host_activates_once = "the explorer is never late",
    skip a_path_answers_its_request = "robots in an exploration stand still",
    skip a_path_for_an_earlier_life_is_ignored = "robots in an exploration stand still",
    skip a_path_for_a_robot_that_is_down_is_ignored = "robots in an exploration stand still",
    skip a_corrupted_robot_continues_until_it_restarts = "the explorer corrupts no state",
    skip effects_wait_for_the_write = "a write takes no time in an exploration",
    skip a_crash_undoes_a_write_and_its_effects = "a write takes no time in an exploration",
    skip writes_are_batched = "a write takes no time in an exploration",
);
