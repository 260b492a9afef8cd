//! The problems of a text, and their fixes.

use super::convert::Text;
use super::documents::Checked;
use lsp_types::{
    CodeAction, CodeActionKind, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity,
    DiagnosticTag, Location, NumberOrString, Range, WorkspaceEdit,
};
use starl_lang::diagnostic::{self, Severity, Span};
use std::collections::HashMap;

/// The problems of a text, by ascending position.
pub fn diagnostics(checked: &Checked) -> Vec<Diagnostic> {
    let text = Text::new(checked.analysis.text());
    let problems = checked.analysis.diagnostics().iter();
    problems
        .map(|problem| converted(checked, &text, problem))
        .collect()
}

fn converted(checked: &Checked, text: &Text<'_>, problem: &diagnostic::Diagnostic) -> Diagnostic {
    let related = problem.labels.iter().map(|label| {
        let location = Location::new(checked.uri.clone(), text.range(label.span));
        DiagnosticRelatedInformation {
            location,
            message: label.message.clone(),
        }
    });
    let related: Vec<_> = related.collect();
    Diagnostic {
        range: text.range(problem.span),
        severity: Some(match problem.severity() {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(problem.code.number().to_string())),
        source: Some("starl".to_string()),
        message: message(problem),
        related_information: (!related.is_empty()).then_some(related),
        tags: problem
            .code
            .is_needless()
            .then(|| vec![DiagnosticTag::UNNECESSARY]),
        ..Diagnostic::default()
    }
}

/// The message with what it says besides, a line each.
fn message(problem: &diagnostic::Diagnostic) -> String {
    let message = [problem.message.clone()].into_iter();
    let lines: Vec<String> = message.chain(problem.remarks()).collect();
    lines.join("\n")
}

/// The fixes of the problems in a part of a text.
pub fn fixes(checked: &Checked, range: Range) -> Vec<CodeAction> {
    let text = Text::new(checked.analysis.text());
    let asked = text.span(range);
    let problems = checked.analysis.diagnostics().iter();
    let touched = problems.filter(|problem| touches(problem.span, asked));
    let actions = touched.filter_map(|problem| {
        let fix = problem.fix.as_ref()?;
        let edits = fix.edits.iter().map(|edit| text.edit(edit)).collect();
        Some(CodeAction {
            title: capitalized(&fix.message),
            kind: Some(CodeActionKind::QUICKFIX),
            diagnostics: Some(vec![converted(checked, &text, problem)]),
            edit: Some(WorkspaceEdit::new(HashMap::from([(
                checked.uri.clone(),
                edits,
            )]))),
            is_preferred: Some(true),
            ..CodeAction::default()
        })
    });
    actions.collect()
}

fn touches(a: Span, b: Span) -> bool {
    a.start <= b.end && b.start <= a.end
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}
