//! Records and messages: their fields, their order, and how large they are.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::collect::name_of;
use super::state::{Checker, RecordNode};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Record, RecordField, RecordId, Type};
use crate::syntax::ast;

/// How deep records may be nested.
const DEEPEST: usize = 30;

/// How many parts a record may have, with the parts of its parts.
const LARGEST: u32 = 100;

impl Checker {
    pub fn record_fields(&mut self, id: RecordId) {
        let fields: Vec<ast::Field> = match &self.nodes.records[id.index()] {
            RecordNode::Record(node) => node.fields().collect(),
            RecordNode::Message(node) => node.fields().collect(),
        };
        self.file = self.program[id].site.file;
        for field in fields {
            let ty = self.written_or_error(field.ty());
            let Some(name) = name_of(&field) else {
                continue;
            };
            let fields = &self.program[id].fields;
            if let Some(first) = fields.iter().find(|other| other.name == name.text) {
                let first = first.site.span;
                self.duplicate("fields", &name.text, name.span, first);
                continue;
            }
            let site = self.site(name.span);
            self.program[id].fields.push(RecordField {
                name: name.text,
                ty,
                site,
            });
        }
    }

    /// Orders the records; one that contains itself is reported, and the field that closes the circle
    /// gets no type.
    pub fn order_records(&mut self) {
        let mut order = Vec::new();
        let mut done = BTreeSet::new();
        for number in 0..self.program.records.len() {
            self.visit_record(
                RecordId(number as u32),
                &mut Vec::new(),
                &mut done,
                &mut order,
            );
        }
        self.program.record_order = order;
    }

    pub fn visit_record(
        &mut self,
        id: RecordId,
        way: &mut Vec<RecordId>,
        done: &mut BTreeSet<RecordId>,
        order: &mut Vec<RecordId>,
    ) {
        if done.contains(&id) {
            return;
        }
        way.push(id);
        for number in 0..self.program[id].fields.len() {
            let mut parts = Vec::new();
            records_in(&self.program[id].fields[number].ty, &mut parts);
            for part in parts {
                if way.contains(&part) || way.len() > DEEPEST {
                    let circle = way.iter().position(|other| *other == part);
                    self.report_recursion(id, number, circle.map(|start| &way[start..]));
                    self.program[id].fields[number].ty = Type::Error;
                    break;
                }
                self.visit_record(part, way, done, order);
            }
        }
        way.pop();
        done.insert(id);
        order.push(id);
        self.check_size(id);
    }

    /// Reports a record whose values would have too many parts. Its parts must be checked before.
    pub fn check_size(&mut self, id: RecordId) {
        let fields = self.program[id].fields.iter();
        let size = 1 + fields.map(|field| self.size(&field.ty)).sum::<u32>();
        if size > LARGEST {
            let site = self.program[id].site;
            let message = match self.program[id].is_tuple() {
                true => "this tuple has too many parts".into(),
                false => format!("a `{}` has too many parts", self.program[id].name),
            };
            self.file = site.file;
            let problem = Diagnostic::new(Code::TooLarge, site.span, message);
            let note = format!(
                "it has {size} parts including nested ones, and at most {LARGEST} are allowed; a list or a map counts as one"
            );
            self.report(problem.note(note));
            self.program[id].fields.clear();
        }
        // Records that contain it are not reported again.
        self.sizes.insert(id, if size > LARGEST { 1 } else { size });
    }

    /// Of how many parts a value of the type is made; a part that holds many, such as a list, is one.
    pub fn size(&self, of: &Type) -> u32 {
        match of {
            Type::Record(id) => self.sizes.get(id).copied().unwrap_or(1),
            Type::Optional(inner) => 1 + self.size(inner),
            Type::Point => 3,
            _ => 1,
        }
    }

    pub fn report_recursion(&mut self, id: RecordId, field: usize, circle: Option<&[RecordId]>) {
        let (record, field) = (&self.program[id], &self.program[id].fields[field]);
        self.file = record.site.file;
        let named = |id: &&RecordId| !self.program[**id].is_tuple();
        let message = match circle.and_then(|circle| circle.iter().find(named)) {
            Some(record) => format!("a `{}` contains itself", self.program[*record].name),
            None => "records are nested too deeply here".into(),
        };
        let problem = Diagnostic::new(Code::RecursiveType, field.site.span, message);
        let note = "values have limited depth; refer to another one by its index or key";
        self.report(problem.note(note));
    }
}

impl Checker {
    /// The type of tuples with these parts, `span` being where it is first written.
    pub fn tuple_type(&mut self, parts: Vec<Type>, span: Span) -> Type {
        if parts.len() < 2 || parts.iter().any(Type::has_error) {
            return Type::Error;
        }
        let id = match self.tuples.get(&parts) {
            Some(known) => *known,
            None => self.add_tuple(parts, span),
        };
        // One that is too large is reported, and has no parts.
        match self.program[id].fields.is_empty() {
            true => Type::Error,
            false => Type::Record(id),
        }
    }

    fn add_tuple(&mut self, parts: Vec<Type>, span: Span) -> RecordId {
        let id = RecordId(self.program.records.len() as u32);
        let site = self.site(span);
        let fields = parts.iter().enumerate().map(|(number, ty)| RecordField {
            name: number.to_string(),
            ty: ty.clone(),
            site,
        });
        self.program.records.push(Record {
            name: String::new(),
            is_message: false,
            fields: fields.collect(),
            site,
            documentation: String::new(),
        });
        self.program.record_order.push(id);
        self.tuples.insert(parts, id);
        self.check_size(id);
        id
    }
}

/// The records that a type is made of.
pub(super) fn records_in(ty: &Type, found: &mut Vec<RecordId>) {
    match ty {
        Type::Record(id) => found.push(*id),
        Type::List(part) | Type::Set(part) | Type::Optional(part) => records_in(part, found),
        Type::Map(key, value) => {
            records_in(key, found);
            records_in(value, found);
        }
        _ => {}
    }
}
