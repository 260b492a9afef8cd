//! Common code of the editor services' tests: texts with a cursor, written `$0`, and libraries.

pub mod formatting;

use starl_editor::{Analysis, Completion, Description, Occurrence, completions};
use starl_lang::check::{Libraries, StandardLibraries};
use starl_lang::diagnostic::{Edit, Fix};

/// The text without its cursor, and where that is.
pub fn cursor(text: &str) -> (String, u32) {
    let at = text.find("$0").expect("the text has a cursor");
    (text.replacen("$0", "", 1), at as u32)
}

/// Libraries by name, and the standard ones.
pub struct Beside<'a>(pub &'a [(&'a str, &'a str)]);

impl Libraries for Beside<'_> {
    fn source(&self, name: &str) -> Option<String> {
        let found = self.0.iter().find(|(own, _)| *own == name);
        match found {
            Some((_, text)) => Some((*text).into()),
            None => StandardLibraries.source(name),
        }
    }

    fn names(&self) -> Vec<String> {
        let own = self.0.iter().map(|(name, _)| (*name).to_string());
        own.chain(StandardLibraries.names()).collect()
    }
}

/// A text with the standard libraries.
pub fn analysis(text: &str) -> Analysis {
    Analysis::new(text, &StandardLibraries)
}

/// The meaning of the name at the cursor.
pub fn at_cursor(text: &str) -> (Analysis, Occurrence) {
    let (text, at) = cursor(text);
    let analysis = analysis(&text);
    let found = analysis.occurrence(at);
    (analysis, found.expect("there is a name at the cursor"))
}

/// The text shown at the cursor.
pub fn hover(text: &str) -> Description {
    let (text, at) = cursor(text);
    let shown = analysis(&text).hover(at);
    shown.expect("something is shown at the cursor").1
}

/// The completions at the cursor.
pub fn complete(text: &str) -> Vec<Completion> {
    complete_with(text, &StandardLibraries)
}

/// The same with other libraries.
pub fn complete_with(text: &str, libraries: &dyn Libraries) -> Vec<Completion> {
    let (text, at) = cursor(text);
    completions(&text, at, libraries).items
}

/// The words that may be typed at the cursor, the likeliest first.
pub fn labels(text: &str) -> Vec<String> {
    let items = complete(text);
    items.into_iter().map(|item| item.label).collect()
}

/// The text after edits.
pub fn edited(text: &str, edits: &[Edit]) -> String {
    let fix = Fix {
        message: String::new(),
        edits: edits.to_vec(),
    };
    fix.apply(text)
}
