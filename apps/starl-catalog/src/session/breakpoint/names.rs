//! The names that breakpoints may use, so that one that could never be met is refused.

use super::Refused;
use crate::Application;
use starl_lang::machine::Origin;
use starl_sim::read::suggest;
use std::collections::BTreeSet;

/// The names that breakpoints may use.
pub struct Names<'a> {
    actions: BTreeSet<&'a str>,
    messages: BTreeSet<&'a str>,
    /// Programs in Rust do not say which actions they have.
    are_all_actions: bool,
}

impl<'a> Names<'a> {
    /// The names of an application's programs.
    pub fn of(application: &'a Application) -> Names<'a> {
        let bytecodes = application
            .programs
            .codes()
            .map(|code| code.program().bytecode());
        let bytecodes: Vec<_> = bytecodes.collect();
        let actions = bytecodes.iter().flat_map(|bytecode| &bytecode.actions);
        let handlers = bytecodes.iter().flat_map(|bytecode| &bytecode.handlers);
        let messages = handlers.filter(|handler| handler.origin == Origin::Message);
        let mut groups = application.scenario().fleet.groups.iter();
        Names {
            actions: actions.map(|action| &*action.name).collect(),
            messages: messages.map(|handler| &*handler.event).collect(),
            are_all_actions: groups.all(|group| group.program.ends_with(crate::language::SUFFIX)),
        }
    }

    /// Refuses an action that no program has.
    pub fn check_action(&self, name: &str) -> Result<(), Refused> {
        match !self.are_all_actions || self.actions.contains(name) {
            true => Ok(()),
            false => Err(unknown("action", name, &self.actions)),
        }
    }

    /// Refuses a message that no program handles.
    pub fn check_message(&self, name: &str) -> Result<(), Refused> {
        match self.messages.contains(name) {
            true => Ok(()),
            false => Err(unknown("handler of a message", name, &self.messages)),
        }
    }
}

fn unknown(what: &str, name: &str, known: &BTreeSet<&str>) -> Refused {
    let known: Vec<&str> = known.iter().copied().collect();
    let help = suggest::help(name, &known, "there are").map(|help| format!("; {help}"));
    let help = help.unwrap_or_default();
    format!("no program of the scenario has the {what} {name:?}{help}").into()
}
