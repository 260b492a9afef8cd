//! Programs of robots that are written in Python.
//!
//! A program is an object of a subclass of `starl.RobotProgram`. Each robot has a deep copy of its own, and so has each
//! snapshot. An exception makes the program fail, with the exception as the reason.

mod handle;
mod monitor;
mod primitive;

pub use handle::{Draws, Handle};
pub use monitor::PyMonitor;
pub use primitive::Primitive;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};
use starl_core::event::Value;
use starl_core::{Message, Order, Payload, Port, Primitives, Program, Random, Robot};
use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The program of a robot.
pub struct PyProgram {
    /// The name of the program in scenarios.
    name: Arc<str>,
    object: Py<PyAny>,
    /// Its primitives, in the order in which the object holds them, each with the object of Python around it.
    primitives: Vec<(Py<PyAny>, Py<Primitive>)>,
    has_stable: bool,
    has_started: bool,
    /// The stable variables as they are on storage.
    saved: BTreeMap<String, Vec<u8>>,
    /// Why it cannot continue.
    broken: Option<String>,
}

impl PyProgram {
    /// The program of this name that an object describes, with primitives that have their names.
    pub fn new(py: Python<'_>, name: &str, object: Py<PyAny>) -> PyResult<PyProgram> {
        let (primitives, has_stable) = object.call_method0(py, "_prepare")?.extract(py)?;
        Ok(PyProgram {
            name: name.into(),
            object,
            primitives,
            has_stable,
            has_started: false,
            saved: BTreeMap::new(),
            broken: None,
        })
    }

    fn copy(&self, py: Python<'_>) -> PyResult<PyProgram> {
        let copied = py
            .import("copy")?
            .call_method1("deepcopy", (&self.object,))?;
        Ok(PyProgram {
            has_started: self.has_started,
            saved: self.saved.clone(),
            broken: self.broken.clone(),
            ..PyProgram::new(py, &self.name, copied.unbind())?
        })
    }

    /// The object.
    pub fn object(&self) -> &Py<PyAny> {
        &self.object
    }

    /// Whether it is the program of this name and its object has been started.
    pub fn runs(&self, name: &str) -> bool {
        *self.name == *name && self.has_started
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
                name: self.name.clone(),
                object: self.object.clone_ref(py),
                primitives: Vec::new(),
                has_stable: false,
                has_started: self.has_started,
                saved: BTreeMap::new(),
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
        for (_, primitive) in &self.primitives {
            primitive.get().visit(|primitive| visit(primitive));
        }
    }
}

impl Program for PyProgram {
    fn start(&mut self, robot: &mut Robot<'_>) {
        self.has_started = true;
        let stored = robot.saved().into_iter();
        let stored = stored.flat_map(|saved| saved.of(Port::PROGRAM));
        self.saved = stored
            .map(|(name, value)| (name.to_string(), value.to_vec()))
            .collect();
        let stable = self.saved.clone();
        self.call(robot, "_start", |py, handle| {
            Ok((handle, stable).into_pyobject(py)?.unbind())
        });
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.call(robot, "_activate", |py, handle| {
            Ok((handle,).into_pyobject(py)?.unbind())
        });
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from.index();
        let mut primitives = self.primitives.iter();
        let primitive = primitives.find(|(_, primitive)| {
            primitive
                .get()
                .visit(|primitive| primitive.port() == message.port)
        });
        let content = match primitive {
            Some((_, primitive)) if primitive.get().passes_raw() => Some(message.payload.to_vec()),
            _ => message.read::<Vec<u8>>(),
        };
        self.call(robot, "_receive", |py, handle| {
            let content = content.map(|content| PyBytes::new(py, &content));
            let primitive = primitive.map(|(object, _)| object.clone_ref(py));
            let arguments = (handle, from, primitive, content);
            Ok(arguments.into_pyobject(py)?.unbind())
        });
    }

    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        let fields = order.fields.iter();
        let fields: serde_json::Map<String, serde_json::Value> = fields
            .map(|(name, value)| (name.to_string(), plain(value)))
            .collect();
        let fields = serde_json::Value::from(fields).to_string();
        self.call(robot, "_told", |py, handle| {
            Ok((handle, &*order.name, fields).into_pyobject(py)?.unbind())
        });
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        if !self.has_stable || self.broken.is_some() {
            return;
        }
        let values = Python::attach(|py| {
            let values = self.object.call_method0(py, "_stable_values");
            let values = values.and_then(|values| values.extract(py));
            values.map_err(|error: PyErr| text(py, &error))
        });
        let values: BTreeMap<String, Vec<u8>> = match values {
            Ok(values) => values,
            Err(reason) => return robot.fail(reason),
        };
        for (name, value) in &values {
            if self.saved.get(name) != Some(value) {
                robot.save_bytes(Port::PROGRAM, name.clone(), Payload::from_slice(value));
            }
        }
        self.saved = values;
    }

    fn corrupt(&mut self, random: &mut Random) {
        let corrupted = Python::attach(|py| {
            let draws = Py::new(py, Draws::of(random)).map_err(|error| text(py, &error))?;
            let corrupted = self
                .object
                .call_method1(py, "_corrupt", (draws.clone_ref(py),));
            *random = draws.get().end();
            corrupted.map(|_| ()).map_err(|error| text(py, &error))
        });
        if let Err(reason) = corrupted {
            self.broken = Some(reason);
        }
        for (_, primitive) in &self.primitives {
            primitive.get().corrupt(random);
        }
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// A detail of an order as JSON has it: places as lists, times in seconds, robots by their numbers.
fn plain(value: &Value) -> serde_json::Value {
    match value {
        Value::Bool(value) => (*value).into(),
        Value::Int(value) => (*value).into(),
        Value::Float(value) => (*value).into(),
        Value::Text(value) => (&**value).into(),
        Value::Time(time) => time.seconds().into(),
        Value::Point(point) => vec![point.x, point.y, point.z].into(),
        Value::Robot(robot) => robot.index().into(),
        Value::Robots(robots) => robots
            .iter()
            .map(|robot| robot.index())
            .collect::<Vec<_>>()
            .into(),
        other => serde_json::to_value(other).unwrap_or_default(),
    }
}

/// An exception as one line, with the place in the program that raised it.
pub fn text(py: Python<'_>, error: &PyErr) -> String {
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
