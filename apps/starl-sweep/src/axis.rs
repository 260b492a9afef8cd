//! An axis of a sweep: a field of the scenario and the values that it takes.
//!
//! `FIELD=A,B,C` lists values as scenarios have them, with units. `FIELD=LOW..HIGH:N` gives N evenly spaced values,
//! both ends included. Commas and points within quotes, brackets and braces belong to a value.

use crate::Error;
use serde::{Deserialize, Serialize};
use starl_sim::read::{Override, Quantity};

/// The name of the axis for the number of robots, which is not a field of scenarios.
pub const FLEET: &str = "fleet";

/// A field and its values.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// The dotted path of the field, or [`FLEET`].
    pub field: String,
    /// The values as a scenario has them; at least one.
    pub values: Vec<String>,
}

/// An axis as a plot or a table has it.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// All values are quantities of one dimension.
    Numbers {
        /// In the order of the axis, in the unit.
        values: Vec<f64>,
        /// As written; empty for plain numbers.
        unit: String,
    },
    /// Anything else.
    Texts,
}

/// A range with more values is a slip.
const MOST_VALUES: usize = 100_000;

/// Digits that a value of a range keeps, so that 0..0.4:9 has 0.15 and not 0.15000000000000002.
const DIGITS: usize = 12;

impl Axis {
    /// Reads `network.loss=0..0.4:9` or `fleet=4,8,16`. A single value is an axis too.
    ///
    /// # Errors
    /// There is no value, a range is invalid, or a value is given twice.
    pub fn parse(assignment: &str) -> Result<Axis, Error> {
        let Override { path, value, .. } = Override::set(assignment).map_err(Error::Problem)?;
        let option = option(&path);
        let mut values = Vec::new();
        for part in split(&value) {
            match range(&part, &option)? {
                Some(numbers) => values.extend(numbers),
                None if part.is_empty() => {
                    let help = "separate values by single commas";
                    return Err(Error::option(&option, "a value is missing", help));
                }
                None => values.push(part),
            }
        }
        let axis = Axis {
            field: path,
            values,
        };
        axis.check()?;
        Ok(axis)
    }

    fn check(&self) -> Result<(), Error> {
        let option = option(&self.field);
        if self.field == "seed" {
            let help = "give the seeds with --seeds";
            return Err(Error::option(&option, "the seed cannot be an axis", help));
        }
        for (index, value) in self.values.iter().enumerate() {
            if self.values[..index].contains(value) {
                let message = format!("{value} is given twice");
                return Err(Error::option(&option, message, "give each value once"));
            }
            if self.field == FLEET && !matches!(value.parse(), Ok(1_u64..=MOST_ROBOTS)) {
                let message = format!("{value} is not a number of robots");
                let help = "give whole numbers from 1 to 10000000";
                return Err(Error::option(&option, message, help));
            }
        }
        Ok(())
    }

    /// Whether it is an axis of the plan, and not a field with a fixed value.
    pub fn varies(&self) -> bool {
        self.values.len() > 1 || self.field == FLEET
    }

    /// The field with its first value, in the form of `--set`: the scenario may need a field that is an axis, so it is
    /// read with this value. None for the number of robots, which is not a field.
    pub fn first_setting(&self) -> Option<String> {
        (self.field != FLEET).then(|| format!("{}={}", self.field, self.values[0]))
    }

    /// The values as numbers in one unit, if they are that.
    pub fn scale(&self) -> Scale {
        let quantities: Option<Vec<Quantity<'_>>> = self
            .values
            .iter()
            .map(|value| Quantity::split(value).filter(|quantity| quantity.number.is_finite()))
            .collect();
        let Some(quantities) = quantities else {
            return Scale::Texts;
        };
        let unit = quantities.iter().map(|quantity| quantity.unit);
        let unit = unit.clone().find(|unit| !unit.is_empty()).unwrap_or("");
        let values: Option<Vec<f64>> = quantities
            .iter()
            .map(|quantity| in_unit(*quantity, unit))
            .collect();
        match values {
            Some(values) => Scale::Numbers {
                values,
                unit: unit.to_string(),
            },
            None => Scale::Texts,
        }
    }
}

/// As `--robots` has it.
const MOST_ROBOTS: u64 = 10_000_000;

/// The option as errors of scenarios name it.
pub(crate) fn option(field: &str) -> String {
    format!("--set {field}")
}

fn in_unit(quantity: Quantity<'_>, unit: &str) -> Option<f64> {
    let Quantity { number, unit: own } = quantity;
    if own == unit || (own.is_empty() && number == 0.0) {
        return Some(number);
    }
    let (dimension, si) = quantity.in_si()?;
    let one = Quantity { number: 1.0, unit };
    let (wanted, one) = one.in_si()?;
    (dimension == wanted).then(|| neat(si / one))
}

/// Splits at the commas that are not within quotes, brackets or braces.
fn split(text: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let (mut depth, mut quote) = (0_u32, None);
    for letter in text.chars() {
        match (letter, quote) {
            (',', None) if depth == 0 => {
                parts.push(String::new());
                continue;
            }
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth = depth.saturating_sub(1),
            ('"' | '\'', None) => quote = Some(letter),
            (letter, Some(open)) if letter == open => quote = None,
            _ => {}
        }
        if let Some(part) = parts.last_mut() {
            part.push(letter);
        }
    }
    let trimmed = parts.iter().map(|part| part.trim().to_string());
    trimmed.collect()
}

