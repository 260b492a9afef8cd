//! A scenario's goal may be a condition over the robots, in the language of their programs.

use starl_catalog::{Application, Refusal};
use starl_core::{Duration, FileError, Time};
use starl_sim::Outcome;
use starl_sim::read::{Loader, Request, Source};

const COUNTER: &str = "\
program Counter
count: Int = 0
up()
    every 1s
    eff count += 1
";

struct OneFile;

impl Loader for OneFile {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match path {
            "counter.starl" => Ok(COUNTER.as_bytes().to_vec()),
            _ => Err(FileError::Missing),
        }
    }
}

/// Two robots that count seconds, one of them from `crash` on no more.
fn read(goal: &str, crash: &str) -> Result<Application, Refusal> {
    let scenario = format!(
        "program = \"counter.starl\"\nduration = \"20s\"\ngoal = {goal:?}\n\
         [[robots]]\nmodel = \"create\"\nstart = [{{ position = [0, 0] }}, {{ position = [1, 0] }}]\n{crash}"
    );
    let request = Request::new(Source::new("run.toml", scenario));
    starl_catalog::read(&request, &OneFile, &Default::default())
}

fn end(goal: &str, crash: &str) -> (Outcome, Time) {
    let application = read(goal, crash).unwrap_or_else(|refusal| panic!("{refusal}"));
    let mut run = application.run().unwrap();
    while !run.is_over() {
        run.advance();
    }
    (run.outcome(), run.simulation().now())
}

#[test]
fn a_run_ends_when_its_condition_becomes_true() {
    for goal in [
        "forall r: r.count == 5",
        "exists r: r.count >= 5",
        "count == 5",
    ] {
        let (outcome, at) = end(goal, "");
        assert_eq!(outcome, Outcome::Reached, "{goal}");
        assert!((4.0..6.0).contains(&at.seconds()), "{goal}: {at}");
    }
}

#[test]
fn a_condition_that_stays_false_times_out() {
    for goal in [
        "forall r: r.count == 50",
        "exists r: r.count < 0",
        "count == 50",
    ] {
        assert_eq!(
            end(goal, ""),
            (Outcome::TimedOut, Time::ZERO + Duration::from_seconds(20)),
            "{goal}"
        );
    }
}

#[test]
fn robots_that_are_down_do_not_keep_the_others_from_the_goal() {
    let crash = "[[fault]]\nat = \"2s\"\nkind = \"crash\"\nrobots = [\"create1\"]\n";
    assert_eq!(end("forall r: r.count >= 5", crash).0, Outcome::Reached);
    assert_eq!(
        end("exists r: r.count >= 5 and crashed == 1", crash).0,
        Outcome::Reached
    );
}

#[test]
fn a_wrong_condition_is_blamed_on_the_scenario() {
    let message = |goal| {
        read(goal, "")
            .err()
            .map(|refusal| refusal.to_string())
            .unwrap_or_default()
    };
    let unknown = message("forall r: r.counted == 5");
    assert!(
        unknown.starts_with("run.toml:3:8: goal: \"forall r: r.counted == 5\": "),
        "{unknown}"
    );
    assert!(
        message("count + 1").contains("wrong type"),
        "{}",
        message("count + 1")
    );
    assert!(
        message("finish").contains("did you mean `finished`?"),
        "{}",
        message("finish")
    );
}

#[test]
fn a_scenario_that_was_written_has_the_same_goal() {
    let application = read("forall r: r.count == 5", "").unwrap();
    let written = starl_sim::write::scenario(application.scenario());
    assert!(
        written.contains("goal = \"forall r: r.count == 5\""),
        "{written}"
    );
}
