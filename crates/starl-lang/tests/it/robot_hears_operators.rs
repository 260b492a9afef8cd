//! A program handles the orders of operators for which it has inputs, and the event of changed waypoints.

use crate::robot_support::{World, compile};
use starl_core::event::Level;
use starl_core::{Event, Input, Order, Point, RobotId, Value, WayPoint};
use starl_lang::machine;

const STEERED: &str = r#"
program Steered

heard: List[String]

on input everything(flag: Bool, count: Int, speed: Float, text: String, place: Point, robot: RobotId, path: List[Point], robots: List[RobotId])
    heard.add(String(flag) + " " + String(count) + " " + String(speed) + " " + text + " " + String(place) + " " + String(robot) + " " + String(path) + " " + String(robots))

on input go(speed: Float)
    heard.add("go " + String(speed))

on input visit(path: List[Point])
    heard.add("visit " + String(path))

on input halt()
    heard.add("halt")
"#;

fn order(name: &'static str, fields: &[(&'static str, Value)]) -> Input {
    let fields = fields.iter();
    let fields = fields.map(|(name, value)| ((*name).into(), value.clone()));
    Input::Order(Order {
        name: name.into(),
        fields: fields.collect(),
    })
}

/// The inputs that the program handles for these orders, and the log meanwhile.
fn heard(orders: &[Input]) -> (String, Vec<(Level, String)>) {
    let mut world = World::of(&compile(STEERED), 1);
    for order in orders {
        world.input(0, order);
    }
    (world.get(0, "heard").to_string(), logged(&world))
}

fn logged(world: &World) -> Vec<(Level, String)> {
    let lines = world.events_of(0).filter_map(|event| match event {
        Event::Log { level, text } => Some((*level, text.to_string())),
        _ => None,
    });
    lines.collect()
}

#[test]
fn an_order_runs_the_handler_of_its_name_with_its_fields() {
    let path = vec![Point::planar(1.0, 2.0), Point::planar(3.0, 4.0)];
    let everything = order(
        "everything",
        &[
            ("robots", vec![RobotId(1), RobotId(0)].into()),
            ("path", path.into()),
            ("robot", RobotId(4).into()),
            ("place", Point::planar(0.5, 1.5).into()),
            ("text", "now".into()),
            ("speed", 0.25.into()),
            ("count", 7_i64.into()),
            ("flag", true.into()),
        ],
    );
    let (texts, log) = heard(&[everything, order("halt", &[])]);
    assert_eq!(
        texts,
        "[\"true 7 0.25 now (0.5, 1.5, 0.0) robot4 [(1.0, 2.0, 0.0), (3.0, 4.0, 0.0)] [robot1, robot0]\", \
         \"halt\"]"
    );
    assert_eq!(log, []);
}

#[test]
fn an_int_is_accepted_for_a_float() {
    let (texts, log) = heard(&[order("go", &[("speed", 2_i64.into())])]);
    assert_eq!((&texts[..], log), ("[\"go 2.0\"]", vec![]));
}

#[test]
fn an_empty_list_is_a_list_of_anything() {
    let none: Vec<RobotId> = Vec::new();
    let (texts, log) = heard(&[order("visit", &[("path", none.into())])]);
    assert_eq!((&texts[..], log), ("[\"visit []\"]", vec![]));
}

#[test]
fn fields_that_the_program_does_not_name_are_ignored() {
    let fields = [("why", "rain".into()), ("speed", 1.0.into())];
    let (texts, log) = heard(&[order("go", &fields)]);
    assert_eq!((&texts[..], log), ("[\"go 1.0\"]", vec![]));
}

#[test]
fn an_order_without_a_field_is_not_run_but_warned_of() {
    let (texts, log) = heard(&[order("go", &[("pace", 1.0.into())])]);
    let warning = "order `go` ignored: its field `speed` must be Float, but it is missing";
    assert_eq!(texts, "[]");
    assert_eq!(log, [(Level::Warning, warning.into())]);
}

#[test]
fn an_order_with_a_field_of_another_type_is_not_run_but_warned_of() {
    let robots = vec![RobotId(1)];
    let (texts, log) = heard(&[
        order("go", &[("speed", "fast".into())]),
        order("visit", &[("path", robots.into())]),
        order("visit", &[("path", Point::ZERO.into())]),
    ]);
    let warnings = [
        "order `go` ignored: its field `speed` must be Float, but it is String",
        "order `visit` ignored: its field `path` must be List[Point], but it is List[RobotId]",
        "order `visit` ignored: its field `path` must be List[Point], but it is Point",
    ];
    assert_eq!(texts, "[]");
    assert_eq!(log, warnings.map(|text| (Level::Warning, text.into())));
}

#[test]
fn an_order_without_a_handler_leaves_a_line_for_debugging() {
    let (texts, log) = heard(&[order("dance", &[])]);
    let line = "order `dance` ignored: it has no handler";
    assert_eq!(texts, "[]");
    assert_eq!(log, [(Level::Debug, line.into())]);
}

