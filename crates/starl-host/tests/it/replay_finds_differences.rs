//! A replay detects software that behaves differently, and where.

use crate::support::{World, said};
use starl_core::effect::Effects;
use starl_core::{Agent, Input, Primitives, Program, Random, Robot, Time, Value};
use starl_host::{Departure, Observed, Replayer};

/// Counts activations and draws, a little otherwise from an activation on.
#[derive(Clone, Primitives)]
struct Counter {
    count: u32,
    changes_at: u32,
}

impl Program for Counter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.count += 1;
        let drawn = robot.random().below(1_000);
        robot.emit("drawn", [("number", drawn.into())]);
        let sign = if self.count >= self.changes_at {
            -0.0
        } else {
            0.0
        };
        robot.emit("zero", [("value", Value::Float(sign))]);
        robot.emit("none", [("value", Value::Float(f64::NAN))]);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.count = random.below(10);
    }
}

const NEVER: Counter = Counter {
    count: 0,
    changes_at: u32::MAX,
};

/// Fresh software on a robot without storage.
fn started(random: &Random) -> Observed<'_> {
    let saved = None;
    Observed::Started { random, saved }
}

/// Feeds a replayer with what a robot did that runs [`NEVER`].
fn feed(replayer: &mut Replayer, activations: u64) -> Result<(), Departure> {
    let random = Random::keyed(3, &[]);
    replayer.observe(Time(0), started(&random))?;
    let mut agent = Agent::new(Box::new(NEVER), random.clone());
    for step in 1..=activations {
        let world = World {
            now: Time(step + 5),
            ..World::default()
        };
        let mut effects = Effects::default();
        agent.handle(&Input::Activate, &world.view(), &mut effects);
        let observed = Observed::Input {
            input: &Input::Activate,
            view: &world.view(),
            effects: &effects.list,
        };
        replayer.observe(Time(step), observed)?;
    }
    Ok(())
}

#[test]
fn the_same_software_agrees() {
    let mut replayer = Replayer::new(Box::new(NEVER));
    assert_eq!(feed(&mut replayer, 10), Ok(()));
    // Another life begins as the first.
    assert_eq!(feed(&mut replayer, 5), Ok(()));
    assert_eq!((replayer.entries(), replayer.lives()), (17, 2));
}

#[test]
fn a_bit_is_enough() {
    let changed = Counter {
        changes_at: 4,
        ..NEVER
    };
    let mut replayer = Replayer::new(Box::new(changed));
    let Err(Departure::Different(found)) = feed(&mut replayer, 10) else {
        panic!("it was not found");
    };
    assert_eq!((found.agreed, found.at, found.now), (4, Time(4), Time(9)));
    assert_eq!(found.input, Input::Activate);
    assert_eq!(found.effect(), 1);
    assert_eq!((found.recorded.len(), found.replayed.len()), (3, 3));
    let shown = format!("{:?}", found.replayed[1]);
    assert!(shown.contains("-0.0"), "{shown}");
}

#[test]
fn so_are_an_effect_more_or_less_and_another_state() {
    let world = World::default();
    let random = Random::keyed(3, &[]);
    for effects in [vec![], vec![said("more"); 4]] {
        let mut replayer = Replayer::new(Box::new(NEVER));
        let started = started(&random);
        assert_eq!(replayer.observe(Time(0), started), Ok(()));
        let observed = Observed::Input {
            input: &Input::Activate,
            view: &world.view(),
            effects: &effects,
        };
        let found = replayer.observe(Time(1), observed);
        assert!(matches!(found, Err(Departure::Different(_))), "{found:?}");
    }
}

/// The random draws of a corruption decide the program's later behaviour.
#[test]
fn corruption_is_done_again() {
    let counts = |random: &Random| random.clone().below(10);
    let mut streams = (0..).map(|key| Random::keyed(key, &[]));
    let high = streams.find(|stream| counts(stream) >= 5);
    let low = streams.find(|stream| counts(stream) < 3);
    for (stream, changes) in [(high, true), (low, false)] {
        let stream = stream.expect("there are as many as one likes");
        let mut replayer = Replayer::new(Box::new(Counter {
            changes_at: 5,
            ..NEVER
        }));
        let (random, world) = (Random::keyed(3, &[]), World::default());
        let mut agent = Agent::new(Box::new(NEVER), random.clone());
        let mut effects = Effects::default();
        agent.handle(&Input::Activate, &world.view(), &mut effects);
        let deeds = [started(&random), Observed::Corrupted { random: &stream }];
        for deed in deeds {
            assert_eq!(replayer.observe(Time(0), deed), Ok(()));
        }
        let activated = Observed::Input {
            input: &Input::Activate,
            view: &world.view(),
            effects: &effects.list,
        };
        assert_eq!(replayer.observe(Time(1), activated).is_err(), changes);
    }
}

#[test]
fn software_that_never_started_cannot_be_replayed() {
    let mut replayer = Replayer::new(Box::new(NEVER));
    let world = World::default();
    let observed = Observed::Input {
        input: &Input::Start,
        view: &world.view(),
        effects: &[],
    };
    assert_eq!(
        replayer.observe(Time(1), observed),
        Err(Departure::NotStarted)
    );
}
