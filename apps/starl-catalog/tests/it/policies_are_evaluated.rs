//! A program evaluates the network of a file beside it: with the numbers of the network, the same from a trace, and
//! with errors that name the file.

use crate::support::memory::{Memory, application};
use starl_catalog::programs::Registry;
use starl_catalog::recording;
use starl_catalog::session::{Budget, Files, Options, Session};
use starl_core::{Event, Time, Value};
use starl_sim::Run;

/// Takes four numbers and gives two.
const DENSE: &[u8] = include_bytes!("../../../../crates/starl-policy/tests/models/dense.onnx");
/// An input and the output of ONNX Runtime (`crates/starl-policy/tests/models/expected.txt`).
const INPUT: &str =
    "0.09168480336666107, 0.06688984483480453, 0.011014859192073345, 0.021548893302679062";
const OUTPUT: [f64; 2] = [-1.5009338855743408, -0.16628362238407135];
const LSTM: &[u8] =
    include_bytes!("../../../../crates/starl-policy/tests/models/broken/operator.onnx");

const SCENARIO: &str = "program = \"lab/asks.starl\"\nduration = \"1s\"\n\
    [[robots]]\nmodel = \"create\"\nstart = [{ position = [0, 0] }]\n";

fn asks(input: &str) -> String {
    format!(
        "program Asks\n\npolicy = Policy(\"models/dense.onnx\")\n\nask()\n    eff\n        \
         let does = policy.evaluate({input})\n        emit(\"does\", first = does[0], second = does[1])\n"
    )
}

fn files(program: &str, model: &[u8]) -> Memory {
    Memory::of(&[
        ("lab/asks.starl", program.as_bytes()),
        ("lab/models/dense.onnx", model),
    ])
}

fn finished(mut run: Run) -> Run {
    while !run.is_over() {
        run.step();
    }
    run
}

/// The numbers that the program was given first.
fn first(mut run: Run) -> Vec<f64> {
    loop {
        assert!(
            run.simulation().now() < Time(900_000_000),
            "{:?}",
            run.failures()
        );
        let records = run.step().iter();
        let mut told = records.filter_map(|record| match &record.event {
            Event::Program { name, fields } if name == "does" => Some(fields.clone()),
            _ => None,
        });
        if let Some(fields) = told.next() {
            let numbers = fields.iter().map(|(name, value)| match value {
                Value::Float(number) => *number,
                other => panic!("{name} is {other:?}"),
            });
            return numbers.collect();
        }
    }
}

#[test]
fn a_program_gets_the_output_of_the_network() {
    let program = asks(&format!("[{INPUT}]"));
    let read = application(SCENARIO, &files(&program, DENSE)).unwrap_or_else(|why| panic!("{why}"));
    for (found, expected) in first(read.run().unwrap()).iter().zip(OUTPUT) {
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
}

/// Neither the file nor its folder is needed again.
#[test]
fn a_trace_holds_the_model() {
    let program = asks(&format!("[{INPUT}]"));
    let read = application(SCENARIO, &files(&program, DENSE)).unwrap();
    let run = finished(read.run().unwrap());
    let header = recording::header(read.resolved(), &run.setting());
    let inputs = recording::inputs(&header).unwrap();
    let again = starl_catalog::read(&inputs.request, &inputs, &Registry::default()).unwrap();
    let again = finished(again.run().unwrap());
    assert_eq!(again.simulation().digest(), run.simulation().digest());
    // Another weight is another run.
    let flipped = (0..DENSE.len()).map(|at| {
        let mut other = DENSE.to_vec();
        other[at] ^= 8;
        other
    });
    let readable = flipped.filter_map(|other| application(SCENARIO, &files(&program, &other)).ok());
    let numbers = first(read.run().unwrap());
    let other = readable.map(|read| read.run().unwrap());
    let mut other = other.filter(|other| first(other.clone()) != numbers);
    let other = finished(other.next().expect("a byte of a weight"));
    assert_ne!(other.simulation().digest(), run.simulation().digest());
}

#[test]
fn front_ends_that_hold_files_in_memory_run_it_too() {
    let program = asks(&format!("[{INPUT}]"));
    let files = [
        ("run.toml", SCENARIO.as_bytes()),
        ("lab/asks.starl", program.as_bytes()),
        ("lab/models/dense.onnx", DENSE),
    ];
    let held = Files::from_iter(files.map(|(path, bytes)| (path.to_string(), bytes.to_vec())));
    let session = Session::open(&held, &Options::default(), &Registry::default());
    let mut session = session.unwrap_or_else(|refused| panic!("{}", refused.message));
    session.advance(Budget::default(), None);
    let read = application(SCENARIO, &Memory::of(&files)).unwrap();
    let run = finished(read.run().unwrap());
    let (digest, same) = (session.report().digest, run.simulation().digest());
    assert_eq!(digest, same.to_string());
}

#[test]
fn problems_of_a_policy_are_reported_with_file_and_position() {
    let right = asks(&format!("[{INPUT}]"));
    let missing = Memory::of(&[("lab/asks.starl", right.as_bytes())]);
    let named = right.replace("(\"models", "(\"nets");
    let chosen = right.replace("(\"models/dense.onnx\")", "(\"a\" + \"b\")");
    let cases = [
        (
            missing,
            "the model `models/dense.onnx` cannot be read: there is no such file",
        ),
        (
            files(&named, DENSE),
            "the model `nets/dense.onnx` cannot be read",
        ),
        (files(&right, b"no model"), "this is not an ONNX file"),
        (
            files(&right, &DENSE[..DENSE.len() / 2]),
            "the model `models/dense.onnx` cannot be evaluated",
        ),
        (
            files(&right, LSTM),
            "the operator `LSTM` of node `memory` is not supported",
        ),
        (
            files(&chosen, DENSE),
            "the path of a model is a text in quotes",
        ),
        (
            files(&asks("[1.0] + [2.0]"), DENSE),
            "`models/dense.onnx` takes 4 numbers, not 2",
        ),
    ];
    for (files, expected) in cases {
        let refusal = application(SCENARIO, &files).err();
        let said = refusal
            .unwrap_or_else(|| panic!("nothing is said, not {expected}"))
            .to_string();
        assert!(
            said.contains(expected) && said.contains("asks.starl:"),
            "{said}"
        );
    }
}

#[test]
fn lists_of_unknown_length_are_counted_at_run_time() {
    let program = asks("[position.x for n in 0..3]");
    let read = application(SCENARIO, &files(&program, DENSE)).unwrap();
    let run = finished(read.run().unwrap());
    let said: Vec<String> = run
        .failures()
        .iter()
        .map(|failure| format!("{failure:?}"))
        .collect();
    assert_eq!(said.len(), 1);
    assert!(
        said[0].contains("asks.starl:7:20: `models/dense.onnx` takes 4 numbers, not 3"),
        "{said:?}"
    );
}

#[test]
fn nan_and_infinity_do_not_stop_a_program() {
    for odd in ["0.0 / 0.0", "1.0 / 0.0", "-1e300"] {
        let program = asks(&format!("[{odd}, 1.0, 2.0, 3.0]"));
        let read =
            application(SCENARIO, &files(&program, DENSE)).unwrap_or_else(|why| panic!("{why}"));
        assert_eq!(first(read.run().unwrap()).len(), 2, "{odd}");
    }
}
