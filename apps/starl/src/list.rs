//! `starl list`: the examples, programs, models and planners.

use crate::args::ListArguments;
use crate::failure::Failure;
use crate::{console, json};
use serde::Serialize;
use starl_catalog::examples::EXAMPLES;
use starl_catalog::programs::{PLANNERS, Registry};
use starl_core::{Command, Point};
use starl_motion::models;
use std::fmt::{self, Write};

#[derive(Serialize)]
struct Listing<'r> {
    examples: Vec<Example>,
    programs: Vec<Named<'r>>,
    models: Vec<Model>,
    planners: Vec<&'static str>,
}

#[derive(Serialize)]
struct Example {
    name: &'static str,
    summary: &'static str,
    programs: Vec<&'static str>,
}

#[derive(Serialize)]
struct Named<'r> {
    name: &'r str,
    summary: &'r str,
}

#[derive(Serialize)]
struct Model {
    name: &'static str,
    summary: &'static str,
    radius_m: f64,
    speed_mps: f64,
    flies: bool,
    commands: Vec<&'static str>,
    parameters: Vec<Parameter>,
}

#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    unit: &'static str,
    default: f64,
    low: f64,
    high: f64,
}

/// One command of each kind, by its name.
const COMMANDS: [(&str, Command); 11] = [
    ("stop", Command::Stop),
    ("straight", Command::Straight { speed: 0.1 }),
    ("turn", Command::Turn { rate: 0.1 }),
    (
        "curve",
        Command::Curve {
            speed: 0.1,
            radius: 1.0,
        },
    ),
    (
        "wheels",
        Command::Wheels {
            left: 0.1,
            right: 0.1,
        },
    ),
    (
        "steer",
        Command::Steer {
            speed: 0.1,
            angle: 0.1,
        },
    ),
    (
        "velocity",
        Command::Velocity {
            velocity: Point::ZERO,
            yaw_rate: 0.0,
        },
    ),
    ("take off", Command::TakeOff),
    ("land", Command::Land),
    ("hover", Command::Hover),
    (
        "attitude",
        Command::Attitude {
            yaw_rate: 0.0,
            pitch: 0.0,
            roll: 0.0,
            gaz: 0.0,
        },
    ),
];

/// Shows what there is.
pub fn list(arguments: &ListArguments, registry: &Registry) -> Result<bool, Failure> {
    let listing = Listing {
        examples: EXAMPLES
            .iter()
            .map(|example| Example {
                name: example.name,
                summary: example.summary,
                programs: example.programs().collect(),
            })
            .collect(),
        programs: registry
            .entries()
            .iter()
            .map(|program| Named {
                name: &program.name,
                summary: &program.summary,
            })
            .collect(),
        models: models::KINDS.iter().filter_map(model).collect(),
        planners: PLANNERS.iter().map(|planner| planner.0).collect(),
    };
    if arguments.json {
        json::print(&listing)?;
    } else {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = write(&mut text, &listing);
        console::print(&text)?;
    }
    Ok(true)
}

fn model(kind: &models::Kind) -> Option<Model> {
    let model = models::by_name(kind.name)?;
    let (body, limits) = (model.body(), model.limits());
    let parameter = |field: &starl_motion::parameters::Field| Parameter {
        name: field.name,
        unit: field.unit,
        default: field.default,
        low: field.low,
        high: field.high,
    };
    Some(Model {
        name: kind.name,
        summary: kind.summary,
        radius_m: body.radius,
        speed_mps: limits.speed,
        flies: body.flies(),
        commands: COMMANDS
            .iter()
            .filter(|(_, command)| model.accepts(command))
            .map(|(name, _)| *name)
            .collect(),
        parameters: kind.fields.iter().map(parameter).collect(),
    })
}

fn write(text: &mut String, listing: &Listing<'_>) -> fmt::Result {
    writeln!(text, "Examples, for `{} run NAME`:", console::command())?;
    for Example {
        name,
        summary,
        programs,
    } in &listing.examples
    {
        writeln!(text, "  {name:19}  {summary}")?;
        for (line, names) in programs.chunks(3).enumerate() {
            let word = if line == 0 { "runs" } else { "and" };
            writeln!(text, "{:23}{word} {}", "", names.join(", "))?;
        }
    }
    writeln!(
        text,
        "\nPrograms, for `program` in a scenario, besides files ending in .starl:"
    )?;
    for Named { name, summary } in &listing.programs {
        writeln!(text, "  {name:12}  {summary}")?;
    }
    writeln!(
        text,
        "\nRobot models, for `model` in a scenario and for --robots:"
    )?;
    for model in &listing.models {
        let Model {
            name,
            summary,
            radius_m,
            speed_mps,
            commands,
            ..
        } = model;
        writeln!(text, "  {name:12}  {summary}")?;
        writeln!(
            text,
            "{:16}radius {radius_m} m, top speed {speed_mps:.2} m/s",
            ""
        )?;
        writeln!(text, "{:16}takes {}", "", commands.join(", "))?;
    }
    writeln!(text, "\nPlanners, for a program's parameter `planner`:")?;
    writeln!(text, "  {}", listing.planners.join(", "))
}
