//! Lists, sets, maps and what builds them from other collections.

use super::super::{SyntaxKind, SyntaxToken};
use super::node::{after, child, nodes, token, word};
use super::{Expression, LoopVariables, Pattern};

nodes! {
    /// `[a, b]` or `[f(x) for x in xs if condition]`
    ListExpression {
        /// The elements; of a comprehension the one that is built.
        elements: [Expression],
        /// The clause of a comprehension.
        comprehension: ComprehensionClause,
    }
    /// A set or a map: `{a, b}`, `{k: v}`, `{}`, `{:}` or a comprehension
    BraceExpression {
        /// The elements of a set; of a comprehension the one that is built.
        elements: [Expression],
        /// The entries of a map; of a comprehension the one that is built.
        entries: [MapEntry],
        /// The clause of a comprehension.
        comprehension: ComprehensionClause,
    }
    /// `k: v`
    MapEntry {
        /// The key.
        key: Expression before Colon,
        /// The value.
        value: Expression after Colon,
    }
    /// `for x in xs if condition by key`
    ComprehensionClause {
        /// One variable, or two for a map.
        variables: [Pattern] in LoopVariables,
        /// The collection that it iterates over.
        collection: Expression after InKeyword,
        /// Which elements are taken, if not all.
        condition: Expression after IfKeyword,
    }
}

impl BraceExpression {
    /// Whether it is a map: it has an entry, or is `{:}`. `{}` is a set.
    #[must_use]
    pub fn is_map(&self) -> bool {
        token(&self.0, SyntaxKind::Colon).is_some() || child::<MapEntry>(&self.0).is_some()
    }
}

impl ComprehensionClause {
    /// The key by which the elements are sorted, if they are.
    #[must_use]
    pub fn key(&self) -> Option<Expression> {
        after(&self.by()?)
    }

    /// The word before the key.
    #[must_use]
    pub fn by(&self) -> Option<SyntaxToken> {
        word(&self.0, "by")
    }
}
