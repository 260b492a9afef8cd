//! What is shown at a name, and what may be typed.

use super::convert::Text;
use super::documents::{Checked, Documents};
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionList, CompletionTextEdit, Documentation, Hover,
    HoverContents, InsertTextFormat, MarkupContent, MarkupKind, ParameterInformation,
    ParameterLabel, Position, SignatureHelp, SignatureInformation, TextEdit,
};
use starl_lang::check::Symbol;
use starl_lang::editor::{self, Call, Completion, Description};

/// What is shown at a place.
pub fn hover(checked: &Checked, position: Position) -> Option<Hover> {
    let text = Text::new(checked.analysis.text());
    let (span, description) = checked.analysis.hover(text.offset(position))?;
    Some(Hover {
        contents: HoverContents::Markup(markdown(shown(&description))),
        range: Some(text.range(span)),
    })
}

fn shown(description: &Description) -> String {
    let mut parts = vec![format!("```starl\n{}\n```", description.signature)];
    let kind = description
        .of_locals
        .filter(|kind| *kind != "a local variable");
    parts.extend(kind.map(|kind| format!("_{kind}_")));
    if !description.documentation.is_empty() {
        parts.push(description.documentation.clone());
    }
    parts.join("\n\n")
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

/// What the call takes whose arguments are being typed.
pub fn signature(checked: &Checked, position: Position) -> Option<SignatureHelp> {
    let text = Text::new(checked.analysis.text());
    let help = checked.analysis.call_help(text.offset(position))?;
    let own = Text::new(&help.signature);
    let parameters = help.parameters.iter().map(|span| {
        let range = own.range(*span);
        let label = [range.start.character, range.end.character];
        ParameterInformation {
            label: ParameterLabel::LabelOffsets(label),
            documentation: None,
        }
    });
    let parameters = parameters.collect();
    let active = help.active.map(|number| number as u32);
    Some(SignatureHelp {
        active_signature: Some(0),
        active_parameter: active,
        signatures: vec![SignatureInformation {
            parameters: Some(parameters),
            documentation: (!help.documentation.is_empty())
                .then(|| Documentation::MarkupContent(markdown(help.documentation.clone()))),
            active_parameter: active,
            label: help.signature,
        }],
    })
}

/// What may be typed at a place of a text; `snippets` says whether the editor can put the cursor between
/// brackets.
pub fn completions(
    documents: &Documents,
    checked: &Checked,
    position: Position,
    snippets: bool,
) -> CompletionList {
    let source = checked.analysis.text();
    let text = Text::new(source);
    let libraries = documents.libraries(&checked.uri);
    let found = editor::completions(source, text.offset(position), &libraries);
    let range = text.range(found.span);
    let is_called = source[found.span.end as usize..].starts_with('(');
    let items = found.items.into_iter().enumerate().map(|(number, item)| {
        let call = if is_called { Call::No } else { item.call };
        let (inserted, format) = inserted(&item.label, call, snippets);
        CompletionItem {
            kind: Some(kind(&item)),
            detail: (!item.detail.is_empty()).then(|| item.detail.clone()),
            documentation: (!item.documentation.is_empty())
                .then(|| Documentation::MarkupContent(markdown(item.documentation.clone()))),
            sort_text: Some(format!("{number:05}")),
            insert_text_format: Some(format),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit::new(range, inserted))),
            label: item.label,
            ..CompletionItem::default()
        }
    });
    CompletionList {
        is_incomplete: false,
        items: items.collect(),
    }
}

fn inserted(label: &str, call: Call, snippets: bool) -> (String, InsertTextFormat) {
    match call {
        Call::Empty => (format!("{label}()"), InsertTextFormat::PLAIN_TEXT),
        Call::Given => (format!("{label} = "), InsertTextFormat::PLAIN_TEXT),
        Call::Arguments if snippets => (format!("{label}($0)"), InsertTextFormat::SNIPPET),
        _ => (label.to_string(), InsertTextFormat::PLAIN_TEXT),
    }
}

fn kind(item: &Completion) -> CompletionItemKind {
    match item.symbol {
        None if item.call == Call::Given => CompletionItemKind::FIELD,
        None if item.detail.starts_with("library ") && item.documentation.is_empty() => {
            CompletionItemKind::MODULE
        }
        None => CompletionItemKind::KEYWORD,
        Some(symbol) => match symbol {
            Symbol::Enum(_) => CompletionItemKind::ENUM,
            Symbol::Variant(..) => CompletionItemKind::ENUM_MEMBER,
            Symbol::Record(_) | Symbol::Type(_) => CompletionItemKind::STRUCT,
            Symbol::Field(..) | Symbol::Coordinate(_) | Symbol::RobotMember(_) => {
                CompletionItemKind::FIELD
            }
            Symbol::Constant(_) => CompletionItemKind::CONSTANT,
            Symbol::Function(_) => CompletionItemKind::FUNCTION,
            Symbol::Builtin(_) if item.call == Call::No => CompletionItemKind::VARIABLE,
            Symbol::Builtin(_) => CompletionItemKind::FUNCTION,
            Symbol::Method(_) => CompletionItemKind::METHOD,
            Symbol::Member(..) if item.call == Call::No => CompletionItemKind::PROPERTY,
            Symbol::Member(..) => CompletionItemKind::METHOD,
            Symbol::Primitive(_) => CompletionItemKind::CLASS,
            Symbol::Event(..) | Symbol::Action(_) | Symbol::Input(_) => CompletionItemKind::EVENT,
            Symbol::File(_) => CompletionItemKind::MODULE,
            Symbol::Parameter(_)
            | Symbol::Variable(_)
            | Symbol::Shared(_)
            | Symbol::Binding(_)
            | Symbol::Local(_)
            | Symbol::Argument(..)
            | Symbol::Property(_) => CompletionItemKind::VARIABLE,
        },
    }
}
