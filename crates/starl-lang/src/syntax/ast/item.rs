//! The parts of a file.

use alloc::string::String;
use alloc::vec::Vec;

use super::super::{SyntaxKind, SyntaxNode, SyntaxToken};
use super::node::{child, choice};
use super::{
    ActionDeclaration, AstNode, BindingDeclaration, CheckDeclaration, ConstantDeclaration,
    EnumDeclaration, Field, FunctionDeclaration, HandlerDeclaration, Import, InitDeclaration,
    LetStatement, LibraryHeader, MessageDeclaration, Name, Parameter, ParameterDeclaration,
    ProgramHeader, PropertyDeclaration, RecordDeclaration, RoleDeclaration, SharedDeclaration,
    SomeExpression, VariableDeclaration,
};

choice! {
    /// A declaration.
    Item {
        /// `program Name`
        Program(ProgramHeader),
        /// `library Name`
        Library(LibraryHeader),
        /// `import name`
        Import(Import),
        /// `enum Name {a, b}`
        Enum(EnumDeclaration),
        /// `record Name {x: Int}`
        Record(RecordDeclaration),
        /// `message Name(x: Int)`
        Message(MessageDeclaration),
        /// `param name: Type = default`
        Parameter(ParameterDeclaration),
        /// `const name = value`
        Constant(ConstantDeclaration),
        /// `name: Type = value`
        Variable(VariableDeclaration),
        /// `allread name[RobotId]: Type` or `allwrite name: Type`
        Shared(SharedDeclaration),
        /// `name = Primitive(arguments)`
        Binding(BindingDeclaration),
        /// `function name(a: T) -> V`
        Function(FunctionDeclaration),
        /// `init`
        Init(InitDeclaration),
        /// `name()` with `pre` and `eff`
        Action(ActionDeclaration),
        /// `on Message(from, a)`
        Handler(HandlerDeclaration),
        /// `role name`
        Role(RoleDeclaration),
        /// `check condition`
        Check(CheckDeclaration),
        /// `invariant`, `always` or `eventually`
        Property(PropertyDeclaration),
    }
}

/// Something that gives a name.
pub trait Named: AstNode {
    /// The name, unless it is missing.
    fn name(&self) -> Option<Name> {
        child(self.syntax())
    }
}

macro_rules! named {
    ($($name:ident)+) => { $(impl Named for $name {})+ };
}

named! {
    ProgramHeader LibraryHeader Import EnumDeclaration RecordDeclaration MessageDeclaration
    ParameterDeclaration ConstantDeclaration VariableDeclaration SharedDeclaration BindingDeclaration
    FunctionDeclaration ActionDeclaration RoleDeclaration PropertyDeclaration Field Parameter
    LetStatement SomeExpression
}

/// Something that comments with three slashes above it may document.
pub trait Documented: AstNode {
    /// The comments above it, one per line, without the slashes; empty if there are none.
    fn documentation(&self) -> String {
        let lines: Vec<String> = comments(self.syntax())
            .map(|token| text_of(&token))
            .collect();
        lines.join("\n")
    }
}

impl Documented for Item {}
impl Documented for Field {}
impl Documented for Parameter {}

fn comments(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    let elements = node
        .descendants_with_tokens()
        .filter_map(rowan::NodeOrToken::into_token);
    let leading = elements.take_while(|token| token.kind().is_trivia());
    leading.filter(|token| token.kind() == SyntaxKind::DocComment)
}

fn text_of(token: &SyntaxToken) -> String {
    let text = token.text().trim_start_matches('/').trim_end();
    text.strip_prefix(' ').unwrap_or(text).into()
}
