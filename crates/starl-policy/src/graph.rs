//! From the graph of an ONNX file to operations in order. Meanings of operators: the ONNX operator reference, opset 7 and later.

use crate::constant::Constant;
use crate::error::ModelError;
use crate::network::Network;
use crate::operation::{Binary, Operand, Operation, Place};
use crate::proto::{self, Node};
use alloc::{borrow::ToOwned, collections::BTreeMap, string::String, vec, vec::Vec};
use prost::Message;

const LARGEST_VALUE: usize = 1_000_000;
const LARGEST_NETWORK: usize = 16_000_000;
/// Before, operands of different shapes met by rules of their own.
const OLDEST_OPERATORS: i64 = 7;
/// ONNX's number for 32-bit floats.
const FLOAT: i64 = 1;

impl Network {
    /// Reads an ONNX file. Several inputs are joined in the order of the file, and so are outputs.
    ///
    /// # Errors
    /// The file is not an ONNX file, or uses unsupported features.
    pub fn read(bytes: &[u8]) -> Result<Self, ModelError> {
        read(bytes)
    }
}

fn read(bytes: &[u8]) -> Result<Network, ModelError> {
    let model = proto::Model::decode(bytes).map_err(|_| ModelError::NotOnnx)?;
    let own = model
        .operator_sets
        .iter()
        .find(|set| matches!(set.domain.as_str(), "" | "ai.onnx"));
    let (Some(graph), Some(set)) = (&model.graph, own) else {
        return Err(ModelError::NotOnnx);
    };
    if set.version < OLDEST_OPERATORS {
        return Err(ModelError::Version { found: set.version });
    }
    let mut builder = Builder::default();
    for tensor in &graph.constants {
        builder.values.insert(
            tensor.name.clone(),
            Value::Constant(Constant::read(tensor)?),
        );
    }
    for input in &graph.inputs {
        // Old files name constants among the inputs, too.
        if !builder.values.contains_key(&input.name) {
            builder.reserve(&input.name, sample_size(input)?)?;
        }
    }
    let inputs = builder.size;
    for node in &graph.nodes {
        builder.node(node)?;
    }
    let output = |output: &proto::Value| match builder.value(&output.name)? {
        Value::Computed(place) => Ok(place.clone()),
        Value::Constant(_) => Err(ModelError::Missing {
            value: output.name.clone(),
        }),
    };
    let outputs = graph
        .outputs
        .iter()
        .map(output)
        .collect::<Result<Vec<_>, _>>()?;
    if inputs == 0 || outputs.is_empty() {
        return Err(ModelError::Empty);
    }
    Ok(Network {
        size: builder.size,
        inputs,
        steps: builder.steps,
        outputs,
    })
}

/// How many numbers one sample of an input has: N of `[1, N]`, `[batch, N]` or `[N]`.
fn sample_size(input: &proto::Value) -> Result<usize, ModelError> {
    let tensor = input.kind.as_ref().and_then(|kind| kind.tensor.as_ref());
    let shape = tensor.and_then(|tensor| tensor.shape.as_ref());
    let size = shape.and_then(|shape| match &shape.dimensions[..] {
        [size] => size.size,
        [batch, size] if batch.size.is_none_or(|size| size == 1) => size.size,
        _ => None,
    });
    let size = size
        .and_then(|size| usize::try_from(size).ok())
        .filter(|&size| size > 0);
    size.ok_or_else(|| ModelError::Shape {
        value: input.name.clone(),
    })
}

/// A value of the graph: known when the file is read, or computed. A computed value is one row of numbers.
#[derive(Clone)]
enum Value {
    Constant(Constant),
    Computed(Place),
}

#[derive(Default)]
struct Builder {
    values: BTreeMap<String, Value>,
    size: usize,
    steps: Vec<(Place, Operation)>,
}

impl Builder {
    fn reserve(&mut self, name: &str, size: usize) -> Result<Place, ModelError> {
        if size > LARGEST_VALUE || self.size + size > LARGEST_NETWORK {
            return Err(ModelError::TooLarge);
        }
        let place = self.size..self.size + size;
        self.size += size;
        self.values
            .insert(name.to_owned(), Value::Computed(place.clone()));
        Ok(place)
    }

