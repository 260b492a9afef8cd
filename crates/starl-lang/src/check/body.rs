//! The body that is being checked: its locals, its scopes, and the allowed purity.

use alloc::string::String;
use alloc::vec::Vec;

use super::Purity;
use crate::diagnostic::{Code, Span};
use crate::ir::{Local, LocalId, SharedId, Type, VariableId};

/// The kind of body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Where {
    /// The value of a constant or the default of a parameter.
    #[default]
    Constant,
    /// The first value of a variable; those from this one on have none yet.
    Initial(VariableId),
    /// The arguments of a primitive's constructor.
    Binding,
    Function,
    Guard,
    /// `init`, an effect or a handler.
    Effect,
    Property,
}

impl Where {
    /// Whether code of this purity is allowed in it.
    pub fn allows(self, purity: Purity) -> bool {
        match self {
            Self::Constant | Self::Function | Self::Binding => purity == Purity::Pure,
            Self::Initial(_) | Self::Guard => purity <= Purity::Query,
            Self::Property => purity <= Purity::Query || purity == Purity::Property,
            Self::Effect => purity <= Purity::Effect,
        }
    }

    /// The phrase for messages.
    pub fn what(self) -> &'static str {
        match self {
            Self::Constant => "a constant",
            Self::Initial(_) => "the first value of a variable",
            Self::Binding => "an argument of a primitive",
            Self::Function => "a function",
            Self::Guard => "a guard",
            Self::Effect => "an effect",
            Self::Property => "a property",
        }
    }
}

/// Whether a local is read, and what is said if it is not.
struct Unread {
    warning: Option<Code>,
    is_read: bool,
}

/// A body.
#[derive(Default)]
pub(super) struct Body {
    pub place: Where,
    pub locals: Vec<Local>,
    /// For each local its dimension, if that is known.
    pub dimensions: Vec<Option<Dimension>>,
    /// For each local whether it is read.
    unread: Vec<Unread>,
    /// The locals that cannot be assigned to, with the phrase for messages.
    pub fixed: Vec<Option<&'static str>>,
    /// For each local that is a part of another one: that, a tuple, and the number of the part.
    parts: Vec<Option<(LocalId, u32)>>,
    /// The locals that can be seen, the innermost last.
    pub names: Vec<(String, LocalId)>,
    /// The type of the result of a function.
    pub result: Option<Type>,
    /// In a property about each robot by itself: the robot.
    pub robot: Option<LocalId>,
    /// The shared variables that were touched, in order, and where.
    pub touched: Vec<(SharedId, Span)>,
    /// Whether it belongs to an action, which can wait.
    pub is_action: bool,
    /// Whether there is an `atomic` in it.
    pub is_atomic: bool,
    /// The words of the `atomic` blocks that touch nothing that all robots write.
    pub idle_atomics: Vec<Span>,
    /// Whether another `atomic` block touches such a variable.
    pub has_busy_atomic: bool,
}

impl Body {
    pub fn new(place: Where) -> Self {
        Self {
            place,
            ..Self::default()
        }
    }

    /// The local of this name.
    pub fn find(&self, name: &str) -> Option<LocalId> {
        let found = self.names.iter().rev().find(|(local, _)| local == name)?;
        Some(found.1)
    }

    /// Adds a local; `unread` is the warning if nothing reads it.
    pub fn add(&mut self, name: String, ty: Type, span: Span, unread: Option<Code>) -> LocalId {
        let id = LocalId(self.locals.len() as u32);
        self.names.push((name.clone(), id));
        self.locals.push(Local { name, ty, span });
        self.unread.push(Unread {
            warning: unread,
            is_read: false,
        });
        self.fixed.push(None);
        self.dimensions.push(None);
        self.parts.push(None);
        id
    }

    /// Adds a local without a name, a tuple whose parts have names.
    pub fn add_whole(&mut self, ty: Type, span: Span) -> LocalId {
        let id = self.add(String::new(), ty, span, None);
        self.names.pop();
        id
    }

    /// Makes a local a part of another one.
    pub fn set_part(&mut self, local: LocalId, whole: LocalId, part: u32) {
        self.parts[local.index()] = Some((whole, part));
    }

    /// The tuple that the local is a part of, with the number of the part.
    pub fn part(&self, local: LocalId) -> Option<(LocalId, u32)> {
        self.parts[local.index()]
    }

    /// Notes that a local is read.
    pub fn read(&mut self, local: LocalId) {
        self.unread[local.index()].is_read = true;
    }

    /// Whether a local is known to be read.
    pub fn is_read(&self, local: LocalId) -> bool {
        self.unread[local.index()].is_read
    }

    /// Takes back that a local is read.
    pub fn forget_read(&mut self, local: LocalId) {
        self.unread[local.index()].is_read = false;
    }

    /// The innermost robot variable that a quantifier of a property binds. Variables of comprehensions and of `some`
    /// are not counted.
    pub fn quantified(&self) -> Option<LocalId> {
        let mut names = self.names.iter().rev().map(|(_, local)| *local);
        names.find(|local| {
            self.fixed[local.index()].is_none() && self.locals[local.index()].ty == Type::Robot
        })
    }

    /// Where the present scope begins, to be given to [`Self::leave`].
    pub fn enter(&self) -> usize {
        self.names.len()
    }

    /// Forgets the names since [`Self::enter`].
    pub fn leave(&mut self, mark: usize) {
        self.names.truncate(mark);
    }

    /// The locals that nothing reads.
    pub fn unread(&self) -> impl Iterator<Item = (Code, &Local)> {
        let pairs = self.unread.iter().zip(&self.locals);
        let unread = pairs.filter(|(unread, _)| !unread.is_read);
        unread.filter_map(|(unread, local)| Some((unread.warning?, local)))
    }
}

/// A dimension of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dimension {
    /// Metres.
    Length,
    /// Radians.
    Angle,
}

impl Dimension {
    pub fn text(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Angle => "angle",
        }
    }

    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Angle => "rad",
        }
    }
}
