//! Reads `robots`: the groups of the fleet, without the starts of their robots.

use super::parameter::{add_parameters, model};
use super::report::Origin;
use super::robots_option;
use super::section::Section;
use super::{Placed, start};
use crate::fields::FieldTable;
use crate::scenario::{Bounds, Clock, Fleet, Group, Parameter, SensorSuite};
use starl_core::intervention::is_robot_name;
use starl_core::{Duration, Pose};
use starl_motion::Model;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A group whose robots have no places yet.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub model: Arc<dyn Model>,
    pub count: usize,
    pub name: String,
    pub numbered: bool,
    pub first_number: u32,
    pub program: String,
    pub parameters: BTreeMap<String, Parameter>,
    /// Starts given in the scenario, for the first of its robots.
    pub starts: Vec<Placed<Pose>>,
    pub area: Option<Placed<Bounds>>,
    pub spacing: f64,
    pub control_period: Duration,
    pub sensors: SensorSuite,
    pub clock: Clock,
    /// Where the group is written, and its path.
    pub origin: Origin,
    pub path: String,
}

/// The groups, as many robots in each as the command line says, or else the scenario.
pub(super) fn read(root: Section<'_>, robots: Option<&str>) -> Vec<Draft> {
    let program = root.text("program");
    let mut parameters = BTreeMap::new();
    add_parameters(root, &mut parameters);
    let before = root.report.count();
    let groups = root.tables("robots", |table| {
        draft(table, program.as_deref(), &parameters)
    });
    let read_whole = root.report.count() == before;
    let mut drafts: Vec<Draft> = groups.into_iter().flatten().collect();
    if let Some(robots) = robots {
        let (fleet, origin) = robots_option::read(robots, root.report);
        if read_whole {
            replace_counts(&mut drafts, &fleet);
            add_models(&mut drafts, &fleet, origin, program, &parameters, root);
        }
        if root.report.count() == before && drafts.iter().all(|draft| draft.count == 0) {
            let message = "this fleet is empty";
            root.report
                .problem_with_help(origin, "", message, "give at least one robot");
        }
    } else if read_whole && drafts.iter().all(|draft| draft.count == 0) {
        root.problem(
            "robots",
            "the fleet is empty",
            "give a group with a count of at least 1",
        );
    }
    let total = drafts
        .iter()
        .fold(0_u64, |sum, draft| sum + draft.count as u64);
    if total > 10_000_000 {
        let message = format!("the fleet has {total} robots");
        root.problem("robots", message, "have at most 10000000");
        drafts.clear();
    }
    drafts
}

/// The field `name` of a group or of a robot that joins.
pub(super) fn robot_name(table: Section<'_>) -> Option<String> {
    let name = table.text("name");
    if let Some(name) = &name
        && !is_robot_name(name)
    {
        let message = format!("{name:?} cannot be the name of a robot");
        let help = "leave out `/` and control characters: robots' names become parts of file names";
        table.problem("name", message, help);
    }
    name
}

fn draft(
    table: Section<'_>,
    program: Option<&str>,
    parameters: &BTreeMap<String, Parameter>,
) -> Option<Draft> {
    let starts = table.tables("start", start::read);
    let given = table.count("count");
    let count = given.unwrap_or(starts.len().max(1) as u64) as usize;
    if starts.len() > count {
        let message = format!(
            "there are more starts ({}) than robots ({count})",
            starts.len()
        );
        table.problem("start", message, "leave some out, or raise `count`");
    }
    let name = robot_name(table);
    let numbered = table.flag("numbered");
    if !numbered && count > 1 {
        let message = format!("{count} robots cannot all have the same name");
        table.problem(
            "numbered",
            message,
            "leave `numbered` out, or have one robot",
        );
    }
    let own_program = table.text("program");
    if own_program.is_none() && program.is_none() && !table.has("program") {
        let help = "set `program` here, or for all robots at the top of the scenario";
        table.problem("program", "is missing", help);
    }
    let mut own_parameters = parameters.clone();
    add_parameters(table, &mut own_parameters);
    let area = table.optional_table("area", start::area);
    let model_name = table.model("model");
    let draft = Draft {
        count,
        name: String::new(),
        numbered,
        first_number: table.count("first_number").unwrap_or_default() as u32,
        program: own_program
            .or(program.map(str::to_string))
            .unwrap_or_default(),
        parameters: own_parameters,
        starts: starts.into_iter().flatten().collect(),
        area,
        spacing: table.number("spacing"),
        control_period: table.duration("control_period"),
        sensors: table.table("sensors", SensorSuite::read),
        clock: table.table("clock", clock),
        model: model(table, model_name.as_deref()?)?,
        origin: table.origin,
        path: table.path_of(""),
    };
    Some(Draft {
        name: name.or(model_name)?,
        ..draft
    })
}

