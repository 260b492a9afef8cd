//! A typed view of one table of the scenario.
//!
//! Invariant: every name in the table is in the schema, or reported; every value asked for is what
//! the schema says, or reported and replaced by the default so that reading goes on and finds more.

use super::report::{Origin, Report};
use super::schema::{Default, Dimension, Field, Kind};
use super::suggest;
use super::tree::{Node, Table, Value};
use super::value::{self, Complaint};
use starl_core::{Duration, Point};

/// A table of the scenario and what the schema says of it.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    table: Option<&'a Table>,
    path: &'a Path<'a>,
    fields: &'static [Field],
    /// Where the table begins, or would.
    pub origin: Origin,
    /// Where problems go.
    pub report: &'a Report,
}

/// The dotted path of a table, as a chain towards the root.
pub(super) struct Path<'a> {
    above: Option<&'a Path<'a>>,
    name: String,
}

impl<'a> Path<'a> {
    /// The path of the whole scenario.
    pub const ROOT: Path<'static> = Path {
        above: None,
        name: String::new(),
    };

    /// The path of what is called `name` in here.
    pub fn join(&self, name: &str) -> String {
        let mut names = vec![name];
        let mut path = Some(self);
        while let Some(Path { above, name }) = path {
            names.push(name);
            path = *above;
        }
        names.retain(|name| !name.is_empty());
        names.reverse();
        names.join(".")
    }

    fn below(&'a self, name: impl ToString) -> Path<'a> {
        Path {
            above: Some(self),
            name: name.to_string(),
        }
    }
}

