//! The rows of a sweep as a table, in the order of the plan, and the files that it is written to.
//!
//! Invariant: the same plan gives the same file, byte by byte, on every machine.

#[cfg(feature = "parquet")]
mod parquet;
mod text;

use crate::{Axis, Error, FLEET, METRICS, Measured, Plan, Row, Scale};
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns, all of the same length.
    pub columns: Vec<Column>,
    /// How many rows there are.
    pub rows: usize,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its values.
    pub values: Values,
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers that may be missing.
    Numbers(Vec<Option<f64>>),
    /// Texts.
    Texts(Vec<String>),
    /// True or false.
    Flags(Vec<bool>),
}

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Apache Parquet, uncompressed.
    #[cfg(feature = "parquet")]
    Parquet,
    /// Values separated by commas, with a line of names (RFC 4180).
    Csv,
    /// One JSON object a line.
    JsonLines,
}

impl Format {
    /// The format by a file's name.
    ///
    /// # Errors
    /// The name has no known format, or one that this build does not support.
    pub fn of(path: &Path) -> Result<Format, Error> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => Ok(Format::Csv),
            Some("jsonl") => Ok(Format::JsonLines),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Format::Parquet),
            #[cfg(not(feature = "parquet"))]
            Some("parquet") => {
                let message = "this build writes no Parquet; name a file ending in .csv or .jsonl";
                Err(Error::file(path, message))
            }
            _ => {
                let message = "the name must end in .parquet, .csv or .jsonl";
                Err(Error::file(path, message))
            }
        }
    }
}

impl Table {
    /// The rows that there are, by number.
    pub fn of(plan: &Plan, rows: &BTreeMap<u64, Measured>) -> Table {
        let rows: Vec<&Row> = rows.values().map(|measured| &measured.row).collect();
        let whole = |of: &dyn Fn(&Row) -> u64| {
            let values = rows.iter().map(|row| of(row) as i64);
            Values::Whole(values.collect())
        };
        let texts = |of: &dyn Fn(&Row) -> String| {
            let values = rows.iter().map(|row| of(row));
            Values::Texts(values.collect())
        };
        let mut columns = vec![column("number", whole(&|row| row.number))];
        let indices = rows.iter().map(|row| plan.combination(row.number));
        let indices: Vec<Vec<usize>> = indices.map(|number| plan.indices(number)).collect();
        for (place, axis) in plan.axes().iter().enumerate() {
            let indices = indices.iter().map(|indices| indices[place]);
            columns.push(of_axis(axis, indices));
        }
        columns.push(column("seed", whole(&|row| row.seed)));
        if let Some(profile) = plan.profile() {
            columns.push(column("profile", texts(&|_| profile.to_string())));
        }
        columns.push(column("outcome", texts(&|row| row.outcome.clone())));
        let reached = rows.iter().map(|row| row.goal_reached).collect();
        columns.push(column("goal_reached", Values::Flags(reached)));
        columns.push(column("violated", texts(&|row| row.violated.join(", "))));
        columns.push(column("digest", texts(&|row| row.digest.clone())));
        for metric in METRICS {
            let values = rows.iter().map(|row| metric.of(row));
            let values = match metric.is_whole {
                true => Values::Whole(values.map(|value| value.unwrap_or(0.0) as i64).collect()),
                false => Values::Numbers(values.collect()),
            };
            columns.push(column(metric.name, values));
        }
        Table {
            columns,
            rows: rows.len(),
        }
    }

    /// Writes the table.
    ///
    /// # Errors
    /// If the output cannot be written.
    pub fn write(&self, format: Format, output: &mut (impl Write + Send)) -> io::Result<()> {
        match format {
            #[cfg(feature = "parquet")]
            Format::Parquet => parquet::write(self, output),
            Format::Csv => text::csv(self, output),
            Format::JsonLines => text::json_lines(self, output),
        }
    }
}

fn column(name: &str, values: Values) -> Column {
    Column {
        name: name.to_string(),
        values,
    }
}

/// The column of an axis: numbers in one unit, which the name ends with, or texts.
fn of_axis(axis: &Axis, indices: impl Iterator<Item = usize>) -> Column {
    match axis.scale() {
        Scale::Numbers { values, .. } if axis.field == FLEET => {
            let whole = indices.map(|index| values[index] as i64);
            column(&axis.field, Values::Whole(whole.collect()))
        }
        Scale::Numbers { values, unit } => {
            let name = match unit.is_empty() {
                true => axis.field.clone(),
                false => format!("{}_{unit}", axis.field),
            };
            let numbers = indices.map(|index| Some(values[index]));
            column(&name, Values::Numbers(numbers.collect()))
        }
        Scale::Texts => {
            let texts = indices.map(|index| axis.values[index].clone());
            column(&axis.field, Values::Texts(texts.collect()))
        }
    }
}
