//! How a run ended: the last record of a whole trace.

use crate::error::Malformed;
use crate::json::Json;
use crate::{Topic, decode};
use serde::Deserialize;
use starl_core::Time;
use std::collections::BTreeMap;

/// The result of a run, as its host reports it at the end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// How it ended, e.g. `finished`.
    pub outcome: String,
    /// The hash of all events, see [`starl_core::Digest::value`].
    pub digest: u64,
    /// When it ended.
    pub end: Time,
}

/// The end of a trace. A trace without one was cut short.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// The result that the host reported.
    pub outcome: Outcome,
    /// How many records there are.
    pub records: u64,
    /// How many there are on each topic that has any, by the topic's name without `/starl/`.
    pub counts: BTreeMap<String, u64>,
    /// The number of messages with inputs of robots, which are not records.
    pub inputs: u64,
}

/// Writes the summary's message.
pub(crate) fn encode(json: &mut Json, summary: &Summary) {
    let Outcome {
        outcome,
        digest,
        end,
    } = &summary.outcome;
    json.mark(b'{').key("outcome").string(outcome);
    json.key("digest").string(&format!("{digest:016x}"));
    json.key("end_ns").integer(end.0);
    json.key("records").integer(summary.records);
    json.key("counts").mark(b'[');
    for (topic, count) in &summary.counts {
        json.item().mark(b'{').key("topic").string(topic);
        json.key("records").integer(*count).mark(b'}');
    }
    json.mark(b']');
    if summary.inputs > 0 {
        json.key("inputs").integer(summary.inputs);
    }
    json.mark(b'}');
}

/// Reads the summary's message.
pub(crate) fn decode(text: &[u8]) -> Result<Summary, Malformed> {
    #[derive(Deserialize)]
    struct Count {
        topic: String,
        records: u64,
    }
    #[derive(Deserialize)]
    struct Message {
        outcome: String,
        digest: String,
        end_ns: Time,
        records: u64,
        counts: Vec<Count>,
        #[serde(default)]
        inputs: u64,
    }
    let message: Message = decode::parse(text)?;
    let digest = u64::from_str_radix(&message.digest, 16)
        .map_err(|_| "the digest is not a hexadecimal number")?;
    Ok(Summary {
        outcome: Outcome {
            outcome: message.outcome,
            digest,
            end: message.end_ns,
        },
        records: message.records,
        counts: message
            .counts
            .into_iter()
            .map(|Count { topic, records }| (topic, records))
            .collect(),
        inputs: message.inputs,
    })
}

/// Counts records by topic.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    records: [u64; Topic::ALL.len()],
    /// Messages with inputs of robots.
    pub inputs: u64,
}

impl Tally {
    pub fn add(&mut self, topic: Topic) {
        self.records[topic as usize] += 1;
    }

    pub fn total(&self) -> u64 {
        self.records.iter().sum()
    }

    pub fn counts(&self) -> BTreeMap<String, u64> {
        (Topic::ALL.into_iter().zip(self.records))
            .filter(|&(_, count)| count > 0)
            .map(|(topic, count)| {
                (
                    topic.name()[crate::topic::PREFIX.len()..].to_string(),
                    count,
                )
            })
            .collect()
    }
}
