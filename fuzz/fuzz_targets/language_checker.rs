//! Checking any text ends; what is said lies in the file that it is said of and can be shown, and a
//! program without errors has none in it. Seeds: `fuzz/seeds/language`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_lang::check::check;
use starl_lang::diagnostic::{Colour, render};

fuzz_target!(|text: &str| {
    // A library that is imported is the same text again.
    let libraries = |name: &str| (name != "missing").then(|| text.to_string());
    let checked = check(text, &libraries);
    for file in &checked.files {
        for diagnostic in &file.diagnostics {
            let labels = diagnostic.labels.iter().map(|label| label.span);
            for span in labels.chain([diagnostic.span]) {
                assert!(
                    file.source
                        .get(span.start as usize..span.end as usize)
                        .is_some()
                );
            }
        }
        if file.diagnostics.len() < 50 {
            let _ = render(&file.name, &file.source, &file.diagnostics, Colour::Off);
        }
    }
    if checked.correct().is_some() {
        let program = format!("{:?}", checked.program);
        for mark in ["ty: Error", "kind: Error", "root: Error", "event: Error"] {
            assert!(!program.contains(mark), "{mark}");
        }
    }
});
