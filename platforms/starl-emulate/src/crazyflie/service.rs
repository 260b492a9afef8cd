//! The answers of an emulated Crazyflie, and the packets that it sends by itself.

use super::flight::Flight;
use super::table::{PARAMETERS, VARIABLES, encode};
use starl_crazyflie::commander::{Order, SetPoint};
use starl_crazyflie::log::{self, Answer, Request};
use starl_crazyflie::packet::{LONGEST, Packet, port};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Its version of the protocol: firmware of 2024.
const VERSION: u8 = 10;

/// Errors of blocks, as in `errno.h`.
const NO_SUCH_BLOCK: u8 = 2;
const TOO_LONG: u8 = 7;
const THERE_ALREADY: u8 = 17;

/// Blocks of the log, and parameters.
#[derive(Debug)]
pub(super) struct Desk {
    blocks: BTreeMap<u8, Block>,
    parameters: [u8; PARAMETERS.len()],
}

#[derive(Debug)]
struct Block {
    /// Type and number of each.
    variables: Vec<(u8, u16)>,
    /// How often it is sent, and when next; none if it is not sent.
    due: Option<(Duration, Instant)>,
}

impl Default for Desk {
    fn default() -> Desk {
        Desk {
            blocks: BTreeMap::new(),
            parameters: PARAMETERS.map(|(_, value)| value),
        }
    }
}

impl Desk {
    /// Takes a datagram; gives the answers.
    pub fn answer(&mut self, datagram: &[u8], flight: &mut Flight) -> Vec<Vec<u8>> {
        let Some(packet) = Packet::decode(datagram) else {
            // Clients send a null packet to find out whether the Crazyflie is there.
            let is_null = datagram.len() == 1;
            return if is_null {
                vec![vec![0xFF]]
            } else {
                Vec::new()
            };
        };
        if let Some(set_point) = SetPoint::decode(&packet) {
            flight.follow(set_point);
        } else if let Some(order) = Order::decode(&packet) {
            flight.obey(order);
        }
        let answer = match packet.port {
            port::LOG => Request::decode(&packet).and_then(|request| self.log(request)),
            port::PARAMETERS => self.parameter(&packet),
            port::MEMORY => memory(&packet),
            port::PLATFORM => version(&packet),
            port::LINK => link(&packet),
            _ => None,
        };
        answer.iter().map(Packet::encode).collect()
    }

    /// The blocks that are due.
    pub fn due(&mut self, flight: &Flight) -> Vec<Vec<u8>> {
        let now = Instant::now();
        let mut due = Vec::new();
        for (&number, block) in &mut self.blocks {
            let Some((period, at)) = &mut block.due else {
                continue;
            };
            if *at > now {
                continue;
            }
            *at = (*at + *period).max(now);
            due.push(values(number, &block.variables, flight).encode().encode());
        }
        due
    }

    fn log(&mut self, request: Request) -> Option<Packet> {
        let done = |request, block, error| Answer::Done {
            request,
            block,
            error,
        };
        let answer = match request {
            Request::Info => Answer::Info {
                count: VARIABLES.len() as u16,
                checksum: 0x5354_4152,
            },
            Request::Item(number) => {
                let (name, kind, _) = VARIABLES.get(usize::from(number))?;
                Answer::Item {
                    number,
                    kind: *kind,
                    name: (*name).to_string(),
                }
            }
            Request::Reset => {
                self.blocks.clear();
                done(log::RESET, 0, 0)
            }
            Request::Create { block, variables } => {
                done(log::CREATE, block, self.create(block, variables))
            }
            Request::Start { block, period } => {
                let period = Duration::from_millis(10 * u64::from(period.max(1)));
                let error = self.schedule(block, Some((period, Instant::now())));
                done(log::START, block, error)
            }
            Request::Stop(block) => done(log::STOP, block, self.schedule(block, None)),
            Request::Delete(block) => {
                let is_gone = self.blocks.remove(&block).is_none();
                done(log::DELETE, block, u8::from(is_gone) * NO_SUCH_BLOCK)
            }
        };
        Some(answer.encode())
    }

    fn create(&mut self, block: u8, variables: Vec<(u8, u16)>) -> u8 {
        let size = |&(kind, number): &(u8, u16)| {
            VARIABLES.get(usize::from(number))?;
            Some(encode(0.0, kind)?.len())
        };
        let length: Option<usize> = variables.iter().map(size).sum();
        // A number and a time stand before the values.
        if length.is_none_or(|length| length > LONGEST - 4) {
            return TOO_LONG;
        }
        if self.blocks.contains_key(&block) {
            return THERE_ALREADY;
        }
        let due = None;
        self.blocks.insert(block, Block { variables, due });
        0
    }

    fn schedule(&mut self, block: u8, due: Option<(Duration, Instant)>) -> u8 {
        match self.blocks.get_mut(&block) {
            Some(block) => {
                block.due = due;
                0
            }
            None => NO_SUCH_BLOCK,
        }
    }

    /// The table of parameters, as that of variables; a parameter is read and written by its number.
    fn parameter(&mut self, packet: &Packet) -> Option<Packet> {
        const BYTE: u8 = 8;
        let content = match (packet.channel, &*packet.content) {
            (0, [3, ..]) => {
                let [low, high] = (PARAMETERS.len() as u16).to_le_bytes();
                vec![3, low, high, b'P', b'A', b'R', b'1']
            }
            (0, [2, low, high, ..]) => {
                let number = usize::from(u16::from_le_bytes([*low, *high]));
                let (name, _) = PARAMETERS.get(number)?;
                let name = name.replacen('.', "\0", 1);
                [&[2, *low, *high, BYTE], name.as_bytes(), &[0]].concat()
            }
            (1, [low, high, ..]) => {
                let number = usize::from(u16::from_le_bytes([*low, *high]));
                vec![*low, *high, 0, *self.parameters.get(number)?]
            }
            (2, [low, high, value, ..]) => {
                let number = usize::from(u16::from_le_bytes([*low, *high]));
                *self.parameters.get_mut(number)? = *value;
                vec![*low, *high, *value]
            }
            _ => return None,
        };
        Some(Packet::new(port::PARAMETERS, packet.channel, &content))
    }
}

fn values(block: u8, variables: &[(u8, u16)], flight: &Flight) -> Answer {
    let value = |&(kind, number): &(u8, u16)| {
        let (_, _, read) = VARIABLES[usize::from(number)];
        encode(read(flight), kind).unwrap_or_default()
    };
    Answer::Values {
        block,
        time_ms: flight.time_ms(),
        values: variables.iter().flat_map(value).collect(),
    }
}

/// There are no memories.
fn memory(packet: &Packet) -> Option<Packet> {
    let is_count = packet.channel == 0 && packet.content.first() == Some(&1);
    is_count.then(|| Packet::new(port::MEMORY, 0, &[1, 0]))
}

fn version(packet: &Packet) -> Option<Packet> {
    let is_version = packet.channel == 1 && packet.content.first() == Some(&0);
    is_version.then(|| Packet::new(port::PLATFORM, 1, &[0, VERSION]))
}

fn link(packet: &Packet) -> Option<Packet> {
    match packet.channel {
        0 => Some(packet.clone()),
        1 => Some(Packet::new(port::LINK, 1, b"Bitcraze Crazyflie\0")),
        _ => None,
    }
}
