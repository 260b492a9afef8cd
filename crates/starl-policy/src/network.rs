//! A network that is ready to be evaluated.

use crate::operation::{Operation, Place};
use alloc::{vec, vec::Vec};
use core::fmt;

/// A trained network: a pure function from [`Network::inputs`] numbers to [`Network::outputs`] numbers.
#[derive(Clone)]
pub struct Network {
    /// How many numbers an evaluation holds; the inputs are the first of them.
    pub(crate) size: usize,
    pub(crate) inputs: usize,
    pub(crate) steps: Vec<(Place, Operation)>,
    pub(crate) outputs: Vec<Place>,
}

impl Network {
    /// How many numbers the network takes.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// How many numbers it gives.
    pub fn outputs(&self) -> usize {
        self.outputs.iter().map(Place::len).sum()
    }

    /// How many additions, multiplications and functions an evaluation takes, about.
    pub fn operations(&self) -> usize {
        let steps = self.steps.iter();
        steps.map(|(to, operation)| operation.cost(to.len())).sum()
    }

    /// Writes the outputs for `input` to `output`, replacing its content. Numbers are rounded to 32-bit floats before.
    /// An output that is not a number is [`f64::NAN`].
    ///
    /// # Panics
    /// If `input` does not have [`Network::inputs`] numbers.
    pub fn evaluate(&self, input: &[f64], output: &mut Vec<f64>) {
        assert_eq!(
            input.len(),
            self.inputs,
            "a network takes as many numbers as it has inputs"
        );
        let mut numbers = vec![0.0; self.size];
        for (number, &given) in numbers.iter_mut().zip(input) {
            *number = given as f32;
        }
        for (to, operation) in &self.steps {
            operation.run(&mut numbers, to);
        }
        output.clear();
        // The bits of what is not a number differ between processors.
        let one = |number: &f32| {
            if number.is_nan() {
                f64::NAN
            } else {
                f64::from(*number)
            }
        };
        output.extend(
            self.outputs
                .iter()
                .flat_map(|place| &numbers[place.clone()])
                .map(one),
        );
    }
}

impl fmt::Debug for Network {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Network({} -> {}, {} operations)",
            self.inputs,
            self.outputs(),
            self.steps.len()
        )
    }
}
