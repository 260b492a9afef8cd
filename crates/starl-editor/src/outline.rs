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

struct Outline<'a> {
    source: &'a str,
}

impl Outline<'_> {
    fn item(&self, item: Item) -> Option<OutlineEntry> {
        let span = item.span();
        let named = |kind, name: Option<ast::Name>, detail: String, parts| {
            let name = name?;
            Some(OutlineEntry {
                kind,
                name: name.text(),
                detail,
                span,
                name_span: name.span(),
                parts,
            })
        };
        let typed = |ty: Option<ast::Type>| ty.map_or(String::new(), |ty| self.text(&ty));
        match item {
            Item::Program(_) | Item::Library(_) | Item::Import(_) => None,
            Item::Enum(node) => {
                let variants = node.variants().map(|name| self.variant(&name)).collect();
                named(OutlineKind::Enum, node.name(), String::new(), variants)
            }
            Item::Record(node) => {
                let fields = node.fields().filter_map(|field| self.field(&field));
                let fields = fields.collect();
                named(OutlineKind::Record, node.name(), String::new(), fields)
            }
            Item::Message(node) => {
                let fields = node.fields().filter_map(|field| self.field(&field));
                let fields = fields.collect();
                named(OutlineKind::Message, node.name(), String::new(), fields)
            }
            Item::Parameter(node) => {
                let detail = typed(node.ty());
                named(OutlineKind::Parameter, node.name(), detail, Vec::new())
            }
            Item::Constant(node) => {
                let detail = typed(node.ty());
                named(OutlineKind::Constant, node.name(), detail, Vec::new())
            }
            Item::Variable(node) => {
                let detail = typed(node.ty());
                named(OutlineKind::Variable, node.name(), detail, Vec::new())
            }
            Item::Shared(node) => {
                let detail = typed(node.ty());
                named(OutlineKind::Variable, node.name(), detail, Vec::new())
            }
            Item::Binding(node) => {
                let detail = self.constructor(&node);
                named(OutlineKind::Primitive, node.name(), detail, Vec::new())
            }
            Item::Function(node) => {
                let detail = typed(node.result());
                named(OutlineKind::Function, node.name(), detail, Vec::new())
            }
            Item::Action(node) => {
                named(OutlineKind::Action, node.name(), String::new(), Vec::new())
            }
            Item::Check(_) => None,
            Item::Init(_) => Some(self.unnamed(OutlineKind::Action, "init".into(), span)),
            Item::Handler(node) => self.handler(&node, span),
            Item::Role(node) => {
                let parts = node.items().filter(|item| !matches!(item, Item::Role(_)));
                let parts = parts.filter_map(|item| self.item(item)).collect();
                named(OutlineKind::Role, node.name(), String::new(), parts)
            }
            Item::Property(node) => match node.name() {
                Some(name) => named(OutlineKind::Property, Some(name), node.word(), Vec::new()),
                None => Some(self.unnamed(OutlineKind::Property, node.word(), span)),
            },
        }
    }

    /// A part without a name, which begins with a keyword.
    fn unnamed(&self, kind: OutlineKind, word: String, span: Span) -> OutlineEntry {
        let end = (span.start + word.len() as u32).min(span.end);
        OutlineEntry {
            kind,
            name: word,
            detail: String::new(),
            span,
            name_span: Span::new(span.start, end),
            parts: Vec::new(),
        }
    }

    fn handler(&self, node: &ast::HandlerDeclaration, span: Span) -> Option<OutlineEntry> {
        if let Some(input) = node.input() {
            return Some(OutlineEntry {
                kind: OutlineKind::Handler,
                name: format!("on input {}", input.text()),
                detail: String::new(),
                span,
                name_span: input.span(),
                parts: Vec::new(),
            });
        }
        let event = node.event()?;
        let name = self.text(&event);
        (!name.is_empty()).then(|| OutlineEntry {
            kind: OutlineKind::Handler,
            name: format!("on {name}"),
            detail: String::new(),
            span,
            name_span: event.span(),
            parts: Vec::new(),
        })
    }

    fn variant(&self, name: &ast::Name) -> OutlineEntry {
        OutlineEntry {
            kind: OutlineKind::Variant,
            name: name.text(),
            detail: String::new(),
            span: name.span(),
            name_span: name.span(),
            parts: Vec::new(),
        }
    }

    fn field(&self, field: &ast::Field) -> Option<OutlineEntry> {
        let name = field.name()?;
        Some(OutlineEntry {
            kind: OutlineKind::Field,
            name: name.text(),
            detail: field.ty().map_or(String::new(), |ty| self.text(&ty)),
            span: field.span(),
            name_span: name.span(),
            parts: Vec::new(),
        })
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
