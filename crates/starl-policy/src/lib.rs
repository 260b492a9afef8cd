//! Trained networks as functions from numbers to numbers.
//!
//! [`Network::read`] takes the bytes of an ONNX file and [`Network::evaluate`] computes its outputs. The result is the same, to
//! the last bit, on every target: numbers are 32-bit floats, each sum is taken in the order of its inputs, and transcendental
//! functions come from [`starl_core::math`]. Libraries for inference choose the order of their sums by the processor, so that a
//! run could not be repeated elsewhere.
//!
//! Networks are feed-forward and take one sample: dense layers, activations, element-wise arithmetic, concatenation,
//! softmax and arg max. Convolutions, recurrent layers and control flow are not supported.

#![no_std]
extern crate alloc;

mod constant;
mod error;
mod graph;
mod network;
mod node;
mod operation;
mod proto;

pub use error::ModelError;
pub use network::Network;
