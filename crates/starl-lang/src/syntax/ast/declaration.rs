//! Declarations and their parts.

use alloc::string::String;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::node::{after, child, children_through_errors, first_word, nodes, token, tokens, word};
use super::{Block, Expression, Item, Name, Type, TypeArguments};

nodes! {
    /// A whole file.
    SourceFile
    /// `program Name`
    ProgramHeader
    /// `library Name`
    LibraryHeader
    /// `import name`
    Import
    /// `param name: Type in from..before = default`
    ParameterDeclaration {
        /// Its type, if that is written.
        ty: Type,
        /// The values that it may have, if that is written.
        range: ParameterRange,
        /// Its value, if that is written.
        value: Expression,
    }
    /// `in from..before`
    ParameterRange {
        /// Its value, if that is written.
        value: Expression,
    }
    /// `const name = value`
    ConstantDeclaration {
        /// Its type, if that is written.
        ty: Type,
        /// Its value, if that is written.
        value: Expression,
    }
    /// `name: Type = value` or `stable name: Type = value`
    VariableDeclaration {
        /// Its type, if that is written.
        ty: Type,
        /// The values that it may have, if that is written.
        range: ParameterRange,
        /// Its value, if that is written.
        value: Expression,
    }
    /// `allread name[RobotId]: Type` or `allwrite name: Type = value`
    SharedDeclaration {
        /// Its type, if that is written.
        ty: Type,
        /// Its value, if that is written.
        value: Expression,
    }
    /// `[causal]`
    Consistency
    /// `name = Primitive(arguments)`
    BindingDeclaration {
        /// Its value, if that is written.
        value: Expression,
    }
    /// `function name(a: T) -> V`
    FunctionDeclaration {
        /// Its parameters.
        parameters: [Parameter] in ParameterList,
        /// The type of its result.
        result: Type,
        /// Its value, if that is written.
        value: Expression,
        /// Its statements, unless it is written with `=` and a value.
        body: Block,
    }
    /// The parameters of a function
    ParameterList
    /// `a: T`
    Parameter {
        /// Its type, if that is written.
        ty: Type,
    }
    /// `init` and statements
    InitDeclaration {
        /// Its statements.
        body: Block,
    }
    /// `name()` with `pre` and `eff`
    ActionDeclaration {
        /// Its guard, if it has one.
        pre: PreClause in ActionBody,
        /// Its effect.
        eff: EffClause in ActionBody,
    }
    /// The clauses under an action's name
    ActionBody
    /// `pre condition` or `pre condition for time`
    PreClause {
        /// The condition.
        condition: Expression,
        /// For how long the condition has to hold, if that is written.
        hold: Expression after ForKeyword,
    }
    /// `every time`
    EveryClause
    /// `eff` and statements
    EffClause {
        /// The statements.
        body: Block,
    }
    /// `on Message(from, a)` or `on input name(a: T)`, and statements
    HandlerDeclaration {
        /// The name of the input that it handles, if it is one.
        input: Name,
        /// The fields of the input.
        fields: [Parameter] in ParameterList,
        /// The message or the primitive's event that it handles; none for an input.
        event: EventPath,
        /// The names for the sender and the fields, or for what the event carries.
        parameters: [Name] in HandlerParameterList,
        /// Its statements.
        body: Block,
    }
    /// `Message` or `primitive.event`
    EventPath
    /// `(from, a)`
    HandlerParameterList
    /// `role name` and declarations
    RoleDeclaration
    /// The declarations under a role's name
    RoleBody
    /// `check condition`
    CheckDeclaration {
        /// The condition.
        condition: Expression,
    }
    /// `invariant name: condition` and the like
    PropertyDeclaration {
        /// The condition; with [`Self::consequence`], the cause.
        condition: Expression,
        /// The condition after `leads_to`, if any.
        consequence: Expression after "leads_to",
        /// How long it may be false after a fault has overwritten variables, if `recovers within` is written.
        recovery: Expression after "recovers",
        /// The condition after `assuming`, if any.
        assumption: Expression after "assuming",
    }
}

impl SourceFile {
    pub(in crate::syntax) fn of(root: SyntaxNode) -> Self {
        Self(root)
    }

    /// The declarations, with the header.
    pub fn items(&self) -> impl Iterator<Item = Item> + use<> {
        children_through_errors(&self.0)
    }
}

impl VariableDeclaration {
    /// Whether it is declared `stable`.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        word(&self.0, "stable").is_some()
    }
}

impl SharedDeclaration {
    /// Whether each robot writes its own element (`allread`), instead of one shared variable.
    #[must_use]
    pub fn is_single_writer(&self) -> bool {
        let first = tokens(&self.0).next();
        first.is_none_or(|word| !matches!(word.text(), "allwrite" | "sharedmw" | "shared"))
    }

    /// The word in brackets that names the consistency, if it is named.
    #[must_use]
    pub fn consistency(&self) -> Option<SyntaxToken> {
        token(&child::<Consistency>(&self.0)?.0, SyntaxKind::Identifier)
    }

    /// The type of its index: `RobotId`.
    #[must_use]
    pub fn index(&self) -> Option<Type> {
        child::<TypeArguments>(&self.0)?.types().next()
    }
}

impl ActionDeclaration {
    /// How often it fires at most, if that is written.
    #[must_use]
    pub fn every(&self) -> Option<Expression> {
        child(&child::<EveryClause>(&child::<ActionBody>(&self.0)?.0)?.0)
    }
}

impl EventPath {
    /// The words: one for a message, two for the event of a primitive.
    pub fn words(&self) -> impl Iterator<Item = SyntaxToken> + use<> {
        tokens(&self.0).filter(|token| token.kind() == SyntaxKind::Identifier)
    }
}

impl RoleDeclaration {
    /// Its declarations.
    pub fn items(&self) -> impl Iterator<Item = Item> + use<> {
        child::<RoleBody>(&self.0)
            .into_iter()
            .flat_map(|body| children_through_errors(&body.0))
    }
}

impl PropertyDeclaration {
    /// Whether it must become true at some time, instead of being always true.
    #[must_use]
    pub fn is_eventual(&self) -> bool {
        self.word() == "eventually"
    }

    /// Whether it must become true at some time and stay true.
    #[must_use]
    pub fn is_eventually_always(&self) -> bool {
        self.is_eventual() && word(&self.0, "always").is_some()
    }

    /// The word that it begins with.
    #[must_use]
    pub fn word(&self) -> String {
        first_word(&self.0)
    }

    /// How long it may take, if `within` is written.
    #[must_use]
    pub fn deadline(&self) -> Option<Expression> {
        let word = word(&self.0, "within")?;
        let mut before = word.siblings_with_tokens(rowan::Direction::Prev);
        let is_recovery = before.any(|other| {
            let token = other.into_token();
            token.is_some_and(|token| token.text() == "recovers")
        });
        if is_recovery { None } else { after(&word) }
    }

    /// Whether robots that are down count too.
    #[must_use]
    pub fn is_despite_crashes(&self) -> bool {
        word(&self.0, "despite").is_some()
    }
}
