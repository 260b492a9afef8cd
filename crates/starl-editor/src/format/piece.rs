//! The parts of a program without its white space: tokens, comments, and declarations with errors as they are.

use rowan::{NodeOrToken, WalkEvent};
use starl_lang::diagnostic::{Code, Severity, Span};
use starl_lang::syntax::{
    Parse, SyntaxElement, SyntaxKind, SyntaxKind::*, SyntaxNode, SyntaxToken,
};

/// A written piece, and its place in the source.
pub(super) struct Piece {
    pub content: Content,
    /// How many line ends are before it.
    pub breaks: usize,
    /// Whether it continues a construct from a line above.
    pub continues: bool,
    /// How many blocks it is in.
    pub depth: usize,
    /// If it is the first of a declaration, whether that has a block.
    pub starts: Option<Declaration>,
}

/// The content of a piece.
pub(super) enum Content {
    /// A token or a comment.
    Token(SyntaxToken),
    /// A declaration with errors, as it is.
    Verbatim(String),
}

/// The sort of a declaration, as far as the lines around it depend on it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Declaration {
    /// One of a line.
    Line,
    /// One with a block, or the header of the file.
    Block,
}

/// Invisible characters at the end of a line.
const BLANK: [char; 3] = [' ', '\t', '\r'];

/// The pieces of a program.
pub(super) fn pieces(parse: &Parse) -> Vec<Piece> {
    let root = parse.syntax();
    let mut walk = Walk {
        pieces: Vec::new(),
        breaks: 0,
        in_line: false,
        depth: 0,
        starts: None,
    };
    let errors = errors(parse, &root);
    let mut group: Vec<SyntaxElement> = Vec::new();
    for element in root.children_with_tokens() {
        let last = match &element {
            NodeOrToken::Node(node) => node.last_token(),
            NodeOrToken::Token(token) => Some(token.clone()),
        };
        group.push(element);
        if last.is_some_and(|last| last.kind() == Newline) {
            walk.group(&group, &errors);
            group.clear();
        }
    }
    walk.group(&group, &errors);
    walk.pieces
}

/// The lines, as parts of the text in ascending order, in which the meaning of white space is unknown.
fn errors(parse: &Parse, root: &SyntaxNode) -> Vec<Span> {
    let known = [Code::TabIndentation, Code::MissingHeader];
    let errors = parse
        .diagnostics()
        .iter()
        .filter(|diagnostic| diagnostic.severity() == Severity::Error);
    let errors = errors
        .filter(|error| !known.contains(&error.code))
        .map(|error| match error.code {
            Code::UnevenIndentation => with_line_above(error.span, root),
            _ => error.span,
        });
    let skipped = root
        .children()
        .filter(|node| node.kind() == Error)
        .map(|node| node.text_range().into());
    let text = root.text().to_string();
    let mut lines: Vec<Span> = errors
        .chain(skipped)
        .map(|span| whole_lines(span, &text))
        .collect();
    lines.sort_unstable();
    lines.dedup_by(|next, last| {
        let joined = next.start <= last.end;
        if joined {
            last.end = last.end.max(next.end);
        }
        joined
    });
    lines
}

/// To which block the line belongs follows from the indentation of what is above.
fn with_line_above(span: Span, root: &SyntaxNode) -> Span {
    let mut above = root.token_at_offset(span.end.into()).right_biased();
    let matters = |token: &SyntaxToken| !token.kind().is_trivia() && token.kind() != Newline;
    loop {
        above = above.and_then(|token| token.prev_token());
        match &above {
            Some(token) if matters(token) => return span.to(Span::from(token.text_range())),
            Some(_) => {}
            None => return span,
        }
    }
}

fn whole_lines(span: Span, text: &str) -> Span {
    let start = text[..span.start as usize]
        .rfind('\n')
        .map_or(0, |at| at + 1);
    let rest = &text[span.end as usize..];
    let end = span.end as usize + rest.find('\n').unwrap_or(rest.len());
    Span::new(start as u32, end as u32)
}

fn has_error(element: &SyntaxElement, errors: &[Span]) -> bool {
    let span = Span::from(element.text_range());
    let text = element.to_string();
    let end = span.end - (text.len() - text.trim_end_matches(['\n', '\r', ' ']).len()) as u32;
    let before = errors.partition_point(|error| error.start < end);
    errors[..before]
        .last()
        .is_some_and(|error| error.end >= span.start)
}

struct Walk {
    pieces: Vec<Piece>,
    breaks: usize,
    /// Whether a line has begun that is not ended.
    in_line: bool,
    depth: usize,
    starts: Option<Declaration>,
}

