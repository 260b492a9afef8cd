//! `starl fleet tell`: an operator's order to the programs of robots.

use super::connect::connect;
use super::file::Fleet;
use crate::args::FleetTellArguments;
use crate::console;
use crate::failure::Failure;
use serde_json::json;
use starl_catalog::programs::Registry;
use starl_core::{Intervention, Order, RobotId};
use starl_sim::read::{self, Source, suggest};
use std::fmt::Write;
use std::time::Duration;

/// The order is repeated for this time to robots that do not confirm it.
const PATIENCE: Duration = Duration::from_secs(4);

/// Sends an order; whether all robots that it is for have received it.
pub fn tell(arguments: &FleetTellArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let (robots, order) = order(arguments, &fleet)?;
    check(&fleet, &robots, &order)?;
    let mut operator = connect(&fleet)?;
    let took = operator.order(&robots, order, PATIENCE);
    let count = console::counted(took.len(), "robot");
    console::print(&format!(
        "{count} received the order `{}`\n",
        arguments.order
    ))?;
    let silent = fleet.silent(&robots, &took);
    if !silent.is_empty() {
        console::error(&format!(
            "no confirmation from {}: not running, waiting for a first position, failed, or not reachable from here",
            silent.join(", ")
        ));
    }
    Ok(silent.is_empty())
}

/// The numbers of the robots, and the order, read as an event of the fleet's scenario.
fn order(arguments: &FleetTellArguments, fleet: &Fleet) -> Result<(Vec<u32>, Order), Failure> {
    let mut text = format!(
        "[[event]]\nkind = \"tell\"\nat = \"0s\"\norder = {}\n",
        json!(arguments.order)
    );
    if let Some(robots) = &arguments.robots {
        let _ = writeln!(text, "robots = {}", json!(robots));
    }
    for field in &arguments.fields {
        let Some((name, value)) = field.split_once('=').filter(|(name, _)| !name.is_empty()) else {
            let help = "write FIELD=VALUE, e.g. 'to=[1.5, 2]'";
            return Err(Failure(format!(
                "the field `{field}` has no name or no value; {help}"
            )));
        };
        let _ = writeln!(text, "fields.{} = {}", json!(name.trim()), written(value));
    }
    let inputs = &fleet.application.resolved().inputs;
    let mut request = inputs.request.clone();
    request.faults = Some(Source {
        name: "the order".into(),
        text,
    });
    let mut events = read::scenario(&request, inputs)?.scenario.events;
    match events.pop().map(|event| event.what) {
        Some(Intervention::Tell { robots, order }) if robots.is_empty() => {
            Ok((fleet.numbers(), order))
        }
        Some(Intervention::Tell { robots, order }) => {
            Ok((robots.iter().map(|robot| robot.0).collect(), order))
        }
        _ => Err(Failure("the order cannot be read".into())),
    }
}

/// A value as a TOML file has it: what is none is a text.
fn written(value: &str) -> String {
    let table = toml::from_str::<toml::Table>(&format!("value = {value}"));
    match table.is_ok_and(|table| table.len() == 1) {
        true => value.to_string(),
        false => json!(value).to_string(),
    }
}

/// Refuses an order that no program handles, or that a program would ignore. Only programs in the StarL language say
/// which orders they handle.
fn check(fleet: &Fleet, robots: &[u32], order: &Order) -> Result<(), Failure> {
    let mut known = Vec::new();
    let mut is_handled = false;
    for &robot in robots {
        let Some(code) = fleet.application.code_of(RobotId(robot)) else {
            is_handled = true;
            continue;
        };
        known.extend(code.orders().names());
        match code.orders().decode(code.program(), order) {
            Ok(arrival) => is_handled |= arrival.is_some(),
            Err(wrong) => {
                return Err(Failure(format!(
                    "{}: the field `{}` of `{}` {}",
                    fleet.robots[robot as usize].name,
                    wrong.field,
                    wrong.order,
                    wrong.need()
                )));
            }
        }
    }
    if is_handled {
        return Ok(());
    }
    known.sort_unstable();
    known.dedup();
    let help = suggest::help(&order.name, &known, "there are")
        .unwrap_or_else(|| "the programs have no `on input`".into());
    Err(Failure(format!(
        "no program of these robots handles the order `{}`; {help}",
        order.name
    )))
}
