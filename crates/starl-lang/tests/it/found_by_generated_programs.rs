//! Faults that random programs have found.

use crate::support;
use starl_lang::check::{NoLibraries, check};
use starl_lang::diagnostic::{Colour, render};
use starl_lang::ir::{Claim, ExpressionKind, Program, RobotMember};

/// Checks a program that must have no errors.
fn checked(text: &str) -> Program {
    let checked = check(text, &NoLibraries);
    let said = render("found.starl", text, checked.diagnostics(), Colour::Off);
    checked
        .correct()
        .unwrap_or_else(|| panic!("{said}"))
        .clone()
}

#[test]
fn return_stands_before_else_on_a_line() {
    checked("program P\nx: Int\ninit\n    if x == 0 then return else x = 1\n");
}

#[test]
fn arithmetic_stands_where_an_optional_is_expected() {
    checked("program P\nx: Int?\ninit\n    x = (if x == none then 1 else 2) / 2\n");
}

#[test]
fn a_sign_stands_where_an_optional_is_expected() {
    checked("program P\nx: Int?\ninit\n    x = -(if x == none then 1 else 2)\n");
}

#[test]
fn empty_collections_stand_where_an_optional_is_expected() {
    checked("program P\nx: List[Int]? = []\ny: Set[Int]? = {}\nz: Map[Int, Int]? = {:}\n");
}

#[test]
fn a_parameter_in_a_property_belongs_to_the_quantified_robot() {
    let text = "program P\nparam limit: Int = 3\nxs: List[Int]\n\
                invariant: [x for x in xs if x > limit].size() == 0\n";
    let program = checked(text);
    let Claim::Always(holds) = &program.properties[0].claim else {
        panic!("an invariant");
    };
    let mut robots = Vec::new();
    parameters(holds, &mut robots);
    assert_eq!(robots, [program.properties[0].robots[0]]);
}

/// The robots whose parameters the expression reads.
fn parameters(expression: &starl_lang::ir::Expression, found: &mut Vec<starl_lang::ir::LocalId>) {
    match &expression.kind {
        ExpressionKind::Binary { left, right, .. } => {
            parameters(left, found);
            parameters(right, found);
        }
        ExpressionKind::Method { receiver, .. } => parameters(receiver, found),
        ExpressionKind::Comprehension(comprehension) => {
            parameters(
                comprehension.condition.as_ref().expect("a condition"),
                found,
            );
        }
        ExpressionKind::OfRobot {
            robot,
            member: RobotMember::Parameter(_),
        } => match robot.kind {
            ExpressionKind::Local(robot) => found.push(robot),
            _ => panic!("a robot is a local here"),
        },
        _ => {}
    }
}

/// The value of the variable `x` when the program has started.
fn x(text: &str) -> String {
    let (checked, bytecode) = support::hold::compiled(text).expect("robots can run it");
    support::hold::means(&checked, &bytecode);
    let program = support::run::load(&bytecode);
    let mut run = support::run::Run::new(&program);
    run.input(support::run::Input::Start).expect("no error");
    let value = program.get(&run.state, "x").expect("a variable x");
    value.to_string()
}

#[test]
fn a_record_that_is_one_list_is_shown_as_a_record() {
    let text = "program P\nrecord R {list: List[Int]}\nr: R = R([1])\nx: String\n\
                init\n    x = String(r)\n";
    assert_eq!(x(text), "\"(list = [1])\"");
}

#[test]
fn a_record_that_is_one_float_is_compared_as_a_float() {
    let text = "program P\nrecord R {part: Float}\nr: R = R(0.0)\nx: Bool\n\
                init\n    if r == R(-0.0)\n        x = true\n";
    assert_eq!(x(text), "true");
}
