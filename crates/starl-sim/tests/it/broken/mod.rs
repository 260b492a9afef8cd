//! Textbook algorithms with a mistake in each, and the hunt for it: from random seeds to the smallest
//! scenario that still shows it, in a file that runs to the same violation.

pub mod election;
pub mod mutex;
pub mod writes;

use starl_core::{Duration, FileError, Point, Pose, Program, Time};
use starl_motion::models;
use starl_sim::read::{self, Request, Source};
use starl_sim::scenario::{Clock, Group, SensorSuite};
use starl_sim::shrink::{Limits, shrink};
use starl_sim::{Finding, Profile, Run, Scenario, Trial, write};

/// This number of robots that stand in a row for half a minute.
pub fn robots(count: usize) -> Scenario {
    let pose = |index| Pose::level(Point::planar(index as f64, 0.0), 0.0);
    let mut scenario = Scenario {
        goal: starl_sim::scenario::Goal::Duration,
        duration: Duration::from_seconds(30),
        ..Scenario::default()
    };
    scenario.fleet.groups.push(Group {
        name: "robot".into(),
        numbered: true,
        first_number: 0,
        model: models::by_name("create").expect("there is this model"),
        program: "broken".into(),
        parameters: Default::default(),
        starts: (0..count).map(pose).collect(),
        control_period: Duration::from_millis(100),
        sensors: SensorSuite::default(),
        clock: Clock::default(),
    });
    scenario
}

/// The failure, and the result of shrinking.
pub struct Quarry {
    /// As it was found.
    pub found: Scenario,
    /// As small as it can be.
    pub smallest: Scenario,
    /// The smallest as a file.
    pub text: String,
}

/// A scenario as it is read from a file.
pub fn read(text: &str) -> Option<Scenario> {
    struct NoFiles;
    impl read::Loader for NoFiles {
        fn load(&self, _: &str) -> Result<Vec<u8>, FileError> {
            Err(FileError::Missing)
        }
    }
    let request = Request::new(Source::new("saved.toml", text));
    let resolved = read::scenario(&request, &NoFiles).ok()?;
    Some(resolved.scenario)
}

/// The result of a run.
pub fn trial(scenario: Scenario, program: &(impl Program + Clone + 'static)) -> Trial {
    let mut run = Run::new(scenario, &|_| Ok(Box::new(program.clone()))).expect("the run starts");
    Trial::of(&mut run, false)
}

/// Runs the program with the seeds from 1 on until the property is violated, and shrinks that.
pub fn hunt(
    scenario: &Scenario,
    profile: Profile,
    property: &'static str,
    program: &(impl Program + Clone + 'static),
) -> Quarry {
    let finding = Some(Finding::Violated(property.into()));
    let mut drawn = (1..=500).map(|seed| profile.apply(scenario, scenario.duration, seed));
    let found = drawn
        .find(|drawn| trial(drawn.clone(), program).finding == finding)
        .unwrap_or_else(|| panic!("{property} holds for 500 seeds"));
    // The candidate fails as read from the file that it is written to.
    let again = |candidate: &Scenario| Some(trial(read(&write::scenario(candidate))?, program));
    let mut fails = |candidate: &Scenario| -> Option<Time> {
        let trial = again(candidate)?;
        (trial.finding == finding).then_some(trial.end)
    };
    let shrunk = shrink(&found, Limits::default(), true, &mut fails);
    let shrunk = shrunk.expect("what was found fails again");
    assert!(shrunk.is_minimal, "the search was cut short");
    let text = write::scenario(&shrunk.scenario);
    let replayed = again(&shrunk.scenario).expect("it can be read");
    assert_eq!(replayed.finding, finding);
    println!("{text}\n{} after {} tries", replayed.text, shrunk.trials);
    Quarry {
        found,
        smallest: shrunk.scenario,
        text,
    }
}
