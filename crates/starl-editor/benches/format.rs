//! Measures the speed of formatting: `cargo bench -p starl-editor --bench format` prints the best and the median
//! milliseconds for a program of 1,000 lines.

#[path = "../../starl-lang/benches/long/mod.rs"]
mod long;

use long::{LINES, measure, program};
use starl_editor::format::format_parse;
use starl_lang::syntax::parse;

fn main() {
    let text = program();
    let read = parse(&text);
    println!("{LINES} lines, {} bytes", text.len());
    measure("format", || format_parse(&read));
}
