//! Common code of all node types.

use alloc::boxed::Box;
use alloc::string::String;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::Expression;
use crate::diagnostic::Span;

/// A node of the tree with a type.
pub trait AstNode: Sized {
    /// The node as this type, if it is of its kind.
    fn cast(node: SyntaxNode) -> Option<Self>;

    /// The node itself.
    fn syntax(&self) -> &SyntaxNode;

    /// Where it is, without the trivia around it.
    fn span(&self) -> Span {
        let tokens = || {
            self.syntax()
                .descendants_with_tokens()
                .filter_map(rowan::NodeOrToken::into_token)
        };
        let matters =
            |token: &SyntaxToken| !token.kind().is_trivia() && token.kind() != SyntaxKind::Newline;
        let start = tokens()
            .find(matters)
            .map(|token| Span::from(token.text_range()));
        let mut last = self.syntax().last_token();
        while let Some(token) = last.as_ref().filter(|token| !matters(token)) {
            last = token.prev_token();
        }
        match (start, last) {
            (Some(start), Some(last)) => start.to(Span::from(last.text_range())),
            _ => Span::from(self.syntax().text_range()),
        }
    }
}

/// Makes a type for each kind of node of the same name, and its methods for the parts in braces.
///
/// | part | what the method returns |
/// | --- | --- |
/// | `name: Part` | the first part of this type |
/// | `name: [Part]` | all parts of this type |
/// | `name: Part in List`, `name: [Part] in List` | the same in the first `List` |
/// | `name: Part after Token`, `name: Part after "word"` | the first part of this type after the token |
/// | `name: Expression before Token` | the last expression before the token |
macro_rules! nodes {
    (@part $(#[$doc:meta])+ $part:ident [$type:ident]) => {
        $(#[$doc])+
        pub fn $part(&self) -> impl Iterator<Item = $type> + use<> {
            $crate::syntax::ast::node::children(&self.0)
        }
    };
    (@part $(#[$doc:meta])+ $part:ident [$type:ident] in $list:ident) => {
        $(#[$doc])+
        pub fn $part(&self) -> impl Iterator<Item = $type> + use<> {
            use $crate::syntax::ast::{AstNode, node};
            let list = node::child::<$list>(&self.0).into_iter();
            list.flat_map(|list| node::children(list.syntax()))
        }
    };
    (@part $(#[$doc:meta])+ $part:ident $type:ident $($place:ident $at:tt)?) => {
        $(#[$doc])+
        #[must_use]
        pub fn $part(&self) -> Option<$type> {
            nodes! { @find self $($place $at)? }
        }
    };
    (@find $node:ident) => {
        $crate::syntax::ast::node::child(&$node.0)
    };
    (@find $node:ident in $list:ident) => {{
        use $crate::syntax::ast::{AstNode, node};
        node::child(node::child::<$list>(&$node.0)?.syntax())
    }};
    (@find $node:ident $place:ident $word:literal) => {{
        use $crate::syntax::ast::node;
        node::$place(&node::word(&$node.0, $word)?)
    }};
    (@find $node:ident $place:ident $token:ident) => {{
        use $crate::syntax::{SyntaxKind, ast::node};
        node::$place(&node::token(&$node.0, SyntaxKind::$token)?)
    }};
    ($(
        $(#[$meta:meta])+
        $name:ident
        $({ $($(#[$doc:meta])+ $part:ident: $type:tt $($place:ident $at:tt)?,)+ })?
    )+) => {$(
        $(#[$meta])+
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $name($crate::syntax::SyntaxNode);

        impl $crate::syntax::ast::AstNode for $name {
            fn cast(node: $crate::syntax::SyntaxNode) -> Option<Self> {
                (node.kind() == $crate::syntax::SyntaxKind::$name).then_some(Self(node))
            }

            fn syntax(&self) -> &$crate::syntax::SyntaxNode {
                &self.0
            }
        }

        $(impl $name {
            $(nodes! { @part $(#[$doc])+ $part $type $($place $at)? })+
        })?
    )+};
}

/// Makes a type for a choice of others.
macro_rules! choice {
    ($(#[$meta:meta])+ $choice:ident { $($(#[$doc:meta])+ $variant:ident($name:ident),)+ }) => {
        $(#[$meta])+
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub enum $choice {
            $($(#[$doc])+ $variant($name),)+
        }

        impl $crate::syntax::ast::AstNode for $choice {
            fn cast(node: $crate::syntax::SyntaxNode) -> Option<Self> {
                match node.kind() {
                    $($crate::syntax::SyntaxKind::$name => $name::cast(node).map(Self::$variant),)+
                    _ => None,
                }
            }

            fn syntax(&self) -> &$crate::syntax::SyntaxNode {
                match self {
                    $(Self::$variant(node) => node.syntax(),)+
                }
            }
        }
    };
}

pub(super) use {choice, nodes};

nodes! {
    /// A name where it is declared.
    Name
}

impl Name {
    /// The word itself.
    #[must_use]
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(&self.0).next()
    }

    /// The word as text; `_` where the value is not wanted.
    #[must_use]
    pub fn text(&self) -> String {
        first_word(&self.0)
    }
}

/// The first part of a type.
pub(super) fn child<N: AstNode>(node: &SyntaxNode) -> Option<N> {
    node.children().find_map(N::cast)
}

/// All parts of a type.
pub(super) fn children<N: AstNode>(node: &SyntaxNode) -> impl Iterator<Item = N> + use<N> {
    node.children().filter_map(N::cast)
}

/// The same, including nodes within errors.
pub(super) fn children_through_errors<N: AstNode + 'static>(
    node: &SyntaxNode,
) -> Box<dyn Iterator<Item = N>> {
    Box::new(node.children().flat_map(|child| match child.kind() {
        SyntaxKind::Error => children_through_errors(&child),
        _ => Box::new(N::cast(child).into_iter()),
    }))
}

/// The tokens directly in a node, without trivia.
pub(super) fn tokens(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> + use<> {
    let tokens = node
        .children_with_tokens()
        .filter_map(rowan::NodeOrToken::into_token);
    tokens.filter(|token| !token.kind().is_trivia())
}

/// The text of the first token directly in a node; empty if there is none.
pub(super) fn first_word(node: &SyntaxNode) -> String {
    let first = tokens(node).next();
    first.map(|token| token.text().into()).unwrap_or_default()
}

/// The first token of a kind directly in a node.
pub(super) fn token(node: &SyntaxNode, kind: SyntaxKind) -> Option<SyntaxToken> {
    tokens(node).find(|token| token.kind() == kind)
}

/// The first token directly in a node with this text.
pub(super) fn word(node: &SyntaxNode, text: &str) -> Option<SyntaxToken> {
    tokens(node).find(|token| token.text() == text)
}

/// The first part of a type that stands after a token.
pub(super) fn after<N: AstNode>(token: &SyntaxToken) -> Option<N> {
    token
        .siblings_with_tokens(rowan::Direction::Next)
        .filter_map(rowan::NodeOrToken::into_node)
        .find_map(N::cast)
}

/// The last expression that stands before a token in its node.
pub(super) fn before(token: &SyntaxToken) -> Option<Expression> {
    let before = token.siblings_with_tokens(rowan::Direction::Prev);
    before
        .filter_map(rowan::NodeOrToken::into_node)
        .find_map(Expression::cast)
}
