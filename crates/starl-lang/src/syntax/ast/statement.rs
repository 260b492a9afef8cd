//! Statements.

use super::super::SyntaxToken;
use super::node::{after, before, child, children, children_through_errors, choice, nodes, tokens};
use super::{AssignOperator, Expression, Name, Type};

nodes! {
    /// Statements one after another
    Block
    /// `let x = value`
    LetStatement
    /// `x = value`, `x += value`
    AssignStatement
    /// `if`, with its `elif`s and `else`
    IfStatement
    /// `if condition` or `elif condition`, with statements
    IfBranch
    /// `else`, with statements
    ElseBranch
    /// `for x in xs`, with statements
    ForStatement
    /// `x` or `k, v`
    LoopVariables
    /// `(a, b)`, names for the parts of a tuple
    TuplePattern
    /// `return value`
    ReturnStatement
    /// A call
    ExpressionStatement
    /// `atomic`, with statements
    AtomicStatement
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

impl TuplePattern {
    /// The names.
    pub fn names(&self) -> impl Iterator<Item = Name> + use<> {
        children(&self.0)
    }
}

impl Block {
    /// The statements.
    pub fn statements(&self) -> impl Iterator<Item = Statement> + use<> {
        children_through_errors(&self.0)
    }
}

impl LetStatement {
    /// The name of the variable, or the names of the parts of its value.
    #[must_use]
    pub fn pattern(&self) -> Option<Pattern> {
        child(&self.0)
    }

    /// The type of the variable, if that is written.
    #[must_use]
    pub fn ty(&self) -> Option<Type> {
        child(&self.0)
    }

    /// Its value.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        child(&self.0)
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

impl IfStatement {
    /// The `if` and the `elif`s.
    pub fn branches(&self) -> impl Iterator<Item = IfBranch> + use<> {
        children(&self.0)
    }

    /// The `else`, if there is one.
    #[must_use]
    pub fn otherwise(&self) -> Option<ElseBranch> {
        child(&self.0)
    }
}

impl IfBranch {
    /// When it is taken.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// The statements of the branch.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl ElseBranch {
    /// The statements of the branch.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl ForStatement {
    /// One variable, or two for a map.
    pub fn variables(&self) -> impl Iterator<Item = Pattern> + use<> {
        child::<LoopVariables>(&self.0)
            .into_iter()
            .flat_map(|variables| variables.patterns())
    }

    /// The collection that it iterates over.
    #[must_use]
    pub fn collection(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// The statements for each element.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl LoopVariables {
    /// The variables.
    pub fn patterns(&self) -> impl Iterator<Item = Pattern> + use<> {
        children(&self.0)
    }
}

impl ReturnStatement {
    /// The returned value, if any.
    #[must_use]
    pub fn value(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl ExpressionStatement {
    /// The call.
    #[must_use]
    pub fn expression(&self) -> Option<Expression> {
        child(&self.0)
    }
}

impl AtomicStatement {
    /// The statements.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}
