//! Descriptions of reserved words and of the words that begin declarations.

use crate::Description;
use starl_lang::diagnostic::Span;
use starl_lang::syntax::{Parse, SyntaxKind, SyntaxToken};

/// A word with its form and its meaning.
pub(crate) struct Word {
    pub word: &'static str,
    pub form: &'static str,
    pub meaning: &'static str,
}

pub(crate) const fn word(word: &'static str, form: &'static str, meaning: &'static str) -> Word {
    Word {
        word,
        form,
        meaning,
    }
}

/// Words that begin a declaration of a file.
pub(crate) const DECLARATIONS: &[Word] = &[
    word(
        "program",
        "program Name",
        "The first line of a program, which every robot of a fleet runs.",
    ),
    word(
        "library",
        "library name",
        "The first line of a library: enums, records, constants and functions for several programs.",
    ),
    word(
        "import",
        "import name",
        "Imports a library from the same folder or from the standard library.",
    ),
    word(
        "enum",
        "enum Name {first, second}",
        "A type with a few named values.",
    ),
    word(
        "record",
        "record Name {x: Int, y: Point}",
        "A type with named fields.",
    ),
    word(
        "message",
        "message Name(x: Int)",
        "A message between robots.",
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
        "A shared array: each robot writes its own element and reads all.",
    ),
    word(
        "allwrite",
        "allwrite name: Type",
        "A shared variable that all robots write and read.",
    ),
    word(
        "stable",
        "stable name: Type = value",
        "A variable that survives a crash if the robot has storage.",
    ),
    word(
        "function",
        "function name(a: Type) -> Type",
        "A function of its arguments and of constants alone.",
    ),
    word(
        "init",
        "init",
        "Statements that run once, before any action.",
    ),
    word(
        "on",
        "on Message(from, field)",
        "Statements that run when a message arrives, or on an event of a primitive.",
    ),
    word(
        "role",
        "role name",
        "Actions and handlers of the robots that have this role.",
    ),
    word(
        "check",
        "check condition",
        "An invariant of the variables; if a fault has overwritten them and it is false, the program restarts.",
    ),
    word(
        "invariant",
        "invariant name: condition",
        "A condition that holds at all times; each run checks it.",
    ),
    word(
        "always",
        "always name: condition leads_to condition within 5s",
        "A condition that holds at all times, or that another condition follows each time.",
    ),
    word(
        "eventually",
        "eventually name: condition within 120s",
        "A condition that becomes true within this time; with `eventually always` it then stays true.",
    ),
];

/// Words after `on`.
pub(crate) const HANDLERS: &[Word] = &[word(
    "input",
    "on input name(field: Type)",
    "Runs when an operator gives an order of this name with these fields; `on input way_points()`: \
     runs when the waypoints have changed.",
)];

/// Words that begin a part of an action.
pub(crate) const CLAUSES: &[Word] = &[
    word(
        "pre",
        "pre condition for 2s",
        "The guard of the action; with `for`, the condition must have held for this time.",
    ),
    word(
        "every",
        "every 500ms",
        "The shortest time from one firing of the action to the next.",
    ),
    word("eff", "eff statements", "The effect of the action."),
];

/// Words that begin a statement.
pub(crate) const STATEMENTS: &[Word] = &[
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
pub(crate) const EXPRESSIONS: &[Word] = &[
    word("true", "true: Bool", "The truth value."),
    word("false", "false: Bool", "The other truth value."),
    word("none", "none", "The optional that has no value."),
    word(
        "some",
        "some x = optional",
        "True if there is a value, and names the value.",
    ),
    word("not", "not condition", "The negation."),
    word(
        "and",
        "a and b",
        "True if both are; the second is evaluated only if the first is true.",
    ),
    word(
        "or",
        "a or b",
        "True if one is; the second is evaluated only if the first is false.",
    ),
    word(
        "in",
        "x in collection",
        "Whether a value is an element, a key or a part.",
    ),
    word(
        "by",
        "[x for x in xs by key]",
        "Sorts the list by this key, ascending; elements with equal keys stay in their order.",
    ),
    word(
        "then",
        "if condition then a else b",
        "The value or statement for the case that the condition holds.",
    ),
    word(
        "forall",
        "forall x in xs: condition",
        "Whether the condition holds for all elements; in a property, `forall r, s: ...` is about all robots.",
    ),
    word(
        "exists",
        "exists x in xs: condition",
        "Whether the condition holds for an element; in a property, `exists r: ...` is about all robots.",
    ),
];

/// Words in properties.
pub(crate) const QUANTIFIERS: &[Word] = &[
    word(
        "within",
        "within 120s",
        "The deadline, counted from the last fault if that is later.",
    ),
    word(
        "recovers",
        "recovers within 20s",
        "The time for which it may be false after a fault has overwritten variables.",
    ),
    word(
        "assuming",
        "assuming condition",
        "The property is judged only while this holds.",
    ),
    word(
        "despite",
        "despite crashes",
        "Robots that are down are judged too.",
    ),
    word(
        "leads_to",
        "cause leads_to consequence",
        "Whenever the cause is true, the consequence is true then or later.",
    ),
];

impl Word {
    pub fn description(&self) -> Description {
        Description::new(self.form, self.meaning)
    }
}

/// The word at a position, unless it is a name.
pub(crate) fn at(parse: &Parse, offset: u32) -> Option<(Span, Description)> {
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
pub(crate) fn is_word(token: &SyntaxToken) -> bool {
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
