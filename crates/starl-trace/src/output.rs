//! Puts messages into the file.

use crate::WriteError;
use crate::json::Json;
use mcap::records::{MessageHeader, op};
use mcap::write::NoSeek;
use starl_core::Time;
use std::collections::BTreeMap;
use std::io::Write;

/// A chunk is closed before the next message once its messages take this many bytes.
const CHUNK: usize = 1 << 20;

/// Puts messages into the file. Messages carry their place in the whole file as sequence number, so
/// that sorting by time and number gives back the order in which things happened.
pub(crate) struct Output<W: Write> {
    pub mcap: mcap::Writer<NoSeek<W>>,
    /// The message in the making.
    pub json: Json,
    /// The messages that are not yet in a closed chunk, as records of the container.
    pub unfinished: Vec<u8>,
    pub sequence: u32,
}

impl<W: Write> Output<W> {
    /// Writes the message in `json`.
    pub fn send(&mut self, channel: u16, at: Time) -> Result<(), WriteError> {
        let json = core::mem::take(&mut self.json);
        let sent = self.send_bytes(channel, at, json.bytes());
        self.json = json;
        sent
    }

    /// Writes a message with this content.
    pub fn send_bytes(&mut self, channel: u16, at: Time, data: &[u8]) -> Result<(), WriteError> {
        if self.unfinished.len() > CHUNK {
            self.close_chunk()?;
        }
        let header = MessageHeader {
            channel_id: channel,
            sequence: self.sequence,
            log_time: at.0,
            publish_time: at.0,
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.mcap.write_to_known_channel(&header, data)?;
        self.keep(&header, data);
        Ok(())
    }

    /// Keeps a message that is not in a closed chunk yet, in MCAP's format.
    fn keep(&mut self, header: &MessageHeader, data: &[u8]) {
        const HEADER: u64 = 22;
        let kept = &mut self.unfinished;
        kept.push(op::MESSAGE);
        kept.extend((HEADER + data.len() as u64).to_le_bytes());
        kept.extend(header.channel_id.to_le_bytes());
        kept.extend(header.sequence.to_le_bytes());
        kept.extend(header.log_time.to_le_bytes());
        kept.extend(header.publish_time.to_le_bytes());
        kept.extend(data);
    }

    /// Writes the chunk in the making.
    pub fn close_chunk(&mut self) -> Result<(), WriteError> {
        self.mcap.flush()?;
        self.unfinished.clear();
        Ok(())
    }

    /// Writes the view in `json`; skips it if a number in it is not finite.
    pub fn send_view(&mut self, channel: u16, at: Time) -> Result<(), WriteError> {
        if self.json.is_finite() {
            self.send(channel, at)
        } else {
            Ok(())
        }
    }

    /// Makes a channel for JSON with this schema.
    pub fn channel(&mut self, topic: &str, name: &str, text: &str) -> Result<u16, WriteError> {
        let schema = self.mcap.add_schema(name, "jsonschema", text.as_bytes())?;
        Ok(self
            .mcap
            .add_channel(schema, topic, "json", &BTreeMap::new())?)
    }

    pub fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), WriteError> {
        Ok(self.mcap.attach(&mcap::Attachment {
            log_time: 0,
            create_time: 0,
            name: name.into(),
            media_type: media_type.into(),
            data: data.into(),
        })?)
    }
}
