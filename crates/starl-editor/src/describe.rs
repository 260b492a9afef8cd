//! Descriptions of names, in the words of their declarations.

use crate::built_in::built_in;
use crate::description::Description;
use crate::index::headers;
use starl_lang::check::{Checked, Symbol};
use starl_lang::ir::{EnumId, Event, RecordId, Site, Type};
use starl_lang::syntax::ast::{self, AstNode, Documented, Item};
use starl_lang::syntax::{SyntaxKind, SyntaxNode};

/// Up to which length a value is part of what is shown of a declaration.
const LONGEST_VALUE: usize = 60;

pub(crate) fn describe(checked: &Checked, symbol: Symbol) -> Description {
    let program = &checked.program;
    let typed = |ty: &Type| program.type_name(ty);
    match symbol {
        Symbol::Enum(id) => {
            let name = program[id].name.clone().unwrap_or_default();
            Description::new(enum_text(checked, id, &name), &*program[id].documentation)
        }
        Symbol::Variant(id, number) => variant(checked, id, number),
        Symbol::Record(id) => {
            Description::new(record_text(checked, id), &*program[id].documentation)
        }
        Symbol::Field(id, number) => field(checked, id, number),
        Symbol::Parameter(id) => {
            let found = &program[id];
            let text = format!("param {}: {}", found.name, typed(&found.ty));
            let text = with_range(checked, text, found.site);
            with_value(checked, text, found.site, &found.documentation)
        }
        Symbol::Constant(id) => {
            let found = &program[id];
            let text = format!("const {}: {}", found.name, typed(&found.ty));
            with_value(checked, text, found.site, &found.documentation)
        }
        Symbol::Variable(id) => {
            let found = &program[id];
            let stable = if found.is_stable { "stable " } else { "" };
            let text = format!("{stable}{}: {}", found.name, typed(&found.ty));
            with_value(checked, text, found.site, &found.documentation)
        }
        Symbol::Shared(id) => {
            let found = &program[id];
            let (word, index) = match found.is_single_writer {
                true => ("allread", "[RobotId]"),
                false => ("allwrite", ""),
            };
            let text = format!("{word} {}{index}: {}", found.name, typed(&found.ty));
            with_value(checked, text, found.site, &found.documentation)
        }
        Symbol::Binding(id) => binding(checked, id),
        Symbol::Function(id) => {
            let found = &program[id];
            let parameters: Vec<String> = (found.locals.iter())
                .take(found.parameters as usize)
                .map(|local| format!("{}: {}", local.name, typed(&local.ty)))
                .collect();
            let text = format!(
                "function {}({}) -> {}",
                found.name,
                parameters.join(", "),
                typed(&found.result)
            );
            Description::new(text, &*found.documentation)
        }
        Symbol::Local(site) => local(checked, site),
        Symbol::Action(number) => match program.actions.get(number as usize) {
            Some(action) => Description::new(format!("{}()", action.name), &*action.documentation),
            None => Description::default(),
        },
        Symbol::Property(number) => match program.properties.get(number as usize) {
            Some(property) => Description::new(
                property.name.clone().unwrap_or_default(),
                &*property.documentation,
            ),
            None => Description::default(),
        },
        Symbol::Input(number) => input(checked, number),
        Symbol::File(file) => header(checked, file),
        _ => built_in(symbol),
    }
}

fn enum_text(checked: &Checked, id: EnumId, name: &str) -> String {
    let variants: Vec<&str> = (checked.program[id].variants.iter())
        .map(|variant| variant.name.as_str())
        .collect();
    match name {
        "" => format!("enum {{{}}}", variants.join(", ")),
        _ => format!("enum {name} {{{}}}", variants.join(", ")),
    }
}

fn record_text(checked: &Checked, id: RecordId) -> String {
    let record = &checked.program[id];
    let fields: Vec<String> = (record.fields.iter())
        .map(|field| format!("{}: {}", field.name, checked.program.type_name(&field.ty)))
        .collect();
    match record.is_message {
        true => format!("message {}({})", record.name, fields.join(", ")),
        false => format!("record {} {{{}}}", record.name, fields.join(", ")),
    }
}

fn variant(checked: &Checked, id: EnumId, number: u16) -> Description {
    let program = &checked.program;
    let declared = &program[id];
    let Some(variant) = declared.variants.get(number as usize) else {
        return Description::default();
    };
    let roles =
        (program.roles.as_ref()).filter(|roles| program[roles.variable].ty == Type::Enum(id));
    if let Some(role) = roles.and_then(|roles| roles.roles.get(number as usize)) {
        return Description::new(format!("role {}", role.name), &*role.documentation);
    }
    let of = declared.name.clone();
    let text = match &of {
        Some(of) => format!("{of}.{}", variant.name),
        None => variant.name.clone(),
    };
    let whole = enum_text(checked, id, of.as_deref().unwrap_or_default());
    Description::new(text, format!("`{whole}`"))
}

fn field(checked: &Checked, id: RecordId, number: u32) -> Description {
    let record = &checked.program[id];
    let Some(field) = record.fields.get(number as usize) else {
        return Description::default();
    };
    let of = checked.program.type_name(&Type::Record(id));
    let ty = checked.program.type_name(&field.ty);
    let text = format!("{of}.{}: {ty}", field.name);
    let node: Option<ast::Field> = around(checked, field.site).filter(|_| !record.is_tuple());
    Description::new(
        text,
        node.map_or(String::new(), |node| node.documentation()),
    )
}