#[test]
fn a_program_without_that_input_ignores_changed_waypoints() {
    let (texts, log) = heard(&[order(Order::WAY_POINTS, &[])]);
    assert_eq!((&texts[..], log), ("[]", vec![]));
}

#[test]
fn only_the_handlers_of_the_present_role_do_something() {
    let text = r#"
program Roles

heard: List[String]

on input go(speed: Float)
    heard.add(String(speed))

role scout
    on input go(speed: Float)
        heard.add("scout " + String(speed))
        role = guard

role guard
    on input go(speed: Float)
        heard.add("guard " + String(speed))
"#;
    let mut world = World::of(&compile(text), 1);
    world.input(0, &order("go", &[("speed", 1.0.into())]));
    assert_eq!(
        world.get(0, "heard").to_string(),
        "[\"1.0\", \"scout 1.0\", \"guard 1.0\"]"
    );
    world.input(0, &order("go", &[("speed", 2.0.into())]));
    assert_eq!(
        world.get(0, "heard").to_string(),
        "[\"1.0\", \"scout 1.0\", \"guard 1.0\", \"2.0\", \"guard 2.0\"]"
    );
}

fn way_points(world: &mut World, places: &[f64]) {
    let way_point = |(index, x): (usize, &f64)| WayPoint {
        name: format!("w{index}"),
        position: Point::planar(*x, 0.0),
        group: 0,
    };
    world.way_points = places.iter().enumerate().map(way_point).collect();
    world.input(0, &order(Order::WAY_POINTS, &[]));
}

#[test]
fn a_program_handles_changed_waypoints() {
    let text = r#"
program Tour

changes: Int
last: Point?

on input way_points()
    changes += 1
    last = way_points().last()
"#;
    let mut world = World::of(&compile(text), 1);
    way_points(&mut world, &[1.0, 2.0]);
    way_points(&mut world, &[3.0]);
    assert_eq!(world.int(0, "changes"), 2);
    let last = machine::Value::Some(Box::new(machine::Value::Point(Point::planar(3.0, 0.0))));
    assert_eq!(world.get(0, "last"), last);
}

#[test]
fn changed_waypoints_wake_a_resting_program() {
    let text = r#"
program Count

seen: Int

count()
    pre seen < way_points().size()
    eff seen += 1
"#;
    let mut world = World::of(&compile(text), 1);
    world.steps(3);
    assert_eq!(world.int(0, "seen"), 0);
    way_points(&mut world, &[1.0, 2.0]);
    world.steps(3);
    assert_eq!(world.int(0, "seen"), 2);
}

#[test]
fn an_order_ends_the_rest_of_a_program() {
    let text = r#"
program Wait

ready: Bool
gone: Bool

on input go()
    ready = true

leave()
    pre ready and not gone
    eff gone = true
"#;
    let mut world = World::of(&compile(text), 1);
    world.steps(3);
    world.input(0, &order("go", &[]));
    world.step();
    assert_eq!(world.get(0, "gone"), machine::Value::Bool(true));
}

#[test]
fn a_run_time_error_in_a_handler_ends_the_program() {
    let text = r#"
program Divide

n: Int

on input divide(by: Int)
    n = 10 / by
"#;
    let mut world = World::of(&compile(text), 1);
    world.input(0, &order("divide", &[("by", 5_i64.into())]));
    assert_eq!(world.int(0, "n"), 2);
    world.input(0, &order("divide", &[("by", 0_i64.into())]));
    assert_eq!(world.failure(0), Some("divide.starl:7:9: division by zero"));
}

#[test]
fn an_order_waits_while_the_writes_of_an_action_are_stored() {
    let text = r#"
program Tally

allwrite[linearizable] sum: Int = 0
turn: Int
order: List[String]

on input add(what: String)
    order.add(what)

count()
    pre turn == 0
    eff
        atomic
            sum += 1
        turn = 1
        order.add("counted")
"#;
    let mut world = World::of(&compile(text), 3);
    let mut orders = 0;
    // Some order comes while the writes are stored, and must wait: it would change what the effect changes.
    while world.int(0, "turn") == 0 {
        assert!(orders < 10_000, "the action never takes place");
        let next = world.now + starl_core::Duration::from_millis(1);
        world.input(0, &order("add", &[("what", "more".into())]));
        orders += 1;
        world.run_before(next);
    }
    let texts = world.get(0, "order").to_string();
    assert_eq!(texts.matches("more").count(), orders, "no order is lost");
    assert!(texts.contains("\"counted\", \"more\""), "{texts}");
}

#[test]
fn a_program_that_has_not_started_hears_nothing() {
    let code = compile(STEERED);
    let program = crate::robot_support::program(&code);
    let mut world = World::unstarted(vec![program]);
    world.input(0, &order("halt", &[]));
    world.start();
    assert_eq!(world.get(0, "heard").to_string(), "[]");
}
