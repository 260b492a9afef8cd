//! Properties.

use alloc::format;
use alloc::vec::Vec;

use super::body::Where;
use super::collect::{first_word, name_of};
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::{Claim, Expression, ExpressionKind, LocalId, Property, Type};
use crate::syntax::ast::{self, AstNode, Documented, Item};

impl Checker {
    /// `invariant name: condition` and the like.
    pub fn check_property(&mut self, node: &ast::PropertyDeclaration) {
        let name = name_of(node);
        let word = first_word(node.syntax());
        let site = self.site(name.as_ref().map_or(word, |name| name.span));
        if let Some(name) = &name {
            let properties = self.program.properties.iter();
            let same = properties
                .filter(|other| other.name.as_ref() == Some(&name.text))
                .map(|other| other.site.span)
                .next();
            if let Some(first) = same {
                self.duplicate("properties", &name.text, name.span, first);
            }
        }
        let about_robot = self.value.is_some()
            || !(mentions_robots(node.condition().as_ref())
                || mentions_robots(node.consequence().as_ref()));
        let ((claim, robots, assumption, recovery), locals) =
            self.in_body(Where::Property, |checker| {
                let mut robots = Vec::new();
                if about_robot {
                    let robot = checker
                        .body
                        .add("this robot".into(), Type::Robot, word, None);
                    checker.body.names.clear();
                    checker.body.robot = Some(robot);
                    robots.push(robot);
                }
                let condition = match checker.value.clone() {
                    Some(ty) => checker.expect(node.condition(), &ty, "the expression"),
                    None => checker.expect(node.condition(), &Type::Bool, "the property"),
                };
                let consequence = node
                    .consequence()
                    .map(|then| checker.expect(Some(then), &Type::Bool, "the consequence"));
                let claim = checker.claim(node, condition, consequence, &mut robots);
                let recovery = node
                    .recovery()
                    .map(|time| checker.expect(Some(time), &Type::Duration, "the time to recover"));
                let assumption = node.assumption().map(|assumption| {
                    checker.body.place = Where::Property;
                    let locals = &checker.body.locals;
                    let names = robots
                        .iter()
                        .map(|robot| (locals[robot.index()].name.clone(), *robot));
                    checker.body.names = names.collect();
                    checker.expect(Some(assumption), &Type::Bool, "the assumption")
                });
                (claim, robots, assumption, recovery)
            });
        self.program.properties.push(Property {
            name: name.map(|name| name.text),
            robots,
            locals,
            claim,
            assumption,
            recovery,
            is_despite_crashes: node.is_despite_crashes(),
            site,
            documentation: Item::Property(node.clone()).documentation(),
        });
    }

    fn claim(
        &mut self,
        node: &ast::PropertyDeclaration,
        condition: Expression,
        consequence: Option<Expression>,
        robots: &mut Vec<LocalId>,
    ) -> Claim {
        self.body.place = Where::Constant;
        let within = node
            .deadline()
            .map(|deadline| self.expect(Some(deadline), &Type::Duration, "the deadline"));
        match (node.is_eventual(), consequence) {
            (false, Some(consequence)) => Claim::LeadsTo {
                cause: condition,
                consequence,
                within,
            },
            (true, consequence) => {
                if let Some(consequence) = consequence {
                    let message = "`leads_to` follows `always`";
                    let problem = Diagnostic::new(Code::InvalidProperty, consequence.span, message);
                    let note = "`eventually` means that a condition becomes true once; `always a leads_to b`, that it does each time";
                    self.report(problem.note(note));
                }
                match node.is_eventually_always() {
                    true => Claim::EventuallyAlways {
                        holds: of_each_robot(condition, robots),
                        within,
                    },
                    false => Claim::Eventually {
                        holds: condition,
                        within,
                    },
                }
            }
            (false, None) => {
                if let Some(within) = within {
                    let message = "a condition that is always true has no deadline";
                    let problem = Diagnostic::new(Code::InvalidProperty, within.span, message);
                    let word = node.word();
                    let note = format!(
                        "`eventually`, `eventually always` and `always ... leads_to` have one; `{word}` alone has not"
                    );
                    self.report(problem.note(note));
                }
                Claim::Always(of_each_robot(condition, robots))
            }
        }
    }
}

/// Splits an invariant of the form `forall r: ...` into a condition for each robot: removes the leading quantifiers and
/// collects their robots.
fn of_each_robot(condition: Expression, robots: &mut Vec<LocalId>) -> Expression {
    match condition.kind {
        ExpressionKind::Quantifier {
            is_universal: true,
            robots: all,
            condition,
        } => {
            robots.extend(all);
            of_each_robot(*condition, robots)
        }
        _ => condition,
    }
}

/// Whether there is a quantifier over all robots in the expression.
fn mentions_robots(expression: Option<&ast::Expression>) -> bool {
    expression.is_some_and(|expression| {
        let nodes = expression.syntax().descendants();
        let mut quantifiers = nodes.filter_map(ast::QuantifierExpression::cast);
        quantifiers.any(|quantifier| quantifier.loop_variables().is_none())
    })
}
