//! The command-line option `--robots create=2,drone=2`: another fleet for the same scenario.

use super::report::{Origin, Report};
use super::schema::model_names;
use super::suggest;

/// Models with how many of each, in the order given.
pub(super) type Fleet = Vec<(String, u64)>;

/// Reads the option; problems go to the report.
pub(super) fn read(text: &str, report: &Report) -> (Fleet, Origin) {
    let origin = report.option(&format!("--robots {text}"));
    let complain = |message: String, help: &str| {
        report.problem_with_help(origin, "", message, help);
    };
    let mut fleet = Fleet::new();
    for part in text.split(',').map(str::trim) {
        let Some((model, count)) = part.split_once('=') else {
            complain(
                format!("{part:?} has no number"),
                "write it like create=2,drone=2",
            );
            continue;
        };
        let (model, count) = (model.trim(), count.trim());
        let names: Vec<&str> = model_names().collect();
        if !names.contains(&model) {
            let help = suggest::help(model, &names, "there are").unwrap_or_default();
            complain(format!("there is no robot model {model:?}"), &help);
        } else if fleet.iter().any(|(other, _)| other == model) {
            complain(format!("{model} is given twice"), "give each model once");
        } else {
            match count.parse::<u64>() {
                Ok(count) if count <= MOST => fleet.push((model.to_string(), count)),
                _ => complain(
                    format!("{count:?} is not a number of robots"),
                    "give a whole number from 0 to 10000000",
                ),
            }
        }
    }
    (fleet, origin)
}

const MOST: u64 = 10_000_000;
