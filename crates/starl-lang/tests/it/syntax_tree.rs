//! The typed view finds every part of a program.

use crate::common::{EVERY_FORM, LISTINGS, parsed};
use starl_lang::syntax::ast::{
    AssignOperator, AstNode, BinaryOperator, Documented, Expression, Item, Literal, Named,
    Statement, Type,
};
use starl_lang::syntax::parse;

fn items(text: &str) -> Vec<Item> {
    parsed(text).tree().items().collect()
}

/// The expression in a program that is otherwise empty.
fn expression(text: &str) -> Expression {
    let items = items(&format!("program P\n\nconst x = {text}\n"));
    let Some(Item::Constant(constant)) = items.into_iter().nth(1) else {
        panic!("{text} is no constant")
    };
    constant.value().expect("a value")
}

fn literal(text: &str) -> Literal {
    match expression(text) {
        Expression::Literal(literal) => literal.value(),
        other => panic!("{other:?} is no literal"),
    }
}

/// An expression with a bracket around each part.
fn grouped(expression: &Expression) -> String {
    let part = |part: Option<Expression>| part.map_or("?".into(), |part| grouped(&part));
    match expression {
        Expression::Binary(binary) => {
            let operator = binary.operator().map_or("?", BinaryOperator::text);
            let not = if binary.is_negated() { "not " } else { "" };
            format!(
                "({} {not}{operator} {})",
                part(binary.left()),
                part(binary.right())
            )
        }
        Expression::Prefix(prefix) => {
            format!(
                "({} {})",
                prefix.operator().map_or("?", |o| o.text()),
                part(prefix.operand())
            )
        }
        Expression::Conditional(c) => {
            format!(
                "(if {} then {} else {})",
                part(c.condition()),
                part(c.then()),
                part(c.otherwise())
            )
        }
        Expression::Unwrap(unwrap) => format!("({}!)", part(unwrap.base())),
        Expression::Field(field) => {
            format!(
                "({}.{})",
                part(field.base()),
                field.field().map_or(String::new(), |f| f.text().into())
            )
        }
        Expression::Index(index) => format!("({}[{}])", part(index.base()), part(index.index())),
        Expression::Call(call) => {
            let arguments: Vec<String> = call
                .arguments()
                .map(|argument| part(argument.value()))
                .collect();
            format!("({}({}))", part(call.callee()), arguments.join(", "))
        }
        Expression::Parenthesized(inner) => part(inner.inner()),
        Expression::Some(some) => format!(
            "(some {} = {})",
            some.name().unwrap().text(),
            part(some.value())
        ),
        other => other.syntax().text().to_string(),
    }
}

#[test]
fn operators_bind_as_the_reference_says() {
    let cases = [
        ("a + b * c - d", "((a + (b * c)) - d)"),
        ("a / b % c", "((a / b) % c)"),
        ("-a * b", "((- a) * b)"),
        ("-a.b(c)!", "(- (((a.b)(c))!))"),
        ("a or b and c", "(a or (b and c))"),
        ("not a == b and c", "((not (a == b)) and c)"),
        ("not not a", "(not (not a))"),
        (
            "a + b < c and d in e..f",
            "(((a + b) < c) and (d in (e .. f)))",
        ),
        ("a not in b or c", "((a not in b) or c)"),
        ("a ?? b ?? c == d", "((a ?? (b ?? c)) == d)"),
        ("a + b ?? c", "((a + b) ?? c)"),
        ("a + b .. c * d", "((a + b) .. (c * d))"),
        ("a ?? b..c", "((a ?? b) .. c)"),
        (
            "if a or b then c + d else e or f",
            "(if (a or b) then (c + d) else (e or f))",
        ),
        ("(a or b) and c", "((a or b) and c)"),
        ("a[b + c].d!", "(((a[(b + c)]).d)!)"),
        ("a - b - c", "((a - b) - c)"),
        ("a == not b", "(a == (not b))"),
        ("f(a, x = b)(c)", "((f(a, b))(c))"),
    ];
    for (text, expected) in cases {
        assert_eq!(grouped(&expression(text)), expected, "{text}");
    }
}

#[test]
fn a_value_that_is_bound_binds_tighter_than_and() {
    let items = items("program P\n\non M(f)\n    if some p = pos[r] and d(p) < 1m then g()\n");
    let Some(Item::Handler(handler)) = items.get(1) else {
        panic!()
    };
    let Some(Statement::If(statement)) = handler.body().unwrap().statements().next() else {
        panic!()
    };
    let condition = statement.branches().next().unwrap().condition().unwrap();
    assert_eq!(
        grouped(&condition),
        "((some p = (pos[r])) and ((d(p)) < 1m))"
    );
}

