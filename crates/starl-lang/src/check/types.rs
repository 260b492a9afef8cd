//! Types as they are written, and the types of declarations.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::collect::name_of;
use super::report::did_you_mean;
use super::resolution::Symbol;
use super::scope::Entity;
use super::state::Checker;
use super::surroundings::Surroundings;
use super::tables::Primitive;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Local, RecordId, Type};
use crate::syntax::SyntaxKind;
use crate::syntax::SyntaxToken;
use crate::syntax::ast::{self, AstNode};
use crate::syntax::type_meant;

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

/// Names in other languages for a type of values that may be missing.
const FOREIGN_OPTIONAL: [&str; 3] = ["Option", "Optional", "Maybe"];

impl Checker {
    /// Gives all declarations except constants their types; a constant has that of its value.
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
                    self.report(problem.write(index.span(), "RobotId"));
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

    fn function_parameters(&mut self, node: &ast::FunctionDeclaration) -> Vec<Local> {
        let mut parameters: Vec<Local> = Vec::new();
        for parameter in node.parameters() {
            let ty = self.written_or_error(parameter.ty());
            let Some(name) = name_of(&parameter) else {
                continue;
            };
            if let Some(first) = parameters.iter().find(|other| other.name == name.text) {
                self.duplicate("parameters", &name.text, name.span, first.span);
            }
            parameters.push(Local {
                name: name.text,
                ty,
                span: name.span,
            });
        }
        parameters
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
                let mut words = optional.syntax().children_with_tokens();
                let twice = words.any(|word| word.kind() == SyntaxKind::QuestionQuestion);
                let span = optional.span();
                let extra = match (&inner, twice) {
                    (Type::Optional(_), true) => Some(2),
                    (Type::Optional(_), false) | (_, true) => Some(1),
                    _ => None,
                };
                if let Some(extra) = extra {
                    let mark = Span::new(span.end - extra, span.end);
                    let problem =
                        Diagnostic::new(Code::TypeArguments, mark, "this type is already optional");
                    self.report(problem.replace("write one `?`", mark, ""));
                }
                Type::optional(inner)
            }
            ast::Type::Tuple(tuple) => {
                let parts = tuple.types().map(|part| self.written(&part)).collect();
                self.tuple_type(parts, tuple.span())
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
        if words.len() == 1
            && let Some(name) = BUILT_IN.iter().find(|name| **name == word.text())
        {
            self.resolve(span, Symbol::Type(name));
        }
        if words.len() == 1 && wanted > 0 {
            return self.collection_type(named, word.text(), wanted, arguments);
        }
        let ty = match words.get(1) {
            Some(name) => self.library_type(word, name),
            None if arguments.len() == 1 && self.is_foreign_optional(word.text()) => {
                return self.foreign_optional(named, word.text());
            }
            None => self.type_by_name(word.text(), span),
        };
        if !arguments.is_empty() && ty != Type::Error {
            let message = format!("`{}` holds no other type", word.text());
            self.error(Code::TypeArguments, named.span(), message);
        }
        ty
    }

    fn is_foreign_optional(&self, word: &str) -> bool {
        let scope = &self.files[self.file as usize].scope;
        FOREIGN_OPTIONAL.contains(&word) && !scope.contains_key(word)
    }

    /// Reports `Option[Int]`.
    fn foreign_optional(&mut self, named: &ast::NamedType, word: &str) -> Type {
        let inner = named.arguments().next().map(|inner| inner.span());
        let meant = format!("{}?", inner.map_or("T", |inner| self.text(inner)));
        let message = format!("there is no type `{word}`");
        let problem = Diagnostic::new(Code::UnknownType, named.span(), message);
        self.report(problem.write(named.span(), meant));
        Type::Error
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
        if let Some(ty) = Type::built_in(name) {
            return ty;
        }
        for file in [self.file, super::prelude::FILE] {
            match self.declared(file, name) {
                Some(Entity::Enum(id)) => {
                    self.usage.used.insert(Entity::Enum(id));
                    self.resolve(span, Symbol::Enum(id));
                    return Type::Enum(id);
                }
                Some(Entity::Record(id)) => {
                    self.usage.used.insert(Entity::Record(id));
                    self.resolve(span, Symbol::Record(id));
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
        if self.is_probe(span) {
            self.note_probe(Surroundings::Type);
        }
        if self.may_be_unread(name) {
            return Type::Error;
        }
        let message = format!("there is no type `{name}`");
        let problem = Diagnostic::new(Code::UnknownType, span, message);
        if Primitive::named(name).is_some() {
            let before = self.text(Span::new(0, span.start)).trim_end();
            let place = Span::new(before.len().saturating_sub(1) as u32, span.end);
            let message = format!("the primitive `{name}` is not a type");
            let problem = Diagnostic::new(Code::UnknownType, span, message);
            self.report(match before.strip_suffix(':') {
                Some(_) => {
                    let meant = format!(" = {name}()");
                    problem.write(place, meant)
                }
                None => problem.note(format!("a primitive is bound to a name: `name = {name}()`")),
            });
            return Type::Error;
        }
        let foreign = type_meant(name);
        let scope = &self.files[self.file as usize].scope;
        let declared = (scope.iter())
            .filter(|(_, declared)| matches!(declared.entity, Entity::Enum(_) | Entity::Record(_)))
            .map(|(name, _)| name.as_str());
        let problem = match foreign {
            Some(meant) => problem.replace(format!("did you mean `{meant}`?"), span, meant),
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
        if self.is_probe(span) {
            self.note_probe(Surroundings::Part(Symbol::File(file)));
        }
        let entity = self.declared(file, name.text());
        if let Some(entity) = entity {
            self.resolve_entity(span, entity);
        }
        match entity {
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
        match self.declared(self.file, word.text()) {
            Some(Entity::Library(file)) => {
                self.usage.imports.insert((self.file, file));
                self.resolve(word.text_range().into(), Symbol::File(file));
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
        let note = "keys are Bool, Int, String, RobotId, Time, Duration, Point, enums, and records and tuples of these";
        self.report(problem.note(note));
        false
    }
}
