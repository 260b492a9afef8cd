//! Tables as Parquet files. See <https://parquet.apache.org/docs/file-format/>.

use super::{Column, Table, Values};
use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// Rows that readers hold at once.
const ROWS_OF_A_GROUP: usize = 100_000;

/// Writes the table. The file depends only on the table.
pub fn write(table: &Table, output: &mut (impl Write + Send)) -> io::Result<()> {
    write_groups(table, output).map_err(|error| match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => io::Error::other(error),
    })
}

fn write_groups(table: &Table, output: &mut (impl Write + Send)) -> Result<()> {
    let fields: Result<Vec<_>> = table.columns.iter().map(field).collect();
    let schema = Type::group_type_builder("sweep")
        .with_fields(fields?)
        .build()?;
    let properties = WriterProperties::builder().set_created_by("starl".to_string());
    let properties = Arc::new(properties.build());
    let mut file = SerializedFileWriter::new(output, Arc::new(schema), properties)?;
    for first in (0..table.rows).step_by(ROWS_OF_A_GROUP) {
        let rows = first..table.rows.min(first + ROWS_OF_A_GROUP);
        let mut group = file.next_row_group()?;
        for column in &table.columns {
            match &column.values {
                Values::Whole(values) => {
                    put::<Int64Type, _>(&mut group, &values[rows.clone()], None)?
                }
                Values::Flags(values) => {
                    put::<BoolType, _>(&mut group, &values[rows.clone()], None)?
                }
                Values::Texts(values) => {
                    let texts = values[rows.clone()].iter();
                    let texts: Vec<ByteArray> = texts.map(|text| text.as_str().into()).collect();
                    put::<ByteArrayType, _>(&mut group, &texts, None)?;
                }
                Values::Numbers(values) => {
                    let values = &values[rows.clone()];
                    let present: Vec<f64> = values.iter().flatten().copied().collect();
                    let levels: Vec<i16> = values.iter().map(|v| i16::from(v.is_some())).collect();
                    put::<DoubleType, _>(&mut group, &present, Some(&levels))?;
                }
            }
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

fn field(column: &Column) -> Result<Arc<Type>> {
    let (kind, logical, repetition) = match &column.values {
        Values::Whole(_) => (PhysicalType::INT64, None, Repetition::REQUIRED),
        Values::Flags(_) => (PhysicalType::BOOLEAN, None, Repetition::REQUIRED),
        Values::Numbers(_) => (PhysicalType::DOUBLE, None, Repetition::OPTIONAL),
        Values::Texts(_) => {
            let text = Some(LogicalType::String);
            (PhysicalType::BYTE_ARRAY, text, Repetition::REQUIRED)
        }
    };
    let field = Type::primitive_type_builder(&column.name, kind);
    let field = field.with_repetition(repetition).with_logical_type(logical);
    Ok(Arc::new(field.build()?))
}

fn put<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<()> {
    let column = group.next_column()?;
    let mut column =
        column.ok_or_else(|| ParquetError::General("a column too many".to_string()))?;
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}
