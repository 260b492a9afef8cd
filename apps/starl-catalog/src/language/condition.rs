//! Conditions over the robots that run a program, asked of a running simulation.

use super::members;
use super::monitor::Members;
use super::source::Compiled;
use starl_core::RobotId;
use starl_lang::compile::with_condition;
use starl_lang::diagnostic::{Code as Number, Diagnostic, Span};
use starl_lang::machine::Fault;
use starl_lang::robot::Code;
use starl_lang::robot::properties::Condition;
use starl_sim::Simulation;

/// The code of a program whose only property is that a condition becomes true.
pub(super) fn code_with(compiled: &Compiled, condition: &str) -> Result<Code, Vec<Diagnostic>> {
    let bytecode = with_condition(&compiled.text, condition, compiled)?;
    Code::load(bytecode).map_err(|error| refusal(condition, &error.to_string()))
}

fn refusal(condition: &str, message: &str) -> Vec<Diagnostic> {
    let whole = Span::new(0, condition.len() as u32);
    Vec::from([Diagnostic::new(Number::TooMuch, whole, message.to_string())])
}

/// A condition over the robots that run one program.
#[derive(Clone)]
pub struct FleetCondition {
    /// The path of the program.
    program: String,
    condition: Condition,
}

impl FleetCondition {
    pub(super) fn new(
        path: &str,
        compiled: &Compiled,
        condition: &str,
    ) -> Result<FleetCondition, Vec<Diagnostic>> {
        let code = code_with(compiled, condition)?;
        let made =
            Condition::new(&code).ok_or_else(|| refusal(condition, "it is not a condition"))?;
        Ok(FleetCondition {
            program: path.to_string(),
            condition: made,
        })
    }

    /// Whether it is true now: see [`Condition::ask`]. It does not change the simulation.
    pub fn ask(&mut self, simulation: &Simulation) -> Vec<(Option<RobotId>, Result<bool, Fault>)> {
        let robots = members(&simulation.scenario().fleet, &self.program);
        let members = Members {
            witness: simulation,
            robots: &robots,
        };
        self.condition.ask(simulation.now(), &members)
    }
}
