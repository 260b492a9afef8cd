//! Parameters: defaults, values of the scenario, and messages about invalid ones.

use crate::robot_support::{World, compile};
use starl_core::{Duration, Point};
use starl_lang::machine::Value;
use starl_lang::robot::{ParameterError, RobotProgram};

const PROGRAM: &str = r#"
program Parameters

enum Shape {line, ring}

const base = 2

param count: Int = base * 3
param pause: Duration
param shape: Shape = ring
param corners: List[Point] = [Point(1.0, 2.0)]

total: Int = count + 1
first: Point? = corners.first()
"#;

fn given<'a>(others: &[(&'a str, Value)]) -> Vec<(&'a str, Value)> {
    let mut all = vec![("pause", Value::Duration(Duration::from_seconds(2)))];
    all.extend_from_slice(others);
    all
}

#[test]
fn defaults_hold_where_nothing_is_given() {
    let code = compile(PROGRAM);
    let world = World::new(vec![RobotProgram::new(&code, &given(&[])).unwrap()]);
    assert_eq!(world.int(0, "count"), 6);
    assert_eq!(world.int(0, "total"), 7);
    assert_eq!(world.get(0, "shape"), Value::Variant("ring".into()));
    assert_eq!(world.get(0, "pause").to_string(), "2s");
    let first = Value::Some(Box::new(Value::Point(Point::planar(1.0, 2.0))));
    assert_eq!(world.get(0, "first"), first);
}

#[test]
fn given_values_are_there_before_the_variables_get_theirs() {
    let code = compile(PROGRAM);
    let values = given(&[
        ("count", Value::Int(10)),
        ("shape", Value::Variant("line".into())),
        ("corners", Value::List(vec![])),
    ]);
    let world = World::new(vec![RobotProgram::new(&code, &values).unwrap()]);
    assert_eq!(world.int(0, "total"), 11);
    assert_eq!(world.get(0, "shape"), Value::Variant("line".into()));
    assert_eq!(world.get(0, "first"), Value::None);
}

fn refusal(values: &[(&str, Value)]) -> ParameterError {
    let program = RobotProgram::new(&compile(PROGRAM), values);
    program.map(|_| ()).unwrap_err()
}

#[test]
fn one_without_default_must_be_given() {
    let error = refusal(&[]);
    let expected = ParameterError::Missing {
        name: "pause".into(),
        expected: "Duration".into(),
    };
    assert_eq!(error, expected);
    assert_eq!(
        error.to_string(),
        "the parameter `pause`, Duration, is not given"
    );
}

#[test]
fn there_must_be_such_a_parameter() {
    let error = refusal(&given(&[("cuont", Value::Int(1))]));
    let text = "the program has no parameter `cuont`; it has count, pause, shape, corners";
    assert_eq!(error.to_string(), text);
    // A variable is none, and neither is a constant.
    let error = refusal(&given(&[("total", Value::Int(1))]));
    assert!(matches!(error, ParameterError::Unknown { .. }));
}

#[test]
fn its_value_must_be_of_its_type() {
    let error = refusal(&given(&[("count", Value::Float(1.5))]));
    assert_eq!(error.to_string(), "the parameter `count` is Int, not 1.5");
    let error = refusal(&given(&[("shape", Value::Variant("star".into()))]));
    let text = "the parameter `shape` is Shape {line, ring}, not star";
    assert_eq!(error.to_string(), text);
    let error = refusal(&given(&[("corners", Value::List(vec![Value::Int(1)]))]));
    assert_eq!(
        error.to_string(),
        "the parameter `corners` is List[Point], not [1]"
    );
}

#[test]
fn its_value_must_be_in_its_range() {
    let source = "program Ranges

const most = 5

param count: Int in 1..most + 1 = 1
param speed: Float in -1.5..1.5 = 0.0
param pause: Duration in 100ms..1min = 1s

idle()
    eff log(\"{} {} {}\", count, speed, pause)
";
    let code = compile(source);
    let given = |name, value| RobotProgram::new(&code, &[(name, value)]).map(|_| ());
    let seconds = |seconds| Value::Duration(Duration::from_seconds(seconds));
    for (name, value) in [
        ("count", Value::Int(1)),
        ("count", Value::Int(5)),
        ("speed", Value::Float(-1.5)),
        ("pause", seconds(59)),
    ] {
        assert_eq!(given(name, value), Ok(()), "{name}");
    }
    for (name, value, range) in [
        ("count", Value::Int(0), "from 1 to 5, and 0 is"),
        ("count", Value::Int(6), "from 1 to 5, and 6 is"),
        (
            "speed",
            Value::Float(1.5),
            "from -1.5 to below 1.5, and 1.5 is",
        ),
        (
            "speed",
            Value::Float(f64::NAN),
            "from -1.5 to below 1.5, and NaN is",
        ),
        ("pause", seconds(60), "from 100ms to below 60s, and 60s is"),
    ] {
        let error = given(name, value).unwrap_err().to_string();
        let expected = format!("the parameter `{name}` goes {range} not in that");
        assert_eq!(error, expected);
    }
}

#[test]
fn a_default_that_cannot_be_computed_is_reported_with_its_position() {
    let code = compile("program Late\n\nconst zero = 0\n\nparam a: Int = 1 / zero\n\nb: Int = a\n");
    let error = RobotProgram::new(&code, &[]).map(|_| ()).unwrap_err();
    assert_eq!(error.to_string(), "late.starl:5:16: division by zero");
}
