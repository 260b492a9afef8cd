//! The kinds of tokens and nodes a syntax tree is made of.

macro_rules! kinds {
    (
        trivia { $($trivia:ident,)+ }
        layout { $($layout:ident = $layout_name:literal,)+ }
        fixed { $($fixed:ident = $text:literal,)+ }
        free { $($free:ident = $free_name:literal,)+ }
        nodes { $($node:ident,)+ }
    ) => {
        /// The kind of a token or a node of the tree.
        ///
        /// Tokens that are trivia come first, then those of the layout, those with one spelling, those
        /// with many, and then the nodes.
        #[allow(missing_docs, reason = "the names say it; the grammar is in the language reference")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum SyntaxKind {
            $($trivia,)+
            $($layout,)+
            $($fixed,)+
            $($free,)+
            $($node,)+
        }

        impl SyntaxKind {
            const ALL: &[Self] = &[
                $(Self::$trivia,)+ $(Self::$layout,)+ $(Self::$fixed,)+ $(Self::$free,)+
                $(Self::$node,)+
            ];

            /// The one spelling of the token, if there is only one.
            #[must_use]
            pub const fn text(self) -> Option<&'static str> {
                match self {
                    $(Self::$fixed => Some($text),)+
                    _ => None,
                }
            }

            /// The name of this kind of token in messages.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$fixed => concat!("`", $text, "`"),)+
                    $(Self::$layout => $layout_name,)+
                    $(Self::$free => $free_name,)+
                    _ => "this",
                }
            }
        }
    };
}

kinds! {
    // Tokens without meaning.
    trivia {
        Whitespace,
        // The end of a line that ends nothing: an empty line, a line in brackets, a line that continues.
        LineBreak,
        Comment,
        DocComment,
        // Characters without meaning; each has a diagnostic of its own.
        Unknown,
    }
    layout {
        // The end of a line that ends a statement or a header; it has text, the other three have none.
        Newline = "the end of the line",
        Indent = "an indented line",
        Dedent = "the end of the block",
        EndOfFile = "the end of the file",
    }
    fixed {
        AndKeyword = "and", OrKeyword = "or", NotKeyword = "not", TrueKeyword = "true", FalseKeyword = "false", NoneKeyword = "none",
        SomeKeyword = "some", IfKeyword = "if", ThenKeyword = "then", ElifKeyword = "elif", ElseKeyword = "else", ForKeyword = "for",
        InKeyword = "in", ReturnKeyword = "return", LetKeyword = "let", PreKeyword = "pre", EffKeyword = "eff", OnKeyword = "on",
        LeftParen = "(", RightParen = ")", LeftBracket = "[", RightBracket = "]",
        LeftBrace = "{", RightBrace = "}",
        Comma = ",", Colon = ":", Semicolon = ";", Dot = ".", DotDot = "..", Ellipsis = "...",
        Plus = "+", Minus = "-", Star = "*", Slash = "/", Percent = "%",
        Equal = "=", PlusEqual = "+=", MinusEqual = "-=", StarEqual = "*=",
        SlashEqual = "/=", PercentEqual = "%=", PlusPlus = "++",
        EqualEqual = "==", NotEqual = "!=", Less = "<", LessEqual = "<=", Greater = ">",
        GreaterEqual = ">=",
        Bang = "!", Question = "?", QuestionQuestion = "??", Arrow = "->",
    }
    free {
        Identifier = "a name", IntegerLiteral = "a number", FloatLiteral = "a number",
        DurationLiteral = "a duration", LengthLiteral = "a length", AngleLiteral = "an angle", StringLiteral = "a string",
        MalformedNumber = "a number", MalformedString = "a string",
    }
    nodes {
        SourceFile, Error, Name,
        ProgramHeader, LibraryHeader, Import,
        EnumDeclaration, VariantList, RecordDeclaration, FieldList, Field, MessageDeclaration,
        ParameterDeclaration, ParameterRange, ConstantDeclaration, VariableDeclaration, SharedDeclaration,
        Consistency, BindingDeclaration, FunctionDeclaration, ParameterList, Parameter,
        InitDeclaration, ActionDeclaration, ActionBody, PreClause, EveryClause, EffClause, HandlerDeclaration, EventPath,
        HandlerParameterList, RoleDeclaration, RoleBody, CheckDeclaration, PropertyDeclaration,
        NamedType, TypeArguments, OptionalType, EnumType, TupleType,
        Block,
        LetStatement, AssignStatement, IfStatement, IfBranch, ElseBranch, ForStatement, LoopVariables, TuplePattern,
        ReturnStatement, ExpressionStatement, AtomicStatement,
        LiteralExpression, NameExpression, ParenthesizedExpression, TupleExpression, FieldExpression, CallExpression,
        ArgumentList, Argument, IndexExpression, UnwrapExpression, PrefixExpression,
        BinaryExpression, SomeExpression, ConditionalExpression, QuantifierExpression,
        ListExpression, BraceExpression, MapEntry, ComprehensionClause,
    }
}