    fn push(
        &mut self,
        output: &str,
        size: usize,
        operation: Operation,
    ) -> Result<Place, ModelError> {
        let to = self.reserve(output, size)?;
        self.steps.push((to.clone(), operation));
        Ok(to)
    }

    fn value(&self, name: &str) -> Result<&Value, ModelError> {
        self.values.get(name).ok_or_else(|| ModelError::Missing {
            value: name.to_owned(),
        })
    }

    fn computed(&self, node: &Node, index: usize) -> Result<Place, ModelError> {
        match self.value(node.input(index)?)? {
            Value::Computed(place) => Ok(place.clone()),
            Value::Constant(_) => {
                Err(node.unsupported("its operand is a constant; export with constants folded"))
            }
        }
    }

    fn node(&mut self, node: &Node) -> Result<(), ModelError> {
        let output = node
            .outputs
            .first()
            .ok_or_else(|| node.unsupported("it has no output"))?;
        if !matches!(node.domain.as_str(), "" | "ai.onnx") {
            return Err(node.unknown());
        }
        match node.operator.as_str() {
            "Constant" => self.keep(output, Value::Constant(node.constant()?)),
            "Identity" | "Dropout" | "Squeeze" => {
                self.keep(output, self.value(node.input(0)?)?.clone())
            }
            "Flatten" => {
                node.check_axis(1)?;
                self.keep(output, self.value(node.input(0)?)?.clone());
            }
            "Cast" if node.int("to", 0) != FLOAT => {
                return Err(node.unsupported("numbers can be cast to float32 alone"));
            }
            "Cast" => self.keep(output, self.value(node.input(0)?)?.clone()),
            "Reshape" => self.reshape(node, output)?,
            "Transpose" => match self.value(node.input(0)?)? {
                Value::Constant(constant) if let Some(turned) = constant.transposed() => {
                    self.keep(output, Value::Constant(turned));
                }
                _ => return Err(node.unsupported("only constant matrices can be transposed")),
            },
            "Gemm" => self.dense(node, output)?,
            "MatMul" => self.dense(node, output)?,
            "Clip" => self.clip(node, output)?,
            "Softmax" => {
                node.check_axis(-1)?;
                let from = self.computed(node, 0)?;
                self.push(output, from.len(), Operation::Softmax { from })?;
            }
            "ArgMax" => {
                node.check_axis(0)?;
                if node.int("select_last_index", 0) != 0 {
                    return Err(node.unsupported("`select_last_index` has to be 0"));
                }
                let from = self.computed(node, 0)?;
                self.push(output, 1, Operation::ArgMax { from })?;
            }
            "Concat" => {
                node.check_axis(0)?;
                let from = (0..node.inputs.len())
                    .map(|index| self.computed(node, index))
                    .collect::<Result<Vec<_>, _>>()?;
                let size = from.iter().map(Place::len).fold(0, usize::saturating_add);
                self.push(output, size, Operation::Concat { from })?;
            }
            "Add" => self.binary(node, output, Binary::Add)?,
            "Sub" => self.binary(node, output, Binary::Subtract)?,
            "Mul" => self.binary(node, output, Binary::Multiply)?,
            "Div" => self.binary(node, output, Binary::Divide)?,
            "Max" => self.binary(node, output, Binary::Maximum)?,
            "Min" => self.binary(node, output, Binary::Minimum)?,
            _ => {
                let function = node.unary().ok_or_else(|| node.unknown())?;
                let from = self.computed(node, 0)?;
                self.push(output, from.len(), Operation::Unary { from, function })?;
            }
        }
        Ok(())
    }

    fn keep(&mut self, name: &str, value: Value) {
        self.values.insert(name.to_owned(), value);
    }

    /// The new shape has to be one row again.
    fn reshape(&mut self, node: &Node, output: &str) -> Result<(), ModelError> {
        let from = self.computed(node, 0)?;
        let row = match self.value(node.input(1)?)? {
            Value::Constant(shape) => match &shape.numbers[..] {
                [others @ .., last] => {
                    others.iter().all(|&size| [-1.0, 0.0, 1.0].contains(&size))
                        && [-1.0, from.len() as f32].contains(last)
                }
                [] => false,
            },
            Value::Computed(_) => false,
        };
        if !row {
            return Err(node.unsupported("the new shape has to be [1, N] or [-1, N]"));
        }
        self.keep(output, Value::Computed(from));
        Ok(())
    }

