//! The states of single robots, by number, and their successors for each input.
//!
//! A fleet has far fewer states of single robots than it has states, so a program runs once for each state of a robot
//! and input.

use crate::code::{Code, Kind, MOST_DATAGRAMS};
use crate::doubt::Doubt;
use crate::robot::{Local, RobotInput, Surroundings};
use crate::step::{Datagram, Step};
use crate::table::{Rows, Table};
use crate::texts::Texts;
use crate::watch;
use starl_core::{Event, RobotId};

/// Events of one turn, with their robot.
pub(crate) type Batch = Vec<(RobotId, Event)>;

/// No events.
pub(crate) const NOTHING: u32 = 0;

/// All states of robots that were seen.
#[derive(Clone)]
pub(crate) struct Robots {
    pub surroundings: Surroundings,
    states: Vec<Local>,
    texts: Texts,
    datagrams: Vec<Datagram>,
    datagram_rows: Table,
    batches: Vec<Batch>,
    batch_texts: Texts,
    /// Rows of state and code.
    turns: Rows,
    outcomes: Vec<Outcome>,
    /// Numbers of datagrams that were sent, turn by turn.
    sent: Vec<u32>,
    pub motions: u64,
    pub doubt: Option<Box<Doubt>>,
}

/// The result of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Outcome {
    /// The robot's state after it.
    pub local: u32,
    /// The events for the checkers.
    pub batch: u32,
    /// The range of the numbers of its sent messages.
    pub sent: (u32, u32),
}

impl Outcome {
    /// Whether nothing came of a turn of a robot in this state.
    pub fn is_idle(&self, local: u32) -> bool {
        self.local == local && self.batch == NOTHING && self.sent.0 == self.sent.1
    }
}

