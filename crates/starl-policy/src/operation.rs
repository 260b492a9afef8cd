//! The operations of a network, computed one after the other.

use alloc::vec::Vec;
use core::ops::Range;
use starl_core::math;

/// Where a value lies among the network's numbers.
pub type Place = Range<usize>;

/// A transcendental function takes as long as so many multiplications.
const TRANSCENDENTAL: usize = 16;

/// A function of one number.
#[derive(Clone, Copy, Debug)]
pub enum Unary {
    Abs,
    Elu(f32),
    Exp,
    LeakyRelu(f32),
    Log,
    Negate,
    Relu,
    Selu { alpha: f32, gamma: f32 },
    Sigmoid,
    Softplus,
    Sqrt,
    Tanh,
}

impl Unary {
    fn apply(self, x: f32) -> f32 {
        let exp = |x: f32| math::exp(f64::from(x)) as f32;
        match self {
            Self::Abs => x.abs(),
            Self::Elu(alpha) if x < 0.0 => alpha * (exp(x) - 1.0),
            Self::Exp => exp(x),
            Self::LeakyRelu(slope) if x < 0.0 => slope * x,
            Self::Log => math::log(f64::from(x)) as f32,
            Self::Negate => -x,
            // Not `max`: NaN stays NaN.
            Self::Relu if x < 0.0 => 0.0,
            Self::Selu { alpha, gamma } if x < 0.0 => gamma * (alpha * (exp(x) - 1.0)),
            Self::Selu { gamma, .. } => gamma * x,
            Self::Sigmoid => (1.0 / (1.0 + math::exp(-f64::from(x)))) as f32,
            // Beyond 30 the difference from `x` is less than a float shows.
            Self::Softplus if x > 30.0 => x,
            Self::Softplus => math::log(1.0 + math::exp(f64::from(x))) as f32,
            Self::Sqrt => math::sqrt(f64::from(x)) as f32,
            Self::Tanh => math::tanh(f64::from(x)) as f32,
            Self::Elu(_) | Self::LeakyRelu(_) | Self::Relu => x,
        }
    }
}

/// A function of two numbers.
#[derive(Clone, Copy, Debug)]
pub enum Binary {
    Add,
    Divide,
    Maximum,
    Minimum,
    Multiply,
    Subtract,
}

impl Binary {
    pub fn apply(self, x: f32, y: f32) -> f32 {
        match self {
            Self::Add => x + y,
            Self::Divide => x / y,
            Self::Maximum => {
                if x.is_nan() || x > y {
                    x
                } else {
                    y
                }
            }
            Self::Minimum => {
                if x.is_nan() || x < y {
                    x
                } else {
                    y
                }
            }
            Self::Multiply => x * y,
            Self::Subtract => x - y,
        }
    }
}

/// The second operand: another value, a list of constants of the same length, or one constant for all.
#[derive(Clone, Debug)]
pub enum Operand {
    Value(Place),
    Constants(Vec<f32>),
    Constant(f32),
}

#[derive(Clone, Debug)]
pub enum Operation {
    /// `to = bias + weights * from`; weights in the order of the inputs, all outputs of one input together.
    Dense {
        from: Place,
        weights: Vec<f32>,
        bias: Vec<f32>,
    },
    Unary {
        from: Place,
        function: Unary,
    },
    /// `swapped` puts the second operand first.
    Binary {
        from: Place,
        operand: Operand,
        function: Binary,
        swapped: bool,
    },
    Softmax {
        from: Place,
    },
    /// The index of the largest number, the first one where several are.
    ArgMax {
        from: Place,
    },
    Concat {
        from: Vec<Place>,
    },
}

impl Operation {
    /// The number of additions, multiplications and functions for this number of outputs.
    pub fn cost(&self, outputs: usize) -> usize {
        match self {
            Self::Dense { weights, .. } => weights.len(),
            Self::Unary { .. } | Self::Softmax { .. } => TRANSCENDENTAL * outputs,
            Self::ArgMax { from } => from.len(),
            Self::Binary { .. } | Self::Concat { .. } => outputs,
        }
    }

    /// Computes the values at `to` from those before.
    pub fn run(&self, numbers: &mut [f32], to: &Place) {
        let (before, after) = numbers.split_at_mut(to.start);
        let to = &mut after[..to.len()];
        match self {
            Self::Dense {
                from,
                weights,
                bias,
            } => {
                to.copy_from_slice(bias);
                for (x, row) in before[from.clone()]
                    .iter()
                    .zip(weights.chunks_exact(to.len()))
                {
                    for (sum, weight) in to.iter_mut().zip(row) {
                        *sum += x * weight;
                    }
                }
            }
            Self::Unary { from, function } => {
                for (y, x) in to.iter_mut().zip(&before[from.clone()]) {
                    *y = function.apply(*x);
                }
            }
            Self::Binary {
                from,
                operand,
                function,
                swapped,
            } => {
                for (index, (y, &x)) in to.iter_mut().zip(&before[from.clone()]).enumerate() {
                    let other = match operand {
                        Operand::Value(place) => before[place.start + index],
                        Operand::Constants(constants) => constants[index],
                        Operand::Constant(constant) => *constant,
                    };
                    *y = if *swapped {
                        function.apply(other, x)
                    } else {
                        function.apply(x, other)
                    };
                }
            }
            Self::Softmax { from } => softmax(&before[from.clone()], to),
            Self::ArgMax { from } => {
                let from = &before[from.clone()];
                let best = (1..from.len()).fold(0, |best, index| {
                    if from[index] > from[best] {
                        index
                    } else {
                        best
                    }
                });
                to[0] = best as f32;
            }
            Self::Concat { from } => {
                let values = from.iter().flat_map(|place| &before[place.clone()]);
                to.iter_mut().zip(values).for_each(|(y, x)| *y = *x);
            }
        }
    }
}

/// The largest is taken off first, so that nothing overflows.
fn softmax(from: &[f32], to: &mut [f32]) {
    let largest = from.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let mut sum = 0.0;
    for (y, x) in to.iter_mut().zip(from) {
        *y = math::exp(f64::from(x - largest)) as f32;
        sum += *y;
    }
    to.iter_mut().for_each(|y| *y /= sum);
}
