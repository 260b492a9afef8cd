//! The driver's part of the log: finds the variables that it needs in the table, and has them sent.

use crate::log::{self, Answer, Request, kind};
use crate::packet::{Numbers, Packet};
use starl_core::Point;
use std::time::{Duration, Instant};

/// The variables, in the order in which they are sent. Together they are not longer than the 26 bytes of a block.
const VARIABLES: [(&str, u8); 9] = [
    ("stateEstimate.x", kind::F32),
    ("stateEstimate.y", kind::F32),
    ("stateEstimate.yaw", kind::F32),
    ("stateEstimateZ.z", kind::I16),
    ("stateEstimateZ.vx", kind::I16),
    ("stateEstimateZ.vy", kind::I16),
    ("stateEstimateZ.vz", kind::I16),
    ("pm.batteryLevel", kind::U8),
    ("supervisor.info", kind::U16),
];

/// Bytes of their values.
const LENGTH: usize = 23;
/// The number of the driver's block.
const BLOCK: u8 = 1;
/// Values come this often, hundredths of a second.
const PERIOD: u8 = 5;
/// A request is repeated after this.
const REPEAT: Duration = Duration::from_millis(150);

/// Bits of `supervisor.info`.
const ARMED: u16 = 1 << 1;
const FLYING: u16 = 1 << 4;
const TUMBLED: u16 = 1 << 5;
const LOCKED: u16 = 1 << 6;
const CRASHED: u16 = 1 << 7;

/// The state that a Crazyflie reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Where it believes to be, metres; its own frame.
    pub position: Point,
    /// The same frame, metres per second.
    pub velocity: Point,
    /// Radians, positive to the left.
    pub yaw: f64,
    /// Charge of its battery, 0 to 1.
    pub battery: f64,
    info: u16,
}

impl State {
    pub fn armed(&self) -> bool {
        self.info & ARMED != 0
    }

    pub fn flying(&self) -> bool {
        self.info & FLYING != 0
    }

    /// Why it cannot fly.
    pub fn fault(&self) -> Option<&'static str> {
        match self.info {
            info if info & LOCKED != 0 => Some("is locked after a fault; restart it"),
            info if info & CRASHED != 0 => Some("has crashed; put it on its feet and restart it"),
            info if info & TUMBLED != 0 => Some("lies on its side; put it on its feet"),
            _ => None,
        }
    }

    fn read(values: &[u8]) -> Option<State> {
        if values.len() != LENGTH {
            return None;
        }
        let mut values = Numbers(values);
        let (x, y) = (values.f32()?, values.f32()?);
        let yaw = f64::from(values.f32()?).to_radians();
        let mut thousandths = || Some(0.001 * f64::from(values.i16()?));
        let z = thousandths()?;
        let velocity = Point::new(thousandths()?, thousandths()?, thousandths()?);
        Some(State {
            position: Point::new(x.into(), y.into(), z),
            velocity,
            yaw,
            battery: (0.01 * f64::from(values.u8()?)).clamp(0.0, 1.0),
            info: values.u16()?,
        })
    }
}

/// How far the log is set up.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Info,
    Item { number: u16, count: u16 },
    Reset,
    Create,
    Start,
    Sending,
}

/// The content of a packet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum News {
    /// The log is set up a step further.
    Progress,
    /// How the Crazyflie is.
    State(State),
}

/// The log of one Crazyflie.
#[derive(Debug)]
pub struct Telemetry {
    phase: Phase,
    /// The numbers of [`VARIABLES`], as far as they are found.
    numbers: [Option<u16>; VARIABLES.len()],
    asked: Option<Instant>,
}

impl Telemetry {
    pub fn new() -> Telemetry {
        Telemetry {
            phase: Phase::Info,
            numbers: [None; VARIABLES.len()],
            asked: None,
        }
    }

    /// A variable that the Crazyflie does not have.
    pub fn missing(&self) -> Option<&'static str> {
        let is_known = matches!(self.phase, Phase::Info | Phase::Item { .. });
        let missing = self.numbers.iter().position(Option::is_none);
        missing
            .filter(|_| !is_known)
            .map(|index| VARIABLES[index].0)
    }

    /// The request that is due.
    pub fn request(&mut self) -> Option<Packet> {
        if self.asked.is_some_and(|at| at.elapsed() < REPEAT) || self.missing().is_some() {
            return None;
        }
        let request = match self.phase {
            Phase::Info => Request::Info,
            Phase::Item { number, .. } => Request::Item(number),
            Phase::Reset => Request::Reset,
            Phase::Create => {
                let kinds = VARIABLES.iter().map(|(_, kind)| *kind);
                let variables = kinds.zip(self.numbers.iter().map(|number| number.unwrap_or(0)));
                Request::Create {
                    block: BLOCK,
                    variables: variables.collect(),
                }
            }
            Phase::Start => Request::Start {
                block: BLOCK,
                period: PERIOD,
            },
            Phase::Sending => return None,
        };
        self.asked = Some(Instant::now());
        Some(request.encode())
    }

    /// Takes a packet; `None` if it says nothing that is waited for.
    pub fn take(&mut self, packet: &Packet) -> Option<News> {
        let phase = match (Answer::decode(packet)?, self.phase) {
            (Answer::Info { count, .. }, Phase::Info) => Phase::Item { number: 0, count },
            (
                Answer::Item { number, name, .. },
                Phase::Item {
                    number: asked,
                    count,
                },
            ) if number == asked => {
                let wanted = VARIABLES.iter().position(|(variable, _)| *variable == name);
                if let Some(index) = wanted {
                    self.numbers[index] = Some(number);
                }
                let is_last = number + 1 >= count || self.numbers.iter().all(Option::is_some);
                match is_last {
                    true => Phase::Reset,
                    false => Phase::Item {
                        number: number + 1,
                        count,
                    },
                }
            }
            (
                Answer::Done {
                    request: log::RESET,
                    ..
                },
                Phase::Reset,
            ) => Phase::Create,
            (
                Answer::Done {
                    request: log::CREATE,
                    error: 0,
                    ..
                },
                Phase::Create,
            ) => Phase::Start,
            (
                Answer::Done {
                    request: log::START,
                    error: 0,
                    ..
                },
                Phase::Start,
            ) => Phase::Sending,
            (
                Answer::Values {
                    block: BLOCK,
                    values,
                    ..
                },
                Phase::Start | Phase::Sending,
            ) => {
                let state = State::read(&values)?;
                self.phase = Phase::Sending;
                return Some(News::State(state));
            }
            _ => return None,
        };
        self.phase = phase;
        // The next request need not wait.
        self.asked = None;
        Some(News::Progress)
    }
}
