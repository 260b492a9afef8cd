//! The dotted path of a table, such as `robots.0.sensors`, built only when a problem needs it.

/// The dotted path of a table, as a chain towards the root.
pub(crate) struct Path<'a> {
    above: Option<&'a Path<'a>>,
    name: String,
}

impl<'a> Path<'a> {
    /// The path of the whole scenario.
    pub const ROOT: Path<'static> = Path {
        above: None,
        name: String::new(),
    };

    /// The path of the field `name` in this table.
    pub fn join(&self, name: &str) -> String {
        let mut names = vec![name];
        let mut path = Some(self);
        while let Some(Path { above, name }) = path {
            names.push(name);
            path = *above;
        }
        names.retain(|name| !name.is_empty());
        names.reverse();
        names.join(".")
    }

    /// The path of a table called `name` in here.
    pub fn below(&'a self, name: impl ToString) -> Path<'a> {
        Path {
            above: Some(self),
            name: name.to_string(),
        }
    }
}
