//! The declarations of a program, except types.

use alloc::string::String;
use alloc::vec::Vec;

use super::{Expression, LocalId, RecordId, SharedId, Site, Statement, Type, VariableId};
use crate::check::{Event as EventSignature, Primitive};
use crate::diagnostic::Span;

/// `param name: Type in from..before = default`
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its value where the scenario gives none; none if the scenario must give it. It reads
    /// constants only.
    pub default: Option<Expression>,
    /// The least value that it may have, and the first beyond the greatest; none if it may have any.
    pub range: Option<[Expression; 2]>,
    /// Locals of the default and the range (of their comprehensions).
    pub locals: Vec<Local>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// `const name = value`
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its value, of constants and functions.
    pub value: Expression,
    /// Locals of the value (of its comprehensions).
    pub locals: Vec<Local>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// A state variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its first value; none for the type's default, which is all zeros and nothing. It may read the
    /// variables above it, parameters, constants and what queries give.
    pub initial: Option<Expression>,
    /// Locals of the initial value (of its comprehensions).
    pub locals: Vec<Local>,
    /// The role that it is declared in, by the role's variant: it gets its initial value again whenever the robot
    /// enters the role, as part of [`Role::entry`]. None outside of roles.
    pub role: Option<u16>,
    /// Whether it is saved if the robot has storage, and begins with the saved value.
    pub is_stable: bool,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// The consistency of a shared variable: the writes of others that a robot may see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Consistency {
    /// Each write some time.
    #[default]
    Eventual,
    /// No write before those that it may depend on.
    Causal,
    /// Each as if there were one variable, in actions with `atomic`.
    Linearizable,
}

impl Consistency {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Eventual, Self::Causal, Self::Linearizable];

    /// The word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Eventual => "eventual",
            Self::Causal => "causal",
            Self::Linearizable => "linearizable",
        }
    }
}

/// A shared variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Shared {
    /// Its name, which all robots know it by.
    pub name: String,
    /// Whether each robot writes an element of its own (`allread`), rather than all the one value.
    pub is_single_writer: bool,
    /// Its consistency.
    pub consistency: Consistency,
    /// The type of the value, or of an element.
    pub ty: Type,
    /// The value that all robots read before any was written; without it they read none.
    pub initial: Option<Expression>,
    /// Locals of the initial value (of its comprehensions).
    pub locals: Vec<Local>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// `name = Primitive(arguments)`
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Its name, by which the instances on different robots find each other.
    pub name: String,
    /// The kind of primitive; none if there is no such kind, which is an error.
    pub primitive: Option<&'static Primitive>,
    /// The arguments in the order of the constructor's parameters; none where one is left out. They
    /// are made of constants, parameters, `me` and `peers`.
    pub arguments: Vec<Option<Expression>>,
    /// Locals of the arguments (of their comprehensions).
    pub locals: Vec<Local>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// A model that a program uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Its path, as the program has it.
    pub path: String,
    /// The content of its file.
    pub bytes: Vec<u8>,
}

/// A local variable of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Local {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Where it is named.
    pub span: Span,
}

/// Statements that run as a unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Procedure {
    /// The local variables.
    pub locals: Vec<Local>,
    /// The statements.
    pub body: Vec<Statement>,
}

/// A function.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// How many parameters it has: its first locals.
    pub parameters: u32,
    /// The parameters, then the other local variables.
    pub locals: Vec<Local>,
    /// The type of its result.
    pub result: Type,
    /// The statements; every way through them returns.
    pub body: Vec<Statement>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// The roles of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Roles {
    /// The variable `role`, an enum of the roles. Its first value is the scenario's parameter `role`,
    /// else the first role.
    pub variable: VariableId,
    /// The roles, by their variants.
    pub roles: Vec<Role>,
}

