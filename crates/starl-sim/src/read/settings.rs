//! Reads a scenario's top level and the tables that concern the run as a whole.

use super::fleet;
use super::inputs::{Recorder, Request};
use super::names::Names;
use super::section::Section;
use super::{event, fault, network, place, reach, suggest, world};
use crate::fields::FieldTable;
use crate::scenario::*;

/// The scenario, or none if its problems would make later checks misleading.
pub(super) fn read(root: Section<'_>, request: &Request, files: &Recorder<'_>) -> Option<Scenario> {
    let title = root
        .text("title")
        .unwrap_or_else(|| stem(&request.source.name));
    let seed = root.count("seed").unwrap_or_default();
    let duration = root.duration("duration");
    let goal = root
        .text("goal")
        .map(|text| goal(root, text))
        .unwrap_or_default();
    let physics = root.table("physics", Physics::read);
    let positioning = root.table("positioning", Positioning::read);
    let storage = root.table("storage", Storage::read);
    let wind = root.table("wind", Wind::read);
    let properties = root.table("properties", Properties::read);
    let trace = root.table("trace", Trace::read);
    let drafts = fleet::read(root, request.robots.as_deref());
    let mut names = Names::new(&drafts, root.report);
    let network = root.table("network", |table| network::read(table, &names));
    let events = event::read(root, &mut names, duration, &network);
    let faults = fault::read(root, &names, duration);
    let contents = root.table("world", |table| world::read(table, &names, files));
    let motion = root.table("motion", Motion::read);

    // Places make sense only in a world and with a fleet that are right.
    if root.report.count() > 0 {
        return None;
    }
    let starts = place::starts(&drafts, &names, &contents, seed, root.report)?;
    let fleet = fleet::assemble(drafts, starts);
    reach::check(&fleet, &contents, root.report);
    let world = contents.world();
    let mut scenario = Scenario {
        title,
        seed,
        duration,
        goal,
        world,
        fleet,
        physics,
        positioning,
        motion,
        storage,
        wind,
        network,
        faults,
        events,
        properties,
        trace,
    };
    scenario.fit_avoidance();
    Some(scenario)
}

fn goal(root: Section<'_>, text: String) -> Goal {
    let words = ["finished", "duration"];
    match text.as_str() {
        "finished" => Goal::AllFinished,
        "duration" => Goal::Duration,
        _ => {
            if let Some(word) = suggest::nearest(&text, words.into_iter()) {
                let message = format!("{text:?} is neither a goal nor a condition over the robots");
                root.problem("goal", message, format!("did you mean `{word}`?"));
            }
            Goal::Condition(text)
        }
    }
}

/// A file's name without folders and ending.
fn stem(name: &str) -> String {
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name);
    base.strip_suffix(".toml").unwrap_or(base).to_string()
}
