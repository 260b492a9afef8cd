//! Traces of any host, read from their files.

use crate::table::{self, Table};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::{Value, json};
use starl_core::{Event, Record};
use starl_trace::{Header, Reader, TraceError};
use std::fs::File;
use std::io::{self, BufReader};
use thiserror::Error;

/// A trace that was read.
#[pyclass(frozen, module = "starl._native")]
pub struct Trace {
    header: Header,
    records: Vec<Record>,
    end: Value,
}

#[pymethods]
impl Trace {
    /// Reads a trace. One that is cut off or damaged is read as far as it goes; `end` says so.
    #[new]
    fn new(py: Python<'_>, path: &str) -> PyResult<Trace> {
        py.detach(|| read(path))
            .map_err(|reason| PyValueError::new_err(format!("{path}: {reason}")))
    }

    /// How the run ended, in JSON: `outcome`, `digest` and `end_ns`; or `error`, why the trace ends before.
    #[getter]
    fn end(&self) -> String {
        self.end.to_string()
    }

    /// The start of the run and how it was steered, in JSON, as the request `open_recorded` takes it.
    #[getter]
    fn recorded(&self) -> String {
        let steered = self
            .records
            .iter()
            .filter_map(|record| match &record.event {
                Event::Intervention(what) => Some((record.at.0, what)),
                _ => None,
            });
        let recorded = json!({
            "scenario": self.header.scenario,
            "files": self.header.files,
            "interventions": steered.collect::<Vec<_>>(),
        });
        recorded.to_string()
    }

    /// The header, in JSON: `program`, `seed` as text, the `robots` with their names and models, and the world.
    #[getter]
    fn header(&self) -> String {
        let robot = |robot: &starl_trace::RobotEntry| json!({ "id": robot.id.index(), "name": robot.name, "model": robot.model });
        let robots: Vec<Value> = self.header.robots.iter().map(robot).collect();
        let obstacle = |obstacle| json!({ "obstacle": obstacle });
        let obstacles: Vec<Value> = self.header.obstacles.iter().map(obstacle).collect();
        let header = json!({
            "program": self.header.program,
            "seed": self.header.seed.to_string(),
            "robots": robots,
            "world": { "obstacles": obstacles, "way_points": self.header.way_points },
        });
        header.to_string()
    }

    fn __len__(&self) -> usize {
        self.records.len()
    }

    /// The records of one topic, or of all topics, as a table.
    #[pyo3(signature = (topic=None))]
    fn records(&self, py: Python<'_>, topic: Option<&str>) -> PyResult<Table> {
        let topic = topic.map(table::topic).transpose()?;
        Ok(py.detach(|| Table::of_records(self.records.iter(), topic))?)
    }
}

/// Why a trace cannot be read at all.
#[derive(Debug, Error)]
enum Unreadable {
    #[error("cannot be read: {0}")]
    File(#[from] io::Error),
    #[error(transparent)]
    Trace(#[from] TraceError),
}

fn read(path: &str) -> Result<Trace, Unreadable> {
    let mut reader = Reader::new(BufReader::new(File::open(path)?))?;
    let mut records = Vec::new();
    let mut end = Value::Null;
    for record in &mut reader {
        match record {
            Ok(record) => records.push(record),
            Err(error) => end = json!({ "error": error.to_string() }),
        }
    }
    if let Some(summary) = reader.summary() {
        end = json!({
            "outcome": summary.outcome.outcome,
            "digest": format!("{:016x}", summary.outcome.digest),
            "end_ns": summary.outcome.end.0,
        });
    }
    Ok(Trace {
        header: reader.header().clone(),
        records,
        end,
    })
}
