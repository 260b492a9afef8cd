//! A robot's variables, guards, primitives, timers and mail, without any effect on the run.

use crate::support::Client;
use serde_json::{Value, json};

fn named<'a>(list: &'a Value, name: &str) -> &'a Value {
    let mut list = list.as_array().expect("a list").iter();
    list.find(|entry| entry["name"] == name)
        .unwrap_or_else(|| panic!("there is no {name}"))
}

#[test]
fn guards_show_the_next_actions() {
    let program = "program Counter\n\ncount: Int = 0\n\nstop()\n    pre count >= 3\n    eff finish()\n\ntick()\n    pre count < 3\n    eff count = count + 1\n";
    let mut client = Client::open(
        json!({"counter.starl": program}),
        json!({"robots": "create=1", "set": ["robots.0.control_period=\"100ms\""]}),
    );
    let before = client.ask("robot", json!({"robot": 0}));
    assert_eq!(before["started"], false);
    assert_eq!(before["variables"], json!([]));
    let mut seen = Vec::new();
    while client.ask("run", json!({"steps": 1}))["over"] == false {
        let robot = client.ask("robot", json!({"robot": 0}));
        let count = named(&robot["variables"], "count")["value"].clone();
        let enabled = |name| named(&robot["actions"], name)["enabled"].clone();
        let now = (count, enabled("tick"), enabled("stop"));
        if seen.last() != Some(&now) {
            seen.push(now);
        }
    }
    let expected = [("1", true), ("2", true), ("3", false)]
        .map(|(count, ticks)| (json!(count), json!(ticks), json!(!ticks)));
    assert_eq!(seen, expected);
}

#[test]
fn inspection_does_not_change_the_run() {
    for example in ["mutex", "memory", "search", "diffusion", "race"] {
        let open = || Client::open(json!({}), json!({"scenario": example, "seed": "5"}));
        let (mut watched, mut alone) = (open(), open());
        let robots = watched
            .ask("fleet", json!({}))
            .as_array()
            .map_or(0, Vec::len);
        for second in 1..4 {
            for robot in 0..robots {
                let seen = watched.ask("robot", json!({"robot": robot}));
                assert_eq!(seen["id"], robot);
                let actions = seen["actions"].as_array().expect("a list");
                assert!(
                    actions.iter().all(|action| action["error"].is_null()),
                    "{actions:?}"
                );
            }
            watched.ask("run", json!({"until": second}));
        }
        alone.ask("run", json!({"until": 3}));
        assert_eq!(watched.digest(), alone.digest(), "{example}");
    }
}

#[test]
fn sensors_read_the_world_around_a_robot() {
    let mut client = Client::open(json!({}), json!({"scenario": "diffusion"}));
    client.ask("run", json!({"until": 1.0}));
    let sensors = client.ask("robot", json!({"robot": 0}))["sensors"].clone();
    assert_eq!(sensors["proximity_range"], 0.4);
    assert!(sensors["detector_range"].is_null(), "it has no detector");
    let rays = sensors["proximity"].as_array().expect("a list");
    assert_eq!(rays.len(), 12);
    let distances = rays.iter().filter_map(|ray| ray["distance"].as_f64());
    assert!(distances.clone().all(|distance| distance <= 0.4));
    assert!(
        distances.clone().any(|distance| distance < 0.4),
        "the robots start close together"
    );

    let mut client = Client::open(json!({}), json!({"scenario": "intersection"}));
    client.ask("run", json!({"until": 5.0}));
    let fleet = client.ask("fleet", json!({}));
    let fleet = fleet.as_array().expect("a list");
    let sees = |client: &mut Client, robot: usize| {
        client.ask("robot", json!({"robot": robot}))["sensors"]["detections"].clone()
    };
    let seen = (0..fleet.len()).map(|robot| sees(&mut client, robot));
    let seen: Vec<_> = seen
        .flat_map(|list| list.as_array().cloned())
        .flatten()
        .collect();
    assert!(!seen.is_empty(), "cars see each other");
    let known = |name| fleet.iter().any(|member| member["name"] == name);
    assert!(seen.iter().all(|seen| known(seen["name"].clone())));
}

