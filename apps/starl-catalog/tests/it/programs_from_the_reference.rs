//! Eight kinds of program that textbooks and Koord's examples have, each short, and each holding its properties under
//! every profile of faults.

use crate::support::code_lines;
use rayon::prelude::*;
use starl_catalog::trial::Subject;
use starl_core::FileError;
use starl_sim::profile::Profile;
use starl_sim::read::{Loader, Request, Source};

/// Reads the files of the folder `programs`.
struct Folder;

impl Loader for Folder {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/programs");
        std::fs::read(format!("{folder}/{path}"))
            .map_err(|error| FileError::Unreadable(error.to_string()))
    }
}

fn text(path: &str) -> String {
    let bytes = Folder.load(path).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Tries a program under every profile with this number of seeds.
fn holds(name: &str, seeds: u64) {
    let lines = code_lines(&text(&format!("{name}.starl")));
    assert!(lines <= 40, "{name} has {lines} lines of code");
    let scenario = format!("{name}.toml");
    let request = Request::new(Source::new(&scenario, text(&scenario)));
    let application = starl_catalog::read(&request, &Folder, &Default::default())
        .unwrap_or_else(|refusal| panic!("{refusal}"));
    let subject = Subject::new(&application, false).unwrap();
    let cases = Profile::ALL
        .into_iter()
        .flat_map(|profile| (1..=seeds).map(move |seed| (profile, seed)));
    cases
        .collect::<Vec<_>>()
        .into_par_iter()
        .for_each(|(profile, seed)| {
            let (_, trial) = subject.try_out(profile, seed);
            assert_eq!(
                trial.finding, None,
                "{name}, {profile:?}, seed {seed}: {}",
                trial.text
            );
        });
}

#[test]
fn addition() {
    holds("addition", 4);
}

#[test]
fn leader_by_shared_memory() {
    holds("leader", 4);
}

#[test]
fn moving_ring() {
    holds("ring", 1);
}

#[test]
fn deliveries() {
    holds("deliveries", 1);
}

#[test]
fn patrol_with_charging_docks() {
    holds("patrol", 1);
}

#[test]
fn graph_colouring() {
    holds("colouring", 4);
}

#[test]
fn scouts_and_collectors() {
    holds("foragers", 1);
}

#[test]
fn gossip_averaging() {
    holds("gossip", 4);
}