    /// `Gemm`, and `MatMul`, which has none of its attributes.
    fn dense(&mut self, node: &Node, output: &str) -> Result<(), ModelError> {
        let from = self.computed(node, 0)?;
        if node.int("transA", 0) != 0 {
            return Err(node.unsupported("`transA` has to be 0"));
        }
        let (alpha, beta) = (node.float("alpha", 1.0), node.float("beta", 1.0));
        let weights = match self.value(node.input(1)?)? {
            Value::Constant(constant) if node.int("transB", 0) != 0 => constant.transposed(),
            Value::Constant(constant) => Some(constant.clone()),
            Value::Computed(_) => None,
        };
        let shape = weights.as_ref().and_then(Constant::matrix);
        let (Some(mut weights), Some((rows, columns))) = (weights, shape) else {
            return Err(node.unsupported("the second operand has to be a constant matrix"));
        };
        if rows != from.len() || columns == 0 {
            return Err(node.unsupported("the matrix does not fit the number of values before it"));
        }
        weights
            .numbers
            .iter_mut()
            .for_each(|weight| *weight *= alpha);
        let bias = match node.optional(2).map(|name| self.value(name)).transpose()? {
            None => vec![0.0; columns],
            Some(Value::Constant(bias)) if bias.is_row(columns) => {
                bias.numbers.iter().map(|number| number * beta).collect()
            }
            Some(Value::Constant(bias)) if bias.is_row(1) => vec![bias.numbers[0] * beta; columns],
            Some(_) => {
                return Err(node.unsupported("the bias has to be a constant that fits the matrix"));
            }
        };
        self.push(
            output,
            columns,
            Operation::Dense {
                from,
                weights: weights.numbers,
                bias,
            },
        )?;
        Ok(())
    }

    fn binary(&mut self, node: &Node, output: &str, function: Binary) -> Result<(), ModelError> {
        if node.inputs.len() != 2 {
            return Err(node.unsupported("it has to have two operands"));
        }
        let (from, other, swapped) =
            match (self.value(node.input(0)?)?, self.value(node.input(1)?)?) {
                (Value::Computed(from), other) => (from.clone(), other, false),
                (other, Value::Computed(from)) => (from.clone(), other, true),
                _ => {
                    return Err(node
                        .unsupported("its operands are constants; export with constants folded"));
                }
            };
        let operand = match other {
            Value::Computed(other) if other.len() == from.len() => Operand::Value(other.clone()),
            Value::Constant(constant) if constant.is_row(1) => {
                Operand::Constant(constant.numbers[0])
            }
            Value::Constant(constant) if constant.is_row(from.len()) => {
                Operand::Constants(constant.numbers.clone())
            }
            _ => return Err(node.unsupported("its operands have different lengths")),
        };
        self.push(
            output,
            from.len(),
            Operation::Binary {
                from,
                operand,
                function,
                swapped,
            },
        )?;
        Ok(())
    }

    /// Limits are operands since opset 11, attributes before.
    fn clip(&mut self, node: &Node, output: &str) -> Result<(), ModelError> {
        let mut place = self.computed(node, 0)?;
        for (index, attribute, function) in
            [(1, "min", Binary::Maximum), (2, "max", Binary::Minimum)]
        {
            let limit = match node
                .optional(index)
                .map(|name| self.value(name))
                .transpose()?
            {
                None => node
                    .attribute(attribute)
                    .and_then(|attribute| attribute.float),
                Some(Value::Constant(limit)) if limit.is_row(1) => Some(limit.numbers[0]),
                Some(_) => return Err(node.unsupported("its limits have to be constant numbers")),
            };
            if let Some(limit) = limit {
                let (from, operand) = (place.clone(), Operand::Constant(limit));
                place = self.push(
                    output,
                    from.len(),
                    Operation::Binary {
                        from,
                        operand,
                        function,
                        swapped: false,
                    },
                )?;
            }
        }
        self.keep(output, Value::Computed(place));
        Ok(())
    }
}
