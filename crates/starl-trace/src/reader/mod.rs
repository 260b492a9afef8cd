//! Reads a trace record by record, in bounded memory.

mod opening;

use crate::container::{Container, RawRecord};
use crate::error::{Malformed, Progress};
use crate::fields::Fields;
use crate::summary::Tally;
use crate::{Header, Summary, Topic, TraceError, decode, summary, topic};
use mcap::records::op;
use starl_core::{Record, Time};
use std::collections::BTreeMap;
use std::io::Read;

/// Reads a trace: first its header, then, as an iterator, its records. The iterator ends after the
/// last record of a whole trace, or with an error; then [`Reader::summary`] says how the run ended.
///
/// Holds one chunk of the file at a time, about a mebibyte.
pub struct Reader<R> {
    container: Container<R>,
    header: Header,
    /// The topic of each of our channels; other channels are views.
    channels: BTreeMap<u16, Topic>,
    /// The channel of [`Inputs`], and the version of their encoding.
    inputs: Option<(u16, u32)>,
    tally: Tally,
    summary: Option<Summary>,
    finished: bool,
}

impl<R: Read> Reader<R> {
    /// Reads the header. Wrap a file in a [`std::io::BufReader`].
    pub fn new(source: R) -> Result<Reader<R>, TraceError> {
        let mut container = Container::new(source)?;
        let header = opening::read(&mut container)?;
        Ok(Reader {
            container,
            header,
            channels: BTreeMap::new(),
            inputs: None,
            tally: Tally::default(),
            summary: None,
            finished: false,
        })
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How the run ended; none until the last record was read.
    pub fn summary(&self) -> Option<&Summary> {
        self.summary.as_ref()
    }

    /// The progress of reading.
    pub fn progress(&self) -> Progress {
        self.container.progress
    }

    /// The version of the encoding of [`Inputs`]; `None` if the trace holds none. It is known once the first
    /// record or input was read.
    pub fn inputs_version(&self) -> Option<u32> {
        self.inputs.map(|(_, version)| version)
    }

    /// The next record or message of inputs; `None` after the last of a whole trace or after an error.
    pub fn next_item(&mut self) -> Option<Result<Item, TraceError>> {
        if self.finished {
            return None;
        }
        let next = self.read_item().transpose();
        self.finished = !matches!(next, Some(Ok(_)));
        next
    }

    fn read_item(&mut self) -> Result<Option<Item>, TraceError> {
        loop {
            let Some(RawRecord { opcode, body }) = self.container.next()? else {
                return match self.summary {
                    Some(_) => Ok(None),
                    None => Err(TraceError::NoEnd(self.container.progress)),
                };
            };
            match opcode {
                op::CHANNEL => {
                    let known = channel(body, &mut self.channels, &mut self.inputs);
                    known.map_err(|what| self.container.damaged(what.0))?;
                }
                op::MESSAGE => {
                    let Some((id, at, data)) = message(body) else {
                        return Err(self.container.damaged("a message is cut short"));
                    };
                    let topic = self.channels.get(&id).copied();
                    let is_input = self.inputs.is_some_and(|(channel, _)| channel == id);
                    let read = match topic {
                        None if !is_input => continue,
                        _ if self.summary.is_some() => {
                            Err("there are messages after the end record".into())
                        }
                        None => {
                            self.tally.inputs += 1;
                            let data = data.to_vec();
                            return Ok(Some(Item::Inputs(Inputs { at, data })));
                        }
                        Some(Topic::Summary) => summary::decode(data).and_then(|end| {
                            self.summary = Some(end);
                            self.check_counts()
                        }),
                        Some(topic) => decode::event(topic, data).map(|(robot, event)| {
                            self.tally.add(topic);
                            Some(Record { at, robot, event })
                        }),
                    };
                    match read {
                        Ok(None) => {}
                        Ok(Some(record)) => {
                            self.container.progress.records += 1;
                            self.container.progress.last = Some(at);
                            return Ok(Some(Item::Record(record)));
                        }
                        Err(Malformed(what)) => {
                            let name = topic.map_or(topic::INPUTS, Topic::name);
                            let (progress, topic) = (self.container.progress, name.into());
                            return Err(TraceError::Message {
                                progress,
                                topic,
                                at,
                                what,
                            });
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// Compares what was read with what the end record says was written.
    fn check_counts(&self) -> Result<Option<Record>, Malformed> {
        let read = self.tally.total();
        match &self.summary {
            Some(end) if end.records != read || end.counts != self.tally.counts() => {
                Err(Malformed(format!(
                    "the end record counts {} records, but {read} were read",
                    end.records
                )))
            }
            Some(end) if end.inputs != self.tally.inputs => Err(Malformed(format!(
                "the end record counts {} messages of inputs, but {} were read",
                end.inputs, self.tally.inputs
            ))),
            _ => Ok(None),
        }
    }
}

/// Something that a trace holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Something that happened.
    Record(Record),
    /// The inputs of robots' software.
    Inputs(Inputs),
}

/// A message with inputs of robots, encoded as a journal of `starl-host`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inputs {
    /// The time of the first of them.
    pub at: Time,
    /// The content.
    pub data: Vec<u8>,
}

/// Returns the records alone.
impl<R: Read> Iterator for Reader<R> {
    type Item = Result<Record, TraceError>;

    fn next(&mut self) -> Option<Result<Record, TraceError>> {
        loop {
            match self.next_item()? {
                Ok(Item::Record(record)) => return Some(Ok(record)),
                Ok(Item::Inputs(_)) => {}
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

/// A whole trace in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The header.
    pub header: Header,
    /// All records in the order in which they were written.
    pub records: Vec<Record>,
    /// How the run ended.
    pub summary: Summary,
}

/// Reads a whole trace from memory; the first thing wrong with it is an error.
pub fn read(bytes: &[u8]) -> Result<Trace, TraceError> {
    let mut reader = Reader::new(bytes)?;
    let records = reader
        .by_ref()
        .collect::<Result<Vec<Record>, TraceError>>()?;
    let Reader {
        header, summary, ..
    } = reader;
    Ok(Trace {
        header,
        records,
        summary: summary.unwrap_or_default(),
    })
}

/// Notes which topic a channel carries, if it is one of ours. Topics that are not known are left out: if one
/// of them carries records, the counts of the end record tell.
fn channel(
    body: &[u8],
    channels: &mut BTreeMap<u16, Topic>,
    inputs: &mut Option<(u16, u32)>,
) -> Result<(), Malformed> {
    let mut fields = Fields(body);
    let parts = (|| {
        let (id, _schema) = (fields.u16()?, fields.u16()?);
        Some((id, fields.text()?, fields.text()?))
    })();
    let Some((id, name, encoding)) = parts else {
        return Err("a channel record is cut short".into());
    };
    if name == topic::INPUTS {
        let pairs = fields.pairs().unwrap_or_default();
        let version = pairs.iter().find(|(key, _)| *key == topic::VERSION);
        let version = version.and_then(|(_, version)| version.parse().ok());
        let version =
            version.ok_or_else(|| Malformed(format!("the topic `{name}` has no version")))?;
        // Channels are repeated at the end of the file.
        return match inputs.replace((id, version)) {
            Some(before) if before != (id, version) => {
                Err(Malformed(format!("`{name}` has two channels")))
            }
            _ => Ok(()),
        };
    }
    let Some(topic) = Topic::named(name) else {
        return Ok(());
    };
    if encoding != "json" {
        return Err(Malformed(format!(
            "the topic `{name}` is not in JSON but `{encoding}`"
        )));
    }
    if channels
        .insert(id, topic)
        .is_some_and(|before| before != topic)
    {
        return Err(Malformed(format!("channel {id} has two topics")));
    }
    Ok(())
}

/// The channel, time and data of a message.
fn message(body: &[u8]) -> Option<(u16, Time, &[u8])> {
    let mut fields = Fields(body);
    let (id, _sequence) = (fields.u16()?, fields.u32()?);
    let (at, _published) = (fields.u64()?, fields.u64()?);
    Some((id, Time(at), fields.0))
}
