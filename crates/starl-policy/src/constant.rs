//! Tensors with constant numbers.

use crate::error::ModelError;
use crate::proto;
use alloc::vec::Vec;

/// Numbers of `data_type` in ONNX.
const FLOAT: i32 = 1;
const INT64: i32 = 7;
const DOUBLE: i32 = 11;

/// A tensor that is known when the file is read; numbers in row-major order.
#[derive(Clone)]
pub struct Constant {
    pub shape: Vec<usize>,
    pub numbers: Vec<f32>,
}

impl Constant {
    pub fn read(tensor: &proto::Tensor) -> Result<Self, ModelError> {
        let bad = || ModelError::Constant {
            value: tensor.name.clone(),
        };
        let shape: Vec<usize> = tensor
            .dimensions
            .iter()
            .map(|&size| usize::try_from(size).map_err(|_| bad()))
            .collect::<Result<_, _>>()?;
        let count = shape
            .iter()
            .try_fold(1_usize, |count, &size| count.checked_mul(size))
            .ok_or_else(bad)?;
        let numbers = numbers(tensor).ok_or_else(bad)?;
        if tensor.location != 0 || numbers.len() != count {
            return Err(bad());
        }
        Ok(Self { shape, numbers })
    }

    /// Whether the tensor is `length` numbers along its last dimension, so that it meets a row of numbers one by one.
    pub fn is_row(&self, length: usize) -> bool {
        let others = self
            .shape
            .split_last()
            .map_or(&[][..], |(_, others)| others);
        self.numbers.len() == length && others.iter().all(|&size| size == 1)
    }

    /// Rows and columns, where the tensor is a matrix.
    pub fn matrix(&self) -> Option<(usize, usize)> {
        match self.shape[..] {
            [rows, columns] => Some((rows, columns)),
            _ => None,
        }
    }

    /// The matrix with rows and columns exchanged.
    pub fn transposed(&self) -> Option<Self> {
        let (rows, columns) = self.matrix()?;
        let numbers = (0..columns)
            .flat_map(|column| (0..rows).map(move |row| row * columns + column))
            .map(|index| self.numbers[index])
            .collect();
        Some(Self {
            shape: [columns, rows].into(),
            numbers,
        })
    }
}

/// The numbers, rounded to 32-bit floats.
fn numbers(tensor: &proto::Tensor) -> Option<Vec<f32>> {
    let raw = &tensor.raw;
    let whole = |size: usize| raw.len().is_multiple_of(size).then_some(());
    Some(match (tensor.element, raw.is_empty()) {
        (FLOAT, true) => tensor.floats.clone(),
        (FLOAT, false) => {
            whole(4)?;
            raw.as_chunks()
                .0
                .iter()
                .map(|&bytes| f32::from_le_bytes(bytes))
                .collect()
        }
        (DOUBLE, true) => tensor.doubles.iter().map(|&number| number as f32).collect(),
        (DOUBLE, false) => {
            whole(8)?;
            raw.as_chunks()
                .0
                .iter()
                .map(|&bytes| f64::from_le_bytes(bytes) as f32)
                .collect()
        }
        (INT64, true) => tensor.ints.iter().map(|&number| number as f32).collect(),
        (INT64, false) => {
            whole(8)?;
            raw.as_chunks()
                .0
                .iter()
                .map(|&bytes| i64::from_le_bytes(bytes) as f32)
                .collect()
        }
        _ => return None,
    })
}
