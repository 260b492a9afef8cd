//! All kinds of problems, with the numbers of their pages.
//!
//! Numbers are never reused. `01xx` are syntax errors, `02xx` belong to the checker, `03xx` to the compiler. `E` is an
//! error: the program does not run. `W` is a warning: it runs.

use core::fmt;

use super::Severity;

macro_rules! codes {
    ($($(#[doc = $doc:literal])+ $name:ident = $number:literal,)+) => {
        /// The kind of problem that a diagnostic reports.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Code {
            $($(#[doc = $doc])+ $name,)+
        }

        impl Code {
            /// All codes by ascending number, errors first.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            /// The number under which a person finds the page that explains it, such as `E0101`.
            #[must_use]
            pub const fn number(self) -> &'static str {
                match self {
                    $(Self::$name => $number,)+
                }
            }

            /// The page that explains it, in Markdown: the cause, and an example with its fix.
            #[must_use]
            pub const fn page(self) -> &'static str {
                match self {
                    $(Self::$name => include_str!(concat!("../../../../docs/errors/", $number, ".md")),)+
                }
            }

            /// The meaning of the code, in a sentence.
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
    /// A tuple of one part.
    ShortTuple = "E0130",
    /// A name that nothing has.
    UnknownName = "E0201",
    /// A name that is declared twice.
    DuplicateName = "E0202",
    /// A local name that hides another.
    HiddenName = "E0203",
    /// A name without a value.
    NoValue = "E0204",
    /// A type that there is not.
    UnknownType = "E0205",
    /// A type with too many or too few types in its brackets.
    TypeArguments = "E0206",
    /// A type that cannot be a key of a map or an element of a set.
    InvalidKey = "E0207",
    /// A record that contains itself.
    RecursiveType = "E0208",
    /// A variable that needs a first value.
    NoDefault = "E0209",
    /// A library that cannot be found.
    UnknownLibrary = "E0210",
    /// Libraries that import each other.
    ImportCycle = "E0211",
    /// A library with errors.
    BrokenLibrary = "E0212",
    /// A declaration that a library cannot hold.
    NotInLibrary = "E0213",
    /// A constant whose value depends on itself.
    ConstantCycle = "E0214",
    /// A field or method that there is not.
    UnknownMember = "E0215",
    /// A variant that the enum does not have.
    UnknownVariant = "E0216",
    /// A variant that several enums have.
    AmbiguousVariant = "E0217",
    /// A value of another type than the one that is needed.
    WrongType = "E0220",
    /// An optional value where a value is needed.
    MayBeNone = "E0221",
    /// An operator between values that it does not join.
    OperatorTypes = "E0222",
    /// Int and Float mixed.
    MixedNumbers = "E0223",
    /// A value whose type cannot be known.
    UnclearType = "E0224",
    /// Something that cannot be run over or looked in.
    NotCollection = "E0225",
    /// Something that is always there, treated as if it may be none.
    NotOptional = "E0226",
    /// Something that cannot be indexed.
    NotIndexable = "E0227",
    /// A range that is neither run over nor looked in.
    MisplacedRange = "E0228",
    /// Lengths, angles and numbers without a unit mixed.
    MixedDimensions = "E0229",
    /// Something called that cannot be, or not called that must be.
    NotCallable = "E0230",
    /// Too many or too few arguments.
    ArgumentCount = "E0231",
    /// An argument with a name that no parameter has.
    ArgumentName = "E0232",
    /// A function that may end without a result.
    MissingReturn = "E0233",
    /// A `return` with a value too many or too few.
    ReturnValue = "E0234",
    /// Something that cannot be written.
    NotWritable = "E0240",
    /// A write to another robot's element of a single-writer variable.
    ForeignElement = "E0241",
    /// Something with an effect where nothing may happen.
    Impure = "E0242",
    /// The state used where it cannot be seen.
    StateOutOfReach = "E0243",
    /// A variable used before it has a value.
    UsedTooEarly = "E0244",
    /// A primitive that there is not.
    UnknownPrimitive = "E0245",
    /// A handler of something that is neither a message nor an event.
    UnknownEvent = "E0246",
    /// A handler whose parameters differ from those of its event.
    HandlerParameters = "E0247",
    /// A quantifier over all robots outside of a property.
    MisplacedQuantifier = "E0248",
    /// Another robot's variable, outside of a property.
    ForeignVariable = "E0249",
    /// A property that cannot be checked.
    InvalidProperty = "E0250",
    /// A consistency that shared variables do not have.
    UnknownConsistency = "E0251",
    /// A second declaration of something unique.
    SecondDeclaration = "E0252",
    /// A record or an enum with too many parts.
    TooLarge = "E0253",
    /// A linearizable variable outside of an action with `atomic`.
    OutsideAtomic = "E0254",
    /// An `atomic` where nothing can wait.
    MisplacedAtomic = "E0255",
    /// An invalid range of a parameter.
    InvalidRange = "E0256",
    /// A field of an input with a type that orders do not carry.
    InputField = "E0257",
    /// A model that cannot be used.
    UnusableModel = "E0258",
    /// More or fewer names than the tuple has parts.
    TupleParts = "E0259",
    /// More values at a time than the machine has registers.
    TooManyRegisters = "E0302",
    /// More of something than a compiled program can hold.
    TooMuch = "E0303",
    /// Types that are nested too deeply.
    NestedTooDeep = "E0304",
    /// A constant whose value cannot be computed.
    NotComputable = "E0305",
    /// A colon at the end of a line that opens a block.
    HeaderColon = "W0101",
    /// An action's name without its brackets.
    KoordAction = "W0102",
    /// A statement that looks as if a condition decided over it, but it does not.
    AfterInlineIf = "W0103",
    /// An action that is never enabled.
    NeverEnabled = "W0201",
    /// A state that no action leaves.
    NoWayOut = "W0202",
    /// A message that is sent and not handled.
    MessageNotHandled = "W0203",
    /// A message that is not sent.
    MessageNotSent = "W0204",
    /// A variable that is never read.
    NeverRead = "W0205",
    /// A local variable that is never read.
    UnusedLocal = "W0206",
    /// A function, constant, parameter or primitive that is not used.
    UnusedDeclaration = "W0207",
    /// An import that is not used.
    UnusedImport = "W0208",
    /// A value that is computed and dropped.
    UnusedValue = "W0209",
    /// Statements that are never reached.
    Unreachable = "W0210",
    /// A condition that is always the same.
    ConstantCondition = "W0211",
    /// An `atomic` that does not protect the variables it uses.
    NothingShared = "W0212",
    /// A text whose `{}` do not match the values after it.
    FormatValues = "W0213",
    /// A name in braces in a text, which is not replaced by its value.
    BracedName = "W0214",
    /// An index below 0.
    NegativeIndex = "W0215",
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

    /// Whether the text that it is about could be taken away without a loss.
    #[must_use]
    pub fn is_needless(self) -> bool {
        matches!(
            self,
            Code::NeverRead
                | Code::UnusedLocal
                | Code::UnusedDeclaration
                | Code::UnusedImport
                | Code::Unreachable
        )
    }
}

impl fmt::Display for Code {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.number())
    }
}
