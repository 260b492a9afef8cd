//! Simulations: requests and answers in JSON, as for the page in a browser, and arrays of numbers.

use crate::numbers;
use crate::robot::{PyMonitor, PyProgram};
use crate::table::{self, Table};
use numpy::PyReadwriteArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use starl_catalog::programs::Registry;
use starl_catalog::service::Service;
use starl_catalog::session::{Disk, Session};
use starl_catalog::{Application, disk};
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Any number of simulations. Calls from several threads wait for each other; engines share nothing.
#[pyclass(frozen, module = "starl._native")]
pub struct Engine(Mutex<Service>);

#[pymethods]
impl Engine {
    /// An engine that knows these programs in Python by their names, beside those of StarL.
    #[new]
    #[pyo3(signature = (programs=None))]
    fn new(py: Python<'_>, programs: Option<BTreeMap<String, Py<PyAny>>>) -> PyResult<Engine> {
        let registry = registry(py, programs)?;
        let service = Service::new(registry).with_disk(Disk(disk::read));
        Ok(Engine(Mutex::new(service)))
    }

    /// Answers a request, both in JSON. Other threads of Python run meanwhile.
    fn request<'py>(&self, py: Python<'py>, request: &[u8]) -> Bound<'py, PyBytes> {
        let answer = py.detach(|| self.service().answer(request));
        PyBytes::new(py, &answer)
    }

    /// The number of robots of a simulation.
    fn robots(&self, py: Python<'_>, simulation: u32) -> PyResult<usize> {
        self.with(py, simulation, |session| {
            session.run().simulation().robots().len()
        })
    }

    /// Writes the poses, the estimates and the velocities of a simulation's robots into arrays, a row a robot. False,
    /// and nothing is written, if an array has another number of rows.
    fn fill(
        &self,
        py: Python<'_>,
        simulation: u32,
        mut poses: PyReadwriteArray2<'_, f64>,
        mut estimates: PyReadwriteArray2<'_, f64>,
        mut velocities: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<bool> {
        let arrays = numbers::Arrays {
            poses: poses.as_slice_mut()?,
            estimates: estimates.as_slice_mut()?,
            velocities: velocities.as_slice_mut()?,
        };
        self.with(py, simulation, |session| {
            arrays.fill(session.run().simulation())
        })
    }

    /// Keeps the records of a simulation without a limit.
    fn keep_all_records(&self, py: Python<'_>, simulation: u32) -> PyResult<()> {
        self.with(py, simulation, |session| {
            session.set_most_records(usize::MAX)
        })
    }

    /// The records of one topic, or of all topics, as a table.
    #[pyo3(signature = (simulation, topic=None))]
    fn records(&self, py: Python<'_>, simulation: u32, topic: Option<&str>) -> PyResult<Table> {
        let topic = topic.map(table::topic).transpose()?;
        let table = self.with(py, simulation, |session| {
            Table::of_records(session.records(), topic)
        })?;
        Ok(table?)
    }
}

impl Engine {
    /// The scenario of a simulation with its programs.
    pub fn application(&self, py: Python<'_>, simulation: u32) -> PyResult<Application> {
        self.with(py, simulation, |session| session.application().clone())
    }

    /// The names that programs of a simulation have everywhere, by those that they have in its scenario.
    pub fn global_names(
        &self,
        py: Python<'_>,
        simulation: u32,
    ) -> PyResult<BTreeMap<String, String>> {
        self.with(py, simulation, |session| session.global_names().clone())
    }

    /// Does something with a simulation. Python's lock is not held meanwhile: a program in Python takes it in the middle
    /// of a request, so a thread that held it while it waits for the engine would wait for ever.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        simulation: u32,
        run: impl FnOnce(&mut Session) -> T + Send,
    ) -> PyResult<T> {
        let done = py.detach(|| self.service().session(simulation).map(run));
        done.map_err(|refused| PyValueError::new_err(refused.message))
    }

    fn service(&self) -> MutexGuard<'_, Service> {
        // Nothing is left half done where a request panics: it is answered by the next one.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The programs that StarL ships with, and these in Python by their names.
pub fn registry(
    py: Python<'_>,
    programs: Option<BTreeMap<String, Py<PyAny>>>,
) -> PyResult<Registry> {
    let mut registry = Registry::default();
    for (name, object) in programs.unwrap_or_default() {
        let monitor = PyMonitor::new(py, &name, &object)?;
        let prototype = PyProgram::new(py, &name, object)?;
        registry = registry.with(&name, "a program in Python", move |_| prototype.clone());
        if let Some(monitor) = monitor {
            registry = registry.watched_by(monitor);
        }
    }
    Ok(registry)
}
