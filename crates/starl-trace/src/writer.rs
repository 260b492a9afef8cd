//! Writes a trace: every event as it happens, and views of it for display.

use crate::json::Json;
use crate::output::Output;
use crate::summary::Tally;
use crate::views::{ViewOptions, Views};
use crate::{
    FORMAT_VERSION, Header, Outcome, Summary, Topic, WriteError, encode, header, schema, summary,
    topic,
};
use mcap::write::{Metadata, NoSeek, WriteOptions};
use starl_core::{Event, Record, RobotId, Time};
use std::io::Write;

/// Writes one trace to an output, sequentially; the output is not read or rewound.
///
/// The records are stored exactly, on the topics under `/starl/`. The writer also derives the views that
/// [`ViewOptions`] enable; a reader skips those.
pub struct Writer<W: Write> {
    output: Output<W>,
    views: Views,
    tally: Tally,
    /// The channel of [`Inputs`], once there is one.
    inputs: Option<u16>,
    last: Time,
}

impl<W: Write> Writer<W> {
    /// Starts a trace. The output need not be buffered: it is given about a mebibyte at a time.
    pub fn new(output: W, header: &Header, options: &ViewOptions) -> Result<Writer<W>, WriteError> {
        let mcap = WriteOptions::new()
            .compression(None)
            .disable_seeking(true)
            // Chunks are closed here, so that it is known what the open one holds.
            .chunk_size(None)
            .profile("starl")
            .library(format!("starl {}", header.starl_version))
            .create(NoSeek::new(output))?;
        let mut output = Output {
            mcap,
            json: Json::default(),
            unfinished: Vec::new(),
            sequence: 0,
        };
        write_header(&mut output, header)?;
        for (index, topic) in Topic::ALL.into_iter().enumerate() {
            let text = schema::text(topic);
            let channel = output.channel(topic.name(), schema::name(topic), &text)?;
            debug_assert_eq!(usize::from(channel), index + 1);
        }
        let views = Views::new(&mut output, header, options)?;
        // From now on the file can be read, however early its writer stops.
        output.close_chunk()?;
        Ok(Writer {
            output,
            views,
            tally: Tally::default(),
            inputs: None,
            last: Time::ZERO,
        })
    }

    /// Writes a record.
    pub fn write(&mut self, record: &Record) -> Result<(), WriteError> {
        self.event(record.at, record.robot, &record.event)
    }

    /// Writes an event.
    pub fn event(
        &mut self,
        at: Time,
        robot: Option<RobotId>,
        event: &Event,
    ) -> Result<(), WriteError> {
        let topic = Topic::of(event);
        self.views.advance(&mut self.output, at)?;
        self.output.json.clear();
        encode::event(&mut self.output.json, robot, event);
        if !self.output.json.is_finite() {
            return Err(WriteError::NotFinite {
                at,
                robot,
                topic: topic.name(),
            });
        }
        self.output.send(topic as u16 + 1, at)?;
        self.tally.add(topic);
        self.last = at;
        self.views.event(&mut self.output, at, robot, event)
    }

    /// Makes room for the inputs of robots in this version of their encoding. To be called before the
    /// first record, so that a reader knows from the start that there are some.
    pub fn expect_inputs(&mut self, version: u32) -> Result<(), WriteError> {
        let metadata = [(topic::VERSION.to_string(), version.to_string())].into();
        let output = &mut self.output.mcap;
        let schema = output.add_schema(topic::INPUTS_SCHEMA, "", b"")?;
        let channel =
            output.add_channel(schema, topic::INPUTS, topic::INPUTS_ENCODING, &metadata)?;
        self.inputs = Some(channel);
        self.output.close_chunk()
    }

    /// Writes inputs of robots from `at` on, encoded. Nothing happens unless
    /// [`Writer::expect_inputs`] was called.
    pub fn inputs(&mut self, at: Time, data: &[u8]) -> Result<(), WriteError> {
        let Some(channel) = self.inputs else {
            return Ok(());
        };
        self.output.send_bytes(channel, at, data)?;
        self.tally.inputs += 1;
        self.last = self.last.max(at);
        Ok(())
    }

    /// The messages that were not written to the output yet, as records of the container. Appended to the output, they
    /// make a readable trace up to here; the next bytes of the writer replace them, and are longer. The output is
    /// flushed whenever it ends with a complete record.
    pub fn unfinished(&self) -> &[u8] {
        &self.output.unfinished
    }

    /// How many records were written.
    pub fn records(&self) -> u64 {
        self.tally.total()
    }

    /// Writes the end record and the file's index, and gives the output back. A trace that is dropped
    /// instead reads as cut short.
    pub fn finish(mut self, outcome: &Outcome) -> Result<W, WriteError> {
        self.views.finish(&mut self.output)?;
        let end = Summary {
            outcome: outcome.clone(),
            records: self.tally.total(),
            counts: self.tally.counts(),
            inputs: self.tally.inputs,
        };
        self.output.json.clear();
        summary::encode(&mut self.output.json, &end);
        // A later time than any record's keeps it last for readers that sort by time.
        let at = Time(outcome.end.0.max(self.last.0));
        self.output.send(Topic::Summary as u16 + 1, at)?;
        self.output.mcap.finish()?;
        let mut output = self.output.mcap.into_inner().into_inner();
        output.flush().map_err(|error| WriteError::Output {
            what: error.to_string(),
        })?;
        Ok(output)
    }
}

fn write_header<W: Write>(output: &mut Output<W>, header: &Header) -> Result<(), WriteError> {
    let metadata = [
        ("format_version", FORMAT_VERSION.to_string()),
        ("starl_version", header.starl_version.clone()),
        ("program", header.program.clone()),
        ("seed", header.seed.to_string()),
    ];
    output.mcap.write_metadata(&Metadata {
        name: topic::METADATA.into(),
        metadata: metadata
            .into_iter()
            .map(|(key, value)| (key.to_string(), value))
            .collect(),
    })?;
    output.attach(
        topic::SCENARIO,
        "application/toml",
        header.scenario.as_bytes(),
    )?;
    for (name, text) in &header.files {
        output.attach(
            &format!("{}{name}", topic::FILES),
            "text/plain",
            text.as_bytes(),
        )?;
    }
    if !header.setting.is_empty() {
        output.attach(
            topic::SETTING,
            "application/json",
            header.setting.as_bytes(),
        )?;
    }
    let mut json = Json::default();
    header::encode_world(&mut json, header);
    if !json.is_finite() {
        return Err(WriteError::NotFinite {
            at: Time::ZERO,
            robot: None,
            topic: topic::WORLD,
        });
    }
    output.attach(topic::WORLD, "application/json", json.bytes())
}