#[test]
fn mail_arrives_at_its_announced_time() {
    let set = ["network.delay=\"300ms\"", "network.jitter=\"0s\""];
    let options = json!({"scenario": "broadcast", "set": set});
    let mut client = Client::open(json!({}), options);
    let mail = loop {
        let status = client.ask("step", json!({}));
        assert_eq!(status["over"], false, "nobody gets a message");
        let robot = client.ask("robot", json!({"robot": 0}));
        assert!(robot["timers"].is_array());
        let mailbox = robot["mailbox"].as_array().expect("a list");
        if let Some(mail) = mailbox.first() {
            break mail.clone();
        }
    };
    assert_eq!(mail["to"], "news");
    client.ask("records", json!({}));
    client.ask(
        "run",
        json!({"until": mail["at"].as_f64().expect("a time") + 0.05}),
    );
    let batch = client.ask("records", json!({}));
    let mut records = batch["records"].as_array().expect("a list").iter();
    let delivered = records.find(|record| {
        let message = &record["message"];
        record["topic"] == "/starl/delivered"
            && message["robot"] == 0
            && message["from"] == mail["from"]
            && message["sequence"] == mail["sequence"]
    });
    let at = delivered.expect("it arrives")["time_ns"]
        .as_f64()
        .expect("a time")
        / 1e9;
    assert!((at - mail["at"].as_f64().expect("a time")).abs() < 1e-9);
}

#[test]
fn primitives_and_timers_have_owners() {
    let mut client = Client::open(json!({}), json!({"scenario": "mutex"}));
    client.ask("run", json!({"until": 2.0}));
    let robot = client.ask("robot", json!({"robot": 0}));
    let primitives = robot["primitives"].as_array().expect("a list");
    assert!(
        primitives
            .iter()
            .any(|primitive| primitive["kind"] == "Mutex")
    );
    assert!(
        primitives
            .iter()
            .all(|primitive| primitive["state"].is_string())
    );
    let timers = robot["timers"].as_array().expect("a list");
    assert!(!timers.is_empty());
    assert!(
        timers.iter().all(|timer| timer["owner"].is_string()),
        "{timers:?}"
    );
}

#[test]
fn poses_are_those_of_robots() {
    let options = json!({"scenario": "race", "set": ["program=race"]});
    let mut client = Client::open(json!({}), options);
    client.ask("run", json!({"until": 3.0}));
    let robot = client.ask("robot", json!({"robot": 1}));
    assert_eq!(robot["actions"], json!([]), "it is a program in Rust");
    let mut poses = Vec::new();
    assert!(client.host.poses(0, &mut poses));
    let fleet = client.ask("fleet", json!({}));
    assert_eq!(poses.len(), 11 * fleet.as_array().map_or(0, Vec::len));
    assert_eq!(json!(poses[11]), robot["pose"]["position"]["x"]);
    assert_eq!(json!(poses[18]), robot["estimate"]["pose"]["position"]["y"]);
    assert!(!client.host.poses(1, &mut poses));
    assert!(client.try_ask("robot", json!({"robot": 999})).is_err());
    let world = client.ask("world", json!({}));
    assert!(
        world["way_points"]
            .as_array()
            .is_some_and(|points| !points.is_empty())
    );
    assert!(world["obstacles"].is_array());
}

#[test]
fn states_are_the_values_of_the_first_enum() {
    let options = json!({"scenario": "race", "set": ["program=race.starl"]});
    let mut client = Client::open(json!({}), options);
    let robots = client
        .ask("fleet", json!({}))
        .as_array()
        .map_or(0, Vec::len);
    assert_eq!(
        client.ask("states", json!({})),
        json!(vec![Value::Null; robots])
    );
    let mut seen = Vec::new();
    while client.ask("run", json!({"steps": 1, "until": 3.0}))["steps"] == 1 {
        let states = client.ask("states", json!({}));
        assert_eq!(states.as_array().map(Vec::len), Some(robots));
        let robot = client.ask("robot", json!({"robot": 1}));
        let variables = robot["variables"].as_array().expect("a list");
        let expected =
            variables.first().map_or(
                &Value::Null,
                |_| &named(&robot["variables"], "loc")["value"],
            );
        assert_eq!(&states[1], expected);
        if seen.last() != Some(expected) {
            seen.push(expected.clone());
        }
    }
    assert!(seen.contains(&json!("wait")), "{seen:?}");
}

#[test]
fn without_an_enum_the_role_is_the_state() {
    let roles = "program Roles\n\nparam colour: Colour = red\n\nenum Colour {red, blue}\n\nticks: Int = 0\n\ntick()\n    pre ticks < 10\n    eff ticks += 1\n\nrole scout\n    go()\n        pre ticks >= 10\n        eff role = guard\n\nrole guard\n    rest()\n        pre false\n        eff finish()\n";
    let options = json!({"robots": "create=1"});
    let mut client = Client::open(json!({"roles.starl": roles}), options);
    client.ask("run", json!({"until": 0.2}));
    assert_eq!(client.ask("states", json!({})), json!(["scout"]));
    client.ask("run", json!({"until": 5.0}));
    assert_eq!(client.ask("states", json!({})), json!(["guard"]));
}

#[test]
fn programs_in_rust_have_no_state() {
    let options = json!({"scenario": "race", "robots": "create=2", "set": ["program=race"]});
    let mut client = Client::open(json!({}), options);
    client.ask("run", json!({"until": 1.0}));
    assert_eq!(client.ask("states", json!({})), json!([null, null]));
}
