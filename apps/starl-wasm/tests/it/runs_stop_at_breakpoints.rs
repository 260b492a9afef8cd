//! A run stops after the step in which a breakpoint is met, and goes as it would go without.

use crate::support::Client;
use serde_json::{Value, json};

fn race() -> Client {
    let set = ["program=race.starl"];
    let options = json!({"scenario": "race", "seed": "11", "robots": "create=3", "set": set});
    Client::open(json!({}), options)
}

fn set(client: &mut Client, breakpoints: Value) {
    client.ask("breakpoints", json!({"breakpoints": breakpoints}));
}

fn refused(client: &mut Client, breakpoint: Value) -> Value {
    let refused = client.try_ask("breakpoints", json!({"breakpoints": [breakpoint]}));
    refused.expect_err("the breakpoint makes no sense")
}

/// Runs to the end; gives what it stopped at, and when.
fn stops(client: &mut Client) -> Vec<(f64, Value)> {
    let mut stops = Vec::new();
    loop {
        let status = client.ask("run", json!({}));
        if status["stopped"].is_null() {
            assert_eq!(status["over"], true);
            return stops;
        }
        stops.push((number(&status["now"]), status["stopped"].clone()));
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The value of `currentIndex` of each robot.
fn indices(client: &mut Client) -> Vec<i64> {
    let index = |robot: &Value| {
        let mut variables = robot["variables"].as_array().expect("a list").iter();
        let found = variables.find(|variable| variable["name"] == "currentIndex");
        let value = found.and_then(|variable| variable["value"].as_str());
        value.map_or(0, |value| value.parse().expect("an Int"))
    };
    let robots = (0..3).map(|robot| client.ask("robot", json!({"robot": robot})));
    robots.map(|robot| index(&robot)).collect()
}

#[test]
fn an_action_stops_the_run() {
    let mut client = race();
    set(
        &mut client,
        json!([{"action": {"name": "finish"}}, {"action": {"name": "pick", "robot": 1}}]),
    );
    let status = client.ask("run", json!({}));
    let stopped = &status["stopped"];
    assert_eq!(
        (&stopped["breakpoint"], &stopped["robot"]),
        (&json!(1), &json!(1))
    );
    assert_eq!(stopped["text"], "iRobot1: action pick");
    let records = client.ask("records", json!({}));
    let fired = records["records"].as_array().expect("a list").iter().rev();
    let mut fired = fired.filter(|record| {
        let message = &record["message"];
        record["topic"] == "/starl/action" && message["robot"] == 1 && message["name"] == "pick"
    });
    let last = fired.next().expect("it has fired");
    assert_eq!(number(&last["time_ns"]) / 1e9, number(&stopped["at"]));
    assert!(fired.next().is_none(), "it stops the first time");
    assert!(number(&status["now"]) - number(&stopped["at"]) <= 0.025 + 1e-9);
}

#[test]
fn a_run_stops_once_for_each_step() {
    let mut client = race();
    set(&mut client, json!([{"action": {"name": "finish"}}]));
    let stops = stops(&mut client);
    let records = client.ask("records", json!({}));
    let records = records["records"].as_array().expect("a list").iter();
    let fired = records.filter(|record| {
        record["topic"] == "/starl/action" && record["message"]["name"] == "finish"
    });
    // A step takes in what happens from its start until before its end.
    let mut steps: Vec<u64> = fired
        .map(|record| record["time_ns"].as_u64().expect("a time") / 25_000_000 + 1)
        .collect();
    assert_eq!(steps.len(), 3);
    steps.dedup();
    let stopped: Vec<u64> = stops
        .iter()
        .map(|(now, _)| (now * 40.0).round() as u64)
        .collect();
    assert_eq!(stopped, steps);
}

#[test]
fn a_message_stops_the_run_by_its_name() {
    let mut client = race();
    set(
        &mut client,
        json!([{"message": {"name": "Reached", "robot": 2}}]),
    );
    let named = stops(&mut client);
    assert!(!named.is_empty());
    for (_, stopped) in &named {
        assert_eq!(stopped["robot"], 2);
        let text = stopped["text"].as_str().expect("a text");
        assert!(text.starts_with("iRobot2: Reached from iRobot"), "{text}");
    }
    let mut client = race();
    set(&mut client, json!([{"message": {"robot": 2}}]));
    let all = stops(&mut client);
    // The others are acknowledgements.
    assert!(all.len() > named.len());
    assert!(all.iter().any(|(_, stopped)| {
        let text = stopped["text"].as_str().expect("a text");
        text.starts_with("iRobot2: datagram from iRobot")
    }));
    assert!(named.iter().all(|stop| all.contains(stop)));
}

#[test]
fn a_condition_stops_the_run_when_it_becomes_true_of_a_robot() {
    let mut client = race();
    set(
        &mut client,
        json!([{"when": {"expression": "currentIndex >= 2"}}]),
    );
    let first = client.ask("run", json!({}));
    let robot = first["stopped"]["robot"].as_u64().expect("a robot") as usize;
    let text = format!("iRobot{robot}: currentIndex >= 2 has become true");
    assert_eq!(first["stopped"]["text"], json!(text));
    assert_eq!(first["stopped"]["at"], first["now"]);
    let reached = indices(&mut client);
    assert!(reached[robot] >= 2, "{reached:?}");
    // It is true of a robot once; several robots may come there in one step.
    let rest = stops(&mut client);
    assert!(rest.len() <= 2, "{rest:?}");
    assert!(rest.iter().all(|(_, stopped)| stopped["robot"] != robot));
}

#[test]
fn a_condition_stops_the_run_when_it_becomes_true_of_the_fleet() {
    let mut client = race();
    set(
        &mut client,
        json!([{"when": {"expression": "forall r: r.currentIndex >= 1"}}]),
    );
    let mut alone = race();
    while indices(&mut alone).iter().any(|&index| index < 1) {
        alone.ask("step", json!({}));
    }
    let expected = alone.ask("status", json!({}));
    let status = client.ask("run", json!({}));
    assert_eq!(status["now"], expected["now"]);
    assert_eq!(status["stopped"]["robot"], Value::Null);
    assert_eq!(stops(&mut client), []);
}

#[test]
fn breakpoints_do_not_change_the_run() {
    let (mut stopped, mut alone) = (race(), race());
    set(
        &mut stopped,
        json!([
            {"when": {"expression": "exists r, s: distance(r.position, s.position) < 1m and r.id != s.id"}},
            {"when": {"expression": "currentIndex == 1"}},
            {"action": {"name": "pick"}},
            {"message": {"name": "Reached"}},
        ]),
    );
    assert!(stops(&mut stopped).len() > 10);
    assert_eq!(stops(&mut alone), []);
    assert_eq!(stopped.digest(), alone.digest());
}

#[test]
fn breakpoints_stay_after_going_back() {
    let mut client = race();
    let before = client.ask("snapshot", json!({}));
    set(
        &mut client,
        json!([{"when": {"expression": "currentIndex >= 1"}}]),
    );
    let first = client.ask("run", json!({}));
    let there = client.ask("snapshot", json!({}));
    client.ask("run", json!({"until": 20.0}));
    client.ask("restore", json!({"snapshot": before}));
    assert_eq!(client.ask("run", json!({}))["stopped"], first["stopped"]);
    // There it is true already: it is not met again before it has been false.
    let status = client.ask("restore", json!({"snapshot": there}));
    assert_eq!(
        (&status["stopped"], &status["now"]),
        (&Value::Null, &first["now"])
    );
    let robot = &first["stopped"]["robot"];
    assert!(
        stops(&mut client)
            .iter()
            .all(|(_, stopped)| &stopped["robot"] != robot)
    );
}

#[test]
fn an_expression_with_an_error_is_answered_with_its_place() {
    let mut client = race();
    let cases = [
        ("currentPoint >= 1", "E0201", 1, 13),
        ("forall r: r.currentIndex", "E0220", 11, 25),
        ("currentIndex + 1", "E0220", 1, 17),
        ("1 <\n currentPoint", "E0201", 2, 14),
    ];
    for (expression, code, column, end_column) in cases {
        let refused = refused(&mut client, json!({"when": {"expression": expression}}));
        let found = &refused["diagnostics"][0];
        assert_eq!(found["code"], code, "{expression}: {refused}");
        assert_eq!(found["field"], "breakpoints.0.when.expression");
        assert_eq!(found["file"], Value::Null);
        assert_eq!(
            (&found["column"], &found["end_column"]),
            (&json!(column), &json!(end_column)),
            "{expression}: {refused}"
        );
    }
    let all = [
        "",
        "(",
        ")",
        "true)",
        "// nothing",
        "true within 3s",
        "x = 1",
        "eventually: true",
        "true)\n\ninit\n    finish(",
        "\"",
        "forall r",
        "\u{1F600}",
    ];
    for expression in all {
        let refused = refused(&mut client, json!({"when": {"expression": expression}}));
        let found = refused["diagnostics"].as_array().expect("a list");
        assert!(!found.is_empty(), "{expression}");
        let units = expression.chars().count() as u64 + 1;
        let in_expression = |found: &Value| {
            found["line"].as_u64() == Some(1) && found["end_column"].as_u64() <= Some(units)
        };
        let is_short = !expression.contains('\n');
        assert!(
            !is_short || found.iter().all(in_expression),
            "{expression}: {refused}"
        );
    }
}

#[test]
fn an_error_while_it_is_evaluated_stops_the_run() {
    let mut client = race();
    set(
        &mut client,
        json!([{"when": {"expression": "way_points()[currentIndex].x > 1000m"}}]),
    );
    let stopped = client.ask("run", json!({}))["stopped"].clone();
    let text = stopped["text"].as_str().expect("a text");
    assert!(
        text.contains("cannot be evaluated: index 4 is out of range 0..4"),
        "{text}"
    );
}

#[test]
fn names_that_the_programs_do_not_have_are_refused() {
    let mut client = race();
    set(&mut client, json!([{"action": {"name": "pick"}}]));
    let cases = [
        (json!({"action": {"name": "pck"}}), "did you mean `pick`?"),
        (json!({"message": {"name": "Letter"}}), "there are: Reached"),
        (
            json!({"action": {"name": "pick", "robot": 3}}),
            "there is no robot 3",
        ),
        (json!({"message": {"robot": 9}}), "there is no robot 9"),
        (json!({"action": {}}), "missing field `name`"),
        (json!({"pause": {}}), "unknown variant `pause`"),
    ];
    for (breakpoint, words) in cases {
        let refused = refused(&mut client, breakpoint);
        let message = refused["message"].as_str().expect("a text");
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(
        client.ask("run", json!({}))["stopped"]["breakpoint"],
        0,
        "it has stayed"
    );
    set(&mut client, json!([]));
    assert_eq!(stops(&mut client), []);
}

#[test]
fn programs_in_rust_stop_at_actions_only() {
    let options = json!({"scenario": "race", "robots": "create=2", "set": ["program=race"]});
    let mut client = Client::open(json!({}), options);
    let refused = refused(&mut client, json!({"when": {"expression": "true"}}));
    let message = refused["message"].as_str().expect("a text");
    assert!(
        message.contains("no robot runs a program in the StarL language"),
        "{message}"
    );
    set(
        &mut client,
        json!([{"action": {"name": "wait", "robot": 0}}]),
    );
    assert_eq!(client.ask("run", json!({}))["stopped"]["robot"], 0);
}
