//! Types as they are written, and the types of declarations.

use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::collect::name_of;
use super::report::did_you_mean;
use super::scope::Entity;
use super::state::{Checker, RecordNode};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Local, RecordField, RecordId, Type};
use crate::syntax::SyntaxToken;
use crate::syntax::ast::{self, AstNode};

const BUILT_IN: &[&str] = &[
    "Bool",
    "Int",
    "Float",
    "String",
    "Point",
    "Time",
    "Duration",
    "RobotId",
    "Area",
    "Obstacles",
    "List",
    "Set",
    "Map",
];

/// How deep records may be nested.
const DEEPEST: usize = 30;

/// How many parts a record may have, with the parts of its parts.
const LARGEST: u32 = 100;

/// What people write who know other languages.
const FOREIGN: &[(&str, &str)] = &[
    ("int", "Int"),
    ("integer", "Int"),
    ("long", "Int"),
    ("float", "Float"),
    ("double", "Float"),
    ("real", "Float"),
    ("number", "Float"),
    ("boolean", "Bool"),
    ("str", "String"),
    ("text", "String"),
    ("ItemPosition", "Point"),
    ("Pos", "Point"),
    ("Position", "Point"),
    ("Robot", "RobotId"),
    ("array", "List"),
    ("dict", "Map"),
];

impl Checker {
    /// Gives all declarations their types, constants aside, which have those of their values.
    pub fn resolve_types(&mut self) {
        for number in 0..self.nodes.records.len() {
            self.record_fields(RecordId(number as u32));
        }
        self.order_records();
        self.file = 0;
        for number in 0..self.nodes.parameters.len() {
            let node = self.nodes.parameters[number].clone();
            self.program.parameters[number].ty = self.written_or_error(node.ty());
        }
        for number in 0..self.nodes.variables.len() {
            if let Some(node) = self.nodes.variables[number].clone() {
                self.program.variables[number].ty = self.written_or_error(node.ty());
            }
        }
        for number in 0..self.nodes.shared.len() {
            let node = self.nodes.shared[number].clone();
            if let Some(index) = node.index() {
                let ty = self.written(&index);
                if !matches!(ty, Type::Robot | Type::Error) {
                    let message = "a single-writer variable has an element for each robot";
                    let problem = Diagnostic::new(Code::WrongType, index.span(), message);
                    let problem = problem.expected("RobotId").found(self.name_of(&ty));
                    self.report(problem.replace("write `RobotId`", index.span(), "RobotId"));
                }
            }
            self.program.shared[number].ty = self.written_or_error(node.ty());
        }
        for number in 0..self.nodes.functions.len() {
            let (file, node) = self.nodes.functions[number].clone();
            self.file = file;
            let parameters = self.function_parameters(&node);
            let result = self.written_or_error(node.result());
            let function = &mut self.program.functions[number];
            function.parameters = parameters.len() as u32;
            function.locals = parameters;
            function.result = result;
        }
        self.check_keys();
        self.file = 0;
    }

