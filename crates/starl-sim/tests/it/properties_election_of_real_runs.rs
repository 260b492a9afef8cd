//! The checker of elections and the primitive agree on simulated robots: the primitive keeps its promises under
//! every fault, and elections that are made worse are found out.

use crate::engine_support::weather::{WEATHERS, fleet, judge, lossy};
use starl_core::event::ElectionEvent;
use starl_core::{
    Destination, Duration, Input, Message, Port, Primitive, Primitives, Program, Random, Robot,
    RobotId, Time,
};
use starl_primitives::election::{Algorithm, Options};
use starl_primitives::{FailureDetector, LeaderElection, failure_detector};
use starl_sim::Scenario;

/// Stands all the time, and resigns now and then.
#[derive(Clone, Primitives)]
struct Elector {
    detector: FailureDetector,
    election: LeaderElection,
}

impl Elector {
    fn by(algorithm: Algorithm) -> Elector {
        let options = Options {
            algorithm,
            ..Options::default()
        };
        Elector {
            detector: FailureDetector::new("watch", failure_detector::Options::default()),
            election: LeaderElection::new("election", None, options),
        }
    }
}

impl Program for Elector {
    fn start(&mut self, robot: &mut Robot<'_>) {
        self.election.elect(robot);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        let leads = self.election.leader() == Some(robot.id());
        if leads && robot.random().below(200) == 0 {
            self.election.resign(robot);
            self.election.elect(robot);
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.election.corrupt(random);
    }
}

/// Votes as in the primitive, and nothing else: a count for an epoch, no leases, no memory over
/// a restart. The leader is lost sight of when it has been silent for two seconds.
#[derive(Clone)]
struct Naive {
    /// The number of others' votes that make a leader.
    needed: usize,
    count: u64,
    votes: Vec<RobotId>,
    leader: Option<RobotId>,
    heard: Time,
}

const NAIVE: Port = Port::named("naive");

impl Naive {
    fn show(&mut self, robot: &mut Robot<'_>, leader: RobotId) {
        if self.leader.replace(leader) != Some(leader) {
            let epoch = Some(self.count);
            robot.report(
                NAIVE,
                ElectionEvent::Leader {
                    leader,
                    epoch,
                    round: None,
                    ballot: None,
                },
            );
        }
        self.heard = robot.now();
    }

    fn hear(&mut self, robot: &mut Robot<'_>, message: &Message) {
        // A count, and whether it asks (0), votes (1) or leads (2).
        match message.read::<(u64, u8)>() {
            Some((count, 0)) if count > self.count => {
                self.count = count;
                self.votes.clear();
                if self.leader == Some(robot.id()) {
                    self.leader = None;
                    robot.report(NAIVE, ElectionEvent::Lost);
                }
                robot.transmit(Destination::Robot(message.from), NAIVE, &(count, 1u8));
            }
            Some((count, 1)) if count == self.count && !self.votes.contains(&message.from) => {
                self.votes.push(message.from);
                if self.votes.len() >= self.needed {
                    self.show(robot, robot.id());
                }
            }
            Some((count, 2)) if count >= self.count => {
                self.count = count;
                self.show(robot, message.from);
            }
            _ => {}
        }
    }

    fn look(&mut self, robot: &mut Robot<'_>) {
        if self.leader == Some(robot.id()) {
            robot.transmit(Destination::All, NAIVE, &(self.count, 2u8));
        } else if robot.now().since(self.heard) > Duration::from_seconds(2) {
            if self.leader.take().is_some() {
                robot.report(NAIVE, ElectionEvent::Lost);
            }
            if robot.random().below(10) == 0 {
                self.count += 1;
                self.votes.clear();
                robot.transmit(Destination::All, NAIVE, &(self.count, 0u8));
            }
        }
    }
}

impl Primitive for Naive {
    fn port(&self) -> Port {
        NAIVE
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => {
                let start = ElectionEvent::Start {
                    algorithm: Algorithm::Leases,
                    participants: robot.fleet().to_vec(),
                };
                robot.report(NAIVE, start);
                robot.report(NAIVE, ElectionEvent::Elect);
                robot.report(NAIVE, ElectionEvent::Vote { anew: false });
                self.heard = robot.now();
            }
            Input::Message(message) => self.hear(robot, message),
            Input::Activate => self.look(robot),
            _ => {}
        }
    }
}

#[derive(Clone, Primitives)]
struct NaiveElector(Naive);

impl Program for NaiveElector {
    fn activate(&mut self, _: &mut Robot<'_>) {}
}

fn naive(needed: usize) -> NaiveElector {
    NaiveElector(Naive {
        needed,
        count: 0,
        votes: Vec::new(),
        leader: None,
        heard: Time::ZERO,
    })
}

#[test]
fn the_primitive_keeps_its_promises_under_every_fault() {
    for seed in 0..10 {
        for algorithm in [Algorithm::Leases, Algorithm::Ballots, Algorithm::Bully] {
            for weather in WEATHERS {
                let mut scenario = fleet(5, seed);
                weather(&mut scenario);
                let (found, changes) = judge(scenario, Elector::by(algorithm), "leader");
                assert_eq!(found, [] as [&str; 0], "{algorithm:?}, seed {seed}");
                assert!(changes >= 10, "{changes}");
            }
        }
    }
}

/// The network falls apart again and again.
fn parted(seed: u64) -> Scenario {
    let mut scenario = fleet(5, seed);
    scenario.faults.rates.partition = 0.1;
    scenario.faults.rates.heal_after = Duration::from_seconds(10);
    scenario
}

/// In how many of ten runs in which the network falls apart a property is violated.
fn often(property: &str, program: &NaiveElector) -> usize {
    let is_violated = |&seed: &u64| {
        let (found, _) = judge(parted(seed), program.clone(), "leader");
        found.iter().any(|found| found == property)
    };
    (0..10).filter(is_violated).count()
}

#[test]
fn one_without_leases_has_two_leaders_at_once() {
    let times = often("election.exclusion", &naive(2));
    assert!(times >= 5, "{times}");
}

#[test]
fn one_without_majorities_has_two_leaders_in_one_epoch() {
    let times = often("election.uniqueness", &naive(1));
    assert!(times >= 1, "{times}");
}

#[test]
fn bounds_that_are_too_short_are_found_out() {
    let mut scenario = fleet(5, 1);
    lossy(&mut scenario);
    scenario.properties.election_bound = Duration::from_millis(500);
    let (found, _) = judge(scenario, Elector::by(Algorithm::Leases), "leader");
    assert_eq!(found, ["election.progress"]);
}