/// A role.
#[derive(Clone, Debug, PartialEq)]
pub struct Role {
    /// Its name.
    pub name: String,
    /// Runs when a robot enters the role, also at the start after [`super::Program::init`]. The role's variables get
    /// their first values before ([`Variable::role`]).
    pub entry: Option<Procedure>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// An action.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Its name.
    pub name: String,
    /// The role whose robots do it, by its variant; the guard says so too.
    pub role: Option<u16>,
    /// The local variables of the guard and the effect.
    pub locals: Vec<Local>,
    /// When it may fire, a Bool; it has no side effects but to set the bindings.
    pub guard: Expression,
    /// The locals that the guard sets, if it holds, and the effect reads.
    pub bindings: Vec<LocalId>,
    /// For how long the guard has to have held, a Duration; none if the action fires at once.
    pub hold: Option<Expression>,
    /// The least time from one firing to the next, a Duration.
    pub every: Option<Expression>,
    /// The statements of the effect.
    pub effect: Vec<Statement>,
    /// The linearizable variables that it uses, in ascending order: with any, it waits until no other robot
    /// does.
    pub atomic: Vec<SharedId>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// A condition that the program's variables always satisfy, as long as no fault has overwritten them. Where it is false the
/// program starts again.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The local variables.
    pub locals: Vec<Local>,
    /// A Bool without side effects.
    pub condition: Expression,
    /// Where it is declared: the check, or the variable that has a range.
    pub site: Site,
}

/// A handler of a message, of a primitive's event or of an operator's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Handler {
    /// The event that it handles.
    pub event: Event,
    /// The role whose robots do it, by its variant; the body says so too.
    pub role: Option<u16>,
    /// The locals that get the sender and the fields, or what the event carries; none for `_`. Of what
    /// a primitive's event carries the last parts may be missing here. Of an input they are its fields.
    pub parameters: Vec<Option<LocalId>>,
    /// The local variables.
    pub locals: Vec<Local>,
    /// The statements of the handler.
    pub body: Vec<Statement>,
    /// Where it is declared: the name of the message, event or input.
    pub site: Site,
}

/// The event of a handler.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// One that is not known, which is an error.
    Error,
    /// A message; the handler's parameters are the sender, a robot, and the message's fields.
    Message(RecordId),
    /// An event of a primitive.
    Primitive {
        /// Which primitive.
        binding: super::BindingId,
        /// The event.
        event: &'static EventSignature,
    },
    /// An operator's order, or the notice that the waypoints have changed ([`starl_core::Order::WAY_POINTS`]).
    Input {
        /// Its name.
        name: String,
        /// The fields that the order must have, by name: [`crate::check::is_input_field`] says which types
        /// they may have. Handlers of one input have the same.
        fields: Vec<(String, Type)>,
    },
}

/// A property.
#[derive(Clone, Debug, PartialEq)]
pub struct Property {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// The locals, all RobotIds, for which it must be true each by itself: an `always` that begins
    /// with `forall`, or one robot for a property without quantifier. With none it is about the fleet.
    pub robots: Vec<LocalId>,
    /// The local variables.
    pub locals: Vec<Local>,
    /// The claim.
    pub claim: Claim,
    /// The assumption, under which the property is judged.
    pub assumption: Option<Expression>,
    /// How long it may be false after a fault has overwritten variables: a constant Duration.
    pub recovery: Option<Expression>,
    /// Whether robots that are down count too.
    pub is_despite_crashes: bool,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// The claim of a property; all expressions are conditions.
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// It is true at all times.
    Always(Expression),
    /// It is true at some time.
    Eventually {
        /// The condition.
        holds: Expression,
        /// When at the latest, since the start and since the last fault: a constant Duration.
        within: Option<Expression>,
    },
    /// It is true from some time on.
    EventuallyAlways {
        /// The condition.
        holds: Expression,
        /// From when on at the latest, since the start and since the last fault: a constant Duration.
        within: Option<Expression>,
    },
    /// Whenever the cause is true, the consequence is true at some time from then on.
    LeadsTo {
        /// The cause.
        cause: Expression,
        /// The consequence.
        consequence: Expression,
        /// How much later at the latest: a constant Duration.
        within: Option<Expression>,
    },
}
