//! From text to a tree that contains every character of it.
//!
//! [`parse`] never fails: it returns a tree and the problems of the text. The tree's text is the source, comments and
//! errors included (full fidelity, after Swift's libsyntax and rust-analyzer). [`ast`] is a typed view of the tree.
//!
//! The steps are: text, tokens (`lexer`), blocks (`layout`), tree (`parser`), placement rules that need the whole tree
//! (`validation`).

pub mod ast;
mod kind;
mod layout;
mod lexer;
mod literal;
mod parser;
mod validation;

use alloc::vec::Vec;

use rowan::{GreenNode, GreenNodeBuilder};

use crate::diagnostic::{Code, Diagnostic, Span};
pub use kind::{Language, SyntaxKind};
pub(crate) use literal::type_meant;
pub use parser::MAX_DEPTH;

/// A node of the tree.
pub type SyntaxNode = rowan::SyntaxNode<Language>;
/// A token of the tree.
pub type SyntaxToken = rowan::SyntaxToken<Language>;
/// A node or a token.
pub type SyntaxElement = rowan::SyntaxElement<Language>;

/// The longest text that is read, in bytes.
pub const MAX_LENGTH: usize = 16 << 20;

/// A text that was read.
#[derive(Clone, Debug)]
pub struct Parse {
    green: GreenNode,
    diagnostics: Vec<Diagnostic>,
}

impl Parse {
    /// The root of the tree, a [`SyntaxKind::SourceFile`].
    #[must_use]
    pub fn syntax(&self) -> SyntaxNode {
        SyntaxNode::new_root(self.green.clone())
    }

    /// The typed view of the tree.
    #[must_use]
    pub fn tree(&self) -> ast::SourceFile {
        ast::SourceFile::of(self.syntax())
    }

    /// The problems of the text, sorted by position.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }
}

/// Reads a program or a library.
#[must_use]
pub fn parse(text: &str) -> Parse {
    if text.len() > MAX_LENGTH {
        return too_long(text);
    }
    let tokens = lexer::lex(text);
    let mut diagnostics = lexer::problems(text, &tokens);
    let (lexemes, problems) = layout::arrange(text, &tokens);
    diagnostics.extend(problems);
    let green = parser::parse(text, &tokens, &lexemes, &mut diagnostics);
    validation::forget_swallowed(text, &mut diagnostics);
    diagnostics.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    Parse { green, diagnostics }
}

fn too_long(text: &str) -> Parse {
    use rowan::Language as _;
    let mut builder = GreenNodeBuilder::new();
    builder.start_node(Language::kind_to_raw(SyntaxKind::SourceFile));
    builder.token(Language::kind_to_raw(SyntaxKind::Unknown), text);
    builder.finish_node();
    let message = "this file is too long to be read";
    let problem = Diagnostic::new(Code::TooLong, Span::empty(0), message);
    let diagnostic = problem.note(alloc::format!("at most {} MiB are read", MAX_LENGTH >> 20));
    Parse {
        green: builder.finish(),
        diagnostics: Vec::from([diagnostic]),
    }
}
