//! The expressions of a task: rewards, ends and measures in the StarL language.

use crate::env::{Batch, Judge, refused};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::json;
use starl_env::{Column, Constant, Kind, Wording, WordingError};
use starl_lang::diagnostic::{Colour, Diagnostic, LineIndex, render};

#[pymethods]
impl Judge {
    /// Constants with a value for each robot; columns with the names of their types and their expressions; the other
    /// expressions of the task.
    #[new]
    fn new(
        batch: PyRef<'_, Batch>,
        constants: Vec<(String, String, Vec<f64>)>,
        columns: Vec<(String, String, Option<String>)>,
        reward: Option<String>,
        terminated: Option<String>,
        information: Vec<(String, String)>,
    ) -> PyResult<Judge> {
        let constants = constants.into_iter().map(|(name, ty, values)| {
            let kind = kind(&ty)?;
            Ok(Constant { name, kind, values })
        });
        let columns = columns.into_iter().map(|(name, ty, text)| {
            let kind = kind(&ty)?;
            Ok(Column { name, kind, text })
        });
        let wording = Wording {
            constants: constants.collect::<PyResult<_>>()?,
            columns: columns.collect::<PyResult<_>>()?,
            reward,
            terminated,
            information,
        };
        let limits: Vec<(f64, f64)> = batch.limits().iter().map(|one| (one.0, one.1)).collect();
        let judge = starl_env::Judge::new(&limits, &wording).map_err(|error| worded(&error))?;
        let words = batch.batch.environments() * limits.len() * judge.memory();
        let memory = vec![0; words];
        Ok(Judge { judge, memory })
    }
}

/// The type with this name.
fn kind(name: &str) -> PyResult<Kind> {
    match name {
        "Bool" => Ok(Kind::Bool),
        "Float" => Ok(Kind::Float),
        "Point" => Ok(Kind::Point),
        other => Err(refused(format!(
            "the type `{other}` is not Bool, Float or Point"
        ))),
    }
}

/// The problems of an expression: the message, and all of them as the package's diagnostics.
fn worded(error: &WordingError) -> PyErr {
    let index = LineIndex::new(&error.text);
    let problem = |problem: &Diagnostic| {
        let place = index.position(&error.text, problem.span.start);
        json!({
            "file": error.part,
            "line": place.line,
            "column": place.column,
            "severity": "error",
            "code": problem.code.number(),
            "field": null,
            "message": problem.message,
            "help": problem.fix.as_ref().map(|fix| &fix.message),
            "notes": problem.remarks().collect::<Vec<_>>(),
        })
    };
    let problems: Vec<_> = error.problems.iter().map(problem).collect();
    let excerpt = render(&error.part, &error.text, &error.problems, Colour::Off);
    PyValueError::new_err((excerpt, json!(problems).to_string()))
}
