//! Renaming, checked: the program means the same afterwards, or it is not renamed.
//!
//! The names are changed in copies of the texts, and the copies are checked: every name must keep its meaning, and
//! there must be no new error. So the rules of the language itself find names that collide, hide each other or get
//! another meaning. Uses in parts with errors cannot be checked this way; if the old name occurs in such a part,
//! nothing is renamed.

mod changes;

use crate::Analysis;
use crate::analysis::PRELUDE_FILE;
use crate::index::{Occurrence, role_enum};
use changes::{Changes, line};
use starl_core::Order;
use starl_lang::check::{Libraries, Symbol};
use starl_lang::diagnostic::{Edit, Span};
use starl_lang::ir::Site;
use starl_lang::syntax::SyntaxKind;
use thiserror::Error;

/// The changes of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileEdits {
    /// The number of the file.
    pub file: u32,
    /// Sorted by position.
    pub edits: Vec<Edit>,
}

/// Why something keeps its name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RenameError {
    /// There is no name, or one without a meaning.
    #[error("there is no known name here")]
    NoName,
    /// A library is called like its file.
    #[error("the library `{0}` has the name of its file")]
    Library(String),
    /// The language gives the name.
    #[error("`{0}` is a name that every program has")]
    Given(String),
    /// The language gives the name, which no text declares.
    #[error("this is a name that every program has")]
    Undeclared,
    /// The input of changed waypoints.
    #[error("`{name}` is an input that every program may hear", name = Order::WAY_POINTS)]
    WayPoints,
    /// The new name is not one.
    #[error(
        "`{0}` is not a name: a name consists of letters, digits and `_`, and does not begin with a digit"
    )]
    NotAName(String),
    /// The new name is `_`.
    #[error("`_` stands for an unused value")]
    Unused,
    /// The new name is a keyword.
    #[error("`{0}` is a keyword")]
    Keyword(String),
    /// The old name occurs in a part with errors.
    #[error("the meaning of `{old}` in {place} is unknown; fix the errors first")]
    Unclear {
        /// The old name.
        old: String,
        /// Where it occurs, e.g. `line 12`.
        place: String,
    },
    /// The program would mean something else.
    #[error("`{old}` cannot become `{name}`: {reason}")]
    Conflict {
        /// The old name.
        old: String,
        /// The new name.
        name: String,
        /// The name that would mean something else, or the new error.
        reason: String,
    },
}

impl Analysis {
    /// The name at a place of the text, if it can be renamed; else why not.
    ///
    /// # Errors
    /// Why it cannot.
    pub fn renameable(&self, offset: u32) -> Result<Occurrence, RenameError> {
        let Some(found) = self.occurrence(offset) else {
            return Err(RenameError::NoName);
        };
        self.may_rename(found.symbol)?;
        Ok(found)
    }

    /// Whether something can be renamed; else why not.
    fn may_rename(&self, symbol: Symbol) -> Result<(), RenameError> {
        let program = &self.checked.program;
        let role = program.roles.as_ref().map(|roles| roles.variable);
        let name = |site| self.name_at(site);
        match (symbol, self.definition(symbol)) {
            (Symbol::File(file), Some(site)) if file > 0 || program.is_library => {
                Err(RenameError::Library(name(site)))
            }
            (Symbol::Variable(id), _) if Some(id) == role => Err(RenameError::Given("role".into())),
            (Symbol::Enum(id), _) if Some(id) == role_enum(program) => {
                Err(RenameError::Given("role".into()))
            }
            (Symbol::Input(_), Some(site)) if self.name_at(site) == Order::WAY_POINTS => {
                Err(RenameError::WayPoints)
            }
            (_, Some(site)) if site.file == PRELUDE_FILE => Err(RenameError::Given(name(site))),
            (_, None) => Err(RenameError::Undeclared),
            _ => Ok(()),
        }
    }

    /// The changes that give something another name, by file. `libraries` are those that the text was checked with.
    ///
    /// # Errors
    /// Why it keeps its name.
    pub fn rename(
        &self,
        symbol: Symbol,
        name: &str,
        libraries: &dyn Libraries,
    ) -> Result<Vec<FileEdits>, RenameError> {
        self.may_rename(symbol)?;
        valid(name)?;
        let names = self.references(symbol);
        let Some(first) = names.first() else {
            return Err(RenameError::NoName);
        };
        let old = self.name_at(first.site);
        if old == name {
            return Ok(Vec::new());
        }
        self.refuse_unclear(&old)?;
        let changes = Changes::new(&names, name);
        let changed = changes.check(self, libraries);
        changes.compare(self, &changed, &old)?;
        Ok(changes.edits())
    }

    /// Refuses if the name stands where it is not known what it stands for.
    fn refuse_unclear(&self, old: &str) -> Result<(), RenameError> {
        if !self.checked.has_errors() {
            return Ok(());
        }
        for (number, file) in self.checked.files.iter().enumerate() {
            let root = file.parse.syntax();
            let all = root.descendants_with_tokens();
            let words = all.filter_map(rowan::NodeOrToken::into_token);
            let same =
                words.filter(|word| word.kind() == SyntaxKind::Identifier && word.text() == old);
            for word in same {
                let span = Span::from(word.text_range());
                let file = number as u32;
                if self.index.exactly(Site { file, span }).is_none() {
                    let place = line(&self.checked, Site { file, span });
                    let old = old.into();
                    return Err(RenameError::Unclear { old, place });
                }
            }
        }
        Ok(())
    }
}

/// Whether it can be a name.
fn valid(name: &str) -> Result<(), RenameError> {
    let mut letters = name.chars();
    let is_word = letters
        .next()
        .is_some_and(|first| first == '_' || first.is_ascii_alphabetic())
        && letters.all(|letter| letter == '_' || letter.is_ascii_alphanumeric());
    if !is_word {
        return Err(RenameError::NotAName(name.into()));
    }
    if name == "_" {
        return Err(RenameError::Unused);
    }
    if SyntaxKind::keyword(name).is_some() {
        return Err(RenameError::Keyword(name.into()));
    }
    Ok(())
}
