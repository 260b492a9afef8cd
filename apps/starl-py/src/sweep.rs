//! Sweeps: plans, single runs, and their rows from any process.

use crate::engine::{Engine, registry};
use crate::table::Table;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::json;
use starl_catalog::disk;
use starl_catalog::programs::Registry;
use starl_core::FileError;
use starl_sim::read::{Inputs, Loader};
use starl_sweep::{Axis, Error, Format, Journal, Measured, Plan, Runner, Seeds, Summary};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A plan and the rows of it that there are.
#[pyclass(frozen, module = "starl._native")]
pub struct Sweep {
    plan: Plan,
    runner: Runner,
    stop: AtomicBool,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    rows: BTreeMap<u64, Measured>,
    journal: Option<Journal>,
}

#[pymethods]
impl Sweep {
    /// A sweep of the scenario of a simulation, which must have the first value of each axis. `axes` are as
    /// `network.loss=0..0.4:9`, `seeds` as `100` or `0..100`.
    #[new]
    #[pyo3(signature = (engine, simulation, axes, seeds, profile=None))]
    fn new(
        py: Python<'_>,
        engine: &Engine,
        simulation: u32,
        axes: Vec<String>,
        seeds: &str,
        profile: Option<&str>,
    ) -> PyResult<Sweep> {
        let application = engine.application(py, simulation)?;
        let plan = py.detach(|| {
            let axes: Result<Vec<Axis>, Error> =
                axes.iter().map(|axis| Axis::parse(axis)).collect();
            let axes = axes?.into_iter().filter(Axis::varies).collect();
            let seeds: Seeds = seeds.parse()?;
            let inputs = &application.resolved().inputs;
            let name = inputs.request.source.name.clone();
            let folder = Path::new(&name).parent().map(Path::to_path_buf);
            let loader = Beside {
                inputs,
                folder: folder.unwrap_or_default(),
            };
            let target = application.scenario().title.clone();
            Plan::new(&target, &application, axes, seeds, profile, &loader)
        });
        let registry = application.registry().clone();
        plan.map(|plan| Sweep::of(plan, registry)).map_err(refused)
    }

    /// The first value of each axis, as fields to set, by which a sweep begins.
    #[staticmethod]
    fn first_values(axes: Vec<String>) -> PyResult<Vec<String>> {
        let axes: Result<Vec<Axis>, Error> = axes.iter().map(|axis| Axis::parse(axis)).collect();
        let axes = axes.map_err(refused)?;
        Ok(axes.iter().filter_map(Axis::first_setting).collect())
    }

    /// The sweep of a plan that `plan` gave, with these programs in Python.
    #[staticmethod]
    #[pyo3(signature = (plan, programs=None))]
    fn from_plan(
        py: Python<'_>,
        plan: &[u8],
        programs: Option<BTreeMap<String, Py<PyAny>>>,
    ) -> PyResult<Sweep> {
        let plan = serde_json::from_slice(plan)
            .map_err(|error| PyValueError::new_err(format!("the plan: {error}")))?;
        Ok(Sweep::of(plan, registry(py, programs)?))
    }

    /// The plan with all its texts, for another process.
    fn plan<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, json!(self.plan).to_string().as_bytes())
    }

    /// Identifies the plan.
    #[getter]
    fn identity(&self) -> String {
        self.plan.identity()
    }

    /// The fields of the axes with their values, the slowest first.
    #[getter]
    fn axes(&self) -> Vec<(String, Vec<String>)> {
        let axes = self.plan.axes().iter();
        axes.map(|axis| (axis.field.clone(), axis.values.clone()))
            .collect()
    }

    /// How many runs there are.
    fn __len__(&self) -> usize {
        self.plan.len() as usize
    }

    /// The numbers of the runs whose rows are not there yet.
    fn open(&self) -> Vec<u64> {
        self.plan.open(&self.state().rows)
    }

    /// Makes one run and gives its row, which depends on the plan and the number alone; None if `stop` ended it.
    fn run<'py>(&self, py: Python<'py>, number: u64) -> PyResult<Option<Bound<'py, PyBytes>>> {
        if number >= self.plan.len() {
            return Err(PyValueError::new_err(format!("there is no run {number}")));
        }
        let row = py.detach(|| self.runner.measure(&self.plan.task(number), &self.stop));
        let row = row.map_err(refused)?;
        Ok(row.map(|row| PyBytes::new(py, json!(row).to_string().as_bytes())))
    }

    /// Ends the runs under way, in other threads, or lets runs begin again.
    fn stop(&self, stop: bool) {
        self.stop.store(stop, Ordering::Relaxed);
    }

    /// Keeps rows as they come in a journal beside the file `out`, after taking those that are in it already.
    fn keep_beside(&self, out: PathBuf) -> PyResult<()> {
        Format::of(&out).map_err(refused)?;
        let path = Journal::path_of(&out);
        let (journal, rows) = Journal::open(&path, &self.plan).map_err(refused)?;
        *self.state() = State {
            rows,
            journal: Some(journal),
        };
        Ok(())
    }

    /// Takes a row that `run` gave, here or elsewhere; false if it was there already.
    fn take(&self, row: &[u8]) -> PyResult<bool> {
        let row: Measured = serde_json::from_slice(row)
            .map_err(|error| PyValueError::new_err(format!("the row: {error}")))?;
        let mut state = self.state();
        if state.rows.contains_key(&row.row.number) {
            return Ok(false);
        }
        if let Some(journal) = &mut state.journal {
            journal.write(&row).map_err(refused)?;
        }
        state.rows.insert(row.row.number, row);
        Ok(true)
    }

    /// Lets another sweep continue with the journal.
    fn release(&self) {
        self.state().journal = None;
    }

    /// Writes the rows that there are into a file.
    fn save(&self, py: Python<'_>, out: PathBuf) -> PyResult<()> {
        let format = Format::of(&out).map_err(refused)?;
        let written = py.detach(|| {
            let table = starl_sweep::Table::of(&self.plan, &self.state().rows);
            let mut content = Vec::new();
            table.write(format, &mut content)?;
            std::fs::write(&out, content)
        });
        let name = out.display();
        written
            .map_err(|error| PyValueError::new_err(format!("{name}: cannot be written: {error}")))
    }

    /// The rows as a table.
    fn table(&self) -> PyResult<Table> {
        let table = starl_sweep::Table::of(&self.plan, &self.state().rows);
        Ok(Table::of_sweep(table)?)
    }

    /// The summary of each combination, in JSON.
    fn summary(&self) -> String {
        json!(Summary::of(&self.plan, &self.state().rows)).to_string()
    }

    /// The metrics: the name of each, and what it is called in a plot.
    #[staticmethod]
    fn metrics() -> Vec<(&'static str, &'static str)> {
        let metrics = starl_sweep::METRICS.iter();
        metrics.map(|metric| (metric.name, metric.label)).collect()
    }
}

impl Sweep {
    fn of(plan: Plan, registry: Registry) -> Sweep {
        Sweep {
            plan,
            runner: Runner::new(registry),
            stop: AtomicBool::new(false),
            state: Mutex::default(),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The files of the scenario as it was read, and others on disk beside it.
struct Beside<'a> {
    inputs: &'a Inputs,
    folder: PathBuf,
}

impl Loader for Beside<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.inputs
            .load(path)
            .or_else(|_| disk::read(&self.folder.join(path)))
    }
}

pub fn refused(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
