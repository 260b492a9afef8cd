//! Lists, sets, maps and what builds them from other collections.

use super::super::{SyntaxKind, SyntaxToken};
use super::node::{after, before, child, children, nodes, token, word};
use super::{Expression, LoopVariables, Pattern};

nodes! {
    /// `[a, b]` or `[f(x) for x in xs if condition]`
    ListExpression
    /// A set or a map: `{a, b}`, `{k: v}`, `{}`, `{:}` or a comprehension
    BraceExpression
    /// `k: v`
    MapEntry
    /// `for x in xs if condition by key`
    ComprehensionClause
}

impl ListExpression {
    /// The elements; of a comprehension the one that is built.
    pub fn elements(&self) -> impl Iterator<Item = Expression> + use<> {
        children(&self.0)
    }

    /// The clause of a comprehension.
    #[must_use]
    pub fn comprehension(&self) -> Option<ComprehensionClause> {
        child(&self.0)
    }
}

impl BraceExpression {
    /// Whether it is a map: it has an entry, or is `{:}`. `{}` is a set.
    #[must_use]
    pub fn is_map(&self) -> bool {
        token(&self.0, SyntaxKind::Colon).is_some() || child::<MapEntry>(&self.0).is_some()
    }

    /// The elements of a set; of a comprehension the one that is built.
    pub fn elements(&self) -> impl Iterator<Item = Expression> + use<> {
        children(&self.0)
    }

    /// The entries of a map; of a comprehension the one that is built.
    pub fn entries(&self) -> impl Iterator<Item = MapEntry> + use<> {
        children(&self.0)
    }

    /// The clause of a comprehension.
    #[must_use]
    pub fn comprehension(&self) -> Option<ComprehensionClause> {
        child(&self.0)
    }
}

impl MapEntry {
    /// The key.
    #[must_use]
    pub fn key(&self) -> Option<Expression> {
        before(&token(&self.0, SyntaxKind::Colon)?)
    }

    /// The value.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::Colon)?)
    }
}

impl ComprehensionClause {
    /// One variable, or two for a map.
    pub fn variables(&self) -> impl Iterator<Item = Pattern> + use<> {
        child::<LoopVariables>(&self.0)
            .into_iter()
            .flat_map(|variables| variables.patterns())
    }

    /// The collection that it iterates over.
    #[must_use]
    pub fn collection(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::InKeyword)?)
    }

    /// Which elements are taken, if not all.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::IfKeyword)?)
    }

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
