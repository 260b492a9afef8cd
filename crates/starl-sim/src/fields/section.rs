//! A typed view of one table of the scenario.
//!
//! Invariant: every name in the table is in the schema, or reported; every requested value satisfies the schema, or is
//! reported and replaced by the default, so that reading continues and finds more problems.

use super::path::Path;
use super::report::{Origin, Report};
use super::schema::{Default, Field, Kind};
use super::suggest;
use super::tree::{Node, Table, Value};
use super::value::Complaint;

/// A table of the scenario with its schema.
#[derive(Clone, Copy)]
pub(crate) struct Section<'a> {
    table: Option<&'a Table>,
    /// Whether something else stands in its place, which is reported once.
    is_replaced: bool,
    path: &'a Path<'a>,
    fields: &'static [Field],
    /// Where the table begins, or would.
    pub origin: Origin,
    /// Where problems go.
    pub report: &'a Report,
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
            is_replaced: false,
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
                section.is_replaced = true;
                let message = format!("{} is not a table", other.describe());
                let is_needed = |field: &&Field| field.default == Default::Required;
                let needed = fields.iter().filter(is_needed);
                let needed: Vec<String> = needed
                    .map(|field| format!("{} = ...", field.name))
                    .collect();
                let help = match needed.is_empty() {
                    true => format!("write [{}] or {{ ... }}", path.join("")),
                    false => format!("write {{ {} }}", needed.join(", ")),
                };
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
            // Parameters of programs are easily mistaken for fields.
            let parameter = || format!("is it a parameter of the program, `parameters.{name}`?");
            let is_top = names.contains(&"parameters") && names.contains(&"program");
            let help = help.or_else(|| is_top.then(parameter));
            self.complain(entry.name_origin, name, (message, help));
        }
    }

    /// The names of all fields.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.fields.iter().map(|field| field.name)
    }

    /// The schema of a field.
    pub fn field(&self, name: &str) -> &'static Field {
        self.fields
            .iter()
            .find(|field| field.name == name)
            .unwrap_or_else(|| unreachable!("{} is not in the schema", self.path.join(name)))
    }

    /// The node of a field; none where it is left out or is the word that says so.
    pub fn node(&self, name: &str) -> Option<&'a Node> {
        let node = &self.table?.get(name)?.node;
        let absent = match (&node.value, self.field(name).default) {
            (Value::Text(text), Default::Word(word) | Default::Kept(Some(word))) => text == word,
            _ => false,
        };
        (!absent).then_some(node)
    }

    /// Whether the field is written, even as a word such as `none`.
    pub fn is_written(&self, name: &str) -> bool {
        self.table.is_some_and(|table| table.contains_key(name))
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

    fn complain(&self, origin: Origin, name: &str, complaint: Complaint) {
        self.report
            .complain(origin, &self.path.join(name), complaint);
    }

    /// Reads a field; reports it if it does not do, or is left out though required.
    pub fn read<T>(
        &self,
        name: &str,
        parse: impl FnOnce(&'a Node) -> Result<T, Complaint>,
    ) -> Option<T> {
        let Some(node) = self.node(name) else {
            let Field { kind, default, .. } = self.field(name);
            if *default == Default::Required && !self.is_replaced {
                let help = match kind {
                    Kind::Tables(_) => format!("write [[{}]]", self.path.join(name)),
                    kind => format!("give a value: {}", kind.describe()),
                };
                self.complain(self.origin, name, ("is missing".to_string(), Some(help)));
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
            Some(Value::Table(_)) => return Some(self.table(name, read)),
            Some(other) => {
                let message = format!("{} is not true, false or a table", other.describe());
                self.problem(name, message, "write true, false or { ... }");
                return None;
            }
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
