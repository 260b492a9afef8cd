//! Random arithmetic gives what the same arithmetic gives in Rust, or stops with the error that is
//! due, where it is due.

use crate::machine_support::{call, program};
use starl_core::Random;
use starl_lang::machine::Fault;

/// An expression over Ints, with the registers of its variables.
enum Expression {
    Variable(usize),
    Constant(i32),
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    Immediate(&'static str, Box<Expression>, i32),
    Choice(
        Box<Expression>,
        Box<Expression>,
        Box<Expression>,
        Box<Expression>,
    ),
}

const VARIABLES: usize = 4;
const UNARY: [&str; 2] = ["negate_int", "absolute_int"];
const BINARY: [&str; 7] = [
    "add_int",
    "subtract_int",
    "multiply_int",
    "divide_int",
    "remainder_int",
    "minimum_int",
    "maximum_int",
];
const IMMEDIATE: [&str; 4] = [
    "add_constant",
    "multiply_constant",
    "divide_constant",
    "remainder_constant",
];

fn choose<'a>(names: &[&'a str], random: &mut Random) -> &'a str {
    names[random.below(names.len() as u32) as usize]
}

fn small(random: &mut Random) -> i32 {
    random.below(21) as i32 - 10
}

fn expression(depth: u32, random: &mut Random) -> Expression {
    if depth == 0 || random.chance(0.1) {
        return match random.chance(0.7) {
            true => Expression::Variable(random.below(VARIABLES as u32) as usize),
            false => Expression::Constant(small(random)),
        };
    }
    let mut part = || Box::new(expression(depth - 1, &mut *random));
    let (first, second, third, fourth) = (part(), part(), part(), part());
    match random.below(10) {
        0..=1 => Expression::Unary(choose(&UNARY, random), first),
        2..=5 => Expression::Binary(choose(&BINARY, random), first, second),
        6..=7 => Expression::Immediate(choose(&IMMEDIATE, random), first, small(random)),
        _ => Expression::Choice(first, second, third, fourth),
    }
}

/// Writes code that leaves the expression's value in this register; those after it are free.
fn compile(expression: &Expression, to: usize, labels: &mut u32, code: &mut String) {
    let next = to + 1;
    match expression {
        Expression::Variable(variable) => *code += &format!("copy r{to} r{variable}\n"),
        Expression::Constant(number) => *code += &format!("int r{to} {number}\n"),
        Expression::Unary(name, from) => {
            compile(from, to, labels, code);
            *code += &format!("{name} r{to} r{to}\n");
        }
        Expression::Binary(name, left, right) => {
            compile(left, to, labels, code);
            compile(right, next, labels, code);
            *code += &format!("{name} r{to} r{to} r{next}\n");
        }
        Expression::Immediate(name, left, right) => {
            compile(left, to, labels, code);
            *code += &format!("{name} r{to} r{to} {right}\n");
        }
        Expression::Choice(left, right, less, otherwise) => {
            compile(left, to, labels, code);
            compile(right, next, labels, code);
            *labels += 1;
            let label = *labels;
            *code += &format!("jump_if_less r{to} r{next} @less{label}\n");
            compile(otherwise, to, labels, code);
            *code += &format!("jump @end{label}\nless{label}:\n");
            compile(less, to, labels, code);
            *code += &format!("end{label}:\n");
        }
    }
}

/// The value in 128 bits, where nothing overflows, and whether it fits into 64.
fn evaluate(expression: &Expression, variables: &[i64]) -> Result<i128, Fault> {
    let value = match expression {
        Expression::Variable(variable) => i128::from(variables[*variable]),
        Expression::Constant(number) => i128::from(*number),
        Expression::Unary(name, from) => {
            let from = evaluate(from, variables)?;
            match *name {
                "negate_int" => -from,
                _ => from.abs(),
            }
        }
        Expression::Binary(name, left, right) => {
            let left = evaluate(left, variables)?;
            binary(name, left, evaluate(right, variables)?)?
        }
        Expression::Immediate(name, left, right) => {
            binary(name, evaluate(left, variables)?, i128::from(*right))?
        }
        Expression::Choice(left, right, less, otherwise) => {
            let left = evaluate(left, variables)?;
            match left < evaluate(right, variables)? {
                true => evaluate(less, variables)?,
                false => evaluate(otherwise, variables)?,
            }
        }
    };
    match i64::try_from(value) {
        Ok(_) => Ok(value),
        Err(_) => Err(Fault::Overflow),
    }
}

fn binary(name: &str, left: i128, right: i128) -> Result<i128, Fault> {
    let divides = name.starts_with("divide") || name.starts_with("remainder");
    if divides && right == 0 {
        return Err(Fault::DivisionByZero);
    }
    Ok(match name.split('_').next() {
        Some("add") => left + right,
        Some("subtract") => left - right,
        Some("multiply") => left * right,
        Some("divide") => left / right,
        Some("remainder") => left % right,
        Some("minimum") => left.min(right),
        Some("maximum") => left.max(right),
        _ => unreachable!("{name}"),
    })
}

#[test]
fn ints() {
    let mut random = Random::keyed(6, &[0]);
    let (mut values, mut overflows, mut divisions) = (0, 0, 0);
    for _ in 0..2000 {
        let expression = expression(5, &mut random);
        let mut code = String::new();
        compile(&expression, VARIABLES, &mut 0, &mut code);
        let program = program(&format!(
            "function f function (Int, Int, Int, Int) (Int) registers 32 objects 0\n\
             {code}return_scalar r{VARIABLES} #0"
        ));
        for _ in 0..5 {
            let variables: Vec<i64> = (0..VARIABLES)
                .map(|_| match random.below(4) {
                    0 => [i64::MIN, i64::MAX, 0, -1][random.below(4) as usize],
                    1 => i64::from(random.bits()) << random.below(32),
                    _ => i64::from(small(&mut random)),
                })
                .collect();
            let expected = evaluate(&expression, &variables);
            match expected {
                Ok(_) => values += 1,
                Err(Fault::Overflow) => overflows += 1,
                Err(_) => divisions += 1,
            }
            let arguments: Vec<u64> = variables.iter().map(|&number| number as u64).collect();
            let found = call(&program, &arguments, &[]);
            let found = found.map(|(scalars, _)| i128::from(scalars[0] as i64));
            let found = found.map_err(|error| error.fault);
            assert_eq!(found, expected, "{variables:?}\n{code}");
        }
    }
    assert!(
        values > 1000 && overflows > 100 && divisions > 100,
        "{values} {overflows} {divisions}"
    );
}