impl SyntaxKind {
    /// Whether it stands between the tokens that matter, so that the parser never sees it.
    #[must_use]
    pub fn is_trivia(self) -> bool {
        self <= Self::Unknown
    }

    /// Whether it is a reserved word.
    #[must_use]
    pub fn is_keyword(self) -> bool {
        (Self::AndKeyword..=Self::OnKeyword).contains(&self)
    }

    /// Whether it is a number, with or without a unit, well written or not.
    #[must_use]
    pub fn is_number(self) -> bool {
        (Self::IntegerLiteral..=Self::AngleLiteral).contains(&self) || self == Self::MalformedNumber
    }

    /// Whether it is a number, a string, a truth value or `none`.
    #[must_use]
    pub fn is_literal(self) -> bool {
        (Self::IntegerLiteral..=Self::MalformedString).contains(&self)
            || matches!(
                self,
                Self::TrueKeyword | Self::FalseKeyword | Self::NoneKeyword
            )
    }

    /// Whether a line that ends with it continues in the next one, if that is indented deeper.
    #[must_use]
    pub fn continues_line(self) -> bool {
        matches!(
            self,
            Self::AndKeyword
                | Self::OrKeyword
                | Self::NotKeyword
                | Self::InKeyword
                | Self::Comma
                | Self::DotDot
        ) || (Self::Plus..=Self::PercentEqual).contains(&self)
            || (Self::EqualEqual..=Self::GreaterEqual).contains(&self)
            || matches!(self, Self::QuestionQuestion | Self::Arrow)
    }

    /// Whether it is `=` or an operator that ends with it and changes a variable.
    #[must_use]
    pub fn is_assignment(self) -> bool {
        (Self::Equal..=Self::PercentEqual).contains(&self)
    }

    /// Whether it compares two values.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        (Self::EqualEqual..=Self::GreaterEqual).contains(&self)
    }

    /// The closing bracket for an opening one.
    #[must_use]
    pub fn closing(self) -> Option<Self> {
        match self {
            Self::LeftParen => Some(Self::RightParen),
            Self::LeftBracket => Some(Self::RightBracket),
            Self::LeftBrace => Some(Self::RightBrace),
            _ => None,
        }
    }

    /// Whether it is a closing bracket.
    #[must_use]
    pub fn is_closing(self) -> bool {
        matches!(
            self,
            Self::RightParen | Self::RightBracket | Self::RightBrace
        )
    }

    /// The keyword that is spelt so.
    #[must_use]
    pub fn keyword(word: &str) -> Option<Self> {
        let keywords = &Self::ALL[Self::AndKeyword as usize..=Self::OnKeyword as usize];
        keywords
            .iter()
            .copied()
            .find(|keyword| keyword.text() == Some(word))
    }
}

/// The language of `rowan`'s trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Language {}

impl rowan::Language for Language {
    type Kind = SyntaxKind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        SyntaxKind::ALL[usize::from(raw.0)]
    }

    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}