/// The values of `LOW..HIGH:N`; none if the text is not a range.
fn range(text: &str, option: &str) -> Result<Option<Vec<String>>, Error> {
    let Some((low, rest)) = text.split_once("..") else {
        return Ok(None);
    };
    let (high, count) = match rest.rsplit_once(':') {
        Some((high, count)) => (high, Some(count.trim())),
        None => (rest, None),
    };
    let (Some(low), Some(high)) = (Quantity::split(low), Quantity::split(high)) else {
        return Ok(None);
    };
    let wrong = |message: String, help: &str| Err(Error::option(option, message, help));
    let example = "write LOW..HIGH:N, such as 0..0.4:9";
    let Some(count) = count else {
        return wrong(format!("the range {text} has no number of values"), example);
    };
    let count = match count.parse::<usize>() {
        Ok(count) if (2..=MOST_VALUES).contains(&count) => count,
        _ => {
            let help = format!("give a whole number from 2 to {MOST_VALUES}");
            return wrong(format!("{count} is not a number of values"), &help);
        }
    };
    // `0..100ms` and `10..100ms` say the unit once.
    if low.unit != high.unit && !low.unit.is_empty() {
        let help = "give both ends the same unit";
        return wrong(format!("the ends of {text} differ in their units"), help);
    }
    if !(low.number.is_finite() && high.number.is_finite() && low.number < high.number) {
        let help = "begin with the lower end";
        return wrong(
            format!("the range {text} has no values between its ends"),
            help,
        );
    }
    let value = |index: usize| {
        let part = index as f64 / (count - 1) as f64;
        let number = neat(low.number + (high.number - low.number) * part);
        format!("{number}{}", high.unit)
    };
    Ok(Some((0..count).map(value).collect()))
}

/// A number without the last digits, which hold what arithmetic on binary fractions leaves over.
fn neat(number: f64) -> f64 {
    let rounded = format!("{number:.*e}", DIGITS - 1);
    rounded.parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        Axis::parse(text).expect(text).values
    }

    fn refused(text: &str) -> String {
        Axis::parse(text).expect_err(text).to_string()
    }

    #[test]
    fn a_range_includes_both_ends_and_has_neat_numbers() {
        let loss = values("network.loss=0..0.4:9");
        let expected = [
            "0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.3", "0.35", "0.4",
        ];
        assert_eq!(loss, expected);
        assert_eq!(values("network.delay=0..100ms:3"), ["0ms", "50ms", "100ms"]);
        assert_eq!(values("x=-1..1:3"), ["-1", "0", "1"]);
        assert_eq!(
            values("x=1e-7..3e-7:3"),
            ["0.0000001", "0.0000002", "0.0000003"]
        );
        assert_eq!(values("fleet=4..16:4"), ["4", "8", "12", "16"]);
        assert_eq!(values("x=0..2:3,10"), ["0", "1", "2", "10"]);
    }

    #[test]
    fn commas_within_quotes_and_brackets_belong_to_a_value() {
        let points = values("parameters.home=[0, 0], [1, 2]");
        assert_eq!(points, ["[0, 0]", "[1, 2]"]);
        assert_eq!(values("title='a, b',\"c, d\""), ["'a, b'", "\"c, d\""]);
        assert_eq!(values("network={loss=0.1, delay='1ms'}").len(), 1);
        assert_eq!(
            values("program=../a.starl,b.starl"),
            ["../a.starl", "b.starl"]
        );
    }

    #[test]
    fn errors_name_the_field() {
        let cases = [
            ("network.loss", "--set network.loss: there is no value"),
            (
                "network.loss=0..0.4",
                "--set network.loss: the range 0..0.4 has no number of values",
            ),
            (
                "network.loss=0..0.4:1",
                "--set network.loss: 1 is not a number of values",
            ),
            (
                "network.loss=0.4..0:3",
                "--set network.loss: the range 0.4..0:3 has no values",
            ),
            (
                "network.delay=1ms..1s:3",
                "--set network.delay: the ends of 1ms..1s:3 differ",
            ),
            (
                "network.loss=0,,1",
                "--set network.loss: a value is missing",
            ),
            (
                "network.loss=0,0.1,0",
                "--set network.loss: 0 is given twice",
            ),
            ("fleet=0", "--set fleet: 0 is not a number of robots"),
            (
                "fleet=4..16:4,2.5",
                "--set fleet: 2.5 is not a number of robots",
            ),
            ("seed=1,2", "--set seed: the seed cannot be an axis"),
        ];
        for (text, message) in cases {
            let found = refused(text);
            assert!(found.starts_with(message), "{text}: {found}");
        }
    }

    #[test]
    fn values_of_one_dimension_share_a_unit() {
        let scale = |text: &str| Axis::parse(text).expect(text).scale();
        let numbers = |values: &[f64], unit: &str| Scale::Numbers {
            values: values.to_vec(),
            unit: unit.to_string(),
        };
        assert_eq!(scale("d=0,500us,2ms"), numbers(&[0.0, 500.0, 2000.0], "us"));
        assert_eq!(scale("l=0,0.1"), numbers(&[0.0, 0.1], ""));
        assert_eq!(scale("l=1ms,1m"), Scale::Texts);
        assert_eq!(scale("planner=rrt,prm"), Scale::Texts);
    }
}
