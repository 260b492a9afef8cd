//! Steps in the files of counterexamples keep their form, so that old files can still be replayed.

use starl_core::timer::Token;
use starl_core::{Port, RobotId, TimerKey};
use starl_explore::Step;

#[test]
fn a_timer_is_written_with_its_port_kind_and_number() {
    let key = TimerKey {
        port: Port(3),
        token: Token::new(1, 7),
    };
    let step = Step::Timer(RobotId(2), key);
    let text = r#"{"timer":[2,{"port":3,"kind":1,"number":7}]}"#;
    assert_eq!(serde_json::to_string(&step).unwrap(), text);
    assert_eq!(serde_json::from_str::<Step>(text).unwrap(), step);
}
