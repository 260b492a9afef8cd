//! The checker resolves every name and expands every abbreviation.

use crate::common::{mutation, written};
use starl_lang::check::{Checked, NoLibraries, check};
use starl_lang::ir::*;

fn correct(source: &str) -> Program {
    let checked = check(source, &NoLibraries);
    assert!(!checked.has_errors(), "{:?}", checked.diagnostics());
    checked.program
}

/// Whether something in the program is an error.
fn is_broken(checked: &Checked) -> bool {
    let text = format!("{:?}", checked.program);
    [
        "ty: Error",
        "kind: Error",
        "root: Error",
        "event: Error",
        "(Error",
    ]
    .iter()
    .any(|mark| text.contains(mark))
}

#[test]
fn a_program_without_errors_has_none_in_it() {
    let mut correct = 0;
    for (_, text) in written() {
        for seed in 0..1000 {
            let text = if seed == 0 {
                text.to_string()
            } else {
                mutation::mutated(text, seed)
            };
            let checked = check(&text, &NoLibraries);
            if !checked.has_errors() {
                assert!(!is_broken(&checked), "{text}");
                correct += 1;
            }
        }
    }
    assert!(correct > 50, "only {correct} were correct");
}

#[test]
fn a_value_becomes_an_optional_where_one_is_expected() {
    let program = correct("program P\nx: Int? = 1\nstart()\n    pre x == 2\n    eff x = none\n");
    let initial = program.variables[0].initial.as_ref().unwrap();
    assert!(matches!(&initial.kind, ExpressionKind::Present(value) if value.ty == Type::Int));
    let ExpressionKind::Binary { right, .. } = &program.actions[0].guard.kind else {
        panic!("{:?}", program.actions[0].guard);
    };
    assert!(matches!(right.kind, ExpressionKind::Present(_)));
    assert_eq!(right.ty, Type::optional(Type::Int));
}

#[test]
fn arguments_are_in_the_order_of_the_parameters() {
    let program = correct(
        "library L\nfunction f(a: Int, b: Bool) -> Int = a\nfunction g() -> Int = f(b = true, a = 1)\n",
    );
    let g = program.functions.iter().find(|f| f.name == "g").unwrap();
    let StatementKind::Return(Some(value)) = &g.body[0].kind else {
        panic!("{:?}", g.body);
    };
    let ExpressionKind::Call { arguments, .. } = &value.kind else {
        panic!("{value:?}");
    };
    assert_eq!(arguments[0].kind, ExpressionKind::Int(1));
    assert_eq!(arguments[1].kind, ExpressionKind::Bool(true));
}

#[test]
fn names_bound_in_a_guard_are_known_in_the_effect() {
    let program = correct(
        "program P\nstart()\n    pre some p = way_point(\"a\") and p.x > 1m\n    eff log(\"{}\", p)\n",
    );
    let action = &program.actions[0];
    assert_eq!(action.bindings, [LocalId(0)]);
    assert_eq!(action.locals[0].ty, Type::Point);
}

#[test]
fn roles_are_part_of_guards() {
    let program = correct(
        "program P\nrole a\n    x: Int = 1\n    init\n        x = 2\n    go()\n        pre x > 0\n        eff role = b\nrole b\n    stay()\n        eff role = a\n",
    );
    let roles = program.roles.as_ref().unwrap();
    assert_eq!(program[roles.variable].name, "role");
    assert!(roles.roles[0].entry.is_some() && roles.roles[1].entry.is_none());
    assert_eq!(program.variables[1].role, Some(0));
    for (number, action) in program.actions.iter().enumerate() {
        assert_eq!(action.role, Some(number as u16));
        let ExpressionKind::Binary { operator, left, .. } = &action.guard.kind else {
            panic!("{:?}", action.guard);
        };
        assert_eq!(*operator, Operator::And);
        let ExpressionKind::Binary {
            operator, right, ..
        } = &left.kind
        else {
            panic!("{left:?}");
        };
        assert_eq!(*operator, Operator::Equal);
        assert_eq!(right.kind, ExpressionKind::Variant(number as u16));
        assert!(matches!(
            action.effect[0].kind,
            StatementKind::ChangeRole { .. }
        ));
    }
}

#[test]
fn properties_have_their_robots() {
    let program = correct(
        "program P\nx: Int\nstart()\n    eff x += 1\nalways a: x >= 0\nalways b: forall r: forall s: r.x == s.x\neventually c: forall r: r.x > 1 within 5s\nalways d: exists r: r.x > 1\n",
    );
    let robots: Vec<usize> = program.properties.iter().map(|p| p.robots.len()).collect();
    assert_eq!(robots, [1, 2, 0, 0]);
    let Claim::Always(first) = &program.properties[0].claim else {
        panic!("{:?}", program.properties[0]);
    };
    let text = format!("{first:?}");
    assert!(
        text.contains("OfRobot") && text.contains("Variable(VariableId(0))"),
        "{text}"
    );
    assert!(matches!(
        &program.properties[2].claim,
        Claim::Eventually { holds, within: Some(_) }
            if matches!(holds.kind, ExpressionKind::Quantifier { is_universal: true, .. })
    ));
}

#[test]
fn constants_and_records_have_an_order() {
    let program = correct(
        "library L\nconst a = b + 1\nconst b = f()\nfunction f() -> Int = c\nconst c = 1\nrecord R {s: S}\nrecord S {t: List[T]}\nrecord T {x: Int}\n",
    );
    let constants: Vec<&str> = (program.constant_order.iter())
        .map(|id| program[*id].name.as_str())
        .collect();
    assert_eq!(constants, ["c", "b", "a"]);
    let records: Vec<&str> = (program.record_order.iter())
        .map(|id| program[*id].name.as_str())
        .filter(|name| name.len() == 1)
        .collect();
    assert_eq!(records, ["T", "S", "R"]);
}

#[test]
fn writes_have_their_targets() {
    let program = correct(
        "program P\nallread pos[RobotId]: Point\nallwrite sum: Int = 0\nxs: List[Point]\nstart()\n    pre pos.size() < sum\n    eff pos[me] = position; sum += 1; xs[0].x = 1m; xs.add(position)\n        atomic\n            sum = xs.size()\n",
    );
    let effect = &program.actions[0].effect;
    let place = |number: usize| match &effect[number].kind {
        StatementKind::Assign { place, .. } | StatementKind::Update { place, .. } => place,
        StatementKind::Evaluate(Expression {
            kind: ExpressionKind::Change { place, .. },
            ..
        }) => place,
        other => panic!("{other:?}"),
    };
    assert_eq!(place(0).root, Root::OwnElement(SharedId(0)));
    assert_eq!(place(1).root, Root::Shared(SharedId(1)));
    assert_eq!(place(2).root, Root::Variable(VariableId(0)));
    assert!(matches!(
        place(2).path[..],
        [Step::Index(_), Step::Coordinate(0)]
    ));
    assert_eq!(place(3).root, Root::Variable(VariableId(0)));
    assert!(matches!(
        &effect[4].kind,
        StatementKind::Atomic { shared, .. } if shared[..] == [SharedId(1)]
    ));
}
