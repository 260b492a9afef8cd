//! The outline of a text, as a tree.

use serde::Serialize;
use starl_lang::diagnostic::Span;
use starl_lang::syntax::Parse;
use starl_lang::syntax::ast::{self, AstNode, Item, Named};

/// The kind of a part of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum OutlineKind {
    /// An enum.
    Enum,
    /// A variant of an enum.
    Variant,
    /// A record.
    Record,
    /// A field of a record or a message.
    Field,
    /// A message.
    Message,
    /// A parameter of the program.
    Parameter,
    /// A constant.
    Constant,
    /// A variable, shared or not.
    Variable,
    /// A bound primitive.
    Primitive,
    /// A function.
    Function,
    /// An action or `init`.
    Action,
    /// A handler.
    Handler,
    /// A role.
    Role,
    /// A property.
    Property,
}

/// A part of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutlineEntry {
    /// Its kind.
    pub kind: OutlineKind,
    /// Its name.
    pub name: String,
    /// More that is worth seeing, such as its type; empty if there is nothing.
    pub detail: String,
    /// All of it, without the comments above.
    pub span: Span,
    /// Its name.
    pub name_span: Span,
    /// Its parts.
    pub parts: Vec<OutlineEntry>,
}

/// The outline of a text, in its order.
#[must_use]
pub fn outline(parse: &Parse) -> Vec<OutlineEntry> {
    let source = String::from(parse.syntax().text());
    let outline = Outline { source: &source };
    let items = parse.tree().items();
    items.filter_map(|item| outline.item(item)).collect()
}

/// The kind of a declaration, its name, what else is worth seeing, and its parts.
type Declared = (OutlineKind, Option<ast::Name>, String, Vec<OutlineEntry>);

struct Outline<'a> {
    source: &'a str,
}

impl Outline<'_> {
    fn item(&self, item: Item) -> Option<OutlineEntry> {
        let span = item.span();
        let (kind, name, detail, parts) = match item {
            Item::Program(_) | Item::Library(_) | Item::Import(_) | Item::Check(_) => return None,
            Item::Enum(node) => {
                let variants = node.variants();
                let variants = variants.map(|name| variant(&name)).collect();
                (OutlineKind::Enum, node.name(), String::new(), variants)
            }
            Item::Record(node) => {
                let fields = self.fields(node.fields());
                (OutlineKind::Record, node.name(), String::new(), fields)
            }
            Item::Message(node) => {
                let fields = self.fields(node.fields());
                (OutlineKind::Message, node.name(), String::new(), fields)
            }
            Item::Parameter(node) => self.typed(OutlineKind::Parameter, node.name(), node.ty()),
            Item::Constant(node) => self.typed(OutlineKind::Constant, node.name(), node.ty()),
            Item::Variable(node) => self.typed(OutlineKind::Variable, node.name(), node.ty()),
            Item::Shared(node) => self.typed(OutlineKind::Variable, node.name(), node.ty()),
            Item::Binding(node) => {
                let detail = self.constructor(&node);
                (OutlineKind::Primitive, node.name(), detail, Vec::new())
            }
            Item::Function(node) => self.typed(OutlineKind::Function, node.name(), node.result()),
            Item::Action(node) => self.typed(OutlineKind::Action, node.name(), None),
            Item::Init(_) => return Some(unnamed(OutlineKind::Action, "init".into(), span)),
            Item::Handler(node) => return self.handler(&node, span),
            Item::Role(node) => {
                let parts = node.items().filter(|item| !matches!(item, Item::Role(_)));
                let parts = parts.filter_map(|item| self.item(item)).collect();
                (OutlineKind::Role, node.name(), String::new(), parts)
            }
            Item::Property(node) => match node.name() {
                None => return Some(unnamed(OutlineKind::Property, node.word(), span)),
                name => (OutlineKind::Property, name, node.word(), Vec::new()),
            },
        };
        let name = name?;
        Some(OutlineEntry {
            detail,
            parts,
            ..entry(kind, name.text(), span, name.span())
        })
    }

    /// A declaration without parts, and its type.
    fn typed(&self, kind: OutlineKind, name: Option<ast::Name>, ty: Option<ast::Type>) -> Declared {
        let detail = ty.map_or(String::new(), |ty| self.text(&ty));
        (kind, name, detail, Vec::new())
    }

    fn handler(&self, node: &ast::HandlerDeclaration, span: Span) -> Option<OutlineEntry> {
        let (name, name_span) = match node.input() {
            Some(input) => (format!("on input {}", input.text()), input.span()),
            None => {
                let event = node.event()?;
                let name = self.text(&event);
                (!name.is_empty()).then(|| (format!("on {name}"), event.span()))?
            }
        };
        Some(entry(OutlineKind::Handler, name, span, name_span))
    }

    fn fields(&self, fields: impl Iterator<Item = ast::Field>) -> Vec<OutlineEntry> {
        let field = |field: ast::Field| {
            let name = field.name()?;
            Some(OutlineEntry {
                detail: field.ty().map_or(String::new(), |ty| self.text(&ty)),
                ..entry(OutlineKind::Field, name.text(), field.span(), name.span())
            })
        };
        fields.filter_map(field).collect()
    }

    fn constructor(&self, node: &ast::BindingDeclaration) -> String {
        let Some(ast::Expression::Call(call)) = node.value() else {
            return String::new();
        };
        call.callee()
            .map_or(String::new(), |callee| self.text(&callee))
    }

    fn text(&self, node: &impl AstNode) -> String {
        node.span().of(self.source).into()
    }
}

/// A part with nothing more to say and no parts of its own.
fn entry(kind: OutlineKind, name: String, span: Span, name_span: Span) -> OutlineEntry {
    OutlineEntry {
        kind,
        name,
        detail: String::new(),
        span,
        name_span,
        parts: Vec::new(),
    }
}

/// A part without a name, which begins with a keyword.
fn unnamed(kind: OutlineKind, word: String, span: Span) -> OutlineEntry {
    let end = (span.start + word.len() as u32).min(span.end);
    entry(kind, word, span, Span::new(span.start, end))
}

fn variant(name: &ast::Name) -> OutlineEntry {
    entry(OutlineKind::Variant, name.text(), name.span(), name.span())
}
