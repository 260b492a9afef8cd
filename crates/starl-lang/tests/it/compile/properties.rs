//! Properties: attributes of robots, and claims.

use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::Code;
use starl_lang::machine::{Claim, Fault, Value};

use super::support::{Robot, robot};

const SOURCE: &str = "program Test
enum Location {idle, busy}
record Goal {at: Point, names: List[String]}
param gap: Float = 0.5
const patience = 2min
loc: Location = idle
count: Int
goal: Goal
names: Set[String]
friend: RobotId = me
next: Int?
go()
    eff
        count += 1
        loc = busy
        names.add(\"x\")
        goal.names.add(\"y\")
        friend = me
        next = 1
invariant own: count >= 0 and loc != busy
always pairs: forall r, s: r == s or distance(r.position, s.position) > gap
always nested: forall r: forall s: r.id == s.id or r.names.intersection(s.names).size() == 0
always someone: exists r: r.loc == busy
always deep: forall r: r.goal.at.y < 1.0 and (r.goal.names.size() == 0 or r.next! > 0)
always each: forall r: exists s: s.friend == r.id
eventually done: forall r: r.finished or not r.up within patience * 2
eventually open: exists r, s: r.id < s.id and r.count == s.count
always answered: exists r: r.loc == busy leads_to forall r: r.loc == idle within 30s
always moving: heading < 1.0 and velocity.x > 0.0 and id == me_of(id)
function me_of(r: RobotId) -> RobotId = r
";

fn fleet() -> Robot {
    let mut test = Robot::started(SOURCE);
    for number in 0..3 {
        test.world.states.insert(number, test.state.clone());
        let at = Value::Point(starl_core::Point::planar(f64::from(number), 0.0));
        test.world
            .answers
            .insert(format!("robot.position(robot{number})"), at);
        test.world
            .answers
            .insert(format!("robot.up(robot{number})"), Value::Bool(true));
        test.state.clone_from(&test.world.states[&number]);
        test.set("friend", &robot((number + 1) % 3));
        test.world.states.insert(number, test.state.clone());
    }
    test
}

/// Lets one robot's program do its action.
fn act(test: &mut Robot, number: u32) {
    let own = test.world.states[&number].clone();
    let outer = std::mem::replace(&mut test.state, own);
    test.action("go").unwrap();
    let own = std::mem::replace(&mut test.state, outer);
    test.world.states.insert(number, own);
}

#[test]
fn claims_and_deadlines() {
    let test = Robot::new(SOURCE);
    let properties = &test.program.bytecode().properties;
    let known: Vec<(&str, u8)> = properties.iter().map(|p| (&p.name[..], p.robots)).collect();
    let expected = [
        ("own", 1),
        ("pairs", 2),
        ("nested", 2),
        ("someone", 0),
        ("deep", 1),
        ("each", 1),
        ("done", 0),
        ("open", 0),
        ("answered", 0),
        ("moving", 1),
    ];
    assert_eq!(known, expected);
    let within = |name: &str| {
        let found = properties
            .iter()
            .find(|property| property.name == name)
            .unwrap();
        match found.claim {
            Claim::Always(_) => panic!("it has none"),
            Claim::Eventually { within, .. }
            | Claim::EventuallyAlways { within, .. }
            | Claim::LeadsTo { within, .. } => within,
        }
    };
    assert_eq!(within("done"), Some(240_000_000_000));
    assert_eq!(within("open"), None);
    assert_eq!(within("answered"), Some(30_000_000_000));
}

#[test]
fn of_one_robot() {
    let mut test = fleet();
    assert_eq!(test.holds("own", 0, &[1]), Ok(true));
    act(&mut test, 1);
    assert_eq!(test.holds("own", 0, &[1]), Ok(false));
    assert_eq!(test.holds("own", 0, &[2]), Ok(true));
    assert_eq!(test.holds("deep", 0, &[1]), Ok(true));
    let missing = test.holds("own", 0, &[9]);
    assert!(matches!(missing, Err(Fault::Host(_))));
}

#[test]
fn of_pairs() {
    let mut test = fleet();
    assert_eq!(test.holds("pairs", 0, &[0, 1]), Ok(true));
    assert_eq!(test.holds("pairs", 0, &[1, 1]), Ok(true));
    let near = Value::Point(starl_core::Point::planar(1.25, 0.0));
    test.world
        .answers
        .insert("robot.position(robot2)".into(), near);
    assert_eq!(test.holds("pairs", 0, &[1, 2]), Ok(false));
    assert_eq!(test.holds("pairs", 0, &[0, 2]), Ok(true));
    assert_eq!(test.holds("nested", 0, &[0, 1]), Ok(true));
    act(&mut test, 0);
    assert_eq!(test.holds("nested", 0, &[0, 1]), Ok(true));
    act(&mut test, 1);
    assert_eq!(test.holds("nested", 0, &[0, 1]), Ok(false));
    assert_eq!(test.holds("nested", 0, &[1, 1]), Ok(true));
}

#[test]
fn with_quantifiers_inside() {
    let mut test = fleet();
    assert_eq!(test.holds("someone", 0, &[]), Ok(false));
    assert_eq!(test.holds("each", 0, &[0]), Ok(true));
    assert_eq!(test.holds("open", 0, &[]), Ok(true));
    assert_eq!(test.holds("done", 0, &[]), Ok(false));
    assert_eq!(test.holds("answered", 0, &[]), Ok(false));
    assert_eq!(test.holds("answered", 1, &[]), Ok(true));
    act(&mut test, 2);
    assert_eq!(test.holds("someone", 0, &[]), Ok(true));
    assert_eq!(test.holds("each", 0, &[0]), Ok(false));
    assert_eq!(test.holds("answered", 0, &[]), Ok(true));
    assert_eq!(test.holds("answered", 1, &[]), Ok(false));
    act(&mut test, 0);
    act(&mut test, 0);
    assert_eq!(test.holds("open", 0, &[]), Ok(false));
    for number in 0..2 {
        let finished = format!("robot.finished(robot{number})");
        test.world.answers.insert(finished, Value::Bool(true));
    }
    assert_eq!(test.holds("done", 0, &[]), Ok(false));
    test.world
        .answers
        .insert("robot.up(robot2)".into(), Value::Bool(false));
    assert_eq!(test.holds("done", 0, &[]), Ok(true));
}

#[test]
fn a_property_of_each_robot() {
    let mut test = fleet();
    test.world
        .answers
        .insert("robot.heading".into(), Value::Float(0.5));
    let velocity = Value::Point(starl_core::Point::planar(1.0, 0.0));
    test.world
        .answers
        .insert("robot.velocity(robot1)".into(), velocity);
    assert_eq!(test.holds("moving", 0, &[1]), Ok(true));
    assert_eq!(test.holds("moving", 0, &[2]), Ok(false));
}

#[test]
fn parameters_are_those_of_the_robot() {
    let mut test = fleet();
    test.state.clone_from(&test.world.states[&2]);
    test.set("gap", &Value::Float(5.0));
    test.world.states.insert(2, test.state.clone());
    assert_eq!(test.holds("pairs", 0, &[1, 2]), Ok(false));
    assert_eq!(test.holds("pairs", 0, &[2, 1]), Ok(true));
}

#[test]
fn a_deadline_that_cannot_be_computed() {
    let source = "program Test\nconst n = 0\nn_: Int\ngo()\n    eff n_ += 1\neventually done: n_ > 3 within 2s / n\n";
    let problems = compile(&check(source, &NoLibraries)).expect_err("it cannot");
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].code, Code::NotComputable);
    assert_eq!(problems[0].span.of(source), "2s / n");
    assert_eq!(problems[0].notes, ["division by zero"]);
}
