//! Expressions.

use alloc::string::String;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::node::{after, before, child, children, choice, nodes, token, tokens};
use super::{
    AstNode, BinaryOperator, BraceExpression, ComprehensionClause, ListExpression,
    LiteralExpression, LoopVariables, Name, Pattern, PrefixOperator,
};

nodes! {
    /// A name
    NameExpression
    /// `(value)`
    ParenthesizedExpression
    /// `(a, b)`
    TupleExpression
    /// `value.field` or `tuple.0`
    FieldExpression
    /// `function(arguments)`
    CallExpression
    /// `(a, name = b)`
    ArgumentList
    /// `a` or `name = b`
    Argument
    /// `collection[index]`
    IndexExpression
    /// `optional!`
    UnwrapExpression
    /// `-a` or `not a`
    PrefixExpression
    /// `a + b`
    BinaryExpression
    /// `some x = optional`
    SomeExpression
    /// `if condition then a else b`
    ConditionalExpression
    /// `forall r, s: condition` or `exists x in xs: condition`
    QuantifierExpression
}

choice! {
    /// An expression.
    Expression {
        /// A number, a string, `true`, `false` or `none`
        Literal(LiteralExpression),
        /// A name
        Name(NameExpression),
        /// `(value)`
        Parenthesized(ParenthesizedExpression),
        /// `(a, b)`
        Tuple(TupleExpression),
        /// `value.field` or `tuple.0`
        Field(FieldExpression),
        /// `function(arguments)`
        Call(CallExpression),
        /// `collection[index]`
        Index(IndexExpression),
        /// `optional!`
        Unwrap(UnwrapExpression),
        /// `-a` or `not a`
        Prefix(PrefixExpression),
        /// `a + b`
        Binary(BinaryExpression),
        /// `some x = optional`
        Some(SomeExpression),
        /// `if condition then a else b`
        Conditional(ConditionalExpression),
        /// `forall r: condition`
        Quantifier(QuantifierExpression),
        /// `[a, b]`
        List(ListExpression),
        /// `{a, b}` or `{k: v}`
        Brace(BraceExpression),
    }
}

impl Expression {
    /// Whether this is a `some`, or a conjunction, whose names are known in it alone: nothing that follows depends on it.
    #[must_use]
    pub fn is_closed_conjunction(&self) -> bool {
        let is_conjunction = match self {
            Expression::Some(_) => true,
            Expression::Binary(node) => joins(node.syntax()),
            _ => false,
        };
        is_conjunction && !decides(self.syntax())
    }
}

/// Whether a node is `a and b`.
fn joins(node: &SyntaxNode) -> bool {
    node.kind() == SyntaxKind::BinaryExpression && token(node, SyntaxKind::AndKeyword).is_some()
}

/// Whether a node is a whole condition, or a part of a conjunction.
fn decides(node: &SyntaxNode) -> bool {
    use SyntaxKind::*;
    node.parent().is_some_and(|parent| match parent.kind() {
        IfBranch | PreClause | ComprehensionClause => true,
        ConditionalExpression => parent.first_child().as_ref() == Some(node),
        ParenthesizedExpression => decides(&parent),
        _ => joins(&parent),
    })
}

impl NameExpression {
    /// The word itself.
    #[must_use]
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(&self.0).next()
    }

    /// The word as text.
    #[must_use]
    pub fn text(&self) -> String {
        self.token()
            .map(|token| token.text().into())
            .unwrap_or_default()
    }
}