#[test]
fn literals_have_their_values() {
    assert_eq!(literal("1_000"), Literal::Int(1000));
    assert_eq!(literal("1.5e-3"), Literal::Float(0.0015));
    assert_eq!(literal("75mm"), Literal::Float(0.075));
    assert_eq!(literal("3cm"), Literal::Float(0.03));
    assert_eq!(literal("2km"), Literal::Float(2000.0));
    assert_eq!(literal("180deg"), Literal::Float(std::f64::consts::PI));
    assert_eq!(literal("1.5rad"), Literal::Float(1.5));
    assert_eq!(literal("5ns"), Literal::Duration(5));
    assert_eq!(literal("500ms"), Literal::Duration(500_000_000));
    assert_eq!(literal("1.5min"), Literal::Duration(90_000_000_000));
    assert_eq!(literal("0.1s"), Literal::Duration(100_000_000));
    assert_eq!(literal("1h"), Literal::Duration(3_600_000_000_000));
    assert_eq!(literal("1e3us"), Literal::Duration(1_000_000));
    assert_eq!(
        literal(r#""a\n\"\\\u{e9}\t""#),
        Literal::String("a\n\"\\\u{e9}\t".into())
    );
    assert_eq!(literal("true"), Literal::Bool(true));
    assert_eq!(literal("none"), Literal::None);
    assert_eq!(literal("5parsec"), Literal::Malformed);
    assert_eq!(literal("9999999999999999999"), Literal::Malformed);
}

#[test]
fn the_least_int_can_be_written() {
    assert_eq!(
        parsed("program P\n\nconst x = -9223372036854775808\n").diagnostics(),
        []
    );
    assert_ne!(
        parsed("program P\n\nconst x = 9223372036854775808\n").diagnostics(),
        []
    );
}

#[test]
fn every_form_has_its_item() {
    let mut kinds = Vec::new();
    for item in items(EVERY_FORM) {
        let kind = item.syntax().kind();
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    // All of the choice: a library's header is not in a program.
    assert_eq!(kinds.len(), 16, "{kinds:?}");
}

#[test]
fn an_action_has_its_guard_and_effect() {
    let items = items(LISTINGS[0].1);
    let action = items.iter().find_map(|item| match item {
        Item::Action(action) if action.name()?.text() == "wait" => Some(action.clone()),
        _ => None,
    });
    let action = action.expect("the action wait");
    let condition = action.pre().unwrap().condition().unwrap();
    assert_eq!(
        grouped(&condition),
        "(((loc == wait) and (motion.done)) and (currentIndex < ((target.size)())))"
    );
    let statements: Vec<Statement> = action.eff().unwrap().body().unwrap().statements().collect();
    assert_eq!(statements.len(), 4);
    let Statement::Assign(step) = &statements[2] else {
        panic!("{:?}", statements[2])
    };
    assert_eq!(step.operator(), Some(AssignOperator::Add));
    assert_eq!(grouped(&step.target().unwrap()), "currentIndex");
    assert_eq!(grouped(&step.value().unwrap()), "1");
}

#[test]
fn an_effect_may_continue_below_its_line() {
    let items = items("program P\n\nrun()\n    eff a = 1; b = 2\n        c = 3\n");
    let Some(Item::Action(action)) = items.get(1) else {
        panic!()
    };
    assert_eq!(
        action.eff().unwrap().body().unwrap().statements().count(),
        3
    );
}

#[test]
fn a_property_has_its_parts() {
    let items = items(
        "program P\n\nalways answered: exists r: r.a\n    leads_to forall s: s.b\n    within 2min\n",
    );
    let Some(Item::Property(property)) = items.get(1) else {
        panic!()
    };
    assert_eq!(property.word(), "always");
    assert_eq!(property.name().unwrap().text(), "answered");
    let text = |part: Option<Expression>| part.unwrap().syntax().text().to_string();
    assert_eq!(text(property.condition()), "exists r: r.a");
    assert_eq!(text(property.consequence()), "forall s: s.b");
    assert_eq!(text(property.deadline()), "2min");
}

#[test]
fn shared_variables_and_types_have_their_parts() {
    let items = items(
        "program P\n\nallread[causal] pos[RobotId]: Map[String, geometry.Line?]\nallwrite x: Int = 1\n",
    );
    let Some(Item::Shared(shared)) = items.get(1) else {
        panic!()
    };
    assert!(shared.is_single_writer());
    assert_eq!(shared.consistency().unwrap().text(), "causal");
    assert!(matches!(shared.index(), Some(Type::Named(_))));
    let Some(Type::Named(map)) = shared.ty() else {
        panic!()
    };
    let arguments: Vec<Type> = map.arguments().collect();
    let Type::Optional(line) = &arguments[1] else {
        panic!()
    };
    let Some(Type::Named(line)) = line.inner() else {
        panic!()
    };
    assert_eq!(
        line.words()
            .map(|word| word.text().to_string())
            .collect::<Vec<_>>(),
        ["geometry", "Line"]
    );
    let Some(Item::Shared(shared)) = items.get(2) else {
        panic!()
    };
    assert!(!shared.is_single_writer() && shared.value().is_some());
}

#[test]
fn comments_with_three_slashes_document_the_declaration_below() {
    let text = "/// The program.\nprogram P\n\n/// not this\n\n// nor this\n/// One\n///  two\nx: Int\nrecord R {\n    /// a field\n    x: Int,\n}\n";
    let items = items(text);
    assert_eq!(items[0].documentation(), "The program.");
    assert_eq!(items[1].documentation(), "One\n two");
    let Item::Record(record) = &items[2] else {
        panic!()
    };
    assert_eq!(record.fields().next().unwrap().documentation(), "a field");
}

#[test]
fn spans_exclude_surrounding_trivia() {
    let text = "program P\n\n/// Documented.\nrun()\n    eff f() // done\n\n// after\nx: Int\n";
    let parse = parse(text);
    let action = parse.tree().items().nth(1).unwrap();
    assert_eq!(action.span().of(text), "run()\n    eff f()");
}

#[test]
fn a_comment_belongs_to_the_block_with_its_indentation() {
    let text = "program P\n\non M(f)\n    if a\n        g()\n        // inner\n    // outer\n// none\nx: Int\n";
    let parse = parse(text);
    let parents = |comment: &str| {
        let token = parse
            .syntax()
            .descendants_with_tokens()
            .find(|e| e.to_string() == comment)
            .unwrap();
        token
            .ancestors()
            .filter(|node| node.kind() == starl_lang::syntax::SyntaxKind::Block)
            .count()
    };
    assert_eq!(
        [parents("// inner"), parents("// outer"), parents("// none")],
        [2, 1, 0]
    );
}
