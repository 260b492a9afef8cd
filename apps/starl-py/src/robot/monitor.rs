//! Properties of programs in Python: functions over the fleet that are judged after each step of a run.

use super::{PyProgram, text};
use crate::robot::handle::numbers;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use starl_core::event::Name;
use starl_core::{Duration, RobotId, Time};
use starl_properties::{Monitor, Violation, Witness};
use std::sync::Arc;

/// Watches the properties of one program.
#[derive(Clone)]
pub struct PyMonitor {
    program: Arc<str>,
    properties: Arc<[Property]>,
    /// How each property stands.
    standings: Vec<Standing>,
}

struct Property {
    /// As `Race.in_order`.
    name: Name,
    /// Returns `None` if the property holds, and else the reason for the violation.
    judge: Py<PyAny>,
    /// It has to hold once by then; at all times if none.
    within: Option<Duration>,
}

#[derive(Clone, Copy, PartialEq)]
enum Standing {
    /// It holds so far, or its deadline has not passed.
    Open,
    /// It did not hold when it was judged last.
    Violated,
    /// It needs no more judgement.
    Settled,
}

impl PyMonitor {
    /// The monitor of a program by its name in scenarios; none if it has no properties.
    pub fn new(py: Python<'_>, name: &str, object: &Py<PyAny>) -> PyResult<Option<PyMonitor>> {
        let found = object.call_method0(py, "_properties")?;
        let found: Vec<(String, Py<PyAny>, Option<f64>)> = found.extract(py)?;
        let properties = found.into_iter().map(|(property, judge, within)| Property {
            name: format!("{name}.{property}").into(),
            judge,
            within: within.map(Duration::from_seconds_f64),
        });
        let properties: Arc<[Property]> = properties.collect();
        Ok((!properties.is_empty()).then(|| PyMonitor {
            program: name.into(),
            standings: vec![Standing::Open; properties.len()],
            properties,
        }))
    }

    /// The robots of the program: number, object, place, velocity, heading, and whether each is up and has finished.
    fn members<'py>(&self, py: Python<'py>, witness: &dyn Witness) -> PyResult<Bound<'py, PyList>> {
        let member = |robot: &RobotId| {
            let program = witness.program(*robot)?.downcast_ref::<PyProgram>()?;
            let pose = witness.pose(*robot)?;
            program.runs(&self.program).then(|| {
                (
                    robot.index(),
                    program.object().clone_ref(py),
                    numbers(pose.position),
                    numbers(witness.velocity(*robot).unwrap_or_default()),
                    pose.yaw,
                    witness.is_up(*robot),
                    witness.has_finished(*robot),
                )
            })
        };
        let members: Vec<_> = witness.robots().iter().filter_map(member).collect();
        PyList::new(py, members)
    }

    /// The reason for a property's violation; `None` if it holds.
    fn judge(py: Python<'_>, property: &Property, fleet: &Bound<'_, PyTuple>) -> Option<String> {
        let judged = property.judge.call1(py, fleet.clone());
        let judged = judged.and_then(|judged| judged.extract::<Option<String>>(py));
        judged.unwrap_or_else(|error| Some(format!("cannot be judged: {}", text(py, &error))))
    }
}

impl Monitor for PyMonitor {
    fn properties(&self) -> Vec<Name> {
        self.properties
            .iter()
            .map(|property| property.name.clone())
            .collect()
    }

    fn observe(&mut self, witness: &dyn Witness, violations: &mut Vec<Violation>) {
        if self.standings.iter().all(|one| *one == Standing::Settled) {
            return;
        }
        let now = witness.now();
        let mut violate = |property: &Property, text: String| {
            violations.push(Violation {
                property: property.name.clone(),
                at: now,
                robots: Vec::new(),
                text,
            });
        };
        Python::attach(|py| {
            let about = self.members(py, witness).and_then(|members| {
                let undisturbed = witness.undisturbed().seconds();
                let uncorrupted = witness.uncorrupted().seconds();
                (now.seconds(), undisturbed, uncorrupted, members).into_pyobject(py)
            });
            for (property, standing) in self.properties.iter().zip(&mut self.standings) {
                if *standing == Standing::Settled {
                    continue;
                }
                let wrong = match &about {
                    Ok(about) => PyMonitor::judge(py, property, about),
                    Err(error) => Some(error.to_string()),
                };
                match (wrong, property.within) {
                    (Some(wrong), None) if *standing == Standing::Open => {
                        violate(property, wrong);
                        *standing = Standing::Violated;
                    }
                    (None, None) => *standing = Standing::Open,
                    (None, Some(_)) => *standing = Standing::Settled,
                    (Some(wrong), Some(within)) if now.since(Time::ZERO) > within => {
                        violate(property, format!("not within {within}: {wrong}"));
                        *standing = Standing::Settled;
                    }
                    (Some(_), _) => {}
                }
            }
        });
    }

    fn is_open(&self, property: usize) -> bool {
        let within = self.properties[property].within;
        within.is_some() && self.standings[property] == Standing::Open
    }
}
