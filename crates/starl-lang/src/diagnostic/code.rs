//! Every kind of problem that a person may be told of, with the number by which it can be looked up.
//!
//! Numbers are never reused. `01xx` is what is wrong with the text itself, `02xx` and on belong to the
//! checker. `E` is an error: the program does not run. `W` is a warning: it runs.

use core::fmt;

use super::Severity;

macro_rules! codes {
    ($($(#[doc = $doc:literal])+ $name:ident = $number:literal,)+) => {
        /// What kind of problem a diagnostic reports.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Code {
            $($(#[doc = $doc])+ $name,)+
        }

        impl Code {
            /// All codes, by rising number, errors first.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            /// The number under which a person finds the page that explains it, such as `E0101`.
            #[must_use]
            pub const fn number(self) -> &'static str {
                match self {
                    $(Self::$name => $number,)+
                }
            }

            /// What the code means, in a sentence.
            #[must_use]
            pub fn title(self) -> &'static str {
                match self {
                    $(Self::$name => concat!($($doc,)+).trim(),)+
                }
            }
        }
    };
}

codes! {
    /// A character that has no meaning in a program.
    UnknownCharacter = "E0101",
    /// A number that is not written as numbers are, or has an unknown unit.
    MalformedNumber = "E0102",
    /// A text in quotes that does not end or holds an unknown escape.
    MalformedString = "E0103",
    /// A tab in the indentation of a line.
    TabIndentation = "E0104",
    /// A line whose indentation matches no line above it.
    UnevenIndentation = "E0105",
    /// A line that is indented although nothing before it opens a block.
    UnexpectedIndentation = "E0106",
    /// Something that needs an indented block has none.
    MissingBlock = "E0107",
    /// Something other than what must stand here.
    Unexpected = "E0108",
    /// A bracket without its partner.
    UnbalancedBracket = "E0109",
    /// An assignment where a condition must stand.
    AssignmentInCondition = "E0110",
    /// A comparison where a statement must stand.
    ComparisonAsStatement = "E0111",
    /// An operator as other languages write it.
    ForeignOperator = "E0112",
    /// A statement that does nothing.
    NoEffect = "E0113",
    /// `else if` instead of `elif`.
    ElseIf = "E0114",
    /// Statements of an action outside its `eff`.
    MissingEff = "E0115",
    /// A variable declared in the manner of another language.
    ForeignDeclaration = "E0116",
    /// Something in a place where it cannot stand.
    Misplaced = "E0117",
    /// A file that does not begin with `program` or `library`.
    MissingHeader = "E0118",
    /// A comparison of a comparison.
    ChainedComparison = "E0119",
    /// More nesting than a program may have.
    TooDeep = "E0120",
    /// A number and its unit that stand apart.
    UnitApart = "E0121",
    /// An assignment to something that is not a variable or a part of one.
    InvalidTarget = "E0122",
    /// `some` where nothing is decided.
    MisplacedSome = "E0123",
    /// A comment as other languages write it.
    ForeignComment = "E0124",
    /// A statement of other languages that StarL does without.
    ForeignStatement = "E0125",
    /// A keyword where a name must stand.
    KeywordAsName = "E0126",
    /// An action with parameters.
    ActionParameters = "E0127",
    /// `pre` and `eff` in the wrong order or number.
    ClauseOrder = "E0128",
    /// More text than a program may have.
    TooLong = "E0129",
    /// A colon at the end of a line that opens a block.
    HeaderColon = "W0101",
    /// An action's name without its brackets.
    KoordAction = "W0102",
}

impl Code {
    /// Whether the program still runs.
    #[must_use]
    pub fn severity(self) -> Severity {
        if self.number().starts_with('W') {
            Severity::Warning
        } else {
            Severity::Error
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.number())
    }
}
