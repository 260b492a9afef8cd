//! The description of a name, as editors show it.

/// The description of a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Description {
    /// How it is declared, in the language: `function f(a: Int) -> Int`.
    pub signature: String,
    /// Its documentation, in Markdown; may be empty.
    pub documentation: String,
    /// Of a local what kind it is.
    pub of_locals: Option<&'static str>,
}

impl Description {
    pub(crate) fn new(signature: impl Into<String>, documentation: impl Into<String>) -> Self {
        Self {
            signature: signature.into(),
            documentation: documentation.into(),
            of_locals: None,
        }
    }

    /// All of it in Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut parts = Vec::from([format!("```starl\n{}\n```", self.signature)]);
        let kind = self.of_locals.filter(|kind| *kind != "a local variable");
        parts.extend(kind.map(|kind| format!("_{kind}_")));
        if !self.documentation.is_empty() {
            parts.push(self.documentation.clone());
        }
        parts.join("\n\n")
    }
}
