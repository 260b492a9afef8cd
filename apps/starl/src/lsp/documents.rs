//! The open texts, the files beside them, and their analyses.

use super::location;
use lsp_types::Uri;
use starl_catalog::disk;
use starl_core::FileError;
use starl_editor::{Analysis, is_library};
use starl_lang::check::{Libraries, StandardLibraries};
use starl_lang::syntax::MAX_LENGTH;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The suffix of a file of the language.
const SUFFIX: &str = "starl";

/// How many files of a folder are looked at for other uses of what a library declares.
const MOST_FILES: usize = 1_000;

/// A text that is open.
struct Document {
    uri: Uri,
    /// `None` if there is no such file yet.
    path: Option<PathBuf>,
    version: i32,
    text: Rc<str>,
    /// The analysis; none if it, or an imported library, may have changed.
    checked: RefCell<Option<Rc<Checked>>>,
    /// Whether its diagnostics have been sent to the editor.
    is_told: bool,
}

/// A library that is a file.
struct Found {
    path: PathBuf,
    /// As the editor named it, if it is open.
    uri: Option<Uri>,
}

/// A text that was checked.
pub struct Checked {
    /// The analysis.
    pub analysis: Analysis,
    /// Where it is.
    pub uri: Uri,
    /// The libraries that it was checked with, by name, as far as they are files.
    found: BTreeMap<String, Found>,
    /// The files that would change it, if they came or changed.
    asked: BTreeSet<PathBuf>,
}

impl Checked {
    /// The editor's URI of one of its files; none for a file that is part of the command.
    pub fn uri_of(&self, file: u32) -> Option<Uri> {
        if file == 0 {
            return Some(self.uri.clone());
        }
        let name = &self.analysis.checked.files.get(file as usize)?.name;
        self.found.get(name)?.uri.clone()
    }

    /// The path of one of its files.
    pub fn path_of(&self, file: u32) -> Option<PathBuf> {
        if file == 0 {
            return location::path(&self.uri);
        }
        let name = &self.analysis.checked.files.get(file as usize)?.name;
        Some(self.found.get(name)?.path.clone())
    }
}

/// All texts.
#[derive(Default)]
pub struct Documents {
    open: BTreeMap<String, Document>,
}

impl Documents {
    /// Adds an opened text.
    pub fn open(&mut self, uri: Uri, version: i32, text: String) {
        let path = location::path(&uri);
        self.forget_importers(path.as_deref());
        let document = Document {
            path,
            version,
            text: text.into(),
            checked: RefCell::default(),
            is_told: false,
            uri: uri.clone(),
        };
        self.open.insert(uri.as_str().to_string(), document);
    }

    /// Applies a change; `change` computes the new text from the old. False if the text is not open.
    pub fn change(&mut self, uri: &Uri, version: i32, change: impl FnOnce(&str) -> String) -> bool {
        let Some(document) = self.open.get_mut(uri.as_str()) else {
            return false;
        };
        document.text = change(&document.text).into();
        document.version = version;
        document.is_told = false;
        document.checked.take();
        let path = document.path.clone();
        self.forget_importers(path.as_deref());
        true
    }

    /// Removes a closed text.
    pub fn close(&mut self, uri: &Uri) {
        if let Some(document) = self.open.remove(uri.as_str()) {
            self.forget_importers(document.path.as_deref());
        }
    }

    /// Drops the analyses of all texts, because files have changed.
    pub fn forget(&mut self) {
        for document in self.open.values_mut() {
            document.is_told = false;
            document.checked.take();
        }
    }

    /// Forgets what is known of the texts that import this one, or tried to.
    fn forget_importers(&mut self, path: Option<&Path>) {
        let Some(path) = path else { return };
        for document in self.open.values_mut() {
            let known = document.checked.get_mut();
            if known
                .as_ref()
                .is_some_and(|known| known.asked.contains(path))
            {
                document.is_told = false;
                *known = None;
            }
        }
    }

    /// The analysis of an open text.
    pub fn checked(&self, uri: &Uri) -> Option<Rc<Checked>> {
        let document = self.open.get(uri.as_str())?;
        let mut known = document.checked.borrow_mut();
        if let Some(checked) = &*known {
            return Some(Rc::clone(checked));
        }
        let checked = Rc::new(self.check(&document.uri, document.path.as_deref(), &document.text));
        *known = Some(Rc::clone(&checked));
        Some(checked)
    }

    fn check(&self, uri: &Uri, path: Option<&Path>, text: &str) -> Checked {
        let beside = self.beside(path);
        let analysis = Analysis::new(text, &beside);
        Checked {
            analysis,
            uri: uri.clone(),
            found: beside.found.into_inner(),
            asked: beside.asked.into_inner(),
        }
    }

