//! Measures the speed of parsing: `cargo bench -p starl-lang --bench syntax` prints the best and the median milliseconds
//! for a program of 1,000 lines. Reading and checking together should take less than 10.

mod long;

use long::{LINES, measure, program};
use starl_lang::syntax::ast::Expression;
use starl_lang::syntax::{ast::AstNode, parse};

fn main() {
    let text = program();
    let read = parse(&text);
    println!(
        "{} lines, {} bytes, {} problems",
        LINES,
        text.len(),
        read.diagnostics().len()
    );
    measure("read", || parse(&text));
    measure("walk every expression", || {
        read.syntax()
            .descendants()
            .filter_map(Expression::cast)
            .map(|expression| expression.span().start)
            .max()
    });
}
