//! A host that is asked as JavaScript asks it.

use serde_json::{Value, json};
use starl_catalog::service::Service;

/// A host with one simulation.
pub struct Client {
    pub host: Service,
    pub simulation: Value,
}

/// The answer to a request, or the error.
pub fn ask(host: &mut Service, request: &Value) -> Result<Value, Value> {
    let answer = host.answer(request.to_string().as_bytes());
    let mut answer: Value = serde_json::from_slice(&answer).expect("answers are JSON");
    match answer.get("error") {
        Some(error) => Err(error.clone()),
        None => Ok(answer["ok"].take()),
    }
}

impl Client {
    /// Opens what a request says.
    pub fn open(files: Value, options: Value) -> Client {
        let mut host = Service::default();
        let request = json!({"open": {"files": files, "options": options}});
        let opened = ask(&mut host, &request).unwrap_or_else(|error| panic!("{error}"));
        Client {
            host,
            simulation: opened["simulation"].clone(),
        }
    }

    /// Asks about the simulation.
    pub fn try_ask(&mut self, name: &str, mut parameters: Value) -> Result<Value, Value> {
        parameters["simulation"] = self.simulation.clone();
        ask(&mut self.host, &json!({ name: parameters }))
    }

    /// Asks about the simulation what must work.
    pub fn ask(&mut self, name: &str, parameters: Value) -> Value {
        let answer = self.try_ask(name, parameters);
        answer.unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The digest at present.
    pub fn digest(&mut self) -> String {
        let report = self.ask("report", json!({}));
        report["digest"].as_str().expect("a text").to_string()
    }
}
