//! The log: a table of variables, and blocks of them that the Crazyflie sends again and again.

use crate::packet::{Numbers, Packet, port};

/// Channels of the port.
pub mod channel {
    /// The table.
    pub const TABLE: u8 = 0;
    /// Blocks are made, started and removed.
    pub const BLOCKS: u8 = 1;
    /// Values.
    pub const VALUES: u8 = 2;
}

/// The types of variables, as the wire has them.
pub mod kind {
    /// One byte.
    pub const U8: u8 = 1;
    /// Two bytes.
    pub const U16: u8 = 2;
    /// Two bytes with a sign.
    pub const I16: u8 = 5;
    /// Four bytes.
    pub const F32: u8 = 7;
}

/// A request of a client.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// How many variables there are.
    Info,
    /// The variable with this number.
    Item(u16),
    /// Forget all blocks.
    Reset,
    /// Make a block of variables: the type and number of each.
    Create {
        /// The block's number.
        block: u8,
        /// Its variables.
        variables: Vec<(u8, u16)>,
    },
    /// Send a block from now on.
    Start {
        /// Which one.
        block: u8,
        /// How often, hundredths of a second.
        period: u8,
    },
    /// Stop sending a block.
    Stop(u8),
    /// Remove a block.
    Delete(u8),
}

/// A packet of the Crazyflie.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// How many variables there are, and a checksum of the table.
    Info {
        /// How many.
        count: u16,
        /// The checksum.
        checksum: u32,
    },
    /// A variable.
    Item {
        /// Its number.
        number: u16,
        /// Its type.
        kind: u8,
        /// `group.name`.
        name: String,
    },
    /// A request about blocks was carried out, or refused.
    Done {
        /// The number of the request, e.g. [`CREATE`].
        request: u8,
        /// The block.
        block: u8,
        /// 0, or why not, as in `errno.h`.
        error: u8,
    },
    /// The values of a block.
    Values {
        /// Which one.
        block: u8,
        /// The Crazyflie's time, milliseconds; 24 bits.
        time_ms: u32,
        /// The values, one after the other.
        values: Vec<u8>,
    },
}

/// Numbers of requests.
const ITEM: u8 = 2;
const INFO: u8 = 3;
/// The number of [`Request::Delete`].
pub const DELETE: u8 = 2;
/// The number of [`Request::Stop`].
pub const STOP: u8 = 4;
/// The number of [`Request::Start`].
pub const START: u8 = 3;
/// The number of [`Request::Reset`].
pub const RESET: u8 = 5;
/// The number of [`Request::Create`].
pub const CREATE: u8 = 6;

impl Request {
    /// The packet.
    pub fn encode(&self) -> Packet {
        let (channel, content) = match self {
            Request::Info => (channel::TABLE, vec![INFO]),
            Request::Item(number) => {
                let [low, high] = number.to_le_bytes();
                (channel::TABLE, vec![ITEM, low, high])
            }
            Request::Reset => (channel::BLOCKS, vec![RESET]),
            Request::Create { block, variables } => {
                let mut content = vec![CREATE, *block];
                for (kind, number) in variables {
                    content.push(*kind);
                    content.extend(number.to_le_bytes());
                }
                (channel::BLOCKS, content)
            }
            Request::Start { block, period } => (channel::BLOCKS, vec![START, *block, *period]),
            Request::Stop(block) => (channel::BLOCKS, vec![STOP, *block]),
            Request::Delete(block) => (channel::BLOCKS, vec![DELETE, *block]),
        };
        Packet::new(port::LOG, channel, &content)
    }

    /// Reads a packet; none if it is not such a request.
    pub fn decode(packet: &Packet) -> Option<Request> {
        if packet.port != port::LOG {
            return None;
        }
        match (packet.channel, &*packet.content) {
            (channel::TABLE, [INFO, ..]) => Some(Request::Info),
            (channel::TABLE, [ITEM, low, high, ..]) => {
                Some(Request::Item(u16::from_le_bytes([*low, *high])))
            }
            (channel::BLOCKS, [RESET, ..]) => Some(Request::Reset),
            (channel::BLOCKS, [CREATE, block, variables @ ..]) => {
                let (variables, _) = variables.as_chunks::<3>();
                let variable = |&[kind, low, high]: &[u8; 3]| {
                    // The type in the table is in the high half, and asks for nothing.
                    (kind & 15, u16::from_le_bytes([low, high]))
                };
                Some(Request::Create {
                    block: *block,
                    variables: variables.iter().map(variable).collect(),
                })
            }
            (channel::BLOCKS, [START, block, period, ..]) => Some(Request::Start {
                block: *block,
                period: *period,
            }),
            (channel::BLOCKS, [STOP, block, ..]) => Some(Request::Stop(*block)),
            (channel::BLOCKS, [DELETE, block, ..]) => Some(Request::Delete(*block)),
            _ => None,
        }
    }
}

impl Answer {
    /// The packet.
    pub fn encode(&self) -> Packet {
        let (channel, content) = match self {
            Answer::Info { count, checksum } => {
                let mut content = vec![INFO];
                content.extend(count.to_le_bytes());
                content.extend(checksum.to_le_bytes());
                // How many blocks and variables a client may have.
                content.extend([16, 128]);
                (channel::TABLE, content)
            }
            Answer::Item { number, kind, name } => {
                let mut content = vec![ITEM];
                content.extend(number.to_le_bytes());
                content.push(*kind);
                content.extend(name.replacen('.', "\0", 1).bytes());
                content.push(0);
                (channel::TABLE, content)
            }
            Answer::Done {
                request,
                block,
                error,
            } => (channel::BLOCKS, vec![*request, *block, *error]),
            Answer::Values {
                block,
                time_ms,
                values,
            } => {
                let mut content = vec![*block];
                content.extend(&time_ms.to_le_bytes()[..3]);
                content.extend(values);
                (channel::VALUES, content)
            }
        };
        Packet::new(port::LOG, channel, &content)
    }

    /// Reads a packet; none if it is not such an answer.
    pub fn decode(packet: &Packet) -> Option<Answer> {
        if packet.port != port::LOG {
            return None;
        }
        let mut rest = Numbers(&packet.content);
        let first = rest.u8()?;
        Some(match (packet.channel, first) {
            (channel::TABLE, INFO) => Answer::Info {
                count: rest.u16()?,
                checksum: u32::from(rest.u16()?) | u32::from(rest.u16()?) << 16,
            },
            (channel::TABLE, ITEM) => {
                let (number, kind) = (rest.u16()?, rest.u8()?);
                let mut words = rest.0.split(|byte| *byte == 0);
                let mut word = || std::str::from_utf8(words.next()?).ok();
                let name = format!("{}.{}", word()?, word()?);
                Answer::Item { number, kind, name }
            }
            (channel::BLOCKS, request) => Answer::Done {
                request,
                block: rest.u8()?,
                error: rest.u8()?,
            },
            (channel::VALUES, block) => Answer::Values {
                block,
                time_ms: u32::from(rest.u16()?) | u32::from(rest.u8()?) << 16,
                values: rest.0.to_vec(),
            },
            _ => return None,
        })
    }
}