    fn record_fields(&mut self, id: RecordId) {
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
                let message = format!("there are two fields `{}`", name.text);
                let problem = Diagnostic::new(Code::DuplicateName, name.span, message);
                let problem = problem.label(first.site.span, "the first one");
                self.report(problem);
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

    fn function_parameters(&mut self, node: &ast::FunctionDeclaration) -> Vec<Local> {
        let mut parameters: Vec<Local> = Vec::new();
        for parameter in node.parameters() {
            let ty = self.written_or_error(parameter.ty());
            let Some(name) = name_of(&parameter) else {
                continue;
            };
            if let Some(first) = parameters.iter().find(|other| other.name == name.text) {
                let message = format!("there are two parameters `{}`", name.text);
                let problem = Diagnostic::new(Code::DuplicateName, name.span, message);
                let problem = problem.label(first.span, "the first one");
                self.report(problem);
            }
            parameters.push(Local {
                name: name.text,
                ty,
                span: name.span,
            });
        }
        parameters
    }

    /// Orders the records; one that contains itself is reported, and the field that closes the circle
    /// gets no type.
    fn order_records(&mut self) {
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

    fn visit_record(
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
                    self.report_recursion(id, number, part, way.contains(&part));
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

    /// Reports a record whose values would have too many parts. Those that it is made of come before.
    fn check_size(&mut self, id: RecordId) {
        let fields = self.program[id].fields.iter();
        let size = 1 + fields.map(|field| self.size(&field.ty)).sum::<u32>();
        if size > LARGEST {
            let site = self.program[id].site;
            let message = format!("a `{}` has too many parts", self.program[id].name);
            self.file = site.file;
            let problem = Diagnostic::new(Code::TooLarge, site.span, message);
            let note = format!(
                "with the parts of its parts there are {size}, and at most {LARGEST}; lists and maps count as one"
            );
            self.report(problem.note(note));
            self.program[id].fields.clear();
        }
        // What is made of one that is too large is not to blame.
        self.sizes.insert(id, if size > LARGEST { 1 } else { size });
    }

    /// Of how many parts a value of the type is made; a part that holds many, such as a list, is one.
    fn size(&self, of: &Type) -> u32 {
        match of {
            Type::Record(id) => self.sizes.get(id).copied().unwrap_or(1),
            Type::Optional(inner) => 1 + self.size(inner),
            Type::Point => 3,
            _ => 1,
        }
    }

    fn report_recursion(&mut self, id: RecordId, field: usize, part: RecordId, is_circle: bool) {
        let (record, field) = (&self.program[id], &self.program[id].fields[field]);
        self.file = record.site.file;
        let message = if is_circle {
            format!("a `{}` contains itself", self.program[part].name)
        } else {
            "records are nested too deeply here".into()
        };
        let problem = Diagnostic::new(Code::RecursiveType, field.site.span, message);
        let note = "values have limited depth; refer to another one by its index or key";
        self.report(problem.note(note));
    }

    /// A type that may be missing, which the parser reports.
    pub fn written_or_error(&mut self, ty: Option<ast::Type>) -> Type {
        ty.map_or(Type::Error, |ty| self.written(&ty))
    }

    /// The type that is written.
    pub fn written(&mut self, ty: &ast::Type) -> Type {
        match ty {
            ast::Type::Named(named) => self.named_type(named),
            ast::Type::Optional(optional) => {
                let inner = self.written_or_error(optional.inner());
                if matches!(inner, Type::Optional(_)) {
                    let span = optional.span();
                    let mark = Span::new(span.end - 1, span.end);
                    let problem =
                        Diagnostic::new(Code::TypeArguments, mark, "this is optional already");
                    self.report(problem.replace("remove one `?`", mark, ""));
                }
                Type::optional(inner)
            }
            ast::Type::Enum(node) => {
                let variants = self.variant_names(node.variants());
                let site = self.site(super::collect::first_word(node.syntax()));
                Type::Enum(self.add_enum(None, variants, site, String::new(), None))
            }
        }
    }

    fn named_type(&mut self, named: &ast::NamedType) -> Type {
        let words: Vec<SyntaxToken> = named.words().collect();
        let arguments: Vec<Type> = named.arguments().map(|part| self.written(&part)).collect();
        let Some(word) = words.first() else {
            return Type::Error;
        };
        let span = Span::from(word.text_range());
        let wanted = match word.text() {
            "List" | "Set" => 1,
            "Map" => 2,
            _ => 0,
        };
        if words.len() == 1 && wanted > 0 {
            return self.collection_type(named, word.text(), wanted, arguments);
        }
        let ty = match words.get(1) {
            Some(name) => self.library_type(word, name),
            None => self.type_by_name(word.text(), span),
        };
        if !arguments.is_empty() && ty != Type::Error {
            let message = format!("`{}` holds no other type", word.text());
            self.error(Code::TypeArguments, named.span(), message);
        }
        ty
    }

    fn collection_type(
        &mut self,
        named: &ast::NamedType,
        word: &str,
        wanted: usize,
        arguments: Vec<Type>,
    ) -> Type {
        let span = named.span();
        if arguments.len() != wanted {
            let form = match word {
                "List" => "List[Int]",
                "Set" => "Set[Int]",
                _ => "Map[String, Int]",
            };
            let holds = if wanted == 1 { "one type" } else { "two types" };
            let message = format!("a {word} holds {holds}");
            let problem = Diagnostic::new(Code::TypeArguments, span, message);
            self.report(problem.note(format!("such as `{form}`")));
            return Type::Error;
        }
        let mut arguments = arguments.into_iter();
        let (Some(first), second) = (arguments.next(), arguments.next()) else {
            return Type::Error;
        };
        match second {
            Some(value) => {
                self.keys.push((self.site(span), first.clone()));
                Type::Map(Box::new(first), Box::new(value))
            }
            None if word == "Set" => {
                self.keys.push((self.site(span), first.clone()));
                Type::set(first)
            }
            None => Type::list(first),
        }
    }

    fn type_by_name(&mut self, name: &str, span: Span) -> Type {
        if let Some(ty) = self.built_in_type(name) {
            return ty;
        }
        for file in [self.file, super::prelude::FILE] {
            let declared = self.files[file as usize].scope.get(name).copied();
            match declared.map(|declared| declared.entity) {
                Some(Entity::Enum(id)) => {
                    self.usage.used.insert(Entity::Enum(id));
                    return Type::Enum(id);
                }
                Some(Entity::Record(id)) => {
                    self.usage.used.insert(Entity::Record(id));
                    return Type::Record(id);
                }
                Some(Entity::Broken) => return Type::Error,
                Some(other) => {
                    let message = format!("`{name}` is {}, not a type", other.what());
                    self.error(Code::UnknownType, span, message);
                    return Type::Error;
                }
                None => {}
            }
        }
        if self.may_be_unread(name) {
            return Type::Error;
        }
        let problem = Diagnostic::new(
            Code::UnknownType,
            span,
            format!("there is no type `{name}`"),
        );
        let foreign = FOREIGN.iter().find(|(word, _)| *word == name);
        let scope = &self.files[self.file as usize].scope;
        let declared = (scope.iter())
            .filter(|(_, declared)| matches!(declared.entity, Entity::Enum(_) | Entity::Record(_)))
            .map(|(name, _)| name.as_str());
        let problem = match foreign {
            Some((_, meant)) => problem.replace(format!("did you mean `{meant}`?"), span, *meant),
            None => did_you_mean(
                problem,
                span,
                name,
                declared.chain(BUILT_IN.iter().copied()),
            ),
        };
        self.report(problem);
        Type::Error
    }

    fn library_type(&mut self, library: &SyntaxToken, name: &SyntaxToken) -> Type {
        let Some(file) = self.library_named(library) else {
            return Type::Error;
        };
        let span = Span::from(name.text_range());
        let entity = self.files[file as usize].scope.get(name.text());
        match entity.map(|declared| declared.entity) {
            Some(Entity::Enum(id)) => Type::Enum(id),
            Some(Entity::Record(id)) => Type::Record(id),
            Some(Entity::Broken) => Type::Error,
            _ => {
                let message = format!("`{}` has no type `{}`", library.text(), name.text());
                let scope = &self.files[file as usize].scope;
                let problem = Diagnostic::new(Code::UnknownType, span, message);
                let names = scope.keys().map(String::as_str);
                let problem = did_you_mean(problem, span, name.text(), names);
                self.report(problem);
                Type::Error
            }
        }
    }

    /// The file of a library that is named; none, which is reported, if it is not imported.
    fn library_named(&mut self, word: &SyntaxToken) -> Option<u32> {
        let scope = &self.files[self.file as usize].scope;
        match scope.get(word.text()).map(|declared| declared.entity) {
            Some(Entity::Library(file)) => {
                self.usage.imports.insert((self.file, file));
                Some(file)
            }
            Some(Entity::Broken) => None,
            _ => {
                let message = format!("there is no library `{}` here", word.text());
                let span = Span::from(word.text_range());
                let problem = Diagnostic::new(Code::UnknownName, span, message);
                self.report(problem.note(format!("it needs `import {}`", word.text())));
                None
            }
        }
    }

    /// Looks at the keys of maps and elements of sets that are written in types.
    pub fn check_keys(&mut self) {
        for (site, ty) in core::mem::take(&mut self.keys) {
            self.file = site.file;
            self.check_key(&ty, site.span);
        }
    }

    /// Reports a type that cannot be a key or an element of a set; whether it can.
    pub fn check_key(&mut self, ty: &Type, span: Span) -> bool {
        if self.program.is_key(ty) {
            return true;
        }
        let name = super::report::article(&self.name_of(ty));
        let message = format!("{name} cannot be a key or an element of a set");
        let problem = Diagnostic::new(Code::InvalidKey, span, message);
        let note = "keys are Bool, Int, String, RobotId, Time, Duration, Point, enums, and records of these";
        self.report(problem.note(note));
        false
    }
}

/// The records that a type is made of.
fn records_in(ty: &Type, found: &mut Vec<RecordId>) {
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
