//! A campaign gives the same results in every process that holds its plan, its smaller scenarios included.

use starl_catalog::programs::Registry;
use starl_catalog::read;
use starl_catalog::trial::{Answers, Shrinking, Subject};
use starl_core::FileError;
use starl_sim::Finding;
use starl_sim::profile::Profile;
use starl_sim::read::{Loader, Request, Source};
use starl_sweep::{Attempt, Campaign, CampaignPlan, Settings};

const SCENARIO: &str = r#"
program = "hasty.starl"
duration = "20s"

[[robots]]
model = "create"
count = 3
start = [{ position = [0, 0] }, { position = [1, 0] }, { position = [2, 0] }]
"#;

const HASTY: &str = "program Hasty

message Word(count: Int)

radio = Broadcast()
heard: Int = 0
spoken: Int = 0

invariant shy: heard < 5

speak()
    pre spoken < 10
    eff radio.broadcast(Word(spoken)); spoken += 1

rest()
    pre spoken >= 10
    eff finish()

on Word(_, _)
    heard += 1
";

struct Files;

impl Loader for Files {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match path {
            "hasty.starl" => Ok(HASTY.as_bytes().to_vec()),
            _ => Err(FileError::Missing),
        }
    }
}

fn subject(scenario: &str) -> Subject {
    let request = Request::new(Source::new("s.toml", scenario));
    let application = read(&request, &Files, &Registry::default()).expect("it can be read");
    Subject::new(&application, false).expect("it can be started")
}

fn campaign() -> Campaign {
    let race = SCENARIO.replace("hasty.starl", "race");
    let settings = Settings {
        profiles: vec![Profile::Calm, Profile::Lossy, Profile::Crashes],
        first_seed: 3,
        seeds: 2,
        most_trials: 40,
    };
    Campaign::new(vec![subject(SCENARIO), subject(&race)], settings)
}

/// The campaign as another process has it.
fn elsewhere(campaign: &Campaign) -> Campaign {
    let text = serde_json::to_string(&campaign.plan()).expect("plain data");
    let plan: CampaignPlan = serde_json::from_str(&text).expect("it was written");
    Campaign::of_plan(plan, &Registry::default()).expect("the programs are known")
}

/// The result without what the machine decides.
fn plain(attempt: Attempt) -> Attempt {
    let text = serde_json::to_string(&attempt).expect("plain data");
    let again: Attempt = serde_json::from_str(&text).expect("it was written");
    assert_eq!(again, attempt);
    Attempt {
        cpu_seconds: 0.0,
        ..attempt
    }
}

#[test]
fn every_run_is_numbered_once() {
    let campaign = campaign();
    assert_eq!(campaign.runs(), 12);
    let mut all: Vec<_> = (0..12).map(|number| campaign.at(number)).collect();
    assert_eq!(all[0], (0, Profile::Calm, 3));
    assert_eq!(all[11], (1, Profile::Crashes, 4));
    all.dedup();
    assert_eq!(all.len(), 12);
    assert!(all.is_sorted());
}

#[test]
fn a_run_is_the_same_in_another_process() {
    let here = campaign();
    let there = elsewhere(&here);
    for number in 0..here.runs() {
        assert_eq!(plain(here.attempt(number)), plain(there.attempt(number)));
    }
    assert_eq!(
        here.attempt(0).finding,
        Some(Finding::Violated("Hasty.shy".into()))
    );
}

#[test]
fn a_smaller_scenario_that_was_found_elsewhere_is_taken_without_trying() {
    let here = campaign();
    let found = elsewhere(&here).shrink(0);
    assert!(found.len() > 3 && found == here.shrink(0));
    let smaller = |known: Answers| {
        let finding = here.attempt(0).finding.expect("it goes wrong");
        let same = |program: &str| program.to_string();
        let key = (Profile::Calm, 3);
        let shrinking = Shrinking::new(&here.subjects()[0], key, finding, String::new(), &same);
        let mut tried = 0;
        let smaller = shrinking.after(known).search(40, &Files, &mut |_| {
            tried += 1;
            true
        });
        (smaller.expect("it fails again").text, tried)
    };
    let (alone, tried) = smaller(Answers::new());
    assert!(tried > 3, "{tried}");
    assert_eq!(smaller(found), (alone, 0));
}

#[test]
fn a_run_without_a_failure_leaves_nothing_to_shrink() {
    let campaign = campaign();
    let calm = (0..campaign.runs()).find(|number| campaign.attempt(*number).finding.is_none());
    assert_eq!(campaign.shrink(calm.expect("the race is won")), []);
}