impl ParenthesizedExpression {
    /// The expression in the brackets.
    #[must_use]
    pub fn inner(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl TupleExpression {
    /// The parts.
    pub fn parts(&self) -> impl Iterator<Item = Expression> + use<> {
        children(&self.0)
    }
}

impl FieldExpression {
    /// The value that has the field.
    #[must_use]
    pub fn base(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// The name of the field, or the number of the part.
    #[must_use]
    pub fn field(&self) -> Option<SyntaxToken> {
        let is_field = |kind| matches!(kind, SyntaxKind::Identifier | SyntaxKind::IntegerLiteral);
        tokens(&self.0).find(|token| is_field(token.kind()))
    }
}

impl CallExpression {
    /// The called function or method.
    #[must_use]
    pub fn callee(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// The arguments.
    pub fn arguments(&self) -> impl Iterator<Item = Argument> + use<> {
        child::<ArgumentList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }
}

impl Argument {
    /// Its name, if it has one.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        child(&self.0)
    }

    /// Its value.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl Argument {
    /// The clause of a comprehension, of which the value is an element.
    #[must_use]
    pub fn comprehension(&self) -> Option<ComprehensionClause> {
        child(&self.0)
    }
}

impl IndexExpression {
    /// The collection.
    #[must_use]
    pub fn base(&self) -> Option<Expression> {
        before(&token(&self.0, SyntaxKind::LeftBracket)?)
    }

    /// Which element.
    #[must_use]
    pub fn index(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::LeftBracket)?)
    }
}

impl UnwrapExpression {
    /// The optional.
    #[must_use]
    pub fn base(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl PrefixExpression {
    /// The operator; `!`, which is reported, is a `not`.
    #[must_use]
    pub fn operator(&self) -> Option<PrefixOperator> {
        let kind = tokens(&self.0).next()?.kind();
        if kind == SyntaxKind::Bang {
            Some(PrefixOperator::Not)
        } else {
            PrefixOperator::of(kind)
        }
    }

    /// The operand.
    #[must_use]
    pub fn operand(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl BinaryExpression {
    /// The operator as a token; of `not in` the `in`.
    #[must_use]
    pub fn operator_token(&self) -> Option<SyntaxToken> {
        tokens(&self.0).find(|token| token.kind() != SyntaxKind::NotKeyword)
    }

    /// The operator; `=`, which is reported, is an `==`.
    #[must_use]
    pub fn operator(&self) -> Option<BinaryOperator> {
        let kind = self.operator_token()?.kind();
        if kind == SyntaxKind::Equal {
            Some(BinaryOperator::Equal)
        } else {
            BinaryOperator::of(kind)
        }
    }

    /// Whether it is `not in`.
    #[must_use]
    pub fn is_negated(&self) -> bool {
        token(&self.0, SyntaxKind::NotKeyword).is_some()
    }

    /// The value before the operator.
    #[must_use]
    pub fn left(&self) -> Option<Expression> {
        before(&self.operator_token()?)
    }

    /// The value after the operator.
    #[must_use]
    pub fn right(&self) -> Option<Expression> {
        after(&self.operator_token()?)
    }
}

impl SomeExpression {
    /// The name for the value, or the names for its parts.
    #[must_use]
    pub fn pattern(&self) -> Option<Pattern> {
        child(&self.0)
    }

    /// The optional whose value gets the name.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl ConditionalExpression {
    /// The condition.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::IfKeyword)?)
    }

    /// The value if it holds.
    #[must_use]
    pub fn then(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::ThenKeyword)?)
    }

    /// The value if it does not.
    #[must_use]
    pub fn otherwise(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::ElseKeyword)?)
    }
}

impl QuantifierExpression {
    /// Whether it is `forall`, rather than `exists`.
    #[must_use]
    pub fn is_universal(&self) -> bool {
        tokens(&self.0)
            .next()
            .is_some_and(|word| word.text() == "forall")
    }

    /// The names of the robots, where no collection is given.
    pub fn variables(&self) -> impl Iterator<Item = Name> + use<> {
        children(&self.0)
    }

    /// The names for what is in the collection, if one is given.
    #[must_use]
    pub fn loop_variables(&self) -> Option<LoopVariables> {
        child(&self.0)
    }

    /// The collection, if one is given.
    #[must_use]
    pub fn collection(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::InKeyword)?)
    }

    /// The condition on each robot or element.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::Colon)?)
    }
}