fn clock(table: Section<'_>) -> Clock {
    let drift = table.number("drift");
    if drift >= 1.0 {
        let message = "with a drift of 1 or more a clock may stand or run backwards";
        table.problem("drift", message, "give less than 1");
    }
    Clock {
        offset: table.duration("offset"),
        drift_ppm: drift * 1e6,
    }
}

/// Gives the groups of each model so many robots in all as are asked for: the last of them shrink
/// first, and the last one grows.
fn replace_counts(drafts: &mut [Draft], fleet: &robots_option::Fleet) {
    let mut left: BTreeMap<&str, usize> = fleet
        .iter()
        .map(|(model, count)| (model.as_str(), *count as usize))
        .collect();
    for index in 0..drafts.len() {
        let (draft, later) = drafts[index..]
            .split_first_mut()
            .expect("the index is in range");
        let model = draft.model.name();
        let Some(left) = left.get_mut(model) else {
            draft.count = 0;
            continue;
        };
        let last = later.iter().all(|other| other.model.name() != model);
        draft.count = if last { *left } else { draft.count.min(*left) };
        draft.numbered |= draft.count > 1;
        *left -= draft.count;
    }
}

/// Adds groups, everything at its default, for models that the scenario has none of.
fn add_models(
    drafts: &mut Vec<Draft>,
    fleet: &robots_option::Fleet,
    origin: Origin,
    program: Option<String>,
    parameters: &BTreeMap<String, Parameter>,
    root: Section<'_>,
) {
    for (model, count) in fleet {
        if drafts.iter().any(|draft| draft.model.name() == model) || *count == 0 {
            continue;
        }
        let Some(program) = program.clone() else {
            let message = format!("the scenario has no {model}, and no program for one");
            let help = "add a group of this model to the scenario, or a `program` for all";
            root.report.problem_with_help(origin, "", message, help);
            continue;
        };
        let base = root.blank_element("robots", |table| Draft {
            model: starl_motion::models::by_name(model).expect("the option names known models"),
            count: *count as usize,
            name: model.clone(),
            numbered: true,
            first_number: 0,
            program,
            parameters: parameters.clone(),
            starts: Vec::new(),
            area: None,
            spacing: table.number("spacing"),
            control_period: table.duration("control_period"),
            sensors: table.table("sensors", SensorSuite::read),
            clock: table.table("clock", clock),
            origin,
            path: String::new(),
        });
        drafts.push(base);
    }
}

/// The fleet, once every robot has its place; groups without robots are left out.
pub(super) fn assemble(drafts: Vec<Draft>, starts: Vec<Vec<Pose>>) -> Fleet {
    let group = |(draft, starts): (Draft, Vec<Pose>)| Group {
        name: draft.name,
        numbered: draft.numbered,
        first_number: draft.first_number,
        model: draft.model,
        program: draft.program,
        parameters: draft.parameters,
        starts,
        control_period: draft.control_period,
        sensors: draft.sensors,
        clock: draft.clock,
    };
    let manned = |group: &Group| !group.starts.is_empty();
    Fleet {
        groups: drafts
            .into_iter()
            .zip(starts)
            .map(group)
            .filter(manned)
            .collect(),
    }
}