impl Robots {
    pub fn new(surroundings: Surroundings) -> Robots {
        let mut robots = Robots {
            surroundings,
            states: Vec::new(),
            texts: Texts::default(),
            datagrams: Vec::new(),
            datagram_rows: Table::default(),
            batches: Vec::new(),
            batch_texts: Texts::default(),
            turns: Rows::new(2, 0),
            outcomes: Vec::new(),
            sent: Vec::new(),
            motions: 0,
            doubt: None,
        };
        let nothing = robots.batch(Vec::new());
        debug_assert_eq!(nothing, NOTHING);
        robots
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// Whether there are more kinds of datagrams than have numbers.
    pub fn is_full(&self) -> bool {
        self.datagrams.len() >= MOST_DATAGRAMS
    }

    pub fn state(&self, local: u32) -> &Local {
        &self.states[local as usize]
    }

    pub fn datagram(&self, number: u32) -> &Datagram {
        &self.datagrams[number as usize]
    }

    pub fn events(&self, batch: u32) -> &Batch {
        &self.batches[batch as usize]
    }

    /// All events of all turns.
    pub fn all_events(&self) -> impl Iterator<Item = &Event> {
        self.batches.iter().flatten().map(|(_, event)| event)
    }

    /// The robot that is in this state.
    pub fn robot(&self, local: u32) -> RobotId {
        self.states[local as usize].robot()
    }

    /// The numbers of the messages sent in a turn.
    pub fn sent(&self, (begin, end): (u32, u32)) -> &[u32] {
        &self.sent[begin as usize..end as usize]
    }

    /// Memory of the turns, without that of the robots themselves, bytes.
    pub fn bytes(&self) -> usize {
        self.turns.bytes()
            + self.outcomes.capacity() * size_of::<Outcome>()
            + self.sent.capacity() * size_of::<u32>()
    }

    /// The result of an event for a robot in this state.
    pub fn turn(&mut self, local: u32, code: Code) -> Outcome {
        let (number, is_new) = self.turns.insert(&[local, code.0], &[]);
        if is_new {
            let happening = self.happening(local, code);
            let turn = self.states[local as usize].turn(&happening, &self.surroundings);
            let outcome = self.enter(turn);
            self.outcomes.push(outcome);
            if self.doubt.is_some() {
                self.compare_twins(local, code);
            }
        }
        self.outcomes[number as usize]
    }

    pub(crate) fn happening(&self, local: u32, code: Code) -> RobotInput {
        let peer = RobotId(code.which());
        match code.kind() {
            Kind::Timer => {
                let armed = self.states[local as usize].timers(&self.surroundings);
                match armed.get(code.which() as usize) {
                    Some((key, _)) => RobotInput::Timer(*key),
                    None => unreachable!("only timers that are armed fire"),
                }
            }
            Kind::Deliver | Kind::Duplicate | Kind::Lose => {
                RobotInput::Message(self.datagram(code.number()).message())
            }
            Kind::Crash => RobotInput::Crash,
            Kind::Restart | Kind::RestartDeaf => RobotInput::Restart,
            Kind::Suspect => RobotInput::Suspect(peer),
            Kind::Trust => RobotInput::Trust(peer),
            Kind::Tick | Kind::TickAll => RobotInput::Tick,
            Kind::Activate => RobotInput::Activate,
        }
    }

    /// Numbers the results of a turn.
    pub(crate) fn enter(&mut self, turn: crate::robot::Turn) -> Outcome {
        self.motions += turn.motions;
        let robot = turn.local.robot();
        let begin = self.sent.len() as u32;
        for datagram in turn.sent {
            let number = self.number_of(datagram);
            self.sent.push(number);
        }
        let events = turn.events.into_iter().filter(watch::is_shown);
        let batch = self.batch(events.map(|event| (robot, event)).collect());
        Outcome {
            local: self.number(turn.local),
            batch,
            sent: (begin, self.sent.len() as u32),
        }
    }

    /// The number of a robot's state.
    pub fn number(&mut self, local: Local) -> u32 {
        let mut text = String::new();
        local.write(&self.surroundings, &mut text);
        let (number, is_new) = self.texts.insert(&text);
        if is_new {
            self.states.push(local);
        } else if let Some(doubt) = &mut self.doubt {
            doubt.meet(number, local);
        }
        number
    }

    /// The number of a datagram.
    pub fn number_of(&mut self, datagram: Datagram) -> u32 {
        let bytes = datagram.payload.chunks(4).map(|chunk| {
            let mut word = [0; 4];
            word[..chunk.len()].copy_from_slice(chunk);
            u32::from_le_bytes(word)
        });
        let head = [
            datagram.from.0,
            datagram.to.0,
            datagram.port.0,
            datagram.payload.len() as u32,
        ];
        let row: Vec<u32> = head.into_iter().chain(bytes).collect();
        let (number, is_new) = self.datagram_rows.insert(&row);
        if is_new {
            self.datagrams.push(datagram);
        }
        number
    }

    fn batch(&mut self, batch: Batch) -> u32 {
        let (number, is_new) = self.batch_texts.insert(&format!("{batch:?}"));
        if is_new {
            self.batches.push(batch);
        }
        number
    }
}

impl Code {
    /// The step in words. `local` is the state of its robot before it.
    pub fn step(self, local: u32, robots: &Robots) -> Step {
        let robot = RobotId(self.0 & 0xff);
        let peer = RobotId(self.which());
        let datagram = || robots.datagram(self.number()).clone();
        match self.kind() {
            Kind::Activate => Step::Activate(robot),
            Kind::Timer => {
                let armed = robots.state(local).timers(&robots.surroundings);
                Step::Timer(robot, armed[self.which() as usize].0)
            }
            Kind::Deliver => Step::Deliver(datagram()),
            Kind::Duplicate => Step::Duplicate(datagram()),
            Kind::Lose => Step::Lose(datagram()),
            Kind::Crash => Step::Crash(robot),
            Kind::Restart => Step::Restart(robot),
            Kind::RestartDeaf => Step::RestartDeaf(robot),
            Kind::Suspect => Step::Suspect(robot, peer),
            Kind::Trust => Step::Trust(robot, peer),
            Kind::Tick => Step::Tick(robot),
            Kind::TickAll => Step::TickAll,
        }
    }
}
