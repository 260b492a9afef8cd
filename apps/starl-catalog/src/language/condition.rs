//! Conditions over the robots that run a program, asked of a running simulation.

use super::members;
use super::monitor::Members;
use super::source::Compiled;
use starl_core::RobotId;
use starl_lang::compile::with_condition;
use starl_lang::diagnostic::{Code as Number, Diagnostic, Span};
use starl_lang::robot::Code;
use starl_lang::robot::properties::Condition;
use starl_sim::Simulation;

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
        let libraries = |name: &str| compiled.libraries.get(name).cloned();
        let bytecode = with_condition(&compiled.text, condition, &libraries)?;
        let code = Code::load(bytecode).map_err(|error| error.to_string());
        let made = code.and_then(|code| {
            let made = Condition::new(&code);
            made.ok_or_else(|| "it is no condition".to_string())
        });
        made.map(|condition| FleetCondition {
            program: path.to_string(),
            condition,
        })
        .map_err(|message| {
            let whole = Span::new(0, condition.len() as u32);
            Vec::from([Diagnostic::new(Number::TooMuch, whole, message)])
        })
    }

    /// Whether it is true now: see [`Condition::ask`]. It makes no difference to the simulation.
    pub fn ask(&mut self, simulation: &Simulation) -> Vec<(Option<RobotId>, Result<bool, String>)> {
        let robots = members(&simulation.scenario().fleet, &self.program);
        let members = Members {
            witness: simulation,
            robots: &robots,
        };
        self.condition.ask(simulation.now(), &members)
    }
}
