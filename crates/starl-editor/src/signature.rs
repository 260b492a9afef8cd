//! The parameters of a call, shown while its arguments are being typed.

use crate::Analysis;
use starl_lang::diagnostic::Span;
use starl_lang::ir::Site;
use starl_lang::syntax::ast::{Argument, AstNode, CallExpression, Expression};
use starl_lang::syntax::{SyntaxKind, SyntaxNode};

/// The signature of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallHelp {
    /// The declaration of the called function.
    pub signature: String,
    /// Its documentation, in Markdown.
    pub documentation: String,
    /// The parameters, as parts of the signature.
    pub parameters: Vec<Span>,
    /// Which of them is being typed.
    pub active: Option<usize>,
}

impl Analysis {
    /// The signature of the innermost call around a position of the text.
    #[must_use]
    pub fn call_help(&self, offset: u32) -> Option<CallHelp> {
        let root = self.checked.files[0].parse.syntax();
        if offset > u32::from(root.text_range().end()) {
            return None;
        }
        let token = root.token_at_offset(offset.into()).left_biased()?;
        let mut lists = token.parent_ancestors();
        let list = lists.find(|node| is_within(node, offset))?;
        let call = CallExpression::cast(list.parent()?)?;
        let span = match call.callee()? {
            Expression::Name(name) => Span::from(name.token()?.text_range()),
            Expression::Field(field) => Span::from(field.field()?.text_range()),
            _ => return None,
        };
        let found = self.index.exactly(Site { file: 0, span })?;
        let description = self.describe(found.symbol);
        let parameters = parameters(&description.signature);
        let active = active(&list, offset, &description.signature, &parameters);
        Some(CallHelp {
            active,
            parameters,
            signature: description.signature,
            documentation: description.documentation,
        })
    }
}

/// Whether the place is between the brackets of the arguments.
fn is_within(list: &SyntaxNode, offset: u32) -> bool {
    if list.kind() != SyntaxKind::ArgumentList {
        return false;
    }
    let bracket = |kind| {
        let tokens = list.children_with_tokens();
        let mut tokens = tokens.filter_map(rowan::NodeOrToken::into_token);
        let found = tokens.find(|token| token.kind() == kind);
        found.map(|token| Span::from(token.text_range()))
    };
    let is_after = bracket(SyntaxKind::LeftParen).is_some_and(|open| open.end <= offset);
    is_after && bracket(SyntaxKind::RightParen).is_none_or(|close| offset <= close.start)
}

/// The parts between the outermost brackets of a signature.
fn parameters(signature: &str) -> Vec<Span> {
    let Some(open) = signature.find(['(', '{']) else {
        return Vec::new();
    };
    let (mut depth, mut start) = (0_u32, open + 1);
    let mut parameters = Vec::new();
    let mut end = |start: usize, end: usize| {
        let part = &signature[start..end];
        let skipped = part.len() - part.trim_start().len();
        if !part.trim().is_empty() {
            let end = start + part.trim_end().len();
            parameters.push(Span::new((start + skipped) as u32, end as u32));
        }
    };
    for (at, sign) in signature[open..].char_indices() {
        let at = open + at;
        match sign {
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' if depth > 1 => depth -= 1,
            ')' | '}' | ']' => {
                end(start, at);
                break;
            }
            ',' if depth == 1 => {
                end(start, at);
                start = at + 1;
            }
            _ => {}
        }
    }
    parameters
}

/// Which parameter the place belongs to: the one that is named, else by the number of commas before it.
fn active(list: &SyntaxNode, offset: u32, signature: &str, parameters: &[Span]) -> Option<usize> {
    let commas = list.children_with_tokens();
    let commas = commas.filter_map(rowan::NodeOrToken::into_token);
    let commas: Vec<u32> = (commas.filter(|token| token.kind() == SyntaxKind::Comma))
        .map(|token| Span::from(token.text_range()).end)
        .filter(|end| *end <= offset)
        .collect();
    let start = commas.last().copied().unwrap_or_default();
    let mut arguments = list.children().filter_map(Argument::cast);
    let own = arguments.find(|argument| {
        let span = argument.span();
        start <= span.start && span.start <= offset
    });
    if let Some(name) = own.and_then(|argument| argument.name()) {
        let name = name.text();
        let is_own = |span: &Span| {
            let text = span.of(signature);
            let end = text.find(['?', ':', ' ']).unwrap_or(text.len());
            text[..end] == name
        };
        return parameters.iter().position(is_own);
    }
    let number = commas.len();
    let takes_more = parameters
        .last()
        .is_some_and(|last| last.of(signature).ends_with("..."));
    match parameters.len() {
        count if number < count => Some(number),
        count if takes_more => Some(count - 1),
        _ => None,
    }
}
