//! Values of robots that are written apart from a program, such as the reward of a task.

use starl_lang::check::NoLibraries;
use starl_lang::compile::with_value;
use starl_lang::ir::Type;
use starl_lang::machine::{
    Host, HostCall, Import, Instruction, Limits, List, Machine, Object, Program, State, Workspace,
};
use std::borrow::Cow;

const PROGRAM: &str = "program Task\n\nx: Float\nplace: Point\n";

/// Robots with a number and a place each, and nothing else.
struct Fleet(Vec<State>);

impl Host for Fleet {
    fn call(&mut self, _: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        assert_eq!(call.import.name, "robot.all");
        let robots = (0..self.0.len() as u64).collect();
        call.set_object(0, Object::from(List::of_scalars(robots)));
        Ok(0)
    }

    fn state_of(&self, robot: starl_core::RobotId) -> Option<&State> {
        self.0.get(robot.index())
    }
}

/// The scalars of an expression's value for each of three robots.
fn values(expression: &str, ty: &Type) -> Vec<Vec<u64>> {
    let (bytecode, function) =
        with_value(PROGRAM, expression, ty, &NoLibraries).expect("a right expression");
    let resolve = |import: &Import| (import.name == "robot.all").then_some(0);
    let program = Program::load(bytecode, &resolve).expect("valid bytecode");
    let states = (0..3).map(|robot| {
        let mut state = program.new_state();
        let numbers = [f64::from(robot), 10.0, 20.0, 30.0];
        state.scalars.copy_from_slice(&numbers.map(f64::to_bits));
        state
    });
    let mut fleet = Fleet(states.collect());
    let (mut none, mut workspace) = (State::default(), Workspace::new());
    let limits = Limits::default();
    let mut machine = Machine::new(&program, &mut none, &mut workspace, &mut fleet, limits);
    let value = |robot: u64| {
        let called = machine.call(function, &[robot], &[]);
        called.expect("no fault").0.to_vec()
    };
    (0..3).map(value).collect()
}

fn floats(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn a_value_may_be_a_number_a_point_or_a_truth() {
    let doubled = values("x * 2.0\n  + place.z", &Type::Float);
    assert_eq!(doubled, [30.0, 32.0, 34.0].map(|value| floats(&[value])));
    let places = values("place + Point(x, 0.0)", &Type::Point);
    assert_eq!(places[2], floats(&[12.0, 20.0, 30.0]));
    assert_eq!(values("x > 0.5", &Type::Bool), [[0], [1], [1]]);
}

#[test]
fn a_value_sees_its_robot_and_all_robots() {
    let found = values("if exists r: r.x > x then x else -1.0", &Type::Float);
    assert_eq!(found, [0.0, 1.0, -1.0].map(|value| floats(&[value])));
}

#[test]
fn problems_and_instructions_are_at_places_of_the_expression() {
    let expression = "x + gaol.x";
    let problems =
        with_value(PROGRAM, expression, &Type::Float, &NoLibraries).expect_err("no name");
    assert_eq!(problems[0].span.of(expression), "gaol");
    let problems = with_value(PROGRAM, "x > 1.0", &Type::Float, &NoLibraries).expect_err("a Bool");
    assert_eq!(problems[0].found.as_deref(), Some("Bool"));
    let (bytecode, _) = with_value(PROGRAM, "1.0 + x", &Type::Float, &NoLibraries).expect("right");
    assert!(bytecode.properties.is_empty());
    let is_sum = |one: &Instruction| matches!(one, Instruction::AddFloat { .. });
    let sum = bytecode.code.iter().position(is_sum).expect("a sum") as u32;
    let of_sum = bytecode.spans.iter().rfind(|(first, _)| *first <= sum);
    let span = of_sum.expect("a place").1;
    assert_eq!((span.start, span.end), (0, 7));
}
