//! From a name to its declaration and its other uses.

use super::convert::Text;
use super::documents::{Checked, Documents};
use lsp_types::{DocumentHighlight, Location, Position, Uri};
use starl_editor::{BUILT_IN, Occurrence};
use starl_lang::check::Symbol;
use starl_lang::ir::Site;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;

/// The name at a place.
pub fn name_at(checked: &Checked, position: Position) -> Option<Occurrence> {
    let text = Text::new(checked.analysis.text());
    checked.analysis.occurrence(text.offset(position))
}

/// A position in the editor's form. Libraries of the command are shown to editors that ask for
/// them.
fn location(checked: &Checked, site: Site, knows_built_in: bool) -> Option<Location> {
    let file = checked.analysis.checked.files.get(site.file as usize)?;
    let built_in = || {
        let name = format!("{}{}.starl", BUILT_IN, file.name);
        name.parse().ok().filter(|_| knows_built_in)
    };
    let uri: Uri = checked.uri_of(site.file).or_else(built_in)?;
    let range = Text::new(&file.source).range(site.span);
    Some(Location::new(uri, range))
}

/// The declaration of the name at a position.
pub fn definition(checked: &Checked, position: Position, knows_built_in: bool) -> Option<Location> {
    let found = name_at(checked, position)?;
    let site = checked.analysis.definition(found.symbol)?;
    location(checked, site, knows_built_in)
}

/// All uses of the name at a position, in other texts too.
pub fn references(
    documents: &Documents,
    checked: &Rc<Checked>,
    position: Position,
    with_declaration: bool,
) -> Option<Vec<Location>> {
    let found = name_at(checked, position)?;
    let mut places = BTreeMap::new();
    for (users, symbol) in users(documents, checked, found.symbol) {
        let names = users.analysis.references(symbol);
        for name in names
            .iter()
            .filter(|name| with_declaration || !name.is_definition)
        {
            if let Some(place) = location(&users, name.site, false) {
                let start = (place.range.start.line, place.range.start.character);
                places.insert((place.uri.as_str().to_string(), start), place);
            }
        }
    }
    Some(places.into_values().collect())
}

/// The texts that may use a symbol, each with the symbol in that text: the text itself, and those that import the
/// library of its declaration.
pub fn users(
    documents: &Documents,
    checked: &Rc<Checked>,
    symbol: Symbol,
) -> Vec<(Rc<Checked>, Symbol)> {
    let mut users = vec![(Rc::clone(checked), symbol)];
    let Some(site) = checked.analysis.definition(symbol) else {
        return users;
    };
    let is_local = site.file == 0 && !checked.analysis.checked.program.is_library;
    let Some(path) = checked.path_of(site.file).filter(|_| !is_local) else {
        return users;
    };
    for other in documents
        .importers(&path)
        .into_iter()
        .chain(documents.checked_file(&path))
    {
        if other.uri == checked.uri {
            continue;
        }
        if let Some(symbol) = symbol_at(&other, &path, site) {
            users.push((other, symbol));
        }
    }
    users
}

/// The name in a text of a declaration at a position of a file.
fn symbol_at(checked: &Checked, path: &PathBuf, site: Site) -> Option<Symbol> {
    let files = 0..checked.analysis.checked.files.len() as u32;
    let mut own = files.filter(|file| checked.path_of(*file).as_ref() == Some(path));
    let file = own.next()?;
    let found = checked.analysis.occurrence_in(file, site.span.start)?;
    (found.is_definition && found.site.span == site.span).then_some(found.symbol)
}

/// The places in the text itself.
pub fn highlights(checked: &Checked, position: Position) -> Option<Vec<DocumentHighlight>> {
    let found = name_at(checked, position)?;
    let text = Text::new(checked.analysis.text());
    let names = checked.analysis.references(found.symbol);
    let own = names.iter().filter(|name| name.site.file == 0);
    let highlights = own.map(|name| DocumentHighlight {
        range: text.range(name.site.span),
        kind: None,
    });
    Some(highlights.collect())
}
