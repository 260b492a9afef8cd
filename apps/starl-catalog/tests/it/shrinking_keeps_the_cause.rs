//! A smaller scenario fails for the reason of the original: nothing is in its causal past that is not in the other.

use starl_catalog::programs::Registry;
use starl_catalog::trial::{Shrinking, Subject};
use starl_core::{FileError, RobotId};
use starl_sim::Finding;
use starl_sim::profile::Profile;
use starl_sim::read::{Loader, Request, Source};
use starl_sim::scenario::FaultKind;

const SCENARIO: &str = r#"
program = "watch.starl"
duration = "20s"
goal = "duration"

[[robots]]
model = "create"
start = [
    { position = [0, 0] }, { position = [1, 0] }, { position = [2, 0] },
    { position = [3, 0] }, { position = [4, 0] }, { position = [5, 0] },
]

[[fault]]
kind = "crash"
robots = ["create5"]
at = "5s"
"#;

/// A robot that is down alarms the others, by an action that depends on the size of the fleet.
const WATCH: &str = "\
program Watch

detector = FailureDetector()
alarmed: Bool = false

many()
    pre not alarmed and peers.size() > 3 and detector.suspects.size() > 0
    eff alarmed = true

few()
    pre not alarmed and peers.size() <= 3 and detector.suspects.size() > 0
    eff alarmed = true

invariant quiet: not alarmed
";

struct OneFile(String);

impl Loader for OneFile {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match path {
            "watch.starl" => Ok(self.0.as_bytes().to_vec()),
            _ => Err(FileError::Missing),
        }
    }
}

/// How many robots the smallest scenario has that fails as the fleet of six does.
fn smallest_fleet(program: String) -> usize {
    let files = OneFile(program);
    let registry = Registry::default();
    let request = Request::new(Source::new("s.toml", SCENARIO));
    let application = starl_catalog::read(&request, &files, &registry)
        .unwrap_or_else(|refusal| panic!("{refusal}"));
    let subject = Subject::new(&application, false).expect("it can be started");
    let finding = Finding::Violated("Watch.quiet".into());
    let same = |program: &str| program.to_string();
    let key = (Profile::Calm, 1);
    let mut shrinking = Shrinking::new(&subject, key, finding, String::new(), &same);
    let found = shrinking.search(1_000, &files, &mut |_| true);
    let found = found.expect("it fails");
    assert!(found.is_minimal);
    let faults = &found.scenario.faults.schedule;
    assert_eq!(faults.len(), 1);
    let robots = found.scenario.fleet.len();
    assert_eq!(
        faults[0].kind,
        FaultKind::Crash(vec![RobotId(robots as u32 - 1)])
    );
    robots
}

#[test]
fn a_smaller_fleet_does_not_fail_by_an_action_that_the_original_did_not_take() {
    assert_eq!(smallest_fleet(WATCH.to_string()), 4);
}

#[test]
fn a_smaller_fleet_may_fail_by_the_same_action() {
    let one_action = WATCH.replace("peers.size() > 3 and", "");
    // Two robots would be no majority once one of them is down.
    assert_eq!(smallest_fleet(one_action), 3);
}
