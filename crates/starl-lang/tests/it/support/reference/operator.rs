//! Operators, as the language says.

use super::value::{Value, comparison, equal};
use super::{Outcome, Stop};
use starl_core::{Point, math};
use starl_lang::ir::Operator;
use starl_lang::machine::Fault;
use std::cmp::Ordering;

/// The result of a binary operator.
pub fn apply(operator: Operator, left: Value, right: Value) -> Outcome<Value> {
    use Operator::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
    let unknown = Stop::Unknown;
    Ok(match operator {
        Equal => Value::Bool(equal(&left, &right, false).ok_or(unknown)?),
        NotEqual => Value::Bool(!equal(&left, &right, false).ok_or(unknown)?),
        Less | LessEqual | Greater | GreaterEqual => {
            let found = comparison(&left, &right);
            Value::Bool(match operator {
                Less => found == Some(Ordering::Less),
                LessEqual => matches!(found, Some(Ordering::Less | Ordering::Equal)),
                Greater => found == Some(Ordering::Greater),
                _ => matches!(found, Some(Ordering::Greater | Ordering::Equal)),
            })
        }
        _ => arithmetic(operator, left, right)?,
    })
}

/// All NaN are one, because processors differ in the sign of the NaN they produce.
pub fn settled(number: f64) -> f64 {
    if number.is_nan() { f64::NAN } else { number }
}

fn arithmetic(operator: Operator, left: Value, right: Value) -> Outcome<Value> {
    use Operator::{Add, Divide, Multiply, Subtract};
    use Value::{Duration, Float, Int, List, Text, Time};
    Ok(match (operator, left, right) {
        (_, Int(left), Int(right)) => Int(integers(operator, left, right)?),
        (_, Float(left), Float(right)) => Float(floats(operator, left, right)),
        (Add, Duration(left), Duration(right)) => Duration(sum(left, right)?),
        (Add, Time(left), Duration(right)) | (Add, Duration(left), Time(right)) => {
            Time(sum(left, right)?)
        }
        (Subtract, Duration(left), Duration(right)) => Duration(left.saturating_sub(right)),
        (Subtract, Time(left), Time(right)) => Duration(left.saturating_sub(right)),
        (Subtract, Time(left), Duration(right)) => Time(left.saturating_sub(right)),
        (Multiply, Duration(span), Int(times)) | (Multiply, Int(times), Duration(span)) => {
            let product = i128::from(span) * i128::from(times);
            Duration(span_of(product)?)
        }
        (Multiply, Duration(span), Float(factor)) | (Multiply, Float(factor), Duration(span)) => {
            Duration(rounded(span as f64 * factor)?)
        }
        (Divide, Duration(_), Int(0)) => return Err(Stop::Fault(Fault::DivisionByZero)),
        (Divide, Duration(span), Int(divisor)) => {
            Duration(span_of(i128::from(span) / i128::from(divisor))?)
        }
        (Divide, Duration(span), Float(divisor)) => Duration(rounded(span as f64 / divisor)?),
        (Divide, Duration(_), Duration(0)) => return Err(Stop::Fault(Fault::DivisionByZero)),
        (Divide, Duration(left), Duration(right)) => Float(left as f64 / right as f64),
        (Add, Value::Point(a), Value::Point(b)) => point(a, b, |a, b| a + b),
        (Subtract, Value::Point(a), Value::Point(b)) => point(a, b, |a, b| a - b),
        (Multiply, Value::Point(p), Float(by)) | (Multiply, Float(by), Value::Point(p)) => {
            point(p, p, |part, _| part * by)
        }
        (Divide, Value::Point(p), Float(by)) => point(p, p, |part, _| part / by),
        (Add, Text(left), Text(right)) => Text(left + &right),
        (Add, List(left), List(right)) => List([left, right].concat()),
        (_, left, right) => panic!("{operator:?} joins {left:?} and {right:?}"),
    })
}

fn point(a: Point, b: Point, each: impl Fn(f64, f64) -> f64) -> Value {
    let each = |a, b| settled(each(a, b));
    Value::Point(Point::new(each(a.x, b.x), each(a.y, b.y), each(a.z, b.z)))
}

fn integers(operator: Operator, left: i64, right: i64) -> Outcome<i64> {
    let (wide, by) = (i128::from(left), i128::from(right));
    let result = match operator {
        Operator::Add => wide + by,
        Operator::Subtract => wide - by,
        Operator::Multiply => wide * by,
        _ if right == 0 => return Err(Stop::Fault(Fault::DivisionByZero)),
        Operator::Divide => wide / by,
        _ => wide % by,
    };
    i64::try_from(result).map_err(|_| Stop::Fault(Fault::Overflow))
}

fn floats(operator: Operator, left: f64, right: f64) -> f64 {
    settled(match operator {
        Operator::Add => left + right,
        Operator::Subtract => left - right,
        Operator::Multiply => left * right,
        _ => left / right,
    })
}

fn sum(left: u64, right: u64) -> Outcome<u64> {
    span_of(i128::from(left) + i128::from(right))
}

/// Nanoseconds that fit into an Int.
fn span_of(nanoseconds: i128) -> Outcome<u64> {
    match (0..=i128::from(i64::MAX)).contains(&nanoseconds) {
        true => Ok(nanoseconds as u64),
        false => Err(Stop::Fault(Fault::Overflow)),
    }
}

/// The nearest nanosecond.
fn rounded(nanoseconds: f64) -> Outcome<u64> {
    let whole = math::round(nanoseconds);
    if (0.0..9_223_372_036_854_775_808.0).contains(&whole) {
        Ok(whole as u64)
    } else {
        Err(Stop::Fault(Fault::Overflow))
    }
}
