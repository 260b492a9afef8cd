//! A run that front ends hold in memory can be written as a trace, and opened again from it.

use starl_catalog::programs::Registry;
use starl_catalog::session::{Budget, Files, Options, Recorded, Session};
use starl_core::intervention::FaultKind;
use starl_core::{Duration, Event, Intervention, RobotId, Time};
use starl_trace::Trace;

const END: Time = Time(8_000_000_000);

fn run_to(session: &mut Session, until: Time) {
    let budget = Budget {
        until,
        ..Budget::default()
    };
    session.advance(budget, None);
}

/// A race in which a robot is steered.
fn steered() -> Session {
    let options = Options {
        scenario: Some("race".to_string()),
        seed: Some("11".to_string()),
        set: vec!["network.loss=0.1".to_string()],
        ..Options::default()
    };
    let session = Session::open(&Files::default(), &options, &Registry::default());
    let mut session = session.unwrap_or_else(|refused| panic!("{}", refused.message));
    run_to(&mut session, Time(2_000_000_000));
    let robots = || vec![RobotId(1)];
    let crash = Intervention::Fault(FaultKind::Crash(robots()));
    let restart = Intervention::Fault(FaultKind::Restart(robots()));
    session.apply(Time::ZERO, crash).expect("it can crash");
    let later = session.run().simulation().now() + Duration::from_seconds(2);
    session.apply(later, restart).expect("it can restart");
    run_to(&mut session, END);
    session
}

fn interventions(trace: &Trace) -> Vec<(u64, Intervention)> {
    let records = trace.records.iter();
    let steered = records.filter_map(|record| match &record.event {
        Event::Intervention(what) => Some((record.at.0, (**what).clone())),
        _ => None,
    });
    steered.collect()
}

#[test]
fn a_trace_ends_with_the_digest_of_its_session() {
    let session = steered();
    let trace = starl_trace::read(&session.trace().expect("it can be written")).expect("a trace");
    let report = session.report();
    let digest = format!("{:016x}", trace.summary.outcome.digest);
    assert_eq!(digest, report.digest);
    assert_eq!(trace.summary.outcome.outcome, "interrupted");
    assert_eq!(interventions(&trace).len(), 2);
}

#[test]
fn the_run_of_a_trace_is_steered_as_it_was() {
    let session = steered();
    let trace = starl_trace::read(&session.trace().expect("it can be written")).expect("a trace");
    let recorded = Recorded {
        interventions: interventions(&trace),
        scenario: trace.header.scenario,
        files: trace.header.files,
    };
    let again = Session::open_recorded(recorded, &Registry::default());
    let mut again = again.unwrap_or_else(|refused| panic!("{}", refused.message));
    run_to(&mut again, END);
    assert_eq!(again.report().digest, session.report().digest);
    let once_more = again.trace().expect("it can be written");
    assert_eq!(once_more, session.trace().expect("it can be written"));
}

#[test]
fn a_trace_without_its_inputs_is_refused() {
    let recorded = Recorded {
        scenario: String::new(),
        files: [].into(),
        interventions: Vec::new(),
    };
    let refused = Session::open_recorded(recorded, &Registry::default()).err();
    let message = refused.map(|refused| refused.message);
    assert_eq!(
        message.as_deref(),
        Some("the recorded run cannot be run again: it holds no options.json")
    );
}
