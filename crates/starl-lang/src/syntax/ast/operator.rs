//! Operators.

use super::super::SyntaxKind;

macro_rules! operators {
    ($(#[$meta:meta])+ $name:ident { $($(#[$doc:meta])+ $variant:ident = $kind:ident,)+ }) => {
        $(#[$meta])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name {
            $($(#[$doc])+ $variant,)+
        }

        impl $name {
            /// The operator that a token of this kind is.
            #[must_use]
            pub fn of(kind: SyntaxKind) -> Option<Self> {
                match kind {
                    $(SyntaxKind::$kind => Some(Self::$variant),)+
                    _ => None,
                }
            }

            /// How it is written.
            #[must_use]
            pub fn text(self) -> &'static str {
                match self {
                    $(Self::$variant => SyntaxKind::$kind.text().unwrap_or_default(),)+
                }
            }
        }
    };
}

operators! {
    /// An operator between two values. `not in` is [`Self::In`] with a `not` before it; see
    /// [`super::BinaryExpression::is_negated`].
    BinaryOperator {
        /// `or`
        Or = OrKeyword,
        /// `and`
        And = AndKeyword,
        /// `==`
        Equal = EqualEqual,
        /// `!=`
        NotEqual = NotEqual,
        /// `<`
        Less = Less,
        /// `<=`
        LessEqual = LessEqual,
        /// `>`
        Greater = Greater,
        /// `>=`
        GreaterEqual = GreaterEqual,
        /// `in`
        In = InKeyword,
        /// `..`
        Range = DotDot,
        /// `??`
        Default = QuestionQuestion,
        /// `+`
        Add = Plus,
        /// `-`
        Subtract = Minus,
        /// `*`
        Multiply = Star,
        /// `/`
        Divide = Slash,
        /// `%`
        Remainder = Percent,
    }
}

operators! {
    /// An operator before a value.
    PrefixOperator {
        /// `-`
        Negate = Minus,
        /// `not`
        Not = NotKeyword,
    }
}

operators! {
    /// An operator that changes a variable.
    AssignOperator {
        /// `=`
        Assign = Equal,
        /// `+=`
        Add = PlusEqual,
        /// `-=`
        Subtract = MinusEqual,
        /// `*=`
        Multiply = StarEqual,
    }
}
