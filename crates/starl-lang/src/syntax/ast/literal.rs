//! Literals and their values.

use alloc::string::String;

use super::super::{SyntaxKind, SyntaxToken, literal};
use super::node::{nodes, tokens};

nodes! {
    /// A number, a string, `true`, `false` or `none`
    LiteralExpression
}

/// The value of a literal.
#[derive(Clone, Debug, PartialEq)]
pub enum Literal {
    /// An Int; 2^63, which is not an Int, only after `-`.
    Int(u64),
    /// A Float; a length in metres, an angle in radians.
    Float(f64),
    /// A Duration in nanoseconds.
    Duration(u64),
    /// A String.
    String(String),
    /// `true` or `false`.
    Bool(bool),
    /// `none`.
    None,
    /// One that is not well written, which is reported.
    Malformed,
}

impl LiteralExpression {
    /// The literal as it is written.
    #[must_use]
    pub fn token(&self) -> Option<SyntaxToken> {
        tokens(&self.0).next()
    }

    /// Its value.
    #[must_use]
    pub fn value(&self) -> Literal {
        let Some(token) = self.token() else {
            return Literal::Malformed;
        };
        let text = token.text();
        let value = match token.kind() {
            SyntaxKind::IntegerLiteral => literal::integer(text).map(Literal::Int),
            SyntaxKind::FloatLiteral | SyntaxKind::LengthLiteral | SyntaxKind::AngleLiteral => {
                literal::float(text).map(Literal::Float)
            }
            SyntaxKind::DurationLiteral => literal::duration(text).map(Literal::Duration),
            SyntaxKind::StringLiteral => Some(Literal::String(literal::string(text).0)),
            SyntaxKind::TrueKeyword => Some(Literal::Bool(true)),
            SyntaxKind::FalseKeyword => Some(Literal::Bool(false)),
            SyntaxKind::NoneKeyword => Some(Literal::None),
            _ => None,
        };
        value.unwrap_or(Literal::Malformed)
    }
}
