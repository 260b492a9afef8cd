//! Records as tables in Arrow's memory layout, which data frames of all libraries accept.
//!
//! Members of records become columns; members of members get names with points between.

use arrow_array::builder::{Float64Builder, UInt32Builder};
use arrow_array::ffi::FFI_ArrowSchema;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::ArrowPrimitiveType;
use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, PrimitiveArray, RecordBatch,
    RecordBatchIterator, StringArray, UInt32Array,
};
use arrow_schema::{ArrowError, Field, Schema};
use numpy::PyArray1;
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use serde_json::Value;
use starl_core::{Event, Pose, Record};
use starl_sweep::Values;
use starl_trace::Topic;
use std::collections::BTreeMap;
use std::sync::Arc;
use thiserror::Error;

/// Rows of records.
#[pyclass(frozen, module = "starl._native")]
pub struct Table(RecordBatch);

#[pymethods]
impl Table {
    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        let schema = self.0.schema();
        let fields = schema.fields().iter();
        fields.map(|field| field.name().clone()).collect()
    }

    /// The numbers of a column: integers as int64 if none is missing, else all numbers as float64, and NaN for what is
    /// missing. None for a column of another type.
    fn numbers<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let column = self.0.column_by_name(name);
        let column = column.ok_or_else(|| {
            PyKeyError::new_err(format!("there is no column {name:?}; see `columns`"))
        })?;
        let any = column.as_any();
        if let Some(column) = any.downcast_ref::<Float64Array>() {
            let numbers = column.iter().map(|number| number.unwrap_or(f64::NAN));
            return Ok(Some(PyArray1::from_iter(py, numbers).into_any()));
        }
        let integers: Vec<Option<i64>> = if let Some(column) = any.downcast_ref::<Int64Array>() {
            column.iter().collect()
        } else if let Some(column) = any.downcast_ref::<UInt32Array>() {
            column.iter().map(|number| number.map(i64::from)).collect()
        } else {
            return Ok(None);
        };
        let whole: Option<Vec<i64>> = integers.iter().copied().collect();
        Ok(Some(match whole {
            Some(whole) => PyArray1::from_vec(py, whole).into_any(),
            None => {
                let number = |number: &Option<i64>| number.map_or(f64::NAN, |number| number as f64);
                PyArray1::from_iter(py, integers.iter().map(number)).into_any()
            }
        }))
    }

    fn __len__(&self) -> usize {
        self.0.num_rows()
    }

    /// The schema as the Arrow PyCapsule interface passes it.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let schema = FFI_ArrowSchema::try_from(self.0.schema().as_ref());
        let schema = schema.map_err(|error| PyValueError::new_err(error.to_string()))?;
        PyCapsule::new_with_value(py, schema, c"arrow_schema")
    }

    /// The rows as the Arrow PyCapsule interface passes them. The memory is shared, not copied.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface allows a producer to pass on its own schema.
        drop(requested_schema);
        let rows = RecordBatchIterator::new([Ok(self.0.clone())], self.0.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(rows));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}

/// Why records are no table.
#[derive(Debug, Error)]
pub enum TableError {
    #[error("the records: {0}")]
    Records(#[from] serde_json::Error),
    #[error(transparent)]
    Columns(#[from] ArrowError),
}

impl From<TableError> for PyErr {
    fn from(error: TableError) -> PyErr {
        PyValueError::new_err(error.to_string())
    }
}

/// The topic of this name, which may leave out the prefix of all topics.
pub fn topic(name: &str) -> PyResult<Topic> {
    let short = |topic: &Topic| topic.name().trim_start_matches("/starl/");
    let found = Topic::ALL
        .iter()
        .find(|topic| name == topic.name() || name == short(topic));
    found.copied().ok_or_else(|| {
        let known: Vec<&str> = Topic::ALL.iter().map(short).collect();
        let known = known.join(", ");
        PyValueError::new_err(format!(
            "there is no topic {name:?}; the topics are {known}"
        ))
    })
}

impl Table {
    /// The records of a topic with a column for each of their members; or those of all topics, each with its content
    /// as JSON.
    pub fn of_records<'a>(
        records: impl Iterator<Item = &'a Record>,
        topic: Option<Topic>,
    ) -> Result<Table, TableError> {
        let chosen =
            records.filter(|record| topic.is_none_or(|topic| Topic::of(&record.event) == topic));
        match topic {
            Some(Topic::Pose | Topic::Estimate) => poses(chosen),
            _ => members(chosen, topic.is_none()),
        }
    }
}

impl Table {
    /// The rows of a sweep.
    pub fn of_sweep(table: starl_sweep::Table) -> Result<Table, TableError> {
        let columns = table.columns.into_iter().map(|column| {
            let values: ArrayRef = match column.values {
                Values::Whole(values) => Arc::new(Int64Array::from(values)),
                Values::Numbers(values) => Arc::new(Float64Array::from(values)),
                Values::Texts(values) => Arc::new(StringArray::from(values)),
                Values::Flags(values) => Arc::new(BooleanArray::from(values)),
            };
            (column.name, values)
        });
        self::table(columns.collect())
    }
}

/// The columns that every table begins with.
#[derive(Default)]
struct Head {
    times: Vec<i64>,
    robots: Vec<Option<u32>>,
}

impl Head {
    fn push(&mut self, record: &Record) {
        self.times.push(record.at.0.cast_signed());
        self.robots
            .push(record.robot.map(|robot| robot.index() as u32));
    }

