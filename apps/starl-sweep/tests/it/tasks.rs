//! Tasks are plain data, and a row depends on its task alone.

use starl_catalog::examples;
use starl_catalog::programs::Registry;
use starl_sim::read::Request;
use starl_sweep::{Axis, Error, Measured, Plan, Row, Runner, Task, execute, run_task};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// A plan for an example.
fn plan(name: &str, axes: &[&str], seeds: &str, profile: Option<&str>) -> Plan {
    let example = examples::find(name).expect("there is this example");
    let request = Request::new(example.source());
    let application = starl_catalog::read(&request, example, &Registry::default());
    let axes = axes.iter().map(|axis| Axis::parse(axis).expect("an axis"));
    Plan::new(
        name,
        &application.expect("the example is right"),
        axes.collect(),
        seeds.parse().expect("seeds"),
        profile,
        example,
    )
    .expect("the axes are right")
}

/// All rows by number, run on so many threads.
fn rows(plan: &Plan, threads: usize, stop_after: u64, rows: &mut BTreeMap<u64, Row>) {
    let stop = AtomicBool::new(false);
    let runner = Runner::new(Registry::default());
    let done: BTreeMap<u64, Measured> = rows
        .iter()
        .map(|(number, row)| {
            (
                *number,
                Measured {
                    row: row.clone(),
                    cpu_seconds: 0.0,
                },
            )
        })
        .collect();
    let open = plan.open(&done).into_iter();
    let mut taken = 0;
    let executed = execute(
        open.map(|number| (number, plan.task(number))),
        &runner,
        threads,
        &stop,
        |number, measured| {
            assert!(
                rows.insert(number, measured.row).is_none(),
                "{number} was run twice"
            );
            taken += 1;
            stop.store(taken >= stop_after, Ordering::Relaxed);
            Ok::<(), Error>(())
        },
    );
    executed.expect("every combination is right");
}

#[test]
fn a_task_that_was_sent_elsewhere_gives_the_same_row() {
    let plan = plan(
        "race",
        &["network.loss=0,0.3", "fleet=2,5"],
        "2",
        Some("chaos"),
    );
    let runner = Runner::new(Registry::default());
    for number in 0..plan.len() {
        let task = plan.task(number);
        let text = serde_json::to_string(&task).expect("a task is plain data");
        let received: Task = serde_json::from_str(&text).expect("it is a task");
        assert_eq!(task, received);
        let (here, there) = (runner.run(&task), run_task(&received));
        let (here, there) = (here.expect("it is right"), there.expect("it is right"));
        assert_eq!(here, there);
        let text = serde_json::to_string(&there).expect("a row is plain data");
        assert_eq!(
            there,
            serde_json::from_str::<Row>(&text).expect("it is a row")
        );
        assert_eq!(here.robots, [2, 5][(number / 2 % 2) as usize]);
    }
}

#[test]
fn a_plan_that_was_sent_elsewhere_has_the_same_tasks() {
    let here = plan("intersection", &["network.delay=1ms..20ms:3"], "5..7", None);
    let text = serde_json::to_string(&here).expect("a plan is plain data");
    let there: Plan = serde_json::from_str(&text).expect("it is a plan");
    assert_eq!(here.identity(), there.identity());
    assert!((0..here.len()).all(|number| here.task(number) == there.task(number)));
}

#[test]
fn rows_do_not_depend_on_threads_or_interruptions() {
    let plan = plan("race", &["network.loss=0,0.4"], "6", None);
    let mut one = BTreeMap::new();
    rows(&plan, 1, u64::MAX, &mut one);
    assert_eq!(one.len() as u64, plan.len());
    for threads in [2, 7] {
        let mut other = BTreeMap::new();
        // Stopped after every few rows and begun again.
        for _ in 0..12 {
            rows(&plan, threads, 3, &mut other);
        }
        assert_eq!(one, other);
    }
}

#[test]
fn a_fleet_keeps_the_shares_of_its_models() {
    let plan = plan("race", &["fleet=1..9:9"], "1", None);
    let all = plan.task(0).inputs.request.source.text.clone();
    assert!(all.contains("create"), "the example has several models");
    let robots: Vec<u64> = (0..plan.len())
        .map(|number| {
            let task = plan.task(number);
            let robots = task.robots.expect("the fleet is an axis");
            let counts = robots.split(',').filter_map(|part| part.split_once('='));
            counts
                .map(|(_, count)| count.parse::<u64>().expect("a number"))
                .sum()
        })
        .collect();
    assert_eq!(robots, (1..=9).collect::<Vec<_>>());
}

#[test]
fn other_texts_make_another_plan() {
    let known = plan("race", &["network.loss=0,0.4"], "6", None).identity();
    for other in [
        plan("race", &["network.loss=0,0.5"], "6", None),
        plan("race", &["network.loss=0,0.4"], "7", None),
        plan("race", &["network.loss=0,0.4"], "6", Some("calm")),
        plan("line", &["network.loss=0,0.4"], "6", None),
    ] {
        assert_ne!(known, other.identity());
    }
}
