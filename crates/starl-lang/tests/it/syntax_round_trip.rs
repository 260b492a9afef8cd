//! The text of the tree is the source, for every source, and parsing never fails.

use crate::common::{generator, mutation, parsed, written};

#[test]
fn written_programs_are_parsed_without_errors() {
    for (name, text) in written() {
        assert_eq!(parsed(text).diagnostics(), [], "{name}");
    }
}

#[test]
fn random_programs_are_read_without_a_complaint() {
    for seed in 0..500 {
        let text = generator::program(seed);
        assert_eq!(parsed(&text).diagnostics(), [], "seed {seed}:\n{text}");
    }
}

#[test]
fn nearly_correct_programs_are_parsed_completely() {
    for (_, text) in written() {
        for seed in 0..1000 {
            parsed(&mutation::mutated(text, seed));
        }
    }
}

#[test]
fn noise_is_read_whole() {
    for seed in 0..5000 {
        parsed(&mutation::noise(seed));
    }
}

#[test]
fn every_beginning_of_a_program_is_read_whole() {
    for (_, text) in written() {
        for (end, _) in text.char_indices() {
            parsed(&text[..end]);
        }
    }
}

#[test]
fn a_text_that_begins_with_an_indented_operator_is_read_whole() {
    parsed(" == b)\nx: Int\n");
}
