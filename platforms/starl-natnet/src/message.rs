//! Messages between client and server: a number, the length of the content, and the content.

use crate::bytes::{Reader, put_text};
use crate::{Frame, Version, WITH_LENGTHS};

/// A message. Those that neither of ours needs are left out.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// 0, client: who are you?
    Connect,
    /// 1, server: the answer.
    ServerInfo(ServerInfo),
    /// 4, client: which bodies are there?
    RequestDescriptions,
    /// 5, server: rigid bodies by number and name. Others are left out.
    Descriptions(Vec<(u32, String)>),
    /// 7, server: where the bodies are.
    Frame(Frame),
    /// 10, client: keep sending to me.
    KeepAlive,
    /// 100, server: the request is unknown.
    Unrecognized,
}

/// A server's description of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServerInfo {
    /// The program, e.g. `Motive`.
    pub application: String,
    /// Version of the protocol that it speaks.
    pub version: Version,
    /// How often the clock behind a frame's stamps ticks in a second; 0 if it does not say.
    pub ticks_per_second: u64,
}

/// Descriptions of this kind are of rigid bodies; 0 is of sets of markers.
const RIGID_BODY: u32 = 1;
const MARKER_SET: u32 = 0;

impl Message {
    /// The datagram, in a version of the protocol.
    pub fn encode(&self, version: Version) -> Vec<u8> {
        let mut body = Vec::new();
        let number: u16 = match self {
            Message::Connect => {
                put_text("Ping", &mut body);
                0
            }
            Message::ServerInfo(info) => {
                info.encode(&mut body);
                1
            }
            Message::RequestDescriptions => 4,
            Message::Descriptions(bodies) => {
                encode_descriptions(bodies, version, &mut body);
                5
            }
            Message::Frame(frame) => {
                frame.encode(version, &mut body);
                7
            }
            Message::KeepAlive => 10,
            Message::Unrecognized => 100,
        };
        let mut datagram = Vec::with_capacity(4 + body.len());
        datagram.extend(number.to_le_bytes());
        datagram.extend((body.len() as u16).to_le_bytes());
        datagram.extend(body);
        datagram
    }

    /// The message of a datagram in a version of the protocol; `None` if it is unknown or malformed.
    pub fn decode(datagram: &[u8], version: Version) -> Option<Message> {
        let mut reader = Reader::new(datagram);
        let number = reader.u16()?;
        let length = usize::from(reader.u16()?);
        // Some clients count a closing zero wrongly, so the length is no more than a bound.
        let rest = datagram.get(4..)?;
        let body = &rest[..rest.len().min(length)];
        Some(match number {
            0 => Message::Connect,
            1 => Message::ServerInfo(ServerInfo::decode(body)?),
            4 => Message::RequestDescriptions,
            5 => Message::Descriptions(decode_descriptions(body, version)?),
            7 => Message::Frame(Frame::decode(body, version)?),
            10 => Message::KeepAlive,
            100 => Message::Unrecognized,
            _ => return None,
        })
    }
}

impl ServerInfo {
    fn encode(&self, out: &mut Vec<u8>) {
        let mut name = self.application.clone().into_bytes();
        name.resize(256, 0);
        // The last byte ends the text, however long the name is.
        name[255] = 0;
        out.extend(name);
        let (major, minor) = self.version;
        // The program's own version, then the protocol's.
        out.extend([major, minor, 0, 0, major, minor, 0, 0]);
        out.extend(self.ticks_per_second.to_le_bytes());
        // Data port, whether the server multicasts, and to where: it does not.
        out.extend([0; 7]);
    }

    fn decode(body: &[u8]) -> Option<ServerInfo> {
        let mut reader = Reader::new(body);
        let application = Reader::new(reader.skip(256)?).text()?;
        reader.skip(4)?;
        let &[major, minor, ..] = reader.skip(4)? else {
            return None;
        };
        Some(ServerInfo {
            application,
            version: (major, minor),
            ticks_per_second: reader.u64().unwrap_or(0),
        })
    }
}

fn encode_descriptions(bodies: &[(u32, String)], version: Version, out: &mut Vec<u8>) {
    out.extend((bodies.len() as u32).to_le_bytes());
    for (number, name) in bodies {
        let mut body = Vec::new();
        put_text(name, &mut body);
        body.extend(number.to_le_bytes());
        // No parent, and no offset from one.
        body.extend([0xFF; 4]);
        body.extend([0; 12]);
        // No markers.
        body.extend([0; 4]);
        out.extend(RIGID_BODY.to_le_bytes());
        if version >= WITH_LENGTHS {
            out.extend((body.len() as u32).to_le_bytes());
        }
        out.extend(body);
    }
}

/// Before descriptions told their lengths, those that come after the rigid bodies cannot be skipped; Motive puts
/// only sets of markers before them.
fn decode_descriptions(body: &[u8], version: Version) -> Option<Vec<(u32, String)>> {
    let mut reader = Reader::new(body);
    let count = reader.count(4)?;
    let mut bodies = Vec::new();
    for _ in 0..count {
        let kind = reader.u32()?;
        if version >= WITH_LENGTHS {
            let length = reader.u32()? as usize;
            let mut description = Reader::new(reader.skip(length)?);
            if kind == RIGID_BODY {
                let name = description.text()?;
                bodies.push((description.u32()?, name));
            }
            continue;
        }
        match kind {
            MARKER_SET => {
                reader.text()?;
                for _ in 0..reader.count(1)? {
                    reader.text()?;
                }
            }
            RIGID_BODY => {
                let name = reader.text()?;
                bodies.push((reader.u32()?, name));
                // The parent and the offset from it.
                reader.skip(4 + 12)?;
                let markers = reader.count(16)?;
                reader.skip(16 * markers)?;
                if version >= (4, 0) {
                    for _ in 0..markers {
                        reader.text()?;
                    }
                }
            }
            _ => return Some(bodies),
        }
    }
    Some(bodies)
}
