//! The tests of `starl-editor`, in one binary so that they link once.

mod call_help;
#[path = "../../../starl-lang/tests/it/common/mod.rs"]
mod common;
mod completion;
mod definition;
mod explain_drawings;
mod explain_edges;
mod explain_listings;
mod explain_misses_no_step;
mod format_generated_programs;
mod format_keeps_meaning;
mod format_layout;
mod format_survives_deep_texts;
#[allow(dead_code, reason = "the tests of the language use the rest")]
#[path = "../../../starl-lang/tests/it/support/generate/mod.rs"]
mod generate;
mod grammar;
mod hover;
mod layout;
mod names_are_all_known;
mod outline;
mod positions;
mod rename;
mod rename_round_trip;
#[allow(dead_code, reason = "the tests of the language use the rest")]
#[path = "../../../starl-lang/tests/it/robot_support/mod.rs"]
mod robot_support;
mod support;
mod survives_any_text;
mod tokens;
