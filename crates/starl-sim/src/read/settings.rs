//! Reads a scenario's top level and the tables that concern the run as a whole.

use super::fleet::{self, Draft};
use super::inputs::{Recorder, Request};
use super::names::Names;
use super::section::Section;
use super::{event, fault, network, place, reach, suggest, world};
use crate::scenario::*;
use starl_motion::avoidance;

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
    let physics = root.table("physics", physics);
    let positioning = root.table("positioning", positioning);
    let storage = root.table("storage", storage);
    let wind = root.table("wind", wind);
    let properties = root.table("properties", properties);
    let trace = root.table("trace", |table| Trace {
        pose_period: table.duration("pose_period"),
    });
    let drafts = fleet::read(root, request.robots.as_deref());
    let mut names = Names::new(&drafts, root.report);
    let network = root.table("network", |table| network::read(table, &names));
    let events = event::read(root, &mut names, duration, &network);
    let faults = fault::read(root, &names, duration);
    let contents = root.table("world", |table| world::read(table, &names, files));
    let motion = root.table("motion", |table| motion(table, &positioning, &drafts));

    // Places make sense only in a world and with a fleet that are right.
    if root.report.count() > 0 {
        return None;
    }
    let starts = place::starts(&drafts, &names, &contents, seed, root.report)?;
    let fleet = fleet::assemble(drafts, starts);
    reach::check(&fleet, &contents, root.report);
    let world = contents.world();
    let scenario = Scenario {
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

fn physics(table: Section<'_>) -> Physics {
    Physics {
        step: table.duration("step"),
        collisions: table.flag("collisions"),
    }
}

fn positioning(table: Section<'_>) -> Positioning {
    Positioning {
        period: table.duration("period"),
        position_noise: table.number("position_noise"),
        heading_noise: table.number("heading_noise"),
        velocity_noise: table.number("velocity_noise"),
    }
}

fn motion(table: Section<'_>, positioning: &Positioning, drafts: &[Draft]) -> Motion {
    let largest = drafts
        .iter()
        .map(|draft| draft.model.body().radius)
        .fold(0.0, f64::max);
    let avoidance = table.switch("avoidance", |table| avoidance::Options {
        margin: table.number("margin"),
        vertical_clearance: table.number("vertical_clearance"),
        patience: table.number("patience"),
        longest_yield: table.number("longest_yield"),
        period: positioning.period.seconds(),
        largest_radius: largest,
    });
    Motion {
        speed_noise: table.number("speed_noise"),
        turn_noise: table.number("turn_noise"),
        noise_period: table.duration("noise_period"),
        avoidance,
    }
}

fn storage(table: Section<'_>) -> Storage {
    Storage {
        kept: table.flag("kept"),
        write_time: table.duration("write_time"),
        loss: table.number("loss"),
    }
}

fn wind(table: Section<'_>) -> Wind {
    Wind {
        steady: table.velocity("steady"),
        gust: table.velocity("gust"),
        gust_period: table.duration("gust_period"),
    }
}

fn properties(table: Section<'_>) -> Properties {
    Properties {
        no_collision: table.flag("no_collision"),
        reach_avoid: table.flag("reach_avoid"),
        progress_bound: table.duration("progress_bound"),
        broadcast: table.flag("broadcast"),
        broadcast_bound: table.duration("broadcast_bound"),
        geocast: table.flag("geocast"),
        geocast_bound: table.duration("geocast_bound"),
        unicast: table.flag("unicast"),
        unicast_bound: table.duration("unicast_bound"),
        shared_memory: table.flag("shared_memory"),
        shared_memory_bound: table.duration("shared_memory_bound"),
        election: table.flag("election"),
        election_bound: table.duration("election_bound"),
        mutex: table.flag("mutex"),
        mutex_bound: table.duration("mutex_bound"),
        register: table.flag("register"),
        registration: table.flag("registration"),
        registration_bound: table.duration("registration_bound"),
        barrier: table.flag("barrier"),
        barrier_bound: table.duration("barrier_bound"),
        program: table.flag("program"),
    }
}
