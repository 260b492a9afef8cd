//! Tables as text: values separated by commas, and JSON lines.

use super::{Table, Values};
use serde::{Serialize, Serializer};
use std::io::{self, BufWriter, Write};

/// Writes a line of names and a line for each row. Missing numbers are empty.
pub fn csv(table: &Table, output: &mut impl Write) -> io::Result<()> {
    let mut output = BufWriter::new(output);
    let names = table.columns.iter().map(|column| quoted(&column.name));
    writeln!(output, "{}", names.collect::<Vec<_>>().join(","))?;
    for row in 0..table.rows {
        let cells = table.columns.iter().map(|column| match &column.values {
            Values::Whole(values) => values[row].to_string(),
            Values::Numbers(values) => values[row].map_or(String::new(), |value| value.to_string()),
            Values::Texts(values) => quoted(&values[row]),
            Values::Flags(values) => values[row].to_string(),
        });
        writeln!(output, "{}", cells.collect::<Vec<_>>().join(","))?;
    }
    output.flush()
}

fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    }
}

/// Writes an object for each row. Missing numbers are null.
pub fn json_lines(table: &Table, output: &mut impl Write) -> io::Result<()> {
    let mut output = BufWriter::new(output);
    for row in 0..table.rows {
        serde_json::to_writer(&mut output, &Line { table, row })?;
        output.write_all(b"\n")?;
    }
    output.flush()
}

/// A row as an object, in the order of the columns.
struct Line<'a> {
    table: &'a Table,
    row: usize,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Cell<'a> {
    Whole(i64),
    Number(Option<f64>),
    Text(&'a str),
    Flag(bool),
}

impl Serialize for Line<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = self.row;
        let cells = self.table.columns.iter().map(|column| {
            let cell = match &column.values {
                Values::Whole(values) => Cell::Whole(values[row]),
                Values::Numbers(values) => Cell::Number(values[row]),
                Values::Texts(values) => Cell::Text(&values[row]),
                Values::Flags(values) => Cell::Flag(values[row]),
            };
            (&column.name, cell)
        });
        serializer.collect_map(cells)
    }
}
