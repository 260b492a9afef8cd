//! Participants that are `peers` are the fleet, robots that join later too, though each robot's `peers` were another set
//! when it started.

use crate::support::memory::{Memory, application};
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{Event, RobotId};

const PROGRAM: &str = "\
program Turns

lock = Mutex(\"m\", peers, ALGORITHM)
waits: Bool = false

want()
    pre not waits
    eff
        lock.acquire({\"x\"})
        waits = true

leave()
    pre waits and lock.held({\"x\"})
    eff
        lock.release()
        waits = false
";

const SCENARIO: &str = r#"
program = "turns.starl"
duration = "40s"
goal = "duration"

[network]
loss = 0.1

[[robots]]
model = "create"
start = [{ position = [0, 0] }, { position = [1, 0] }, { position = [2, 0] }]

[[event]]
kind = "join"
like = "create0"
name = "late"
position = [3, 1]
at = "5s"
"#;

const LATE: RobotId = RobotId(3);

#[test]
fn a_robot_that_joins_has_its_turns_and_no_other_at_once() {
    for algorithm in ["permission", "quorum", "lease"] {
        let program = PROGRAM.replace("ALGORITHM", algorithm);
        for seed in 1..=8 {
            let files = Memory::of(&[("turns.starl", program.as_bytes())]);
            let scenario = format!("seed = {seed}\n{SCENARIO}");
            let application =
                application(&scenario, &files).unwrap_or_else(|refusal| panic!("{refusal}"));
            let mut run = application.run().unwrap();
            let mut turns = 0;
            while !run.is_over() {
                turns += run
                    .step()
                    .iter()
                    .filter(|record| record.robot == Some(LATE) && is_entry(&record.event))
                    .count();
            }
            assert_eq!(run.violations(), [], "{algorithm}, seed {seed}");
            assert!(turns > 0, "{algorithm}, seed {seed}: no turn");
        }
    }
}

fn is_entry(event: &Event) -> bool {
    let Event::Primitive { event, .. } = event else {
        return false;
    };
    matches!(event, PrimitiveEvent::Mutex(MutexEvent::Enter { .. }))
}
