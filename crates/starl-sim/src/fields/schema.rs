//! The kinds of fields of a scenario, with their ranges, defaults and meanings.

pub use super::unit::Dimension;

/// A field of a table.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name in the file.
    pub name: &'static str,
    /// The kind of its value.
    pub kind: Kind,
    /// The default.
    pub default: Default,
    /// The meaning, in a sentence.
    pub about: &'static str,
}

/// The default of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Default {
    /// This value, as it would be written in the file without quotes.
    Value(&'static str),
    /// Nothing; this word says so, and may be written too.
    Word(&'static str),
    /// Something that depends on other fields, in words.
    Depends(&'static str),
    /// The previous value, in a change; the word removes it.
    Kept(Option<&'static str>),
    /// It must not be left out.
    Required,
}

/// Which numbers are allowed; all must be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// All.
    Any,
    /// Zero and above.
    NotNegative,
    /// Above zero.
    Positive,
    /// A span of time that is not so short that a run in such steps would never end.
    Period,
}

/// The least [`Range::Period`], seconds.
pub const LEAST_PERIOD: f64 = 1e-4;

/// The kind of a field's value.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A text that is not empty.
    Text,
    /// A list of texts.
    Texts,
    /// `true` or `false`.
    Flag,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// The name of a robot model.
    Model,
    /// A whole number, both ends included.
    Count(u64, u64),
    /// A number from 0 to 1, or a percentage.
    Probability,
    /// A number with a unit.
    Quantity(Dimension, Range),
    /// `[x, y]` or `[x, y, z]`, lengths.
    Point,
    /// `[x, y]`, lengths.
    PlanarPoint,
    /// Two or more of `[x, y]`.
    Outline,
    /// `[x, y]` or `[x, y, z]`, speeds.
    Velocity,
    /// `[low, high]`, lengths.
    Heights,
    /// Robots: a list of names of robots or of groups, or `"all"`.
    Robots,
    /// A list of such lists.
    RobotGroups,
    /// Values under names of the program's own.
    Parameters,
    /// Numbers under names of the model's own.
    ModelParameters,
    /// A table.
    Table(&'static [Field]),
    /// Any number of tables.
    Tables(&'static [Field]),
    /// A table that may also be `true`, all its fields at their defaults, or `false`.
    Switch(&'static [Field]),
}

/// Declares fields: for each its name, its kind and its default. The comment is the meaning in the reference.
macro_rules! fields {
    ($($(#[doc = $about:literal])+ $name:ident = $kind:expr, $how:ident $(($default:expr))?;)+) => {
        &[$($crate::fields::schema::Field {
            name: stringify!($name),
            kind: $kind,
            default: $crate::fields::schema::Default::$how $(($default))?,
            about: concat!($($about),+).trim_ascii(),
        },)+]
    };
}

pub(crate) use fields;

/// Several lists, one behind the other.
pub(crate) const fn join<T: Copy, const COUNT: usize>(lists: &[&[T]]) -> [T; COUNT] {
    let mut all = [lists[0][0]; COUNT];
    let (mut list, mut count) = (0, 0);
    while list < lists.len() {
        let mut index = 0;
        while index < lists[list].len() {
            all[count] = lists[list][index];
            count += 1;
            index += 1;
        }
        list += 1;
    }
    assert!(count == COUNT);
    all
}

/// A duration above zero.
pub(crate) const SPAN: Kind = Kind::Quantity(Dimension::Time, Range::Positive);
/// A duration between two events of the same kind.
pub(crate) const PERIOD: Kind = Kind::Quantity(Dimension::Time, Range::Period);
/// A duration.
pub(crate) const TIME: Kind = Kind::Quantity(Dimension::Time, Range::NotNegative);
/// A length above zero.
pub(crate) const SIZE: Kind = Kind::Quantity(Dimension::Length, Range::Positive);
/// A length.
pub(crate) const LENGTH: Kind = Kind::Quantity(Dimension::Length, Range::NotNegative);
/// A standard deviation or bound of a relative error.
pub(crate) const RATIO: Kind = Kind::Quantity(Dimension::Ratio, Range::NotNegative);
/// A speed.
pub(crate) const SPEED: Kind = Kind::Quantity(Dimension::Speed, Range::NotNegative);
/// Events in a second.
pub(crate) const RATE: Kind = Kind::Quantity(Dimension::Rate, Range::NotNegative);

/// The names of the robot models.
pub fn model_names() -> impl Iterator<Item = &'static str> {
    starl_motion::models::NAMES
        .into_iter()
        .map(|(name, _)| name)
}

impl Kind {
    /// The kind in words, for the reference.
    pub fn describe(&self) -> String {
        let range = |range: Range| match range {
            Range::Any => "",
            Range::NotNegative => ", at least 0",
            Range::Positive => ", above 0",
            Range::Period => ", at least 100us",
        };
        match self {
            Kind::Text => "text".to_string(),
            Kind::Texts => "list of texts".to_string(),
            Kind::Flag => "true or false".to_string(),
            Kind::Choice(words) => words
                .iter()
                .map(|word| format!("`\"{word}\"`"))
                .collect::<Vec<_>>()
                .join(", "),
            Kind::Model => model_names()
                .map(|name| format!("`\"{name}\"`"))
                .collect::<Vec<_>>()
                .join(", "),
            Kind::Count(least, u64::MAX) => format!("whole number, at least {least}"),
            Kind::Count(least, most) => format!("whole number, {least} to {most}"),
            Kind::Probability => "probability, 0 to 1 or a percentage".to_string(),
            Kind::Quantity(dimension, limits) => {
                let name = dimension
                    .name()
                    .trim_start_matches("an ")
                    .trim_start_matches("a ");
                format!("{name}{}", range(*limits))
            }
            Kind::Point => "point `[x, y]` or `[x, y, z]`".to_string(),
            Kind::PlanarPoint => "point `[x, y]`".to_string(),
            Kind::Outline => "list of points `[x, y]`".to_string(),
            Kind::Velocity => "velocity `[x, y]` or `[x, y, z]`".to_string(),
            Kind::Heights => "heights `[low, high]`".to_string(),
            Kind::Robots => "robots".to_string(),
            Kind::RobotGroups => "list of robots".to_string(),
            Kind::Parameters => "table of anything".to_string(),
            Kind::ModelParameters => "table of quantities".to_string(),
            Kind::Table(_) => "table".to_string(),
            Kind::Tables(_) => "list of tables".to_string(),
            Kind::Switch(_) => "table, `true` or `false`".to_string(),
        }
    }

    /// The fields of a table's kind.
    pub fn fields(&self) -> &'static [Field] {
        match self {
            Kind::Table(fields) | Kind::Tables(fields) | Kind::Switch(fields) => fields,
            _ => &[],
        }
    }
}

impl Default {
    /// The default, for the reference.
    pub fn describe(&self) -> String {
        match self {
            Default::Value(text) | Default::Word(text) | Default::Depends(text) => {
                (*text).to_string()
            }
            Default::Kept(None) => "as it is".to_string(),
            Default::Kept(Some(word)) => format!("as it is; or `\"{word}\"`"),
            Default::Required => "required".to_string(),
        }
    }
}