impl<'a> Section<'a> {
    /// The scenario's top level.
    pub fn root(
        node: &'a Node,
        path: &'a Path<'a>,
        fields: &'static [Field],
        report: &'a Report,
    ) -> Section<'a> {
        Section::open(Some(node), node.origin, path, fields, report)
    }

    fn open(
        node: Option<&'a Node>,
        origin: Origin,
        path: &'a Path<'a>,
        fields: &'static [Field],
        report: &'a Report,
    ) -> Section<'a> {
        let mut section = Section {
            table: None,
            path,
            fields,
            origin,
            report,
        };
        match node.map(|node| &node.value) {
            None => {}
            Some(Value::Table(table)) => {
                section.table = Some(table);
                section.check_names(table);
            }
            Some(other) => {
                let message = format!("{} is not a table", other.describe());
                let help = format!("write [{}] or {{ ... }}", path.join(""));
                report.problem_with_help(origin, &path.join(""), message, help);
            }
        }
        section
    }

    fn check_names(&self, table: &Table) {
        for (name, entry) in table {
            if self.fields.iter().any(|field| field.name == name) {
                continue;
            }
            let names: Vec<&str> = self.fields.iter().map(|field| field.name).collect();
            let message = "there is no such field".to_string();
            let help = suggest::help(name, &names, "there are");
            self.complain(entry.name_origin, name, (message, help));
        }
    }

    fn field(&self, name: &str) -> &'static Field {
        self.fields
            .iter()
            .find(|field| field.name == name)
            .unwrap_or_else(|| unreachable!("{} is not in the schema", self.path.join(name)))
    }

    /// The node of a field; none where it is left out or is the word that says so.
    pub fn node(&self, name: &str) -> Option<&'a Node> {
        let node = &self.table?.get(name)?.node;
        let absent = match (&node.value, self.field(name).default) {
            (Value::Text(text), Default::Word(word)) => text == word,
            _ => false,
        };
        (!absent).then_some(node)
    }

    /// Whether the field is given.
    pub fn has(&self, name: &str) -> bool {
        self.node(name).is_some()
    }

    /// The dotted path of a field.
    pub fn path_of(&self, name: &str) -> String {
        self.path.join(name)
    }

    /// Where a field's value is, or else where its table begins.
    pub fn origin_of(&self, name: &str) -> Origin {
        self.node(name).map_or(self.origin, |node| node.origin)
    }

    /// Notes a problem with a field.
    pub fn problem(&self, name: &str, message: impl ToString, help: impl ToString) {
        let complaint = (message.to_string(), Some(help.to_string()));
        self.complain(self.origin_of(name), name, complaint);
    }

    fn complain(&self, origin: Origin, name: &str, (message, help): Complaint) {
        let field = self.path.join(name);
        match help {
            Some(help) => self.report.problem_with_help(origin, &field, message, help),
            None => self.report.problem(origin, &field, message),
        }
    }

    /// Reads a field; reports it if it does not do, or is left out though required.
    fn read<T>(
        &self,
        name: &str,
        parse: impl FnOnce(&'a Node) -> Result<T, Complaint>,
    ) -> Option<T> {
        let Some(node) = self.node(name) else {
            if self.field(name).default == Default::Required {
                let message = "is missing".to_string();
                self.complain(
                    self.origin,
                    name,
                    (message, Some("it must be given".to_string())),
                );
            }
            return None;
        };
        match parse(node) {
            Ok(value) => Some(value),
            Err(complaint) => {
                self.complain(node.origin, name, complaint);
                None
            }
        }
    }

    /// A text, or none.
    pub fn text(&self, name: &str) -> Option<String> {
        self.read(name, value::text)
    }

    /// A list of texts, each with its place and path.
    pub fn texts(&self, name: &str) -> Vec<(String, Origin, String)> {
        self.list(name)
            .into_iter()
            .filter_map(|(node, path)| match value::text(node) {
                Ok(text) => Some((text, node.origin, path)),
                Err((message, help)) => {
                    let help = help.unwrap_or_default();
                    self.report
                        .problem_with_help(node.origin, &path, message, help);
                    None
                }
            })
            .collect()
    }

    /// The elements of a list with their paths.
    pub fn list(&self, name: &str) -> Vec<(&'a Node, String)> {
        let path = self.path.join(name);
        let list = self.read(name, |node| match &node.value {
            Value::List(list) => Ok(list),
            other => {
                let message = format!("{} is not a list", other.describe());
                Err((
                    message,
                    Some("write it in brackets: [..., ...]".to_string()),
                ))
            }
        });
        let numbered = |(index, node)| (node, format!("{path}.{index}"));
        list.map_or(&[][..], Vec::as_slice)
            .iter()
            .enumerate()
            .map(numbered)
            .collect()
    }

    /// `true` or `false`.
    pub fn flag(&self, name: &str) -> bool {
        let default = matches!(self.field(name).default, Default::Value("true"));
        self.read(name, value::flag).unwrap_or(default)
    }

    /// One of a choice of words.
    pub fn choice(&self, name: &str) -> Option<String> {
        let Field { kind, default, .. } = self.field(name);
        let words = if let Kind::Choice(words) = kind {
            words
        } else {
            &[][..]
        };
        self.read(name, |node| value::choice(node, words))
            .or(match default {
                Default::Value(word) => Some((*word).to_string()),
                _ => None,
            })
    }

    /// The name of a robot model.
    pub fn model(&self, name: &str) -> Option<String> {
        self.read(name, value::model)
    }

    /// A whole number, or none where there is neither value nor default.
    pub fn count(&self, name: &str) -> Option<u64> {
        let Field { kind, default, .. } = self.field(name);
        let (least, most) = if let Kind::Count(least, most) = kind {
            (*least, *most)
        } else {
            (0, u64::MAX)
        };
        self.read(name, |node| value::count(node, least, most))
            .or(match default {
                Default::Value(text) => text.parse().ok(),
                _ => None,
            })
    }

    /// A probability or quantity in SI, or none where there is neither value nor default.
    pub fn optional_number(&self, name: &str) -> Option<f64> {
        let Field { kind, default, .. } = self.field(name);
        let number = self.read(name, |node| match kind {
            Kind::Quantity(dimension, range) => value::quantity(node, *dimension, *range),
            _ => value::probability(node),
        });
        number.or(match default {
            Default::Value(text) => Some(value::default_number(kind, text)),
            _ => None,
        })
    }

    /// A probability or quantity in SI.
    pub fn number(&self, name: &str) -> f64 {
        self.optional_number(name).unwrap_or_default()
    }

    /// A duration, or none where there is neither value nor default.
    pub fn optional_duration(&self, name: &str) -> Option<Duration> {
        let duration = Duration::from_seconds_f64(self.optional_number(name)?);
        let written = self.node(name).is_some();
        if written && duration.is_zero() && self.number(name) > 0.0 {
            self.problem(
                name,
                "this is less than half a nanosecond",
                "give at least \"1ns\"",
            );
        }
        Some(duration)
    }

    /// A duration.
    pub fn duration(&self, name: &str) -> Duration {
        self.optional_duration(name).unwrap_or_default()
    }

    /// A point, with the number of coordinates given.
    pub fn point(&self, name: &str) -> Option<(Point, usize)> {
        let spatial = matches!(self.field(name).kind, Kind::Point);
        self.read(name, |node| value::point(node, Dimension::Length, spatial))
    }

    /// A velocity; zero where left out.
    pub fn velocity(&self, name: &str) -> Point {
        self.read(name, |node| value::point(node, Dimension::Speed, true))
            .map_or(Point::ZERO, |(velocity, _)| velocity)
    }

    /// A list of points of the floor plane.
    pub fn outline(&self, name: &str) -> Vec<Point> {
        let mut points = Vec::new();
        for (node, path) in self.list(name) {
            match value::point(node, Dimension::Length, false) {
                Ok((point, _)) => points.push(point),
                Err((message, help)) => {
                    let help = help.unwrap_or_default();
                    self.report
                        .problem_with_help(node.origin, &path, message, help);
                }
            }
        }
        points
    }

    /// A pair of heights.
    pub fn heights(&self, name: &str) -> Option<(f64, f64)> {
        self.read(name, value::heights)
    }

    /// Reads a table; where it is left out, as if it were empty.
    pub fn table<T>(&self, name: &str, read: impl FnOnce(Section<'_>) -> T) -> T {
        let path = self.path.below(name);
        let node = self.node(name);
        let origin = node.map_or(self.origin, |node| node.origin);
        read(Section::open(
            node,
            origin,
            &path,
            self.field(name).kind.fields(),
            self.report,
        ))
    }

    /// Reads a table; none where it is left out.
    pub fn optional_table<T>(
        &self,
        name: &str,
        read: impl FnOnce(Section<'_>) -> Option<T>,
    ) -> Option<T> {
        self.node(name)?;
        self.table(name, read)
    }

    /// Reads a table that may be `true` or `false` instead.
    pub fn switch<T>(&self, name: &str, read: impl FnOnce(Section<'_>) -> T) -> Option<T> {
        let on = match self.node(name).map(|node| &node.value) {
            None => matches!(self.field(name).default, Default::Value("true")),
            Some(Value::Flag(flag)) => *flag,
            Some(_) => return Some(self.table(name, read)),
        };
        let path = self.path.below(name);
        let origin = self.origin_of(name);
        let fields = self.field(name).kind.fields();
        on.then(|| read(Section::open(None, origin, &path, fields, self.report)))
    }

    /// Reads an element of a list of tables as if it were empty; for what the command line adds.
    pub fn blank_element<T>(&self, name: &str, read: impl FnOnce(Section<'_>) -> T) -> T {
        let path = self.path.below(name);
        read(Section::open(
            None,
            self.origin,
            &path,
            self.field(name).kind.fields(),
            self.report,
        ))
    }

    /// Reads each of several tables.
    pub fn tables<T>(&self, name: &str, mut read: impl FnMut(Section<'_>) -> T) -> Vec<T> {
        let path = self.path.below(name);
        let fields = self.field(name).kind.fields();
        let mut found = Vec::new();
        for (index, (node, _)) in self.list(name).into_iter().enumerate() {
            let path = path.below(index);
            found.push(read(Section::open(
                Some(node),
                node.origin,
                &path,
                fields,
                self.report,
            )));
        }
        found
    }
}
