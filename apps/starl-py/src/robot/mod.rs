//! Programs of robots that are written in Python.
//!
//! A program is an object of a subclass of `starl.RobotProgram`. Each robot has a deep copy of its own, and so has each
//! snapshot. An exception makes the program fail, with the exception as the reason.

mod handle;
mod primitive;

pub use handle::Handle;
pub use primitive::Primitive;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use starl_core::{Message, Primitives, Program, Robot};

/// The program of a robot.
pub struct PyProgram {
    object: Py<PyAny>,
    /// Its primitives, in the order in which the object holds them.
    primitives: Vec<Py<Primitive>>,
    /// Why it cannot go on.
    broken: Option<String>,
}

impl PyProgram {
    /// The program that an object describes, with primitives that have their names.
    pub fn new(py: Python<'_>, object: Py<PyAny>) -> PyResult<PyProgram> {
        let primitives = object.call_method0(py, "_primitives")?.extract(py)?;
        Ok(PyProgram {
            object,
            primitives,
            broken: None,
        })
    }

    fn copy(&self, py: Python<'_>) -> PyResult<PyProgram> {
        let copied = py
            .import("copy")?
            .call_method1("deepcopy", (&self.object,))?;
        PyProgram::new(py, copied.unbind())
    }

    /// Calls a method of the object with the robot and other arguments.
    fn call(
        &self,
        robot: &mut Robot<'_>,
        method: &str,
        arguments: impl FnOnce(Python<'_>, Py<Handle>) -> PyResult<Py<PyTuple>>,
    ) {
        if let Some(reason) = &self.broken {
            return robot.fail(reason.clone());
        }
        let called = Python::attach(|py| {
            let handle = Py::new(py, Handle::of(robot)).map_err(|error| text(py, &error))?;
            let called = arguments(py, handle.clone_ref(py))
                .and_then(|arguments| self.object.call_method1(py, method, arguments.bind(py)));
            handle.get().end(robot);
            called.map(|_| ()).map_err(|error| text(py, &error))
        });
        if let Err(reason) = called {
            robot.fail(reason);
        }
    }
}

impl Clone for PyProgram {
    fn clone(&self) -> PyProgram {
        Python::attach(|py| {
            self.copy(py).unwrap_or_else(|error| PyProgram {
                object: self.object.clone_ref(py),
                primitives: Vec::new(),
                broken: Some(format!(
                    "the program cannot be copied: {}",
                    text(py, &error)
                )),
            })
        })
    }
}

impl Primitives for PyProgram {
    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn starl_core::Primitive)) {
        for primitive in &self.primitives {
            primitive.get().visit(|primitive| visit(primitive));
        }
    }
}

impl Program for PyProgram {
    fn start(&mut self, robot: &mut Robot<'_>) {
        self.call(robot, "_start", |py, handle| {
            Ok((handle,).into_pyobject(py)?.unbind())
        });
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.call(robot, "_activate", |py, handle| {
            Ok((handle,).into_pyobject(py)?.unbind())
        });
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from.index();
        let mut primitives = self.primitives.iter().map(|primitive| primitive.get());
        let raw = primitives
            .find(|primitive| primitive.visit(|primitive| primitive.port()) == message.port)
            .is_some_and(Primitive::passes_raw);
        let content = match raw {
            true => Some(message.payload.to_vec()),
            false => message.read::<Vec<u8>>(),
        };
        let Some(content) = content else {
            return;
        };
        let port = message.port.0;
        self.call(robot, "_receive", |py, handle| {
            let content = PyBytes::new(py, &content);
            Ok((handle, from, port, content).into_pyobject(py)?.unbind())
        });
    }
}

/// An exception as one line, with the place in the program that raised it.
fn text(py: Python<'_>, error: &PyErr) -> String {
    let mut place = None;
    let mut traceback = error.traceback(py).map(Bound::into_any);
    while let Some(level) = traceback.filter(|level| !level.is_none()) {
        let line = level
            .getattr("tb_lineno")
            .and_then(|line| line.extract::<u32>());
        let file = level
            .getattr("tb_frame")
            .and_then(|frame| frame.getattr("f_code"))
            .and_then(|code| code.getattr("co_filename"))
            .and_then(|file| file.extract::<String>());
        place = file.ok().zip(line.ok()).or(place);
        traceback = level.getattr("tb_next").ok();
    }
    match place {
        Some((file, line)) => format!("{file}:{line}: {error}"),
        None => error.to_string(),
    }
}
