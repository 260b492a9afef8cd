//! Every robot of every example can be replayed from its journal alone, with every kind of fault in the run.

use rayon::prelude::*;
use starl_catalog::Application;
use starl_catalog::examples::{EXAMPLES, Example};
use starl_catalog::programs::Registry;
use starl_core::{Duration, Time};
use starl_host::journal::{Packer, Reader};
use starl_host::{Observed, Replayer};
use starl_sim::profile::Profile;
use starl_sim::read::Request;

/// How long runs are at the longest.
const SPAN: Duration = Duration::from_seconds(12);

/// The history of the robots of a run.
#[derive(Debug, Default)]
struct Account {
    entries: u64,
    restarts: u32,
    corruptions: u32,
}

/// Runs an example with faults and replays each of its robots; panics at the first difference.
fn account(example: &'static Example, profile: Profile, seed: u64) -> Account {
    let application = starl_catalog::read(
        &Request::new(example.source()),
        example,
        &Registry::default(),
    )
    .unwrap();
    let scenario = profile.apply(application.scenario(), SPAN, seed);
    let mut run = application.run_of(scenario).unwrap();
    run.set_journal(true);
    let mut packer = Packer::default();
    let mut messages = Vec::new();
    while !run.is_over() && run.simulation().now() < Time::ZERO + SPAN {
        run.advance();
        messages.extend(packer.pack(run.simulation().journal()));
    }
    let mut account = Account::default();
    for &robot in run.simulation().robots() {
        let place = format!("{} {} {seed}: robot {robot}", example.name, profile.name());
        let replayer = replay(&application, &messages, robot, &place, &mut account);
        account.entries += replayer.entries();
        account.restarts += replayer.lives().saturating_sub(1);
    }
    account
}

fn replay(
    application: &Application,
    messages: &[(Time, Vec<u8>)],
    robot: starl_core::RobotId,
    place: &str,
    account: &mut Account,
) -> Replayer {
    let mut replayer = Replayer::new(application.program_of(robot).unwrap());
    let mut reader = Reader::new(robot);
    for (start, message) in messages {
        let mut see = |at, observed: Observed<'_>| {
            account.corruptions += u32::from(matches!(observed, Observed::Corrupted { .. }));
            if let Err(departure) = replayer.observe(at, observed) {
                panic!("{place} at {at}: {departure:#?}");
            }
        };
        reader.read(*start, message, &mut see).unwrap();
    }
    replayer
}

fn all(profile: Profile, seeds: u64) -> Account {
    let jobs = EXAMPLES
        .iter()
        .flat_map(|example| (1..=seeds).map(move |seed| (example, seed)));
    let jobs: Vec<_> = jobs.collect();
    let accounts = jobs.into_par_iter().map(|(example, seed)| {
        let account = account(example, profile, seed);
        assert!(account.entries > 100, "{}: {account:?}", example.name);
        account
    });
    accounts.reduce(Account::default, |a, b| Account {
        entries: a.entries + b.entries,
        restarts: a.restarts + b.restarts,
        corruptions: a.corruptions + b.corruptions,
    })
}

#[test]
fn when_all_is_well() {
    all(Profile::Calm, 1);
}

#[test]
fn in_chaos() {
    let account = all(Profile::Chaos, 2);
    assert!(account.restarts > 20, "{account:?}");
}

#[test]
fn over_crashes_and_restarts() {
    let account = all(Profile::Crashes, 2);
    assert!(account.restarts > 20, "{account:?}");
}

#[test]
fn over_corruption() {
    let account = all(Profile::Corruption, 2);
    assert!(account.corruptions > 20, "{account:?}");
}
