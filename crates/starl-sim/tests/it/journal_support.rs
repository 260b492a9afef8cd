//! Runs with journals, and replays of every robot from them.

use starl_core::{Duration, Program, RobotId, Time};
use starl_host::journal::{Packer, Reader};
use starl_host::{Observed, Replayer};
use starl_sim::Simulation;

/// The journal messages of a trace of this many seconds.
pub fn recorded(simulation: &mut Simulation, seconds: f64) -> Vec<(Time, Vec<u8>)> {
    simulation.set_journal(true);
    let end = Time::ZERO + Duration::from_seconds_f64(seconds);
    let mut packer = Packer::default();
    let mut messages = Vec::new();
    while simulation.now() < end {
        simulation.step();
        messages.extend(packer.pack(simulation.journal()));
    }
    messages
}

/// The result of a replay.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replay {
    pub entries: u64,
    pub lives: u32,
    pub corruptions: u32,
}

/// Replays a robot; panics if its software behaves differently.
pub fn replay(messages: &[(Time, Vec<u8>)], robot: RobotId, program: Box<dyn Program>) -> Replay {
    let mut replayer = Replayer::new(program);
    let mut reader = Reader::new(robot);
    let mut corruptions = 0;
    for (start, message) in messages {
        let mut see = |at, observed: Observed<'_>| {
            corruptions += u32::from(matches!(observed, Observed::Corrupted { .. }));
            if let Err(departure) = replayer.observe(at, observed) {
                panic!("robot {robot} at {at}: {departure:#?}");
            }
        };
        let read = reader.read(*start, message, &mut see);
        read.expect("it is a journal");
    }
    Replay {
        entries: replayer.entries(),
        lives: replayer.lives(),
        corruptions,
    }
}