    /// The libraries that a text may import.
    pub fn libraries(&self, uri: &Uri) -> Beside<'_> {
        let path = location::path(uri);
        self.beside(path.as_deref())
    }

    fn beside(&self, path: Option<&Path>) -> Beside<'_> {
        Beside {
            documents: self,
            folder: path.and_then(Path::parent).map(Path::to_path_buf),
            found: RefCell::default(),
            asked: RefCell::default(),
        }
    }

    /// The texts whose problems have not been published, with their versions.
    pub fn untold(&mut self) -> Vec<(Rc<Checked>, i32)> {
        let uris: Vec<Uri> = (self.open.values_mut())
            .filter(|document| !document.is_told)
            .map(|document| {
                document.is_told = true;
                document.uri.clone()
            })
            .collect();
        let checked = uris.iter().filter_map(|uri| {
            let version = self.open.get(uri.as_str())?.version;
            Some((self.checked(uri)?, version))
        });
        checked.collect()
    }

    /// The other texts that may name what a file declares: those in its folder, open or not.
    pub fn importers(&self, of: &Path) -> Vec<Rc<Checked>> {
        let Some(folder) = of.parent() else {
            return Vec::new();
        };
        let mut importers = Vec::new();
        let in_folder = |document: &&Document| {
            let path = document.path.as_deref();
            path.and_then(Path::parent) == Some(folder) && path != Some(of)
        };
        for document in self.open.values().filter(in_folder) {
            importers.extend(self.checked(&document.uri));
        }
        for path in files(folder) {
            if path == of || self.open_text(&path).is_some() {
                continue;
            }
            let (Some(text), Some(uri)) = (file_text(&path), location::uri(&path)) else {
                continue;
            };
            if text.contains("import") {
                importers.push(Rc::new(self.check(&uri, Some(&path), &text)));
            }
        }
        importers
    }

    /// The text of a file, if it is open.
    pub fn checked_file(&self, path: &Path) -> Option<Rc<Checked>> {
        self.checked(&self.open_text(path)?.uri)
    }

    fn open_text(&self, path: &Path) -> Option<&Document> {
        let mut documents = self.open.values();
        documents.find(|document| document.path.as_deref() == Some(path))
    }
}

/// The libraries of a folder: texts that are open, then files, then the standard library.
pub struct Beside<'a> {
    documents: &'a Documents,
    folder: Option<PathBuf>,
    found: RefCell<BTreeMap<String, Found>>,
    asked: RefCell<BTreeSet<PathBuf>>,
}

impl Libraries for Beside<'_> {
    fn source(&self, name: &str) -> Option<String> {
        let beside = self.folder.as_ref().and_then(|folder| {
            let path = folder.join(name).with_extension(SUFFIX);
            self.asked.borrow_mut().insert(path.clone());
            let (text, uri) = match self.documents.open_text(&path) {
                Some(document) => (document.text.to_string(), Some(document.uri.clone())),
                None => (file_text(&path)?, location::uri(&path)),
            };
            let found = Found { path, uri };
            self.found.borrow_mut().insert(name.to_string(), found);
            Some(text)
        });
        beside.or_else(|| StandardLibraries.source(name))
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let folder = self.folder.as_ref();
        let path = folder.map(|folder| folder.join(path));
        let path = path.ok_or(FileError::Missing)?;
        self.asked.borrow_mut().insert(path.clone());
        disk::read(&path)
    }

    fn names(&self) -> Vec<String> {
        let mut names = StandardLibraries.names();
        let folder = self.folder.as_deref();
        let beside = folder.map(files).unwrap_or_default();
        let open = (self.documents.open.values())
            .filter_map(|document| document.path.clone())
            .filter(|path| path.parent() == folder);
        for path in beside.into_iter().chain(open) {
            let is_library = match self.documents.open_text(&path) {
                Some(document) => is_library(&document.text),
                None => file_text(&path).is_some_and(|text| is_library(&text)),
            };
            let name = path.file_stem().and_then(|name| name.to_str());
            names.extend(name.filter(|_| is_library).map(str::to_string));
        }
        names.sort();
        names.dedup();
        names
    }
}

/// The files of the language in a folder, in order.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let own = paths.filter(|path| path.extension().is_some_and(|suffix| suffix == SUFFIX));
    let mut files: Vec<PathBuf> = own.take(MOST_FILES).collect();
    files.sort();
    files
}

/// The text of a file; none if it cannot be read.
fn file_text(path: &Path) -> Option<String> {
    let size = fs::metadata(path).ok().filter(fs::Metadata::is_file)?.len();
    if size > MAX_LENGTH as u64 {
        return None;
    }
    fs::read_to_string(path).ok()
}
