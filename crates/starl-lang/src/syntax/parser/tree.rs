//! Putting lexemes and trivia into the tree.

use rowan::{Checkpoint, Language as _};

use super::super::kind::Language;
use super::{Parser, SyntaxKind, SyntaxKind::*};

impl Parser<'_> {
    /// Puts the next lexeme into the tree.
    pub fn bump(&mut self) {
        let Some(lexeme) = self.lexemes.get(self.position) else {
            return;
        };
        self.flush(lexeme.index as usize);
        self.position += 1;
        if !matches!(lexeme.kind, Indent | Dedent) {
            self.token(lexeme.kind);
        }
    }

    /// Takes the next lexeme if it is of this kind.
    pub fn eat(&mut self, kind: SyntaxKind) -> bool {
        let found = self.at(kind);
        if found {
            self.bump();
        }
        found
    }

    /// Takes the next lexeme if it is the name `word`.
    pub fn eat_word(&mut self, word: &str) -> bool {
        let found = self.at_word(word);
        if found {
            self.bump();
        }
        found
    }

    /// Takes the next lexeme, or reports that it is missing.
    pub fn expect(&mut self, kind: SyntaxKind) -> bool {
        let found = self.eat(kind);
        if !found {
            self.unexpected(kind.name());
        }
        found
    }

    /// Puts the next lexeme into an `Error`.
    pub fn bump_error(&mut self) {
        self.start(Error);
        self.bump();
        self.finish();
    }

    /// Puts tokens into the tree, all trivia, up to the one at `index`.
    pub fn flush(&mut self, index: usize) {
        while self.flushed < index {
            let kind = self.tokens.kind(self.flushed);
            self.token(if kind == Newline { LineBreak } else { kind });
        }
    }

    pub fn token(&mut self, kind: SyntaxKind) {
        let text = self.tokens.span(self.flushed).of(self.text);
        self.builder.token(Language::kind_to_raw(kind), text);
        self.flushed += 1;
    }

    /// Puts the trivia before the next lexeme into the tree.
    pub fn flush_trivia(&mut self) {
        self.flush(self.next_token());
    }

    /// Starts a node with the next lexeme.
    pub fn start(&mut self, kind: SyntaxKind) {
        self.flush_trivia();
        self.builder.start_node(Language::kind_to_raw(kind));
    }

    /// A place before the next lexeme, where a node can be started later.
    pub fn checkpoint(&mut self) -> Checkpoint {
        self.flush_trivia();
        self.builder.checkpoint()
    }

    /// A checkpoint before the comments that document the next declaration.
    pub fn checkpoint_with_documentation(&mut self) -> Checkpoint {
        let next = self.next_token();
        let (mut start, mut lines) = (next, 0);
        for index in (self.flushed..next).rev() {
            match self.tokens.kind(index) {
                DocComment => (start, lines) = (index, 0),
                Newline if lines == 0 => lines = 1,
                Whitespace => {}
                _ => break,
            }
        }
        self.flush(start);
        self.builder.checkpoint()
    }

    pub fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        self.builder
            .start_node_at(checkpoint, Language::kind_to_raw(kind));
    }

    pub fn finish(&mut self) {
        self.builder.finish_node();
    }
}
