//! The values of a table that are not tables: numbers, texts, points and lists of these.
//!
//! Each method asks for a field of one kind; which kinds, ranges and defaults there are is the
//! schema's to say.

use super::plain::FieldValue;
use super::report::Origin;
use super::schema::{Default, Dimension, Field, Kind};
use super::section::Section;
use super::tree::{Node, Value};
use super::value;
use starl_core::{Duration, Point};

impl<'a> Section<'a> {
    /// A text, or none.
    pub fn text(&self, name: &str) -> Option<String> {
        self.read(name, value::text)
    }

    /// A list of texts, each with its place and path.
    pub fn texts(&self, name: &str) -> Vec<(String, Origin, String)> {
        self.list(name)
            .into_iter()
            .filter_map(|(node, path)| match value::text(node) {
                Ok(text) => Some((text, node.origin, path)),
                Err(complaint) => {
                    self.report.complain(node.origin, &path, complaint);
                    None
                }
            })
            .collect()
    }

    /// The elements of a list with their paths.
    pub fn list(&self, name: &str) -> Vec<(&'a Node, String)> {
        let path = self.path_of(name);
        let list = self.read(name, |node| match &node.value {
            Value::List(list) => Ok(list),
            other => {
                let help = match self.field(name).kind {
                    Kind::Tables(_) => format!("write [[{path}]], with two brackets"),
                    _ => "write it in brackets: [..., ...]".to_string(),
                };
                Err((format!("{} is not a list", other.describe()), Some(help)))
            }
        });
        let numbered = |(index, node)| (node, format!("{path}.{index}"));
        list.map_or(&[][..], Vec::as_slice)
            .iter()
            .enumerate()
            .map(numbered)
            .collect()
    }

    /// The value of a field of plain data, or none where there is neither value nor default.
    fn plain<T: FieldValue>(&self, name: &str) -> Option<T> {
        let field = self.field(name);
        let preset = || matches!(field.default, Default::Value(_)).then(|| T::preset(field));
        T::read(*self, name).or_else(preset)
    }

    /// `true` or `false`.
    pub fn flag(&self, name: &str) -> bool {
        self.plain(name).unwrap_or_default()
    }

    /// One of a choice of words.
    pub fn choice(&self, name: &str) -> Option<String> {
        let Field { kind, default, .. } = self.field(name);
        let words = if let Kind::Choice(words) = kind {
            words
        } else {
            &[][..]
        };
        self.read(name, |node| value::choice(node, words))
            .or(match default {
                Default::Value(word) => Some((*word).to_string()),
                _ => None,
            })
    }

    /// The name of a robot model.
    pub fn model(&self, name: &str) -> Option<String> {
        self.read(name, value::model)
    }

    /// A whole number, or none where there is neither value nor default.
    pub fn count(&self, name: &str) -> Option<u64> {
        let Field { kind, default, .. } = self.field(name);
        let (least, most) = if let Kind::Count(least, most) = kind {
            (*least, *most)
        } else {
            (0, u64::MAX)
        };
        self.read(name, |node| value::count(node, least, most))
            .or(match default {
                Default::Value(text) => text.parse().ok(),
                _ => None,
            })
    }

    /// A probability or quantity in SI, or none where there is neither value nor default.
    pub fn optional_number(&self, name: &str) -> Option<f64> {
        self.plain(name)
    }

    /// A probability or quantity in SI.
    pub fn number(&self, name: &str) -> f64 {
        self.optional_number(name).unwrap_or_default()
    }

    /// A duration, or none where there is neither value nor default.
    pub fn optional_duration(&self, name: &str) -> Option<Duration> {
        self.plain(name)
    }

    /// A duration.
    pub fn duration(&self, name: &str) -> Duration {
        self.optional_duration(name).unwrap_or_default()
    }

    /// A point, with the number of coordinates given.
    pub fn point(&self, name: &str) -> Option<(Point, usize)> {
        let spatial = matches!(self.field(name).kind, Kind::Point);
        self.read(name, |node| value::point(node, Dimension::Length, spatial))
    }

    /// A list of points of the floor plane.
    pub fn outline(&self, name: &str) -> Vec<Point> {
        let mut points = Vec::new();
        for (node, path) in self.list(name) {
            match value::point(node, Dimension::Length, false) {
                Ok((point, _)) => points.push(point),
                Err(complaint) => self.report.complain(node.origin, &path, complaint),
            }
        }
        points
    }

    /// A pair of heights.
    pub fn heights(&self, name: &str) -> Option<(f64, f64)> {
        self.read(name, value::heights)
    }
}
