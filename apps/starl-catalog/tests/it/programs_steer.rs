//! Programs in the language command the models themselves: the robot moves as under the same command from Rust.

use crate::support::memory::{Memory, application};
use starl_core::{Event, Point, Pose, RobotId, Time};
use starl_sim::Run;

const WHILE: Time = Time(3_000_000_000);

/// A run of one robot of a model, for three seconds.
fn run(model: &str, height: f64, program: &str, files: Memory) -> Run {
    let scenario = format!(
        "duration = \"4s\"\n{program}\n[[robots]]\nmodel = \"{model}\"\nstart = [{{ position = [0, 0, {height}] }}]\n\
         [[world.way_point]]\nname = \"east\"\nposition = [2, 0]\n"
    );
    let application = application(&scenario, &files).unwrap_or_else(|refusal| panic!("{refusal}"));
    let mut run = application.run().unwrap();
    while run.simulation().now() < WHILE {
        run.step();
    }
    assert!(run.failures().is_empty(), "{:?}", run.failures());
    run
}

fn pose(run: &Run) -> Pose {
    run.simulation().state(RobotId(0)).pose
}

/// Gives this command at every activation.
fn in_the_language(model: &str, call: &str) -> Run {
    from_height(model, 0.0, call)
}

fn from_height(model: &str, height: f64, call: &str) -> Run {
    let program = format!("program Steers\n\nsteer()\n    eff {call}\n");
    let files = Memory::of(&[("steers.starl", program.as_bytes())]);
    run(model, height, "program = \"steers.starl\"", files)
}

#[test]
fn each_command_moves_a_robot_as_it_does_from_rust() {
    let cases = [
        (
            "create",
            "drive_wheels(0.2, 0.1)",
            "wheels",
            "left = 0.2\nright = 0.1",
        ),
        (
            "create",
            "drive_straight(0.2)",
            "wheels",
            "left = 0.2\nright = 0.2",
        ),
        (
            "differential",
            "drive_wheels(-0.1, 0.1)",
            "wheels",
            "left = -0.1\nright = 0.1",
        ),
        (
            "car",
            "drive_car(0.5, 0.2)",
            "steer",
            "speed = 0.5\nangle = 0.2",
        ),
        (
            "holonomic",
            "drive_velocity(Point(0.4, 0.0), 0.3)",
            "velocity",
            "speed = 0.4\nyaw_rate = 0.3",
        ),
        (
            "holonomic",
            "drive_velocity(Point(0.4, 0.0))",
            "velocity",
            "speed = 0.4",
        ),
        (
            "drone",
            "drive_attitude(0.1, 0.05, -0.02, 0.3)",
            "attitude",
            "yaw_rate = 0.1\npitch = 0.05\nroll = -0.02\nclimb = 0.3",
        ),
    ];
    for (model, call, command, parameters) in cases {
        // A drone on the ground flies in no attitude.
        let height = if model == "drone" { 1.0 } else { 0.0 };
        let own = pose(&from_height(model, height, call));
        let program =
            format!("program = \"drive\"\n[parameters]\ncommand = \"{command}\"\n{parameters}");
        let same = pose(&run(model, height, &program, Memory::default()));
        assert_eq!(own, same, "{call}");
        let moved = own.position.at_height(0.0).distance(Point::ZERO);
        assert!(moved > 0.01 || own.yaw != 0.0, "{call}: {own:?}");
    }
}

#[test]
fn a_robot_turns_and_drives_in_circles() {
    let turned = pose(&in_the_language("create", "drive_turn(0.5)"));
    assert!(turned.position.x.abs() < 1e-9, "{turned:?}");
    assert!((turned.yaw - 1.5).abs() < 0.2, "{turned:?}");
    let left = pose(&in_the_language("create", "drive_curve(0.2, 0.5)"));
    let right = pose(&in_the_language("create", "drive_curve(0.2, -0.5)"));
    assert!(
        left.position.y > 0.1 && right.position.y < -0.1,
        "{left:?} {right:?}"
    );
}

#[test]
fn a_drone_takes_off_hovers_and_lands() {
    let up = pose(&in_the_language("drone", "take_off()")).position.z;
    assert!(up > 0.3, "{up} m");
    let kept = "if position.z < 40cm then take_off() else hover()";
    let kept = pose(&in_the_language("drone", kept)).position.z;
    assert!((0.3..up).contains(&kept), "{kept} m");
    let down = pose(&in_the_language(
        "drone",
        "if position.z > 40cm then land() else take_off()",
    ));
    assert!(down.position.z < kept, "{} m", down.position.z);
}

#[test]
fn a_command_that_the_model_refuses_stops_the_robot_and_is_logged() {
    for (model, call) in [
        ("car", "drive_wheels(0.2, 0.2)"),
        ("create", "drive_straight(0.0 / 0.0)"),
        ("create", "drive_straight(1.0 / 0.0)"),
        ("create", "drive_curve(0.2, 0.0)"),
    ] {
        let mut run = in_the_language(model, call);
        assert_eq!(pose(&run), Pose::default(), "{call}");
        let warned = |event: &Event| matches!(event, Event::Log { text, .. } if text.contains("does not take"));
        let warnings = (0..20).filter(|_| run.step().iter().any(|record| warned(&record.event)));
        assert!(warnings.count() > 0, "{call}");
    }
}

/// Drives off while it is on a trip to the east.
const TURNS_BACK: &str = "program Back

motion = ReachAvoid()
gone: Bool = false

go()
    pre not gone
    eff motion.reach_avoid(way_points()[0], obstacles()); gone = true

turn_back()
    pre gone and position.x > 30cm
    eff drive_velocity(Point(-0.5, 0.0)); log(\"{}\", motion.active)
";

#[test]
fn a_command_ends_a_trip() {
    let files = Memory::of(&[("back.starl", TURNS_BACK.as_bytes())]);
    let run = run("holonomic", 0.0, "program = \"back.starl\"", files);
    let x = pose(&run).position.x;
    // The command holds when its action no longer fires; a trip would continue to the east.
    assert!(x < -0.3, "it is at {x} m");
}
