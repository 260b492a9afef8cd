//! Functions that call the robot.

use starl_lang::machine::Value;

use super::support::{Robot, effect, robot, some, values};

#[test]
fn asking() {
    values(
        "",
        &[
            ("me", "robot1"),
            ("Int(me)", "1"),
            ("Float(Int(me) + 1) * 0.5", "1.0"),
            ("[Int(r) for r in peers by -Int(r)]", "[2, 1, 0]"),
            ("position", "(1.0, 2.0, 3.0)"),
            ("position.y + velocity.x", "2.25"),
            ("heading", "0.5"),
            ("peers.size()", "3"),
            ("way_points().size()", "3"),
            ("way_point(\"home\")", "none"),
            ("bumped", "none"),
            ("bumped == left", "false"),
            ("ranges.size()", "0"),
            ("detected.size()", "0"),
        ],
    );
}

#[test]
fn detections_have_fields() {
    let source = "program Test\ngo()\n    pre some side = bumped and side != both\n    eff\n        for d in detected\n            log(\"{} {} {}\", d.robot, d.thing ?? 0, d.position.x)\n        log(\"{}\", side)\n";
    let mut test = Robot::started(source);
    let detection = Value::Record(vec![
        ("robot".into(), some(robot(4))),
        ("thing".into(), Value::None),
        (
            "position".into(),
            Value::Point(starl_core::Point::planar(2.0, 0.0)),
        ),
    ]);
    test.world
        .answers
        .insert("detected".into(), Value::List(vec![detection]));
    test.world
        .answers
        .insert("bumped".into(), some(Value::Variant("right".into())));
    assert_eq!(test.action("go"), Ok(true));
    assert_eq!(test.told(), ["log(\"robot4 0 2.0\")", "log(\"right\")"]);
}

#[test]
fn telling() {
    let told = effect(
        "",
        "draw_point(\"a\", position)\ndraw_line(\"b\", way_points())\ndraw_circle(\"c\", Point(0.0, 0.0), 1m)\ndraw_text(\"d\", position)\ndraw_nothing(\"a\")\nstop()\nfinish()\nfail(\"lost \" + String(me))",
    );
    let path = "[(1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (4.0, 0.0, 0.0)]";
    assert_eq!(
        told.unwrap(),
        [
            "draw_point(\"a\", (1.0, 2.0, 3.0))".into(),
            format!("draw_line(\"b\", {path})"),
            "draw_circle(\"c\", (0.0, 0.0, 0.0), 1.0)".into(),
            "draw_text(\"d\", (1.0, 2.0, 3.0))".into(),
            "draw_nothing(\"a\")".into(),
            "stop()".into(),
            "finish()".into(),
            "fail(\"lost robot1\")".into(),
        ]
    );
}

#[test]
fn choosing_draws_an_index() {
    let source = "program Test
l: List[String] = [\"a\", \"b\", \"c\"]
o: List[Int?] = [none, 2]
go()
    eff
        log(\"{}\", choose(l))
        l = []
        log(\"{}\", choose(l))
        log(\"{}\", choose(o) ?? 5)
        log(\"{}\", choose([1, 2])! + 1)
";
    let mut test = Robot::started(source);
    test.world
        .answers
        .insert("random_int".into(), Value::Int(1));
    test.action("go").unwrap();
    assert_eq!(
        test.told(),
        [
            "random_int(0, 3)",
            "log(\"b\")",
            "log(\"none\")",
            "random_int(0, 2)",
            "log(\"2\")",
            "random_int(0, 2)",
            "log(\"3\")",
        ]
    );
}
