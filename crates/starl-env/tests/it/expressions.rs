//! Rewards, ends and measures as expressions of the language.

use crate::support::{Arrays, settings};
use starl_core::{Point, Pose};
use starl_env::{Batch, Column, Constant, Judge, Kind, Verdicts, Wording, WordingError};

const ROBOTS: usize = 3;

/// Two robots beside each other and one far away, which all drive in the direction of x.
struct Fleet {
    batch: Batch,
    arrays: Arrays,
    judge: Judge,
    rows: Vec<f64>,
    memory: Vec<u64>,
    rewards: Vec<f64>,
    terminated: Vec<bool>,
    information: Vec<f64>,
}

impl Fleet {
    fn new(environments: usize, wording: &Wording) -> Result<Fleet, WordingError> {
        let mut batch = Batch::new(settings("holonomic", ROBOTS), environments).expect("settings");
        let places = [(2.0, 2.0), (3.0, 2.0), (-3.0, -3.0)];
        let poses = places.map(|(x, y)| Pose::level(Point::planar(x, y), 0.0));
        (0..environments).for_each(|environment| batch.place(environment, &poses));
        let judge = Judge::new(&[(0.15, 0.5); ROBOTS], wording)?;
        Ok(Fleet {
            arrays: Arrays::of(&batch),
            rows: vec![0.0; environments * ROBOTS * judge.row()],
            memory: vec![0; environments * ROBOTS * judge.memory()],
            rewards: vec![0.0; environments * ROBOTS],
            terminated: vec![false; environments],
            information: vec![0.0; environments * judge.means()],
            batch,
            judge,
        })
    }

    fn judge(&mut self, begins: Option<&[bool]>) -> Result<(), String> {
        let verdicts = Verdicts {
            rows: &mut self.rows,
            memory: &mut self.memory,
            lidar: &self.arrays.lidar,
            rewards: &mut self.rewards,
            terminated: &mut self.terminated,
            information: &mut self.information,
        };
        let judged = self.batch.judge(&self.judge, begins, verdicts);
        judged.map_err(|error| error.to_string())
    }

    fn step(&mut self, ahead: f64) -> Result<(), String> {
        let environments = self.batch.environments();
        let actions: Vec<f64> = [ahead, 0.0, 0.0].repeat(environments * ROBOTS);
        let stepped = self.batch.step(&actions, &[], self.arrays.outputs());
        stepped.expect("finite actions");
        self.judge(None)
    }
}

fn text(text: &str) -> Option<String> {
    Some(text.to_string())
}

fn column(name: &str, kind: Kind, expression: Option<&str>) -> Column {
    Column {
        name: name.into(),
        kind,
        text: expression.map(String::from),
    }
}

fn reward(expression: &str) -> Wording {
    Wording {
        reward: text(expression),
        ..Wording::default()
    }
}

#[test]
fn previous_is_the_value_before_the_action() {
    let mut fleet = Fleet::new(2, &reward("position.x - previous.position.x")).expect("a reward");
    fleet.judge(Some(&[true, true])).expect("no error");
    assert_eq!(
        fleet.rewards, [0.0; 6],
        "the start of an episode has no rewards"
    );
    fleet.step(1.0).expect("no error");
    let first = fleet.batch.state(0, 0).pose.position.x - 2.0;
    assert!(first > 0.0);
    assert_eq!(fleet.rewards[0], first);
    fleet.step(-1.0).expect("no error");
    assert!(fleet.rewards[0] < 0.0);
}

#[test]
fn measures_remember_and_columns_are_read() {
    let wording = Wording {
        constants: vec![Constant {
            name: "counts".into(),
            kind: Kind::Bool,
            values: vec![1.0, 0.0, 1.0],
        }],
        columns: vec![
            column("goal", Kind::Point, None),
            column(
                "there",
                Kind::Bool,
                Some("previous.there or distance(position, goal) < 0.02"),
            ),
            column("middle", Kind::Point, Some("(position + goal) / 2.0")),
        ],
        reward: text("if there and counts then middle.x else -1.0"),
        terminated: text("there or not counts"),
        information: vec![
            ("there".into(), "there".into()),
            ("x".into(), "position.x".into()),
        ],
    };
    let mut fleet = Fleet::new(1, &wording).expect("a task");
    for (robot, goal) in [(2.0, 2.0), (9.0, 9.0), (8.0, 8.0)].into_iter().enumerate() {
        fleet.rows[robot * 5..][..2].copy_from_slice(&[goal.0, goal.1]);
    }
    fleet.judge(Some(&[true])).expect("no error");
    assert_eq!(fleet.rows[2], 1.0, "robot 0 starts at its goal");
    fleet.step(1.0).expect("no error");
    fleet.step(1.0).expect("no error");
    let x = fleet.batch.state(0, 0).pose.position.x;
    assert!(x > 2.03, "{x}");
    assert_eq!(fleet.rewards, [f64::midpoint(x, 2.0), -1.0, -1.0]);
    assert_eq!(fleet.information[0], 1.0 / 3.0);
    assert!(!fleet.terminated[0]);
    let end = fleet.batch.state(0, 2).pose.position;
    fleet.rows[10..12].copy_from_slice(&[end.x, end.y]);
    fleet.step(0.0).expect("no error");
    assert!(fleet.terminated[0]);
}

