//! Renaming, in all texts that name the same thing.

use super::convert::Text;
use super::documents::{Checked, Documents};
use super::navigate::users;
use lsp_types::{Position, PrepareRenameResponse, TextEdit, Uri, WorkspaceEdit};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The name that can be renamed at a position, or the reason why there is none.
pub fn prepare(checked: &Checked, position: Position) -> Result<PrepareRenameResponse, String> {
    let text = Text::new(checked.analysis.text());
    let found = checked.analysis.renameable(text.offset(position))?;
    check_place(checked, found.symbol)?;
    Ok(PrepareRenameResponse::RangeWithPlaceholder {
        range: text.range(found.site.span),
        placeholder: checked.analysis.name_at(found.site),
    })
}

/// Declarations of the standard library cannot be changed.
fn check_place(checked: &Checked, symbol: starl_lang::check::Symbol) -> Result<(), String> {
    let site = checked.analysis.definition(symbol);
    match site {
        Some(site) if checked.uri_of(site.file).is_none() => {
            let name = checked.analysis.name_at(site);
            Err(format!("`{name}` is part of the standard library"))
        }
        _ => Ok(()),
    }
}

/// The changes of a file, by the places that they change.
type Places = BTreeMap<(u32, u32), TextEdit>;

/// The changes that rename the name at a position, or the reason why it cannot be renamed.
pub fn rename(
    documents: &Documents,
    checked: &Rc<Checked>,
    position: Position,
    name: &str,
) -> Result<WorkspaceEdit, String> {
    let text = Text::new(checked.analysis.text());
    let found = checked.analysis.renameable(text.offset(position))?;
    check_place(checked, found.symbol)?;
    // By the names of the files: several texts may import one library.
    let mut changes: BTreeMap<String, (Uri, Places)> = BTreeMap::new();
    for (user, symbol) in users(documents, checked, found.symbol) {
        let libraries = documents.libraries(&user.uri);
        let renamed = user.analysis.rename(symbol, name, &libraries);
        let renamed = renamed.map_err(|reason| match user.uri == checked.uri {
            true => reason,
            false => format!("in {}: {reason}", file_name(&user)),
        })?;
        for file in renamed.files {
            let Some(uri) = user.uri_of(file.file) else {
                continue;
            };
            let source = &user.analysis.checked.files[file.file as usize].source;
            let text = Text::new(source);
            let key = uri.as_str().to_string();
            let (_, own) = changes.entry(key).or_insert((uri, Places::new()));
            for edit in &file.edits {
                own.insert((edit.span.start, edit.span.end), text.edit(edit));
            }
        }
    }
    let changes = changes.into_values();
    let changes = changes.map(|(uri, edits)| (uri, edits.into_values().collect()));
    Ok(WorkspaceEdit::new(changes.collect()))
}

fn file_name(checked: &Checked) -> String {
    let path = checked.path_of(0);
    let name = path.as_ref().and_then(|path| path.file_name());
    name.map_or(String::new(), |name| name.to_string_lossy().into_owned())
}
