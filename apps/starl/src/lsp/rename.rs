//! Renaming, in all texts that name the same thing.

use super::convert::Text;
use super::documents::{Checked, Documents};
use super::navigate::users;
use lsp_types::{Position, PrepareRenameResponse, TextEdit, Uri, WorkspaceEdit};
use starl_editor::{Occurrence, RenameError};
use std::collections::BTreeMap;
use std::rc::Rc;
use thiserror::Error;

/// Why a name is not changed.
#[derive(Debug, Error)]
pub enum Refused {
    /// It must stay in this text.
    #[error(transparent)]
    Here(#[from] RenameError),
    /// It must stay in another text that uses it.
    #[error("in {file}: {error}")]
    Elsewhere { file: String, error: RenameError },
    /// It is declared where nothing can be changed.
    #[error("`{0}` is part of the standard library")]
    Standard(String),
}

/// The name that can be renamed at a position, or the reason why there is none.
pub fn prepare(checked: &Checked, position: Position) -> Result<PrepareRenameResponse, Refused> {
    let found = renameable(checked, position)?;
    let text = Text::new(checked.analysis.text());
    Ok(PrepareRenameResponse::RangeWithPlaceholder {
        range: text.range(found.site.span),
        placeholder: checked.analysis.name_at(found.site),
    })
}

/// The name at a position, unless it is declared in the standard library, which cannot be changed.
fn renameable(checked: &Checked, position: Position) -> Result<Occurrence, Refused> {
    let analysis = &checked.analysis;
    let found = analysis.renameable(Text::new(analysis.text()).offset(position))?;
    match analysis.definition(found.symbol) {
        Some(site) if checked.uri_of(site.file).is_none() => {
            Err(Refused::Standard(analysis.name_at(site)))
        }
        _ => Ok(found),
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
) -> Result<WorkspaceEdit, Refused> {
    let found = renameable(checked, position)?;
    // By the names of the files: several texts may import one library.
    let mut changes: BTreeMap<String, (Uri, Places)> = BTreeMap::new();
    for (user, symbol) in users(documents, checked, found.symbol) {
        let libraries = documents.libraries(&user.uri);
        let renamed = user.analysis.rename(symbol, name, &libraries);
        let renamed = renamed.map_err(|error| match user.uri == checked.uri {
            true => Refused::Here(error),
            false => {
                let file = file_name(&user);
                Refused::Elsewhere { file, error }
            }
        })?;
        for file in renamed {
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
