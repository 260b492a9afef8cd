//! Declarations and their parts.

use alloc::string::String;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::node::{after, child, children, children_through_errors, nodes, token, tokens, word};
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
    ParameterDeclaration
    /// `in from..before`
    ParameterRange
    /// `const name = value`
    ConstantDeclaration
    /// `name: Type = value` or `stable name: Type = value`
    VariableDeclaration
    /// `allread name[RobotId]: Type` or `allwrite name: Type = value`
    SharedDeclaration
    /// `[causal]`
    Consistency
    /// `name = Primitive(arguments)`
    BindingDeclaration
    /// `function name(a: T) -> V`
    FunctionDeclaration
    /// The parameters of a function
    ParameterList
    /// `a: T`
    Parameter
    /// `init` and statements
    InitDeclaration
    /// `name()` with `pre` and `eff`
    ActionDeclaration
    /// The clauses under an action's name
    ActionBody
    /// `pre condition` or `pre condition for time`
    PreClause
    /// `every time`
    EveryClause
    /// `eff` and statements
    EffClause
    /// `on Message(from, a)` or `on input name(a: T)`, and statements
    HandlerDeclaration
    /// `Message` or `primitive.event`
    EventPath
    /// `(from, a)`
    HandlerParameterList
    /// `role name` and declarations
    RoleDeclaration
    /// The declarations under a role's name
    RoleBody
    /// `check condition`
    CheckDeclaration
    /// `invariant name: condition` and the like
    PropertyDeclaration
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

macro_rules! typed {
    ($($name:ident)+) => {$(
        impl $name {
            /// Its type, if that is written.
            #[must_use]
            pub fn ty(&self) -> Option<Type> {
                child(&self.0)
            }
        }
    )+};
}

macro_rules! valued {
    ($($name:ident)+) => {$(
        impl $name {
            /// Its value, if that is written.
            #[must_use]
            pub fn value(&self) -> Option<Expression> {
                child(&self.0)
            }
        }
    )+};
}

typed! { Parameter ParameterDeclaration ConstantDeclaration VariableDeclaration SharedDeclaration }
valued! {
    ParameterDeclaration ConstantDeclaration VariableDeclaration SharedDeclaration BindingDeclaration
    FunctionDeclaration ParameterRange
}

impl ParameterDeclaration {
    /// The values that it may have, if that is written.
    #[must_use]
    pub fn range(&self) -> Option<ParameterRange> {
        child(&self.0)
    }
}

impl VariableDeclaration {
    /// The values that it may have, if that is written.
    #[must_use]
    pub fn range(&self) -> Option<ParameterRange> {
        child(&self.0)
    }

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

impl FunctionDeclaration {
    /// Its parameters.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> + use<> {
        child::<ParameterList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }

    /// The type of its result.
    #[must_use]
    pub fn result(&self) -> Option<Type> {
        child(&self.0)
    }

    /// Its statements, unless it is written with `=` and a value.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl InitDeclaration {
    /// Its statements.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl ActionDeclaration {
    /// Its guard, if it has one.
    #[must_use]
    pub fn pre(&self) -> Option<PreClause> {
        child(&child::<ActionBody>(&self.0)?.0)
    }

    /// How often it fires at most, if that is written.
    #[must_use]
    pub fn every(&self) -> Option<Expression> {
        child(&child::<EveryClause>(&child::<ActionBody>(&self.0)?.0)?.0)
    }

    /// Its effect.
    #[must_use]
    pub fn eff(&self) -> Option<EffClause> {
        child(&child::<ActionBody>(&self.0)?.0)
    }
}

impl PreClause {
    /// The condition.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// For how long the condition has to hold, if that is written.
    #[must_use]
    pub fn hold(&self) -> Option<Expression> {
        after(&token(&self.0, SyntaxKind::ForKeyword)?)
    }
}

impl EffClause {
    /// The statements.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
    }
}

impl HandlerDeclaration {
    /// The name of the input that it handles, if it is one.
    #[must_use]
    pub fn input(&self) -> Option<Name> {
        child(&self.0)
    }

    /// The fields of the input.
    pub fn fields(&self) -> impl Iterator<Item = Parameter> + use<> {
        child::<ParameterList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }

    /// The message or the primitive's event that it handles; none for an input.
    #[must_use]
    pub fn event(&self) -> Option<EventPath> {
        child(&self.0)
    }

    /// The names for the sender and the fields, or for what the event carries.
    pub fn parameters(&self) -> impl Iterator<Item = Name> + use<> {
        child::<HandlerParameterList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }

    /// Its statements.
    #[must_use]
    pub fn body(&self) -> Option<Block> {
        child(&self.0)
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

impl CheckDeclaration {
    /// The condition.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        child(&self.0)
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
        tokens(&self.0)
            .next()
            .map(|token| token.text().into())
            .unwrap_or_default()
    }

    /// The condition; with [`Self::consequence`], the cause.
    #[must_use]
    pub fn condition(&self) -> Option<Expression> {
        child(&self.0)
    }

    /// The condition after `leads_to`, if any.
    #[must_use]
    pub fn consequence(&self) -> Option<Expression> {
        after(&word(&self.0, "leads_to")?)
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

    /// How long it may be false after a fault has overwritten variables, if `recovers within` is written.
    #[must_use]
    pub fn recovery(&self) -> Option<Expression> {
        after(&word(&self.0, "recovers")?)
    }

    /// The condition after `assuming`, if any.
    #[must_use]
    pub fn assumption(&self) -> Option<Expression> {
        after(&word(&self.0, "assuming")?)
    }

    /// Whether robots that are down count too.
    #[must_use]
    pub fn is_despite_crashes(&self) -> bool {
        word(&self.0, "despite").is_some()
    }
}
