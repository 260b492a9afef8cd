//! Every request gets an answer: bad requests get an error, and never a panic.

use crate::support::ask;
use serde_json::{Value, json};
use starl_catalog::service::Service;
use starl_core::Random;

#[test]
fn bytes_that_are_not_a_request_are_refused() {
    let mut host = Service::default();
    let cases: [&[u8]; 7] = [
        b"",
        b"{",
        b"null",
        b"\xff\xfe",
        br#"{"dance": {}}"#,
        br#"{"status": {"simulation": 0}}"#,
        br#"{"check": {"files": {"a.starl": {"no": "text"}}}}"#,
    ];
    for bytes in cases {
        let answer = String::from_utf8(host.answer(bytes)).expect("answers are text");
        assert!(answer.starts_with(r#"{"error":{"#), "{answer}");
    }
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(host.answer(deep.as_bytes()).starts_with(br#"{"error""#));
}

/// Requests that are sound, to be damaged.
fn sound() -> Vec<Value> {
    let point = json!({"x": 1.0, "y": -2.0, "z": 0.5});
    let pose = json!({"position": point, "yaw": 0.1, "pitch": 0.0, "roll": 0.0});
    let circle = json!({"shape": {"Circle": {"center": point, "radius": 0.3, "height": null}}});
    let cuboid =
        json!({"shape": {"Cuboid": {"low": point, "high": {"x": 2.0, "y": 0.0, "z": 1.0}}}});
    let base = json!([point, {"x": 2.0, "y": 1.0, "z": 0.0}, {"x": 0.0, "y": 3.0, "z": 0.0}]);
    let polygon =
        json!({"shape": {"Polygon": {"base": base, "height": {"low": 0.0, "high": 2.0}}}});
    let interventions = [
        json!({"fault": {"crash": [0, 1]}}),
        json!({"fault": {"restart": [0]}}),
        json!({"fault": {"partition": [[0], [1, 2]]}}),
        json!({"fault": "heal"}),
        json!({"fault": {"corrupt_state": [2]}}),
        json!({"push": {"robot": 0, "by": point}}),
        json!({"network": [{"delay": 1000}, {"loss": 0.5}, {"range": 3.0}, {"bandwidth": 1e6}, {"largest": 9}]}),
        json!({"add_obstacle": {"obstacle": circle, "hidden": true}}),
        json!({"add_obstacle": {"obstacle": cuboid, "hidden": false}}),
        json!({"add_obstacle": {"obstacle": polygon, "hidden": false}}),
        json!({"move_obstacle": {"index": 1, "obstacle": polygon}}),
        json!({"remove_obstacle": {"index": 0}}),
        json!({"set_way_point": {"name": "x", "position": point, "group": 0}}),
        json!({"set_thing": {"name": "x", "position": point}}),
        json!({"tell": {"robots": [], "order": {"name": "go", "fields": [["x", {"float": 1.0}]]}}}),
        json!({"join": {"like": 0, "name": "late", "pose": pose}}),
        json!({"leave": [1]}),
    ];
    let apply =
        |intervention| json!({"apply": {"simulation": 0, "at": 0.5, "intervention": intervention}});
    let mut sound: Vec<Value> = interventions.map(apply).into();
    let about = json!({"simulation": 0});
    sound.extend(
        [
            "status", "step", "scenario", "world", "fleet", "states", "report", "snapshot",
        ]
        .map(|name| json!({ name: about })),
    );
    sound.extend([
        json!({"run": {"simulation": 0, "until": 2.0, "steps": 20, "sample": 0.1}}),
        json!({"records": {"simulation": 0, "max": 7}}),
        json!({"robot": {"simulation": 0, "robot": 1}}),
        json!({"breakpoints": {"simulation": 0, "breakpoints": [
            {"action": {"name": "pick", "robot": 0}}, {"message": {"name": null, "robot": 1}},
            {"when": {"expression": "forall r: r.up"}},
        ]}}),
        json!({"restore": {"simulation": 0, "snapshot": 0}}),
        json!({"drop": {"simulation": 0, "snapshot": 1}}),
        json!({"check": {"files": {"a.starl": "program A\n", "b.toml": "title = 1\n", "c.bin": [1, 2]}}}),
        json!({"hover": {"files": {"a.starl": "program A\n"}, "path": "a.starl", "position": {"line": 0, "character": 9}}}),
        json!({"complete": {"files": {"a.starl": "program A\n"}, "path": "a.starl", "position": {"line": 1, "character": 0}}}),
        json!({"definition": {"files": {"a.starl": "program A\n"}, "path": "a.starl", "position": {"line": 0, "character": 9}}}),
        json!({"outline": {"files": {"a.starl": "program A\n"}, "path": "a.starl"}}),
        json!({"format": {"text": "program A\n"}}),
        json!({"open": {
            "files": {"a.starl": "program A\n", "b.toml": "program = \"a.starl\"\n[[robots]]\nmodel = \"create\"\n"},
            "options": {"scenario": "b.toml", "program": "a.starl", "seed": "1", "set": ["network.loss=0.1"]},
            "topics": ["/starl/pose"],
        }}),
    ]);
    sound
}

/// Changes one thing somewhere in a value.
fn damage(value: &mut Value, random: &mut Random) {
    let odd = [
        json!(null),
        json!(-1),
        json!(0),
        json!(1e300),
        json!(-1e-300),
        json!(u64::MAX),
        json!(4_294_967_295u32),
        json!(0.1),
        json!(""),
        json!("../\u{0}\u{1F600}"),
        json!([]),
        json!({}),
        json!([[[]]]),
        json!(true),
    ];
    let mut pick = |count: usize| random.below(count as u32) as usize;
    let stays = pick(4) == 0;
    match value {
        Value::Object(members) if !stays && !members.is_empty() => {
            let name = members.keys().nth(pick(members.len())).cloned();
            let Some(name) = name else { return };
            match pick(12) {
                0 => drop(members.remove(&name)),
                1 => drop(members.insert("more".to_string(), odd[pick(odd.len())].clone())),
                _ => damage(&mut members[&name], random),
            }
        }
        Value::Array(items) if !stays && !items.is_empty() => {
            let place = pick(items.len());
            damage(&mut items[place], random);
        }
        _ => *value = odd[pick(odd.len())].clone(),
    }
}

#[test]
fn damaged_requests_never_panic() {
    for seed in 0..6 {
        println!("seed {seed}");
        let mut random = Random::keyed(seed, &[]);
        let mut host = Service::default();
        let example = ["race", "search", "mutex"][seed as usize % 3];
        let open = json!({"open": {"options": {"scenario": example, "robots": "create=3"}}});
        ask(&mut host, &open).unwrap_or_else(|error| panic!("{error}"));
        let sound = sound();
        for _ in 0..400 {
            let mut request = sound[random.below(sound.len() as u32) as usize].clone();
            for _ in 0..random.below(3) {
                damage(&mut request, &mut random);
            }
            // Without a bound on the steps a run may take long, which is not a fault.
            if let Some(run) = request.get_mut("run").and_then(Value::as_object_mut) {
                run.insert("steps".to_string(), json!(20));
            }
            println!("{request}");
            let _ = ask(&mut host, &request);
            let step = json!({"step": {"simulation": 0}});
            ask(&mut host, &step).unwrap_or_else(|error| panic!("{error}"));
        }
    }
}
