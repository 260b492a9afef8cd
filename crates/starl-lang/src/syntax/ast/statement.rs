//! Statements.

use super::super::SyntaxToken;
use super::node::{after, before, children_through_errors, choice, nodes, tokens};
use super::{AssignOperator, Expression, Name, Type};

nodes! {
    /// Statements one after another
    Block
    /// `let x = value`
    LetStatement {
        /// The name of the variable, or the names of the parts of its value.
        pattern: Pattern,
        /// The type of the variable, if that is written.
        ty: Type,
        /// Its value.
        value: Expression,
    }
    /// `x = value`, `x += value`
    AssignStatement
    /// `if`, with its `elif`s and `else`
    IfStatement {
        /// The `if` and the `elif`s.
        branches: [IfBranch],
        /// The `else`, if there is one.
        otherwise: ElseBranch,
    }
    /// `if condition` or `elif condition`, with statements
    IfBranch {
        /// When it is taken.
        condition: Expression,
        /// The statements of the branch.
        body: Block,
    }
    /// `else`, with statements
    ElseBranch {
        /// The statements of the branch.
        body: Block,
    }
    /// `for x in xs`, with statements
    ForStatement {
        /// One variable, or two for a map.
        variables: [Pattern] in LoopVariables,
        /// The collection that it iterates over.
        collection: Expression,
        /// The statements for each element.
        body: Block,
    }
    /// `x` or `k, v`
    LoopVariables {
        /// The variables.
        patterns: [Pattern],
    }
    /// `(a, b)`, names for the parts of a tuple
    TuplePattern {
        /// The names.
        names: [Name],
    }
    /// `return value`
    ReturnStatement {
        /// The returned value, if any.
        value: Expression,
    }
    /// A call
    ExpressionStatement {
        /// The call.
        expression: Expression,
    }
    /// `atomic`, with statements
    AtomicStatement {
        /// The statements.
        body: Block,
    }
}

choice! {
    /// A statement.
    Statement {
        /// `let x = value`
        Let(LetStatement),
        /// `x = value`
        Assign(AssignStatement),
        /// `if condition`
        If(IfStatement),
        /// `for x in xs`
        For(ForStatement),
        /// `return value`
        Return(ReturnStatement),
        /// A call
        Expression(ExpressionStatement),
        /// `atomic`
        Atomic(AtomicStatement),
    }
}

choice! {
    /// Where a value gets a name, or its parts do.
    Pattern {
        /// `x`
        Name(Name),
        /// `(a, b)`
        Tuple(TuplePattern),
    }
}

impl Block {
    /// The statements.
    pub fn statements(&self) -> impl Iterator<Item = Statement> + use<> {
        children_through_errors(&self.0)
    }
}

impl AssignStatement {
    /// The operator as a token.
    #[must_use]
    pub fn operator_token(&self) -> Option<SyntaxToken> {
        tokens(&self.0).find(|token| token.kind().is_assignment())
    }

    /// Which assignment it is.
    #[must_use]
    pub fn operator(&self) -> Option<AssignOperator> {
        AssignOperator::of(self.operator_token()?.kind())
    }

    /// The target of the assignment.
    #[must_use]
    pub fn target(&self) -> Option<Expression> {
        before(&self.operator_token()?)
    }

    /// The assigned value.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        after(&self.operator_token()?)
    }
}
