//! An operator sends orders to the programs of robots that run in processes of their own.

#![cfg(unix)]

use crate::fleet::{Up, fleet_file, hear_each_other, wait_until};
use crate::support::*;
use starl_core::{Event, Intervention, RobotId};
use std::fs::File;

const PROGRAM: &str = "program Called

motion = ReachAvoid()

arrive()
    pre motion.done
    eff finish()

on input go_to(place: Point)
    motion.reach_avoid(place, obstacles())
";

const SCENARIO: &str = r#"
program = "called.starl"
duration = "60s"

[[robots]]
model = "holonomic"
name = "robot"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
"#;

#[test]
fn robots_follow_the_orders_of_an_operator() {
    let folder = folder("fleet_orders");
    file(&folder, "called.starl", PROGRAM);
    file(&folder, "called.toml", SCENARIO);
    fleet_file(&folder, "called.toml");
    let tell = |arguments: &[&str]| {
        let mut all = vec!["fleet", "tell", "fleet.toml"];
        all.extend_from_slice(arguments);
        starl(&folder, &all)
    };

    let up = Up::start(&folder, &[]);
    wait_until(&folder, hear_each_other);
    let refused = [
        (
            &["go_too"][..],
            "handles the order `go_too`; did you mean `go_to`?",
        ),
        (
            &["go_to"][..],
            "robot0: the field `place` of `go_to` must be Point, but it is missing",
        ),
        (&["go_to", "place=1"][..], "must be Point, but it is Int"),
        (&["go_to", "place"][..], "write FIELD=VALUE"),
        (
            &["go_to", "place=[1]"][..],
            "write a point, [x, y] or [x, y, z]",
        ),
        (
            &["go_to", "place=[1, 0]", "--robots", "robot7"][..],
            "robot7",
        ),
    ];
    for (arguments, message) in refused {
        let output = tell(arguments);
        assert_eq!(status(&output), 2, "{}", stderr(&output));
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }

    let output = tell(&["go_to", "place=[1, 0]", "--robots", "robot0"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(stdout(&output), "1 robot received the order `go_to`\n");
    let robots = wait_until(&folder, |robots| robots[0]["condition"] == "finished");
    assert_eq!(robots[1]["condition"], "running");
    let output = tell(&["go_to", "place=[1.0, 1]"]);
    assert_eq!(stdout(&output), "2 robots received the order `go_to`\n");
    let output = up.end();
    assert_eq!(status(&output), 0, "{}", stderr(&output));

    // No robot is there any more.
    let output = tell(&["go_to", "place=[1, 0]"]);
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    assert!(stderr(&output).contains("no confirmation from robot0, robot1"));

    let merged = folder.join("fleet.runs/0001/merged.mcap");
    let reader = starl_trace::Reader::new(File::open(merged).expect("it was written"));
    let records = reader
        .expect("it is a trace")
        .map(|record| record.expect("it is whole"));
    let orders = records.filter_map(|record| match record.event {
        Event::Intervention(what) => match *what {
            Intervention::Tell { robots, .. } => Some(robots),
            _ => None,
        },
        _ => None,
    });
    let mut orders: Vec<Vec<RobotId>> = orders.collect();
    orders.sort();
    let (first, second) = (vec![RobotId(0)], vec![RobotId(1)]);
    assert_eq!(orders, [first.clone(), first, second]);
}