#[test]
fn expressions_see_the_whole_fleet() {
    let wording = reward(
        "nearest + [r.position.x for r in peers].sum() * 100.0 + (if exists r: r.position.x < 0.0 then 1000.0 else 0.0)",
    );
    let mut fleet = Fleet::new(1, &wording).expect("a reward");
    fleet.step(0.0).expect("no error");
    let far = Point::planar(2.0, 2.0).distance(Point::planar(-3.0, -3.0));
    assert_eq!(fleet.rewards, [1201.0, 1201.0, 1200.0 + far]);
    let mut fleet =
        Fleet::new(1, &reward("mean_position.x + lidar[0] + radius")).expect("a reward");
    fleet.step(0.0).expect("no error");
    assert_eq!(fleet.rewards[2], 2.0 / 3.0 + 1.0 + 0.15);
}

#[test]
fn the_number_of_environments_changes_nothing() {
    let wording = reward("distance(previous.position, mean_position) * 7.0 / nearest");
    let run = |environments: usize, parallel: bool| {
        let mut fleet = Fleet::new(environments, &wording).expect("a reward");
        fleet.batch.set_parallel(parallel);
        fleet
            .judge(Some(&vec![true; environments]))
            .expect("no error");
        for step in 0..5 {
            fleet.step(0.2 * f64::from(step)).expect("no error");
        }
        fleet.rewards[fleet.rewards.len() - ROBOTS..].to_vec()
    };
    let alone = run(1, false);
    assert!(alone.iter().all(|reward| *reward > 0.0));
    assert_eq!(alone, run(40, false));
    assert_eq!(alone, run(41, true));
}

#[test]
fn only_environments_that_begin_are_begun() {
    let mut fleet = Fleet::new(2, &reward("Float(previous.steps)")).expect("a reward");
    fleet.step(1.0).expect("no error");
    fleet.step(1.0).expect("no error");
    fleet.judge(Some(&[false, true])).expect("no error");
    let rewards = fleet.rewards.clone();
    assert_eq!(
        rewards, [1.0; 6],
        "an episode that begins does not touch rewards"
    );
    let pose = Pose::level(Point::planar(1.0, 1.0), 0.0);
    fleet
        .batch
        .place(1, &[pose, Pose::level(Point::planar(5.0, 5.0), 0.0), pose]);
    fleet.judge(Some(&[false, true])).expect("no error");
    fleet.step(1.0).expect("no error");
    assert_eq!(fleet.rewards, [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]);
}

#[test]
fn wrong_expressions_are_refused_at_their_places() {
    for (expression, part, found) in [
        ("1.0 + gaol.x", "gaol", "there is no `gaol`"),
        (
            "1.0 + touched",
            "1.0 + touched",
            "`+` does not apply to Float and Bool",
        ),
        (
            "if finished then 1.0 else 0.0",
            "finished",
            "an environment does not know `finished`",
        ),
        ("ranges[0]", "ranges", "a task cannot use `ranges`"),
        ("random(0.0, 1.0)", "random", "a task cannot call `random`"),
    ] {
        let error = Fleet::new(1, &reward(expression)).err().expect("an error");
        let problem = &error.problems[0];
        assert_eq!(error.part, "reward");
        assert_eq!(problem.span.of(expression), part, "{problem:?}");
        assert!(problem.message.starts_with(found), "{}", problem.message);
    }
    let wording = Wording {
        columns: vec![column("touched", Kind::Float, None)],
        ..reward("1.0")
    };
    let error = Fleet::new(1, &wording).err().expect("an error");
    assert_eq!(error.to_string(), "names: the name `touched` is taken");
}

#[test]
fn an_expression_that_fails_names_robot_and_environment() {
    let mut fleet =
        Fleet::new(3, &reward("1.0 + [1.0][if nearest > 2.0 then 1 else 0]")).expect("a reward");
    let error = fleet.step(1.0).expect_err("no element");
    assert_eq!(
        error,
        "reward: `[1.0][if nearest > 2.0 then 1 else 0]` fails for robot 2 in environment 0: index 1 is out of range 0..1"
    );
}
