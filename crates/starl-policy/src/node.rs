//! One node of an ONNX graph, and errors about it.

use crate::constant::Constant;
use crate::error::ModelError;
use crate::operation::Unary;
use crate::proto::{Attribute, Node};
use alloc::{format, string::String, vec};

impl Node {
    fn label(&self) -> String {
        let own = (!self.name.is_empty()).then_some(&self.name);
        own.or(self.outputs.first()).cloned().unwrap_or_default()
    }

    /// The error that the operator is not known.
    pub fn unknown(&self) -> ModelError {
        let operator = match self.domain.as_str() {
            "" => self.operator.clone(),
            domain => format!("{domain}.{}", self.operator),
        };
        ModelError::Operator {
            operator,
            node: self.label(),
        }
    }

    /// The error that this use of a known operator is not supported.
    pub fn unsupported(&self, reason: &'static str) -> ModelError {
        ModelError::Use {
            operator: self.operator.clone(),
            node: self.label(),
            reason,
        }
    }

    /// The name of an operand that has to be there.
    pub fn input(&self, index: usize) -> Result<&str, ModelError> {
        self.optional(index)
            .ok_or_else(|| self.unsupported("an operand is missing"))
    }

    /// The name of an operand that may be left out; an empty name says so, too.
    pub fn optional(&self, index: usize) -> Option<&str> {
        self.inputs
            .get(index)
            .map(String::as_str)
            .filter(|name| !name.is_empty())
    }

    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes
            .iter()
            .find(|attribute| attribute.name == name)
    }

    pub fn float(&self, name: &str, default: f32) -> f32 {
        self.attribute(name)
            .and_then(|attribute| attribute.float)
            .unwrap_or(default)
    }

    pub fn int(&self, name: &str, default: i64) -> i64 {
        self.attribute(name)
            .and_then(|attribute| attribute.int)
            .unwrap_or(default)
    }

    /// Checks that the operator works along the last dimension of `[1, N]`.
    pub fn check_axis(&self, default: i64) -> Result<(), ModelError> {
        match self.int("axis", default) {
            -1 | 1 => Ok(()),
            _ => Err(self.unsupported("`axis` has to be -1 or 1")),
        }
    }

    /// The value of a node `Constant`.
    pub fn constant(&self) -> Result<Constant, ModelError> {
        let reason = "only tensors, floats and integers can be constants";
        let attribute = self
            .attributes
            .first()
            .ok_or_else(|| self.unsupported(reason))?;
        let list = |numbers: vec::Vec<f32>| Constant {
            shape: vec![numbers.len()],
            numbers,
        };
        let one = |number| Constant {
            shape: vec![],
            numbers: vec![number],
        };
        match attribute.name.as_str() {
            "value" => attribute
                .tensor
                .as_ref()
                .map(Constant::read)
                .unwrap_or_else(|| Err(self.unsupported(reason))),
            "value_float" => Ok(one(attribute.float.unwrap_or_default())),
            "value_floats" => Ok(list(attribute.floats.clone())),
            "value_int" => Ok(one(attribute.int.unwrap_or_default() as f32)),
            "value_ints" => Ok(list(attribute.ints.iter().map(|&int| int as f32).collect())),
            _ => Err(self.unsupported(reason)),
        }
    }

    /// The function of one number that the operator is, with ONNX's defaults.
    pub fn unary(&self) -> Option<Unary> {
        Some(match self.operator.as_str() {
            "Abs" => Unary::Abs,
            "Elu" => Unary::Elu(self.float("alpha", 1.0)),
            "Exp" => Unary::Exp,
            "LeakyRelu" => Unary::LeakyRelu(self.float("alpha", 0.01)),
            "Log" => Unary::Log,
            "Neg" => Unary::Negate,
            "Relu" => Unary::Relu,
            "Selu" => Unary::Selu {
                alpha: self.float("alpha", 1.673_263_2),
                gamma: self.float("gamma", 1.050_701),
            },
            "Sigmoid" => Unary::Sigmoid,
            "Softplus" => Unary::Softplus,
            "Sqrt" => Unary::Sqrt,
            "Tanh" => Unary::Tanh,
            _ => return None,
        })
    }
}
