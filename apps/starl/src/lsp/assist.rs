//! Hover and completion.

use super::convert::Text;
use super::documents::{Checked, Documents};
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionList, CompletionTextEdit, Documentation, Hover,
    HoverContents, InsertTextFormat, MarkupContent, MarkupKind, ParameterInformation,
    ParameterLabel, Position, SignatureHelp, SignatureInformation, TextEdit,
};
use starl_editor::{Completion, CompletionKind, Insertion};

/// The information at a position.
pub fn hover(checked: &Checked, position: Position) -> Option<Hover> {
    let text = Text::new(checked.analysis.text());
    let (span, description) = checked.analysis.hover(text.offset(position))?;
    Some(Hover {
        contents: HoverContents::Markup(markdown(description.markdown())),
        range: Some(text.range(span)),
    })
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

/// The parameters of the call whose arguments are being typed.
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

/// The completions at a position of a text; `snippets` says whether the editor can put the cursor
/// between brackets.
pub fn completions(
    documents: &Documents,
    checked: &Checked,
    position: Position,
    snippets: bool,
) -> CompletionList {
    let source = checked.analysis.text();
    let text = Text::new(source);
    let libraries = documents.libraries(&checked.uri);
    let found = starl_editor::completions(source, text.offset(position), &libraries);
    let range = text.range(found.span);
    let has_brackets = found.has_brackets;
    let items = found.items.into_iter().enumerate().map(|(number, item)| {
        let (inserted, format) = inserted(&item, has_brackets, snippets);
        CompletionItem {
            kind: Some(kind(item.kind())),
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

/// An editor that cannot put the cursor between brackets gets none: they would be in the way.
fn inserted(item: &Completion, has_brackets: bool, snippets: bool) -> (String, InsertTextFormat) {
    let Insertion { text, cursor } = item.insertion(has_brackets);
    match (text.split_at(cursor), snippets) {
        ((_, ""), _) => (text, InsertTextFormat::PLAIN_TEXT),
        ((before, behind), true) => (format!("{before}$0{behind}"), InsertTextFormat::SNIPPET),
        (_, false) => (item.label.clone(), InsertTextFormat::PLAIN_TEXT),
    }
}

fn kind(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Class => CompletionItemKind::CLASS,
        CompletionKind::Constant => CompletionItemKind::CONSTANT,
        CompletionKind::Enum => CompletionItemKind::ENUM,
        CompletionKind::EnumMember => CompletionItemKind::ENUM_MEMBER,
        CompletionKind::Event => CompletionItemKind::EVENT,
        CompletionKind::Field => CompletionItemKind::FIELD,
        CompletionKind::Function => CompletionItemKind::FUNCTION,
        CompletionKind::Keyword => CompletionItemKind::KEYWORD,
        CompletionKind::Method => CompletionItemKind::METHOD,
        CompletionKind::Module => CompletionItemKind::MODULE,
        CompletionKind::Property => CompletionItemKind::PROPERTY,
        CompletionKind::Struct => CompletionItemKind::STRUCT,
        CompletionKind::Variable => CompletionItemKind::VARIABLE,
    }
}
