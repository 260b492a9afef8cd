//! Networks against what ONNX Runtime computes. `tests/models/make.py` makes the models and the expected numbers.

use starl_policy::{ModelError, Network};
use std::path::{Path, PathBuf};

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/models")
}

fn read(name: &str) -> Result<Network, ModelError> {
    Network::read(&std::fs::read(models().join(format!("{name}.onnx"))).unwrap())
}

fn evaluate(network: &Network, input: &[f64]) -> Vec<f64> {
    let mut output = Vec::new();
    network.evaluate(input, &mut output);
    output
}

#[test]
fn outputs_are_those_of_onnx_runtime() {
    let expected = include_str!("../models/expected.txt");
    let mut compared = 0;
    for line in expected.lines() {
        let (name, row) = line.split_once(": ").unwrap();
        let numbers = |text: &str| {
            text.split(' ')
                .map(|number| number.parse().unwrap())
                .collect::<Vec<f64>>()
        };
        let (input, output) = row.split_once(" -> ").unwrap();
        let (input, output) = (numbers(input), numbers(output));
        let network = read(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        let found = evaluate(&network, &input);
        assert_eq!(found.len(), output.len(), "{name}");
        for (index, (found, output)) in found.iter().zip(&output).enumerate() {
            let near = (found - output).abs() <= 2e-6 * (1.0 + output.abs());
            assert!(
                near,
                "{name}, output {index} for {input:?}: {found}, ONNX Runtime says {output}"
            );
            compared += 1;
        }
    }
    assert!(
        compared > 300,
        "{compared} numbers are too few for all models"
    );
}

#[test]
fn unsupported_operators_are_rejected_with_the_node_and_the_fix() {
    let messages = [
        (
            "operator",
            "the operator `LSTM` of node `memory` is not supported",
        ),
        (
            "domain",
            "the operator `com.example.Gelu` of node `y` is not supported",
        ),
        ("batch", "the shape of `x` is not that of one sample"),
        ("unknown_size", "the shape of `x` is not that of one sample"),
        ("image", "the shape of `x` is not that of one sample"),
        ("missing", "no node before its use makes the value `z`"),
        ("unfit", "`MatMul` of node `y`: the matrix does not fit"),
        (
            "broadcast",
            "`Add` of node `y`: its operands have different lengths",
        ),
        ("axis", "`Softmax` of node `y`: `axis` has to be -1 or 1"),
        (
            "reshape",
            "`Reshape` of node `y`: the new shape has to be [1, N]",
        ),
        (
            "whole_numbers",
            "`Cast` of node `y`: numbers can be cast to float32 alone",
        ),
        (
            "half",
            "the constant `c` cannot be read; export it as float32",
        ),
        (
            "elsewhere",
            "the constant `c` cannot be read; export it as float32 numbers inside the file",
        ),
        ("short", "the constant `c` cannot be read"),
        ("empty", "the network has no input or no output"),
        ("old", "the file uses version 6 of ONNX's operators"),
        ("doubling", "the network is too large"),
    ];
    for (name, message) in messages {
        let error = read(&format!("broken/{name}")).expect_err(name).to_string();
        assert!(error.starts_with(message), "{name}: {error}");
    }
}

#[test]
fn bytes_that_are_cut_off_or_changed_never_panic() {
    let bytes = std::fs::read(models().join("dense.onnx")).unwrap();
    let mut read = 0;
    for length in 0..bytes.len() {
        read += usize::from(Network::read(&bytes[..length]).is_ok());
    }
    assert_eq!(read, 0, "no part of a file is a network");
    for index in 0..bytes.len() {
        let mut changed = bytes.clone();
        for bit in [1, 16, 128] {
            changed[index] = bytes[index] ^ bit;
            if let Ok(network) = Network::read(&changed) {
                evaluate(&network, &vec![1.0; network.inputs()]);
            }
        }
    }
}

#[test]
fn numbers_without_bounds_give_no_panic_and_one_kind_of_nan() {
    for name in ["dense", "activations", "arithmetic", "best"] {
        let network = read(name).unwrap();
        for wild in [
            f64::NAN,
            -f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1e300,
            -1e300,
            0.0,
        ] {
            let output = evaluate(&network, &vec![wild; network.inputs()]);
            assert!(
                output
                    .iter()
                    .all(|number| !number.is_nan() || number.to_bits() == f64::NAN.to_bits()),
                "{name} of {wild}"
            );
        }
    }
}

/// These bits are the same in debug and release builds, natively and on WebAssembly, or runs cannot be repeated
/// elsewhere.
#[test]
fn a_sum_is_taken_in_the_order_of_the_inputs() {
    let network = read("dense").unwrap();
    let bits: Vec<u64> = evaluate(&network, &[0.1, -0.7, 1.3, 2.9])
        .iter()
        .map(|number| number.to_bits())
        .collect();
    assert_eq!(bits, [13828797221325242368, 4602374401554382848]);
}