fn binding(checked: &Checked, id: starl_lang::ir::BindingId) -> Description {
    let found = &checked.program[id];
    let node: Option<ast::BindingDeclaration> = around(checked, found.site);
    let text = node.map_or(found.name.clone(), |node| {
        written(checked, found.site.file, &node)
    });
    let of_kind = found.primitive.map_or("", |kind| kind.documentation);
    let parts = [found.documentation.as_str(), of_kind];
    let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    Description::new(text, parts.join("\n\n"))
}

fn local(checked: &Checked, site: Site) -> Description {
    let locals = &checked.resolutions.locals;
    let found = locals.iter().find(|(own, _)| *own == site);
    let ty = found.map_or("?".into(), |(_, ty)| checked.program.type_name(ty));
    let name = checked.files.get(site.file as usize);
    let name = name.map_or("", |file| site.span.of(&file.source));
    let node = node_at(checked, site);
    let (what, documentation) = match &node {
        Some(node) => (local_kind(node), parameter_documentation(node)),
        None => ("a local variable", String::new()),
    };
    let text = match what {
        "a local variable" => format!("let {name}: {ty}"),
        _ => format!("{name}: {ty}"),
    };
    Description {
        of_locals: Some(what),
        ..Description::new(text, documentation)
    }
}

/// The kind of local that the name declares.
pub(crate) fn local_kind(name: &SyntaxNode) -> &'static str {
    match name.parent().map(|parent| parent.kind()) {
        Some(SyntaxKind::Parameter) => "a parameter",
        Some(SyntaxKind::LoopVariables) => "a loop variable",
        Some(SyntaxKind::HandlerParameterList) => "a parameter of the handler",
        Some(SyntaxKind::QuantifierExpression) => "a robot",
        Some(SyntaxKind::SomeExpression) => "the value of an optional",
        _ => "a local variable",
    }
}

fn parameter_documentation(name: &SyntaxNode) -> String {
    let parameter = name.parent().and_then(ast::Parameter::cast);
    parameter.map_or(String::new(), |parameter| parameter.documentation())
}

fn input(checked: &Checked, number: u32) -> Description {
    let program = &checked.program;
    let Some(handler) = program.handlers.get(number as usize) else {
        return Description::default();
    };
    let Event::Input { name, fields } = &handler.event else {
        return Description::default();
    };
    let fields = fields.iter();
    let fields: Vec<String> = fields
        .map(|(name, ty)| format!("{name}: {}", program.type_name(ty)))
        .collect();
    let node: Option<Item> = around(checked, handler.site);
    Description::new(
        format!("on input {name}({})", fields.join(", ")),
        node.map_or(String::new(), |node| node.documentation()),
    )
}

fn header(checked: &Checked, file: u32) -> Description {
    let Some(found) = checked.files.get(file as usize) else {
        return Description::default();
    };
    let mut items = found.parse.tree().items();
    let item = items.find(|item| matches!(item, Item::Program(_) | Item::Library(_)));
    let is_program = matches!(item, Some(Item::Program(_)));
    let word = if is_program { "program" } else { "library" };
    let documentation = item.map_or(String::new(), |item| item.documentation());
    let site = headers(checked).find(|(number, _)| *number == file);
    let name = site.map_or(found.name.as_str(), |(_, site)| site.span.of(&found.source));
    Description::new(format!("{word} {name}"), documentation)
}

/// The text of a declaration with the range of a parameter as it is written.
fn with_range(checked: &Checked, text: String, site: Site) -> String {
    match part::<ast::ParameterRange>(checked, site) {
        Some(range) => format!("{text} {}", written(checked, site.file, &range)),
        None => text,
    }
}

/// The description of a declaration, with its value as it is written, if there is one and it is short.
fn with_value(checked: &Checked, text: String, site: Site, documentation: &str) -> Description {
    let value = part::<ast::Expression>(checked, site);
    let value = value.map(|value| written(checked, site.file, &value));
    let text = match value.filter(|value| value.len() <= LONGEST_VALUE) {
        Some(value) => format!("{text} = {value}"),
        None => text,
    };
    Description::new(text, documentation)
}

/// A part of the declaration whose name is at a place.
fn part<T: AstNode>(checked: &Checked, site: Site) -> Option<T> {
    let declaration = node_at(checked, site)?.parent()?;
    declaration.children().find_map(T::cast)
}

/// The innermost node of this kind around a name at a place.
fn around<T: AstNode>(checked: &Checked, site: Site) -> Option<T> {
    node_at(checked, site)?.ancestors().find_map(T::cast)
}

/// A part of a file as it is written, on one line.
fn written(checked: &Checked, file: u32, node: &impl AstNode) -> String {
    let text = node.span().of(&checked.files[file as usize].source);
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ")
}

/// The node that is a name at a place.
pub(crate) fn node_at(checked: &Checked, site: Site) -> Option<SyntaxNode> {
    let file = checked.files.get(site.file as usize)?;
    let root = file.parse.syntax();
    let range = rowan::TextRange::new(site.span.start.into(), site.span.end.into());
    if !root.text_range().contains_range(range) {
        return None;
    }
    // Unlike `token_at_offset` this looks at few of the nodes on its way.
    match root.covering_element(range) {
        rowan::NodeOrToken::Node(node) => Some(node),
        rowan::NodeOrToken::Token(token) => token.parent(),
    }
}
