//! After any renaming in the listings the program checks as before, and renaming back restores the text.

use crate::common::{EVERY_FORM, LISTINGS};
use crate::support::edited;
use starl_editor::{Analysis, Occurrence, RenameError};
use starl_lang::check::StandardLibraries;
use starl_lang::diagnostic::{Code, Severity};

/// A name that none of the texts has.
const NEW: &str = "entirely_new";

/// The codes of the diagnostics, and the meaning of every name in the order of the text.
fn meaning(analysis: &Analysis) -> (Vec<(Code, Severity)>, Vec<String>) {
    let told = analysis.diagnostics().iter();
    let told = told.map(|problem| (problem.code, problem.severity()));
    let names = analysis.occurrences().iter();
    // Locals are known by their places, which move.
    let names = names.map(|name| match format!("{:?}", name.symbol) {
        local if local.starts_with("Local") => format!("Local {}", name.is_definition),
        other => format!("{other} {}", name.is_definition),
    });
    (told.collect(), names.collect())
}

fn rename(analysis: &Analysis, name: &Occurrence, to: &str) -> Result<String, RenameError> {
    let renamed = analysis.rename(name.symbol, to, &StandardLibraries)?;
    assert!(
        renamed.iter().all(|file| file.file == 0),
        "only the text itself changes"
    );
    let edits = renamed.first().map_or(&[][..], |file| &file.edits[..]);
    Ok(edited(analysis.text(), edits))
}

/// Renames everything that the text declares; returns how many names it has renamed.
fn all_of(label: &str, text: &str) -> usize {
    let before = Analysis::new(text, &StandardLibraries);
    let mut count = 0;
    for name in before
        .occurrences()
        .iter()
        .filter(|name| name.is_definition)
    {
        let old = before.name_at(name.site);
        let context = format!("{old} of {label}");
        let changed = match rename(&before, name, NEW) {
            Ok(changed) => changed,
            Err(reason) => panic!("{context}: {reason}"),
        };
        assert_ne!(changed, text, "{context}");
        let after = Analysis::new(&changed, &StandardLibraries);
        assert_eq!(meaning(&after), meaning(&before), "{context}");
        let again = after
            .occurrence(name_start(&after))
            .expect("the name is there");
        assert_eq!(
            rename(&after, &again, &old).as_deref(),
            Ok(text),
            "{context}"
        );
        count += 1;
    }
    count
}

fn name_start(analysis: &Analysis) -> u32 {
    analysis.text().find(NEW).expect("the new name is there") as u32
}

#[test]
fn in_the_four_listings() {
    let renamed: usize = LISTINGS.iter().map(|(name, text)| all_of(name, text)).sum();
    assert!(renamed > 60, "{renamed} names");
}

/// It is full of errors, which must stay the same.
#[test]
fn in_a_text_with_errors() {
    let before = Analysis::new(EVERY_FORM, &StandardLibraries);
    let (mut renamed, mut refused) = (0, Vec::new());
    for name in before
        .occurrences()
        .iter()
        .filter(|name| name.is_definition)
    {
        let old = before.name_at(name.site);
        match rename(&before, name, NEW) {
            Ok(changed) => {
                let after = Analysis::new(&changed, &StandardLibraries);
                assert_eq!(meaning(&after), meaning(&before), "{old}");
                renamed += 1;
            }
            Err(_) => refused.push(old),
        }
    }
    assert!(renamed >= 30, "{renamed}, and not {refused:?}");
}
