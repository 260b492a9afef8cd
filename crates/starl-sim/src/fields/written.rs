//! Values and tables of a TOML file. Numbers are written so that reading gives the same bits again.

use starl_core::{Duration, Point};
use std::fmt::Write;

/// A table whose lines are being collected.
pub(crate) struct Table {
    header: String,
    lines: String,
}

impl Table {
    /// The file's top level.
    pub fn root() -> Table {
        Table::headed(String::new())
    }

    /// A table of this dotted name.
    pub fn named(name: &str) -> Table {
        Table::headed(format!("\n[{name}]\n"))
    }

    /// An element of a list of tables.
    pub fn element(name: &str) -> Table {
        Table::headed(format!("\n[[{name}]]\n"))
    }

    fn headed(header: String) -> Table {
        let lines = String::new();
        Table { header, lines }
    }

    /// Adds a field.
    pub fn set(&mut self, name: &str, value: String) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.lines, "{} = {value}", key(name));
    }

    /// Adds a field that is not at its default.
    pub fn differing<T: PartialEq>(
        &mut self,
        name: &str,
        value: T,
        default: T,
        show: impl FnOnce(T) -> String,
    ) {
        if value != default {
            self.set(name, show(value));
        }
    }

    /// The table's text; nothing if no field was added.
    pub fn finish(self) -> String {
        match self.lines.is_empty() {
            true => String::new(),
            false => self.header + &self.lines,
        }
    }

    /// The text of an element, which counts even without fields.
    pub fn finish_element(self) -> String {
        self.header + &self.lines
    }

    /// As a table within a line; none if no field was added.
    pub fn inline(self) -> Option<String> {
        let lines: Vec<&str> = self.lines.lines().collect();
        (!lines.is_empty()).then(|| format!("{{ {} }}", lines.join(", ")))
    }
}

/// A field's name.
fn key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    match !name.is_empty() && name.chars().all(is_bare) {
        true => name.to_string(),
        false => text(name),
    }
}

/// A text in quotes.
pub(crate) fn text(content: &str) -> String {
    let mut out = String::from("\"");
    for character in content.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            control if control.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(control));
            }
            other => out.push(other),
        }
    }
    out + "\""
}

/// A list within a line.
pub(crate) fn list(elements: impl IntoIterator<Item = String>) -> String {
    let elements: Vec<String> = elements.into_iter().collect();
    format!("[{}]", elements.join(", "))
}

/// A span of time with its unit.
pub(crate) fn time(span: Duration) -> String {
    format!("\"{span}\"")
}

/// A number in SI with its unit.
pub(crate) fn quantity(number: f64, unit: &str) -> String {
    // Not so for -0.
    match number.to_bits() == 0 {
        true => "0".to_string(),
        false => format!("\"{number:?}{unit}\""),
    }
}

/// Metres.
pub(crate) fn metres(number: f64) -> String {
    quantity(number, "m")
}

/// A number without a unit.
pub(crate) fn number(number: f64) -> String {
    format!("{number:?}")
}

/// `true` or `false`.
pub(crate) fn flag(flag: bool) -> String {
    flag.to_string()
}

/// A coordinate: whole ones without a point.
fn coordinate(number: f64) -> String {
    let text = format!("{number:?}");
    match text.strip_suffix(".0") {
        Some(whole) if whole != "-0" => whole.to_string(),
        _ => text,
    }
}

/// A point of the floor plane.
pub(crate) fn planar(point: Point) -> String {
    list([point.x, point.y].map(coordinate))
}

/// A point or a velocity, with its height where it has one.
pub(crate) fn spatial(point: Point) -> String {
    match point.z.to_bits() == 0 {
        true => planar(point),
        false => solid(point),
    }
}

/// A point with its height.
pub(crate) fn solid(point: Point) -> String {
    list([point.x, point.y, point.z].map(coordinate))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_that_look_like_other_toml_values_stay_texts() {
        assert_eq!(
            text("a \"b\" \\ \n\u{7f}é"),
            "\"a \\\"b\\\" \\\\ \\u000A\\u007Fé\""
        );
    }

    #[test]
    fn names_are_bare_where_they_can_be() {
        let mut table = Table::root();
        table.set("plain_1", "1".into());
        table.set("with space", "2".into());
        table.set("", "3".into());
        assert_eq!(
            table.finish(),
            "plain_1 = 1\n\"with space\" = 2\n\"\" = 3\n"
        );
    }
}
