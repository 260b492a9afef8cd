//! The outline of a text, its words for colouring, and its layout.

use super::convert::Text;
use super::documents::Checked;
use lsp_types::{
    DocumentSymbol, FoldingRange, Range, SemanticToken, SemanticTokenModifier, SemanticTokenType,
    SemanticTokens, SymbolKind, TextEdit,
};
use starl_editor::{OutlineEntry, OutlineKind, TokenKind, TokenModifiers};

/// The outline of a text.
pub fn outline(checked: &Checked) -> Vec<DocumentSymbol> {
    let text = Text::new(checked.analysis.text());
    let entries = starl_editor::outline(&checked.analysis.checked.files[0].parse);
    entries.iter().map(|entry| symbol(entry, &text)).collect()
}

fn symbol(entry: &OutlineEntry, text: &Text<'_>) -> DocumentSymbol {
    let children: Vec<_> = entry.parts.iter().map(|part| symbol(part, text)).collect();
    #[allow(deprecated, reason = "the field must be given")]
    DocumentSymbol {
        name: entry.name.clone(),
        detail: (!entry.detail.is_empty()).then(|| entry.detail.clone()),
        kind: symbol_kind(entry.kind),
        tags: None,
        deprecated: None,
        range: text.range(entry.span),
        selection_range: text.range(entry.name_span),
        children: (!children.is_empty()).then_some(children),
    }
}

fn symbol_kind(kind: OutlineKind) -> SymbolKind {
    match kind {
        OutlineKind::Enum => SymbolKind::ENUM,
        OutlineKind::Variant => SymbolKind::ENUM_MEMBER,
        OutlineKind::Record => SymbolKind::STRUCT,
        OutlineKind::Field => SymbolKind::FIELD,
        OutlineKind::Message => SymbolKind::INTERFACE,
        OutlineKind::Parameter | OutlineKind::Constant => SymbolKind::CONSTANT,
        OutlineKind::Variable => SymbolKind::VARIABLE,
        OutlineKind::Primitive => SymbolKind::OBJECT,
        OutlineKind::Function => SymbolKind::FUNCTION,
        OutlineKind::Action => SymbolKind::METHOD,
        OutlineKind::Handler => SymbolKind::EVENT,
        OutlineKind::Role => SymbolKind::CLASS,
        OutlineKind::Property => SymbolKind::BOOLEAN,
    }
}

/// The parts of a text that can be folded: declarations of more than a line.
pub fn folds(checked: &Checked) -> Vec<FoldingRange> {
    let text = Text::new(checked.analysis.text());
    let mut open = starl_editor::outline(&checked.analysis.checked.files[0].parse);
    let mut folds = Vec::new();
    while let Some(entry) = open.pop() {
        let range = text.range(entry.span);
        if range.start.line < range.end.line {
            folds.push(FoldingRange {
                start_line: range.start.line,
                end_line: range.end.line,
                ..FoldingRange::default()
            });
        }
        open.extend(entry.parts);
    }
    folds.sort_by_key(|fold| (fold.start_line, fold.end_line));
    folds
}

/// The kinds of words, by the numbers that the tokens use.
const KINDS: &[(TokenKind, SemanticTokenType)] = &[
    (TokenKind::Keyword, SemanticTokenType::KEYWORD),
    (TokenKind::Comment, SemanticTokenType::COMMENT),
    (TokenKind::Number, SemanticTokenType::NUMBER),
    (TokenKind::String, SemanticTokenType::STRING),
    (TokenKind::Namespace, SemanticTokenType::NAMESPACE),
    (TokenKind::Enum, SemanticTokenType::ENUM),
    (TokenKind::EnumMember, SemanticTokenType::ENUM_MEMBER),
    (TokenKind::Struct, SemanticTokenType::STRUCT),
    (TokenKind::Type, SemanticTokenType::TYPE),
    (TokenKind::Class, SemanticTokenType::CLASS),
    (TokenKind::Property, SemanticTokenType::PROPERTY),
    (TokenKind::Variable, SemanticTokenType::VARIABLE),
    (TokenKind::Parameter, SemanticTokenType::PARAMETER),
    (TokenKind::Function, SemanticTokenType::FUNCTION),
    (TokenKind::Method, SemanticTokenType::METHOD),
    (TokenKind::Event, SemanticTokenType::EVENT),
];

/// The kinds of words, in the order of their numbers.
pub fn token_types() -> Vec<SemanticTokenType> {
    KINDS.iter().map(|(_, kind)| kind.clone()).collect()
}

/// The modifiers of tokens, in the order of the bits.
pub fn token_modifiers() -> Vec<SemanticTokenModifier> {
    vec![
        SemanticTokenModifier::DECLARATION,
        SemanticTokenModifier::READONLY,
        SemanticTokenModifier::DEFAULT_LIBRARY,
        SemanticTokenModifier::DOCUMENTATION,
    ]
}

/// The words of a text, or of a part of it, each placed by the one before.
pub fn tokens(checked: &Checked, part: Option<Range>) -> SemanticTokens {
    let text = Text::new(checked.analysis.text());
    let (mut line, mut start) = (0, 0);
    let mut data = Vec::new();
    for token in starl_editor::tokens(&checked.analysis) {
        let range = text.range(token.span);
        if part.is_some_and(|part| range.end < part.start || part.end < range.start) {
            continue;
        }
        let number = KINDS.iter().position(|(kind, _)| *kind == token.kind);
        let is_one_line = range.start.line == range.end.line;
        let Some(number) = number.filter(|_| is_one_line) else {
            continue;
        };
        let column = range.start.character;
        data.push(SemanticToken {
            delta_line: range.start.line - line,
            delta_start: if range.start.line == line {
                column - start
            } else {
                column
            },
            length: range.end.character - column,
            token_type: number as u32,
            token_modifiers_bitset: bits(token.modifiers),
        });
        (line, start) = (range.start.line, column);
    }
    SemanticTokens {
        result_id: None,
        data,
    }
}

fn bits(modifiers: TokenModifiers) -> u32 {
    u32::from(modifiers.declaration)
        | u32::from(modifiers.readonly) << 1
        | u32::from(modifiers.default_library) << 2
        | u32::from(modifiers.documentation) << 3
}

/// The changes that lay a text out.
pub fn layout(checked: &Checked) -> Vec<TextEdit> {
    let source = checked.analysis.text();
    let text = Text::new(source);
    let edits = starl_editor::layout(source);
    edits.iter().map(|edit| text.edit(edit)).collect()
}
