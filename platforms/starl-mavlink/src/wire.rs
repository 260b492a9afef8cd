//! MAVLink 2 messages in datagrams. Messages with a wrong checksum, of unknown kinds or of MAVLink 1 are left out.

use mavlink::dialects::common::MavMessage;
use mavlink::{MAVLinkV2MessageRaw, MavHeader, MavlinkVersion, Message};

const START: u8 = 0xFD;
/// Bytes of a message besides its content: header and checksum.
const FRAME: usize = 12;
/// Bytes of a signature at the end of a message that has one.
const SIGNATURE: usize = 13;
/// The one bit of a message's flags that is understood here.
const SIGNED: u8 = 1;

/// Appends a message.
pub fn encode(header: MavHeader, message: &MavMessage, out: &mut Vec<u8>) {
    mavlink::write_v2_msg(out, header, message).expect("a vector takes any number of bytes");
}

/// The messages of a datagram, with their senders.
pub fn decode(datagram: &[u8]) -> Vec<(MavHeader, MavMessage)> {
    let mut found = Vec::new();
    let mut rest = datagram;
    while let Some(start) = rest.iter().position(|&byte| byte == START) {
        rest = &rest[start..];
        match first(rest) {
            Some((length, message)) => {
                found.extend(message);
                rest = &rest[length..];
            }
            None => rest = &rest[1..],
        }
    }
    found
}

/// The length of the message with which the bytes begin, and the message if its kind is known.
fn first(bytes: &[u8]) -> Option<(usize, Option<(MavHeader, MavMessage)>)> {
    let (&content, &flags) = (bytes.get(1)?, bytes.get(2)?);
    if flags & !SIGNED != 0 {
        return None;
    }
    let signature = if flags & SIGNED != 0 { SIGNATURE } else { 0 };
    let length = FRAME + usize::from(content) + signature;
    let frame = bytes.get(..length)?;
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.as_mut_slice()[..length].copy_from_slice(frame);
    if !raw.has_valid_crc::<MavMessage>() {
        return None;
    }
    let header = MavHeader {
        system_id: raw.system_id(),
        component_id: raw.component_id(),
        sequence: raw.sequence(),
    };
    let message = MavMessage::parse(MavlinkVersion::V2, raw.message_id(), raw.payload()).ok();
    Some((length, message.map(|message| (header, message))))
}