    fn columns(self) -> Vec<(String, ArrayRef)> {
        let seconds = self.times.iter().map(|&time| time as f64 * 1e-9);
        let seconds = Float64Array::from_iter_values(seconds);
        let mut robots = UInt32Builder::new();
        robots.extend(self.robots);
        vec![
            ("time".to_string(), Arc::new(seconds)),
            (
                "time_ns".to_string(),
                Arc::new(Int64Array::from(self.times)),
            ),
            ("robot".to_string(), Arc::new(robots.finish())),
        ]
    }
}

/// Poses are most of a trace: they do not take the way through JSON.
fn poses<'a>(records: impl Iterator<Item = &'a Record>) -> Result<Table, TableError> {
    const NAMES: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];
    let mut head = Head::default();
    let mut numbers: [Float64Builder; 6] = std::array::from_fn(|_| Float64Builder::new());
    for record in records {
        let Some(pose) = pose(&record.event) else {
            continue;
        };
        head.push(record);
        let position = pose.position;
        let row = [
            position.x, position.y, position.z, pose.yaw, pose.pitch, pose.roll,
        ];
        for (column, number) in numbers.iter_mut().zip(row) {
            column.append_value(number);
        }
    }
    let mut columns = head.columns();
    for (name, mut column) in NAMES.into_iter().zip(numbers) {
        columns.push((name.to_string(), Arc::new(column.finish())));
    }
    table(columns)
}

fn pose(event: &Event) -> Option<Pose> {
    match event {
        Event::Moved(pose) | Event::Estimated(pose) => Some(*pose),
        _ => None,
    }
}

/// Every member a column, or the whole content one column of JSON.
fn members<'a>(
    records: impl Iterator<Item = &'a Record>,
    whole: bool,
) -> Result<Table, TableError> {
    let records: Vec<&Record> = records.collect();
    let json = starl_trace::json_list(records.iter().copied());
    let rows: Vec<Value> = serde_json::from_slice(&json)?;
    let mut head = Head::default();
    let mut values: BTreeMap<String, Vec<Option<Value>>> = BTreeMap::new();
    for (index, (record, row)) in records.iter().zip(rows).enumerate() {
        head.push(record);
        let mut message = row["message"].clone();
        if let Some(message) = message.as_object_mut() {
            message.remove("robot");
        }
        let mut put = |name: String, value: Value| {
            let column = values.entry(name).or_default();
            column.resize(index, None);
            column.push(Some(value));
        };
        match whole {
            true => {
                put("topic".to_string(), row["topic"].clone());
                put("content".to_string(), Value::String(message.to_string()));
            }
            false => flatten(String::new(), message, &mut put),
        }
    }
    let mut columns = head.columns();
    for (name, mut values) in values {
        values.resize(records.len(), None);
        columns.push((name, column(values)));
    }
    table(columns)
}

/// Puts a value's members under their names, and those of the list `fields` under the names that they hold.
fn flatten(name: String, value: Value, put: &mut impl FnMut(String, Value)) {
    let under = |member: &str| match name.is_empty() {
        true => member.to_string(),
        false => format!("{name}.{member}"),
    };
    match value {
        Value::Object(members) => {
            for (member, value) in members {
                flatten(under(&member), value, put);
            }
        }
        Value::Array(fields) if name == "fields" => {
            for mut field in fields {
                let Some(members) = field.as_object_mut() else {
                    continue;
                };
                let member = members.remove("name").unwrap_or_default();
                let member = under(member.as_str().unwrap_or_default());
                if let Some(value) = members.values_mut().next() {
                    put(member, value.take());
                }
            }
        }
        value => put(name, value),
    }
}

/// The narrowest type that holds all values; what is of several types, or a list, is text in JSON.
fn column(values: Vec<Option<Value>>) -> ArrayRef {
    let all = |holds: fn(&Value) -> bool| values.iter().flatten().all(holds);
    if all(Value::is_boolean) {
        let values: Vec<Option<bool>> = each(&values, Value::as_bool);
        return Arc::new(BooleanArray::from(values));
    }
    if all(Value::is_i64) {
        return numbers::<arrow_array::types::Int64Type>(each(&values, Value::as_i64));
    }
    if all(Value::is_number) {
        return numbers::<arrow_array::types::Float64Type>(each(&values, Value::as_f64));
    }
    let text = |value: &Value| match value {
        Value::String(text) => Some(text.clone()),
        value => Some(value.to_string()),
    };
    Arc::new(StringArray::from(each(&values, text)))
}

fn each<'a, T>(values: &'a [Option<Value>], of: impl Fn(&'a Value) -> Option<T>) -> Vec<Option<T>> {
    values
        .iter()
        .map(|value| value.as_ref().and_then(&of))
        .collect()
}

fn numbers<T: ArrowPrimitiveType>(values: Vec<Option<T::Native>>) -> ArrayRef
where
    PrimitiveArray<T>: From<Vec<Option<T::Native>>>,
{
    Arc::new(PrimitiveArray::<T>::from(values))
}

fn table(columns: Vec<(String, ArrayRef)>) -> Result<Table, TableError> {
    let field = |(name, column): &(String, ArrayRef)| {
        Field::new(name.clone(), column.data_type().clone(), true)
    };
    let schema = Schema::new(columns.iter().map(field).collect::<Vec<_>>());
    let columns = columns.into_iter().map(|(_, column)| column).collect();
    Ok(Table(RecordBatch::try_new(Arc::new(schema), columns)?))
}