impl Walk {
    /// Adds a group: tokens that share a line, or that begin on one.
    fn group(&mut self, group: &[SyntaxElement], errors: &[Span]) {
        let matters =
            |element: &SyntaxElement| !element.kind().is_trivia() && element.kind() != Newline;
        let whole = (group.iter().position(matters)).zip(group.iter().rposition(matters));
        let wrong = whole.filter(|(first, last)| {
            let mut elements = group[*first..=*last].iter();
            elements.any(|element| has_error(element, errors))
        });
        let Some((first, last)) = wrong else {
            return self.elements(group);
        };
        // Tokens before it on its line belong to it.
        let line = group[..first]
            .iter()
            .rposition(|element| element.kind() == LineBreak);
        let first = line.map_or(0, |line| line + 1);
        self.elements(&group[..first]);
        let text: String = group[first..=last]
            .iter()
            .map(|element| element.to_string())
            .collect();
        self.verbatim(&text);
        self.elements(&group[last + 1..]);
    }

    fn elements(&mut self, elements: &[SyntaxElement]) {
        elements.iter().for_each(|element| self.element(element));
    }

    fn element(&mut self, element: &SyntaxElement) {
        let node = match element {
            NodeOrToken::Node(node) => node,
            NodeOrToken::Token(token) => return self.token(token.clone()),
        };
        for event in node.preorder_with_tokens() {
            match event {
                WalkEvent::Enter(NodeOrToken::Node(node)) => self.enter(&node),
                WalkEvent::Leave(NodeOrToken::Node(node)) => self.leave(&node),
                WalkEvent::Enter(NodeOrToken::Token(token)) => self.token(token),
                WalkEvent::Leave(NodeOrToken::Token(_)) => {}
            }
        }
    }

    fn enter(&mut self, node: &SyntaxNode) {
        match node.kind() {
            Block | ActionBody | RoleBody => self.depth += 1,
            ProgramHeader | LibraryHeader | InitDeclaration | ActionDeclaration
            | HandlerDeclaration | RoleDeclaration => self.starts = Some(Declaration::Block),
            FunctionDeclaration => {
                let has_block = node.children().any(|child| child.kind() == Block);
                self.starts = Some(if has_block {
                    Declaration::Block
                } else {
                    Declaration::Line
                });
            }
            kind if (Import..=PropertyDeclaration).contains(&kind) => {
                let parent = node.parent().map(|parent| parent.kind());
                if matches!(parent, Some(SourceFile | RoleBody)) {
                    self.starts = Some(Declaration::Line);
                }
            }
            _ => {}
        }
    }

    fn leave(&mut self, node: &SyntaxNode) {
        if matches!(node.kind(), Block | ActionBody | RoleBody) {
            self.depth -= 1;
        }
    }

    fn token(&mut self, token: SyntaxToken) {
        match token.kind() {
            Whitespace => {}
            Newline => {
                self.breaks += 1;
                self.in_line = false;
            }
            LineBreak => self.breaks += 1,
            kind => {
                self.push(Content::Token(token));
                self.in_line |= !kind.is_trivia();
            }
        }
    }

    /// A declaration as it is; the line ends around it are as everywhere.
    fn verbatim(&mut self, text: &str) {
        let is_blank = |character: char| character == '\n' || BLANK.contains(&character);
        // Its indentation belongs to it, if it has any.
        let start = text.len() - text.trim_start_matches(['\n', '\r']).len();
        self.breaks += text[..start].matches('\n').count();
        let body = text[start..].trim_end_matches(is_blank);
        if !body.is_empty() {
            self.starts = Some(Declaration::Line);
            self.push(Content::Verbatim(body.into()));
        }
        self.breaks += text[start + body.len()..].matches('\n').count();
        self.in_line = self.breaks == 0;
    }

    fn push(&mut self, content: Content) {
        let breaks = std::mem::take(&mut self.breaks);
        let continues = self.in_line;
        let starts = self.starts.take();
        self.pieces.push(Piece {
            content,
            breaks,
            continues,
            depth: self.depth,
            starts,
        });
    }
}

impl Content {
    /// The kind of the token; none for a declaration that stays as it is.
    pub fn kind(&self) -> Option<SyntaxKind> {
        match self {
            Self::Token(token) => Some(token.kind()),
            Self::Verbatim(_) => None,
        }
    }

    /// How it is written.
    pub fn text(&self) -> &str {
        match self {
            Self::Token(token) if token.kind().is_trivia() => token.text().trim_end_matches(BLANK),
            Self::Token(token) => token.text(),
            Self::Verbatim(text) => text,
        }
    }
}
