//! Descriptions of reserved words and of the words that begin declarations.

use alloc::string::String;

use super::Description;
use crate::diagnostic::Span;
use crate::syntax::{Parse, SyntaxKind, SyntaxToken};

/// A word with its form and its meaning.
pub(super) struct Word {
    pub word: &'static str,
    pub form: &'static str,
    pub meaning: &'static str,
}

const fn word(word: &'static str, form: &'static str, meaning: &'static str) -> Word {
    Word {
        word,
        form,
        meaning,
    }
}

/// Words that begin a declaration of a file.
pub(super) const DECLARATIONS: &[Word] = &[
    word(
        "program",
        "program Name",
        "The first line of a program: what every robot of a fleet runs.",
    ),
    word(
        "library",
        "library name",
        "The first line of a library: enums, records, constants and functions for several programs.",
    ),
    word(
        "import",
        "import name",
        "Brings in a library, of the same folder or of the standard library.",
    ),
    word(
        "enum",
        "enum Name {first, second}",
        "A type with a few named values.",
    ),
    word(
        "record",
        "record Name {x: Int, y: Point}",
        "A type made of named parts.",
    ),
    word(
        "message",
        "message Name(x: Int)",
        "What robots send each other.",
    ),
    word(
        "param",
        "param name: Type = default",
        "A value that the scenario sets.",
    ),
    word("const", "const name = value", "A value that never changes."),
    word(
        "allread",
        "allread name[RobotId]: Type",
        "A shared variable of which each robot writes its own element and reads all.",
    ),
    word(
        "allwrite",
        "allwrite name: Type",
        "A shared variable that all robots write and read.",
    ),
    word(
        "stable",
        "stable name: Type = value",
        "A variable that outlasts a crash where the robot has storage.",
    ),
    word(
        "function",
        "function name(a: Type) -> Type",
        "Something computed from arguments and constants alone.",
    ),
    word("init", "init", "What is done once, before any action."),
    word(
        "on",
        "on Message(from, field)",
        "What is done when a message arrives, or when a primitive reports something.",
    ),
    word(
        "role",
        "role name",
        "Actions and handlers of the robots that have this role.",
    ),
    word(
        "check",
        "check condition",
        "A condition that the variables always satisfy; where a fault has overwritten them and it is false, the program starts again.",
    ),
    word(
        "invariant",
        "invariant name: condition",
        "A condition that holds at all times; each run checks it.",
    ),
    word(
        "always",
        "always name: condition leads_to condition within 5s",
        "A condition that holds at all times, or that another one follows each time.",
    ),
    word(
        "eventually",
        "eventually name: condition within 120s",
        "A condition that comes true, at the latest after this time; with `eventually always` it stays true.",
    ),
];

/// Words after `on`.
pub(super) const HANDLERS: &[Word] = &[word(
    "input",
    "on input name(field: Type)",
    "Runs when an operator gives an order of this name with these fields; `on input way_points()`: \
     runs when the waypoints have changed.",
)];

/// Words that begin a part of an action.
pub(super) const CLAUSES: &[Word] = &[
    word(
        "pre",
        "pre condition for 2s",
        "When the action may fire; with `for`, when the condition has held for so long.",
    ),
    word(
        "every",
        "every 500ms",
        "The least time from one firing of the action to the next.",
    ),
    word("eff", "eff statements", "What the action does."),
];

/// Words that begin a statement.
pub(super) const STATEMENTS: &[Word] = &[
    word("let", "let name = value", "A local variable."),
    word(
        "if",
        "if condition",
        "Statements for the case that the condition holds.",
    ),
    word(
        "elif",
        "elif condition",
        "Statements for the case that the conditions above do not hold and this one does.",
    ),
    word(
        "else",
        "else",
        "Statements for the case that no condition above holds.",
    ),
    word("for", "for x in collection", "Statements for each element."),
    word(
        "return",
        "return value",
        "Ends the function with its result, or an effect or handler without one.",
    ),
    word(
        "atomic",
        "atomic",
        "Statements that run while this robot alone writes the shared variables.",
    ),
];

/// Words in expressions.
pub(super) const EXPRESSIONS: &[Word] = &[
    word("true", "true: Bool", "The truth value."),
    word("false", "false: Bool", "The other truth value."),
    word("none", "none", "The optional that has no value."),
    word(
        "some",
        "some x = optional",
        "Holds if there is a value, which then has the name.",
    ),
    word("not", "not condition", "The opposite."),
    word(
        "and",
        "a and b",
        "Holds if both do; the second is looked at only if the first holds.",
    ),
    word(
        "or",
        "a or b",
        "Holds if one does; the second is looked at only if the first does not.",
    ),
    word(
        "in",
        "x in collection",
        "Whether something is an element, a key or a part.",
    ),
    word(
        "then",
        "if condition then a else b",
        "What comes if the condition holds.",
    ),
];

/// Words in properties.
pub(super) const QUANTIFIERS: &[Word] = &[
    word(
        "forall",
        "forall r, s: condition",
        "Holds if the condition does for all robots.",
    ),
    word(
        "exists",
        "exists r: condition",
        "Holds if the condition does for some robot.",
    ),
    word(
        "within",
        "within 120s",
        "How long it may take, counted from the last fault too.",
    ),
    word(
        "recovers",
        "recovers within 20s",
        "How long it may be false after a fault has overwritten variables.",
    ),
    word(
        "assuming",
        "assuming condition",
        "The property is judged only while this holds.",
    ),
    word(
        "despite",
        "despite crashes",
        "Robots that are down count too.",
    ),
    word(
        "leads_to",
        "cause leads_to consequence",
        "Each time that the cause holds, the consequence holds then or later.",
    ),
];

impl Word {
    pub fn description(&self) -> Description {
        Description {
            signature: self.form.into(),
            documentation: self.meaning.into(),
            of_locals: None,
        }
    }
}

/// The word at a position, unless it is a name.
pub(super) fn at(parse: &Parse, offset: u32) -> Option<(Span, Description)> {
    let root = parse.syntax();
    if offset > u32::from(root.text_range().end()) {
        return None;
    }
    let token = root.token_at_offset(offset.into()).find(is_word)?;
    let text = String::from(token.text());
    let tables = [
        CLAUSES,
        STATEMENTS,
        EXPRESSIONS,
        QUANTIFIERS,
        DECLARATIONS,
        HANDLERS,
    ];
    let mut words = tables.into_iter().flatten();
    let found = words.find(|word| word.word == text)?;
    Some((token.text_range().into(), found.description()))
}

/// Whether the token is reserved, or begins a declaration or a statement here.
pub(super) fn is_word(token: &SyntaxToken) -> bool {
    if token.kind().is_keyword() {
        return true;
    }
    let Some(parent) = token.parent().map(|parent| parent.kind()) else {
        return false;
    };
    let names = matches!(
        parent,
        SyntaxKind::Name
            | SyntaxKind::NameExpression
            | SyntaxKind::FieldExpression
            | SyntaxKind::NamedType
            | SyntaxKind::EventPath
            | SyntaxKind::Consistency
            | SyntaxKind::Error
    );
    token.kind() == SyntaxKind::Identifier && !names
}
