//! The answer to `/start.json`: the mode of the page, and the data for it.

use serde_json::{Value, json};
use starl_catalog::Application;
use starl_catalog::service::Service;
use starl_catalog::session::Session;
use starl_sim::read::{Content, Inputs};
use std::collections::BTreeMap;
use std::path::Path;

/// The page alone.
pub fn of_page() -> Value {
    json!({ "mode": "web" })
}

/// A trace.
pub fn of_trace(name: &str, size: u64) -> Value {
    json!({ "mode": "trace", "name": name, "size": size })
}

/// A fleet that runs.
pub fn of_fleet(name: &str) -> Value {
    json!({ "mode": "fleet", "name": name })
}

/// A run, as the request `open` describes it, with the texts that it was read from.
pub fn of_run(session: &Session, application: &Application) -> Value {
    let inputs = &application.resolved().inputs;
    json!({
        "mode": "run",
        "opened": Service::default().adopt(session.clone()),
        "scenario": scenario_name(inputs),
        "files": files(inputs),
    })
}

/// The scenario's name in its own folder, from which the other files are named.
fn scenario_name(inputs: &Inputs) -> &str {
    file_name(&inputs.request.source.name)
}

fn file_name(path: &str) -> &str {
    let name = Path::new(path).file_name();
    name.and_then(|name| name.to_str()).unwrap_or(path)
}

/// The scenario, the programs and libraries, and whatever else was read and is text.
fn files(inputs: &Inputs) -> BTreeMap<&str, &str> {
    let named = inputs.files.iter();
    let mut files: BTreeMap<&str, &str> = named
        .filter_map(|(path, content)| match content {
            Content::Text(text) => Some((path.as_str(), text.as_str())),
            Content::Hex(_) => None,
        })
        .collect();
    let faults = inputs.request.faults.iter();
    for source in faults.chain([&inputs.request.source]) {
        files.insert(file_name(&source.name), &source.text);
    }
    files
}
