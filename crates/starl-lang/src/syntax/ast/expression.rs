//! Expressions.

use alloc::string::String;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::node::{after, before, choice, first_word, nodes, token, tokens};
use super::{
    AstNode, BinaryOperator, BraceExpression, ComprehensionClause, ListExpression,
    LiteralExpression, LoopVariables, Name, Pattern, PrefixOperator,
};

nodes! {
    /// A name
    NameExpression
    /// `(value)`
    ParenthesizedExpression {
        /// The expression in the brackets.
        inner: Expression,
    }
    /// `(a, b)`
    TupleExpression {
        /// The parts.
        parts: [Expression],
    }
    /// `value.field` or `tuple.0`
    FieldExpression {
        /// The value that has the field.
        base: Expression,
    }
    /// `function(arguments)`
    CallExpression {
        /// The called function or method.
        callee: Expression,
        /// The arguments.
        arguments: [Argument] in ArgumentList,
    }
    /// `(a, name = b)`
    ArgumentList
    /// `a` or `name = b`
    Argument {
        /// Its name, if it has one.
        name: Name,
        /// Its value.
        value: Expression,
        /// The clause of a comprehension, of which the value is an element.
        comprehension: ComprehensionClause,
    }
    /// `collection[index]`
    IndexExpression {
        /// The collection.
        base: Expression before LeftBracket,
        /// Which element.
        index: Expression after LeftBracket,
    }
    /// `optional!`
    UnwrapExpression {
        /// The optional.
        base: Expression,
    }
    /// `-a` or `not a`
    PrefixExpression {
        /// The operand.
        operand: Expression,
    }
    /// `a + b`
    BinaryExpression
    /// `some x = optional`
    SomeExpression {
        /// The name for the value, or the names for its parts.
        pattern: Pattern,
        /// The optional whose value gets the name.
        value: Expression,
    }
    /// `if condition then a else b`
    ConditionalExpression {
        /// The condition.
        condition: Expression after IfKeyword,
        /// The value if it holds.
        then: Expression after ThenKeyword,
        /// The value if it does not.
        otherwise: Expression after ElseKeyword,
    }
    /// `forall r, s: condition` or `exists x in xs: condition`
    QuantifierExpression {
        /// The names of the robots, where no collection is given.
        variables: [Name],
        /// The names for what is in the collection, if one is given.
        loop_variables: LoopVariables,
        /// The collection, if one is given.
        collection: Expression after InKeyword,
        /// The condition on each robot or element.
        condition: Expression after Colon,
    }
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
        first_word(&self.0)
    }
}

impl FieldExpression {
    /// The name of the field, or the number of the part.
    #[must_use]
    pub fn field(&self) -> Option<SyntaxToken> {
        let is_field = |kind| matches!(kind, SyntaxKind::Identifier | SyntaxKind::IntegerLiteral);
        tokens(&self.0).find(|token| is_field(token.kind()))
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

impl QuantifierExpression {
    /// Whether it is `forall`, rather than `exists`.
    #[must_use]
    pub fn is_universal(&self) -> bool {
        first_word(&self.0) == "forall"
    }
}
