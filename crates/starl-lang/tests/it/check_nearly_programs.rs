//! Checking ends for every text, and its diagnostics are within the text.

use crate::common::{generator, mutation, written};
use starl_lang::check::{Checked, check};
use starl_lang::diagnostic::{Colour, render};

fn checked(text: &str) -> Checked {
    let library = |name: &str| {
        (name == "geometry")
            .then(|| "library geometry\nrecord Line {a: Point, b: Point}\n".to_string())
    };
    let checked = check(text, &library);
    for file in &checked.files {
        for diagnostic in &file.diagnostics {
            let labels = diagnostic.labels.iter().map(|label| label.span);
            let edits = diagnostic.fix.iter().flat_map(|fix| &fix.edits);
            for span in labels
                .chain(edits.map(|edit| edit.span))
                .chain([diagnostic.span])
            {
                let range = span.start as usize..span.end as usize;
                assert!(file.source.get(range).is_some(), "{diagnostic:?} in {text}");
            }
        }
        let _ = render(&file.name, &file.source, &file.diagnostics, Colour::Off);
    }
    checked
}

#[test]
fn listings_with_random_changes() {
    for (_, text) in written() {
        for seed in 0..1000 {
            checked(&mutation::mutated(text, seed));
        }
    }
}

#[test]
fn every_beginning_of_a_listing() {
    for (_, text) in written() {
        for (end, _) in text
            .char_indices()
            .filter(|(_, character)| character.is_whitespace())
        {
            checked(&text[..end]);
        }
    }
}

#[test]
fn random_programs_and_noise() {
    for seed in 0..500 {
        checked(&generator::program(seed));
        checked(&mutation::noise(seed));
    }
}

#[test]
fn tokens_replaced_by_others_of_the_listings() {
    use starl_core::Random;
    let words: Vec<&str> = (written())
        .flat_map(|(_, text)| text.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_'))
        .collect();
    for (_, text) in written() {
        let own: Vec<&str> =
            (text.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_')).collect();
        for seed in 0..500 {
            let mut random = Random::keyed(seed, &[7]);
            let mut tokens = own.clone();
            for _ in 0..=random.below(5) {
                let at = random.below(tokens.len() as u32) as usize;
                tokens[at] = words[random.below(words.len() as u32) as usize];
            }
            checked(&tokens.concat());
        }
    }
}
