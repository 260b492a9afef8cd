//! `starl run --log` shows what programs log, as it happens.

use crate::support::*;

const TALK: &str = "\
program Talk
said: Int = 0
say()
    pre said < 2
    every 1s
    eff said += 1; log(\"said {}\", said)
stop_there()
    pre said == 2 and robot_name(me) == \"robot1\"
    eff fail(\"enough\")
done()
    pre said == 2 and robot_name(me) == \"robot0\"
    eff finish()
";

const SCENARIO: &str = "\
program = \"talk.starl\"
[[robots]]
model = \"create\"
start = [{ position = [0, 0] }, { position = [1, 0] }]
";

fn shown(test: &str, options: &[&str]) -> (i32, String) {
    let folder = folder(test);
    file(&folder, "talk.starl", TALK);
    file(&folder, "talk.toml", SCENARIO);
    let output = starl(
        &folder,
        &[&["run", "talk.toml", "--quiet"], options].concat(),
    );
    (status(&output), stderr(&output))
}

#[test]
fn lines_have_time_and_robot() {
    let (_, text) = shown("log_lines", &["--log"]);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5, "{text}");
    for robot in ["create0", "create1"] {
        let own: Vec<&&str> = lines.iter().filter(|line| line.contains(robot)).collect();
        assert!(
            own[0].contains(" s  ") && own[0].ends_with("said 1"),
            "{text}"
        );
        assert!(own[1].ends_with("said 2"), "{text}");
    }
    assert!(
        text.contains("error: ") && text.contains("enough"),
        "{text}"
    );
    assert_eq!(shown("log_none", &[]).1, "");
}

#[test]
fn levels_and_robots_are_chosen() {
    let (_, errors) = shown("log_errors", &["--log=error"]);
    assert_eq!(errors.lines().count(), 1, "{errors}");
    assert!(
        errors.contains("create1") && errors.contains("enough"),
        "{errors}"
    );
    let (_, one) = shown("log_one", &["--log", "--log-robots", "create0"]);
    assert_eq!(one.lines().count(), 2, "{one}");
    assert!(!one.contains("create1"), "{one}");
}

#[test]
fn an_unknown_robot_is_refused() {
    let (status, text) = shown("log_unknown", &["--log", "--log-robots", "create7"]);
    assert_eq!(
        (status, text.as_str()),
        (
            2,
            "error: --log-robots: there is no robot create7; did you mean `create0`?\n"
        )
    );
    assert_eq!(shown("log_alone", &["--log-robots", "create0"]).0, 2);
    assert_eq!(shown("log_level", &["--log=loud"]).0, 2);
}
