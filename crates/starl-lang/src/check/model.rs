//! Models: the files that primitives name are there, are networks, and get as many numbers as they take.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::Libraries;
use super::report::counted;
use super::state::{Checker, Evaluation};
use super::tables::{Shape, Signature};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BindingId, Expression, ExpressionKind, Model, Operator};
use starl_policy::Network;

impl Checker {
    /// Notes what a primitive with a model is asked.
    pub fn note_evaluation(&mut self, binding: BindingId, arguments: &[Option<Expression>]) {
        if self.model_of(binding).is_none() {
            return;
        }
        let [Some(list)] = arguments else { return };
        if let Some(numbers) = length(list) {
            self.evaluations.push(Evaluation {
                binding,
                numbers,
                span: list.span,
            });
        }
    }

    /// The place of the model among the parameters of a primitive that has one.
    fn model_of(&self, binding: BindingId) -> Option<usize> {
        let primitive = self.program[binding].primitive?;
        let signature = Signature::read(primitive.constructor);
        let mut parameters = signature.parameters.iter();
        parameters.position(|parameter| parameter.shape == Shape::Model)
    }

    /// Reads the models of all bindings.
    pub fn check_models(&mut self, libraries: &dyn Libraries) {
        self.file = 0;
        for number in 0..self.program.bindings.len() {
            let id = BindingId(number as u32);
            let Some(place) = self.model_of(id) else {
                continue;
            };
            let argument = self.program[id].arguments.get(place);
            let Some(Some(argument)) = argument else {
                continue;
            };
            let span = argument.span;
            let path = match &argument.kind {
                ExpressionKind::String(path) => path.clone(),
                ExpressionKind::Error => continue,
                _ => {
                    let message = "the path of a model is a text in quotes";
                    let problem = Diagnostic::new(Code::UnusableModel, span, message);
                    let note =
                        "the file is read before the program runs, as in `Policy(\"model.onnx\")`";
                    self.report(problem.note(note));
                    continue;
                }
            };
            match self.read_model(&path, libraries) {
                Ok(network) => self.check_evaluations(id, &path, &network),
                Err((message, note)) => {
                    let problem = Diagnostic::new(Code::UnusableModel, span, message);
                    self.report(problem.note(note));
                }
            }
        }
    }

    /// Reads a model and keeps it. An error has a message, and a fix.
    fn read_model(
        &mut self,
        path: &str,
        libraries: &dyn Libraries,
    ) -> Result<Network, (String, String)> {
        let bytes = libraries.model(path).map_err(|reason| {
            let message = format!("the model `{path}` cannot be read: {reason}");
            (message, format!("`{path}` is looked for beside this file"))
        })?;
        let network = Network::read(&bytes).map_err(|error| {
            let message = format!("the model `{path}` cannot be evaluated");
            (message, error.to_string())
        })?;
        let models = &mut self.program.models;
        if models.iter().all(|model| model.path != path) {
            let path = path.into();
            models.push(Model { path, bytes });
        }
        Ok(network)
    }

    /// Reports where a model is asked about too few or too many numbers.
    fn check_evaluations(&mut self, id: BindingId, path: &str, network: &Network) {
        let takes = network.inputs();
        let evaluations = self.evaluations.iter();
        let wrong: Vec<(Span, usize)> = evaluations
            .filter(|evaluation| evaluation.binding == id && evaluation.numbers != takes)
            .map(|evaluation| (evaluation.span, evaluation.numbers))
            .collect();
        for (span, given) in wrong {
            let message = format!("`{path}` takes {}, not {given}", counted(takes, "number"));
            let problem = Diagnostic::new(Code::UnusableModel, span, message);
            let note = "give the numbers that it was trained with, in their order";
            self.report(problem.note(note));
        }
    }
}

/// How many elements a list has, if its text says so.
fn length(list: &Expression) -> Option<usize> {
    match &list.kind {
        ExpressionKind::List(elements) => Some(elements.len()),
        ExpressionKind::Binary {
            operator: Operator::Add,
            left,
            right,
        } => Some(length(left)? + length(right)?),
        _ => None,
    }
}
