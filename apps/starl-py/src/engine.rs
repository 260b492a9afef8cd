//! Simulations: requests and answers in JSON, as for the page in a browser, and arrays of numbers.

use crate::table::{self, Table};
use crate::{disk, numbers};
use numpy::PyReadwriteArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_catalog::service::Service;
use starl_catalog::session::Disk;
use starl_sim::read::Loader;
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Any number of simulations. Calls from several threads wait for each other; engines share nothing.
#[pyclass(frozen, module = "starl._native")]
pub struct Engine(Mutex<Service>);

#[pymethods]
impl Engine {
    #[new]
    fn new() -> Engine {
        let service = Service::new(Registry::default()).with_disk(Disk(disk::read));
        Engine(Mutex::new(service))
    }

    /// Answers a request, both in JSON. Other threads of Python run meanwhile.
    fn request<'py>(&self, py: Python<'py>, request: &[u8]) -> Bound<'py, PyBytes> {
        let answer = py.detach(|| self.service().answer(request));
        PyBytes::new(py, &answer)
    }

    /// The number of robots of a simulation.
    fn robots(&self, simulation: u32) -> PyResult<usize> {
        let mut service = self.service();
        let session = service.session(simulation).map_err(PyValueError::new_err)?;
        Ok(session.run().simulation().robots().len())
    }

    /// Writes the poses, the estimates and the velocities of a simulation's robots into arrays, a row a robot. False,
    /// and nothing is written, if an array has another number of rows.
    fn fill(
        &self,
        simulation: u32,
        mut poses: PyReadwriteArray2<'_, f64>,
        mut estimates: PyReadwriteArray2<'_, f64>,
        mut velocities: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<bool> {
        let mut service = self.service();
        let session = service.session(simulation).map_err(PyValueError::new_err)?;
        let arrays = numbers::Arrays {
            poses: poses.as_slice_mut()?,
            estimates: estimates.as_slice_mut()?,
            velocities: velocities.as_slice_mut()?,
        };
        Ok(arrays.fill(session.run().simulation()))
    }

    /// Keeps the records of a simulation without a limit.
    fn keep_all_records(&self, simulation: u32) -> PyResult<()> {
        let mut service = self.service();
        let session = service.session(simulation).map_err(PyValueError::new_err)?;
        session.set_most_records(usize::MAX);
        Ok(())
    }

    /// The files that the scenario of a simulation names, by their paths from its folder.
    fn inputs(&self, simulation: u32) -> PyResult<BTreeMap<String, Vec<u8>>> {
        let application = self.application(simulation)?;
        let inputs = &application.resolved().inputs;
        let files = inputs
            .files
            .keys()
            .map(|path| Ok((path.clone(), inputs.load(path)?)));
        files
            .collect::<Result<_, String>>()
            .map_err(PyValueError::new_err)
    }

    /// The records of one topic, or of all topics, as a table.
    #[pyo3(signature = (simulation, topic=None))]
    fn records(&self, py: Python<'_>, simulation: u32, topic: Option<&str>) -> PyResult<Table> {
        let topic = topic.map(table::topic).transpose()?;
        py.detach(|| {
            let mut service = self.service();
            let session = service.session(simulation)?;
            Table::of_records(session.records(), topic)
        })
        .map_err(PyValueError::new_err)
    }
}

impl Engine {
    /// The scenario of a simulation with its programs.
    pub fn application(&self, simulation: u32) -> PyResult<Application> {
        let mut service = self.service();
        let session = service.session(simulation).map_err(PyValueError::new_err)?;
        Ok(session.application().clone())
    }

    fn service(&self) -> MutexGuard<'_, Service> {
        // Nothing is left half done where a request panics: it is answered by the next one.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
