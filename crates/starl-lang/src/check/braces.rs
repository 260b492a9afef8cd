//! Names in braces in a text, which other languages replace by values and StarL does not.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::scope::Entity;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Edit, Fix, Span};
use crate::syntax::SyntaxKind;
use crate::syntax::ast::{self, AstNode};

/// A name with its braces, or a name and fields of it: `{target.x}`.
struct Braced<'t> {
    /// The place of the brace in the text.
    start: usize,
    /// The text between the braces.
    inner: &'t str,
}

impl Checker {
    /// Warns if a text in quotes has the name of a visible value in braces.
    pub fn check_braces(&mut self, node: &ast::LiteralExpression, span: Span) {
        let text = String::from(self.text(span));
        let all = braced(&text).into_iter();
        let named: Vec<Braced<'_>> = all.filter(|braced| self.is_visible(braced)).collect();
        let Some(Braced { start, inner }) = named.first() else {
            return;
        };
        for name in &named {
            self.note_read(name);
        }
        let start = span.start + *start as u32;
        let at = Span::new(start, start + inner.len() as u32 + 2);
        let message = format!("`{{{inner}}}` in a text is not replaced by the value of `{inner}`");
        let problem = Diagnostic::new(Code::BracedName, at, message);
        self.report(match log_arguments(node) {
            None => problem.fix(joined(node, &text, &named, span)),
            Some(1) if !text.contains("{}") => problem.fix(listed(&text, &named, span)),
            Some(_) => {
                problem.note("in `log`, write `{}` and put the value after the text, in its place")
            }
        });
    }

    fn is_visible(&self, braced: &Braced<'_>) -> bool {
        let name = braced.name();
        if self.body.find(name).is_some() {
            return true;
        }
        match self.declared(self.file, name) {
            Some(entity) => matches!(
                entity,
                Entity::Parameter(_)
                    | Entity::Constant(_)
                    | Entity::Variable(_)
                    | Entity::Shared(_)
            ),
            None => Builtin::named(name).is_some_and(|builtin| {
                !builtin.signature().is_call && self.body.place.allows(builtin.purity())
            }),
        }
    }

    /// The value was meant to be read, so nothing more is said about it.
    fn note_read(&mut self, braced: &Braced<'_>) {
        if let Some(local) = self.body.find(braced.name()) {
            self.body.read(local);
            return;
        }
        if let Some(entity) = self.declared(self.file, braced.name()) {
            self.usage.used.insert(entity);
        }
    }
}

impl Braced<'_> {
    fn name(&self) -> &str {
        self.inner.split('.').next().unwrap_or_default()
    }
}

/// The names in braces, in the order of the text.
fn braced(text: &str) -> Vec<Braced<'_>> {
    let is_name = |word: &str| {
        let mut bytes = word.bytes();
        bytes
            .next()
            .is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
            && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    };
    let found = text.match_indices('{').filter_map(|(start, _)| {
        let (inner, _) = text[start + 1..].split_once('}')?;
        // `\u{e9}` is a character.
        let is_escape = text[..start].ends_with("\\u");
        (!is_escape && inner.split('.').all(is_name)).then_some(Braced { start, inner })
    });
    found.collect()
}

/// If the text is the first argument of `log`, the number of its arguments.
fn log_arguments(node: &ast::LiteralExpression) -> Option<usize> {
    let call = node
        .syntax()
        .ancestors()
        .nth(3)
        .and_then(ast::CallExpression::cast)?;
    let Some(ast::Expression::Name(callee)) = call.callee() else {
        return None;
    };
    let first = call.arguments().next()?.value()?;
    let is_format = callee.text() == "log" && first.syntax() == node.syntax();
    is_format.then(|| call.arguments().count())
}

/// `"dock {n}"` as `"dock " + String(n)`.
fn joined(node: &ast::LiteralExpression, text: &str, named: &[Braced<'_>], span: Span) -> Fix {
    let mut parts: Vec<String> = Vec::new();
    let mut from = 1;
    for Braced { start, inner } in named {
        parts.push(format!("\"{}\"", &text[from..*start]));
        parts.push(format!("String({inner})"));
        from = start + inner.len() + 2;
    }
    parts.push(format!("\"{}\"", &text[from..text.len() - 1]));
    parts.retain(|part| part != "\"\"");
    let mut whole = parts.join(" + ");
    // Stands before or after something that binds more closely than `+`.
    let parent = node.syntax().parent().map(|parent| parent.kind());
    let is_operand = matches!(
        parent,
        Some(SyntaxKind::FieldExpression | SyntaxKind::BinaryExpression)
    );
    if is_operand && parts.len() > 1 {
        whole = format!("({whole})");
    }
    Fix {
        message: format!("write `{whole}`"),
        edits: Vec::from([Edit::new(span, whole)]),
    }
}

/// `"dock {n}"` as `"dock {}", n`.
fn listed(text: &str, named: &[Braced<'_>], span: Span) -> Fix {
    let mut whole = String::new();
    let mut from = 0;
    for Braced { start, inner } in named {
        whole += &text[from..*start];
        whole += "{}";
        from = start + inner.len() + 2;
    }
    whole += &text[from..];
    for Braced { inner, .. } in named {
        whole += ", ";
        whole += inner;
    }
    Fix {
        message: format!("write `{whole}`"),
        edits: Vec::from([Edit::new(span, whole)]),
    }
}
