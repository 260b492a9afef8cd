//! Why a file is not a network that can be evaluated.

use alloc::string::String;
use thiserror::Error;

/// Why a model cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ModelError {
    /// The bytes are not a complete ONNX file.
    #[error("this is not an ONNX file, or it is cut off; export the network again")]
    NotOnnx,
    /// The file uses operators of a version before 7.
    #[error("the file uses version {found} of ONNX's operators; export it with opset 7 or later")]
    Version {
        /// The version it uses.
        found: i64,
    },
    /// A node has an operator that is not supported.
    #[error(
        "the operator `{operator}` of node `{node}` is not supported; use dense layers (Gemm, MatMul), activations, element-wise arithmetic, Concat, Softmax and ArgMax"
    )]
    Operator {
        /// The operator's name in ONNX, with its domain where that is not ONNX's own.
        operator: String,
        /// The node's name, or the name of its output.
        node: String,
    },
    /// A node uses a supported operator in a way that is not supported.
    #[error("`{operator}` of node `{node}`: {reason}")]
    Use {
        /// The operator's name in ONNX.
        operator: String,
        /// The node's name, or the name of its output.
        node: String,
        /// Says what is not supported, and what is.
        reason: &'static str,
    },
    /// A node takes a value, or the graph gives one, that nothing before it makes.
    #[error("no node before its use makes the value `{value}`")]
    Missing {
        /// The value's name.
        value: String,
    },
    /// An input or an output whose shape is unknown, or that is for more than one sample at a time.
    #[error(
        "the shape of `{value}` is not that of one sample; export it as [1, N], [batch, N] or [N] with a fixed N"
    )]
    Shape {
        /// The name of the input or output.
        value: String,
    },
    /// A constant's numbers are not 32- or 64-bit floats or 64-bit integers, are in another file, or do not fill its shape.
    #[error("the constant `{value}` cannot be read; export it as float32 numbers inside the file")]
    Constant {
        /// The constant's name.
        value: String,
    },
    /// The network has more than a million numbers in one layer or 16 million in all.
    #[error("the network is too large: a layer may have 1,000,000 values, all together 16,000,000")]
    TooLarge,
    /// The network has no input or no output.
    #[error("the network has no input or no output")]
    Empty,
}
