//! The state machine that a program is: the values of its control variable, of an enum or a Bool, as states, and
//! its actions and handlers as edges between them.
//!
//! An edge from one state to another means that an action's guard can hold in the first and that a path through its
//! effect ends in the second. Any other condition than one on the control variable may be true or false. So no step
//! that a robot takes is missing, but some edges may never be taken. Only states that are reachable in this graph have
//! edges.

mod choose;
mod dot;
mod edges;
mod mermaid;

use starl_lang::ir::Program;
use std::collections::BTreeSet;
use std::fmt;

/// The state machine of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateMachine {
    /// The program's name.
    pub program: String,
    /// The control variable's name.
    pub variable: String,
    /// The values of the variable, in the order in which the enum declares them, or false and true.
    pub states: Vec<State>,
    /// The edges between states, by start, then end, then in the order of the program.
    pub edges: Vec<Edge>,
}

/// A value of the control variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct State {
    /// The value's name.
    pub name: String,
    /// Whether a robot may start in it.
    pub is_initial: bool,
    /// Whether a robot may reach it.
    pub is_reached: bool,
    /// Whether something leads out of it: into another state, or to the end of the program.
    pub is_left: bool,
}

/// A step that a robot may take.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// The number of the state in which it begins.
    pub from: usize,
    /// Where it leads.
    pub to: Target,
    /// The action or handler.
    pub cause: Cause,
}

/// Where an edge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// The state with this number.
    State(usize),
    /// A state that cannot be determined from the text.
    Unknown,
    /// The end of the program: `finish()`.
    End,
}

/// The cause of a robot's step.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cause {
    /// Whether it is a handler rather than an action.
    pub is_handler: bool,
    /// The role whose robots take it, if not all.
    pub role: Option<String>,
    /// The action's name, or that of the message or event.
    pub name: String,
}

/// The reason why there is no state machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// A library has no state.
    Library,
    /// No variable of the program is of an enum or a Bool.
    NoControlVariable,
    /// There is no such variable of this name.
    UnknownVariable {
        /// The name that was given.
        name: String,
        /// The variables that there are.
        others: Vec<String>,
    },
}

impl StateMachine {
    /// The state machine of a program without errors: of the variable with this name, or of the one
    /// that most of its guards name.
    pub fn of(program: &Program, variable: Option<&str>) -> Result<Self, Refusal> {
        if program.is_library {
            return Err(Refusal::Library);
        }
        let id = choose::variable(program, variable)?;
        let declared = &program[id];
        let names = program.values_of(id);
        let initial = edges::initial(program, id, names.len());
        let (reached, edges) = edges::reachable(program, id, &initial, names.len());
        let left: BTreeSet<usize> = (edges.iter())
            .filter(|edge| edge.to != Target::State(edge.from))
            .map(|edge| edge.from)
            .collect();
        let states = names.into_iter().enumerate().map(|(number, name)| State {
            name: name.into(),
            is_initial: initial.contains(&number),
            is_reached: reached.contains(&number),
            is_left: left.contains(&number),
        });
        Ok(Self {
            program: program.name.clone(),
            variable: declared.name.clone(),
            states: states.collect(),
            edges,
        })
    }

    /// The state machine as a Mermaid state diagram.
    #[must_use]
    pub fn mermaid(&self) -> String {
        mermaid::write(self)
    }

    /// The state machine as a graph for Graphviz, in its language DOT.
    #[must_use]
    pub fn dot(&self) -> String {
        dot::write(self)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(role) = &self.role {
            write!(formatter, "{role}: ")?;
        }
        if self.is_handler {
            formatter.write_str("on ")?;
        }
        formatter.write_str(&self.name)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Library => formatter.write_str("a library has no state machine"),
            Self::NoControlVariable => formatter.write_str(
                "the program has no variable of an enum type and no Bool, so there are no states to show",
            ),
            Self::UnknownVariable { name, others } => {
                write!(formatter, "there is no variable `{name}` of an enum type or of type Bool")?;
                match others.as_slice() {
                    [] => formatter.write_str("; the program has none"),
                    _ => write!(formatter, "; there are: {}", others.join(", ")),
                }
            }
        }
    }
}

impl std::error::Error for Refusal {}
