//! The simplest expressions of each type: literals, names, and what must be built from such.

use super::Generator;
use super::expression::{Context, Text, power};
use super::model::Type;

const INTS: &[&str] = &[
    "0",
    "1",
    "2",
    "3",
    "5",
    "7",
    "10",
    "1_000",
    "64",
    "-1",
    "-3",
    "9223372036854775807",
    "-9223372036854775808",
];
// Plain numbers, so that any two of them can be added.
const FLOATS: &[&str] = &[
    "0.0",
    "1.0",
    "0.5",
    "2.0",
    "3.75",
    "-2.25",
    "1e-3",
    "(75mm / 1m)",
    "(90deg / 1rad)",
    "12.0",
    "1e300",
    "-0.0",
];
const STRINGS: &[&str] = &[
    "\"\"",
    "\"a\"",
    "\"b c\"",
    "\"a,b\"",
    "\"\\n\\\"\"",
    "\"\\u{e9}x\"",
    "\"x // y\"",
    "\"{}\"",
];
const DURATIONS: &[&str] = &["0s", "1s", "500ms", "1.5min", "3ns", "20us", "1h"];
const BOOLS: &[&str] = &["false", "true"];

impl Generator<'_> {
    /// A literal, a name, or the least that makes a value of the type.
    pub(super) fn leaf(&mut self, ty: &Type, context: Context) -> Text {
        self.budget = self.budget.saturating_sub(1);
        if self.choices.below(3) > 0 || !self.can_write(ty) {
            let names = self.readable(ty);
            if !names.is_empty() {
                let name = names[self.choices.below(names.len().min(256))].clone();
                return Text::atom(name);
            }
        }
        self.literal(ty, context)
    }

    fn literal(&mut self, ty: &Type, context: Context) -> Text {
        match ty {
            Type::Bool => self.one_of(BOOLS),
            Type::Int => self.one_of(INTS),
            Type::Float => self.one_of(FLOATS),
            Type::String => self.one_of(STRINGS),
            Type::Duration => self.one_of(DURATIONS),
            Type::Point => {
                let (x, y) = (self.one_of(FLOATS), self.one_of(FLOATS));
                Text::atom(format!("Point({}, {})", x.text, y.text))
            }
            // Nothing asks for one where there is none, see `can_make`.
            Type::Time => Text::atom("now"),
            Type::Robot => Text::atom("me"),
            Type::Obstacles => Text::atom("obstacles()"),
            Type::Area => {
                let center = self.leaf(&Type::Point, Context::Fit);
                Text::atom(format!("circle({}, 2.5)", center.text))
            }
            Type::Enum(number) => self.variant(*number, context),
            Type::Record(number) => self.record(*number, 0),
            Type::Tuple(parts) => self.tuple(parts, context, 0),
            Type::List(element) => {
                if context != Context::Unknown && self.choices.below(2) == 0 {
                    return Text::atom("[]");
                }
                let element = self.leaf(element, context.part());
                Text::atom(format!("[{}]", element.text))
            }
            Type::Set(element) => {
                if context != Context::Unknown && self.choices.below(2) == 0 {
                    return Text::atom("{}");
                }
                let element = self.leaf(element, context.part());
                Text::atom(format!("{{{}}}", element.text))
            }
            Type::Map(key, value) => {
                if context != Context::Unknown && self.choices.below(2) == 0 {
                    return Text::atom("{:}");
                }
                let key = self.leaf(key, context.part());
                let value = self.leaf(value, context.part());
                Text::atom(format!("{{{}: {}}}", key.text, value.text))
            }
            Type::Optional(inner) => match context {
                Context::Fit if self.choices.below(2) == 1 && self.can_make(inner) => {
                    self.leaf(inner, Context::Fit)
                }
                Context::Unknown => {
                    let element = self.leaf(inner, Context::Unknown);
                    Text::atom(format!("[{}].first()", element.text))
                }
                _ => Text::atom("none"),
            },
        }
    }

    /// One of these; negative numbers bind less tightly.
    pub(super) fn one_of(&mut self, from: &[&str]) -> Text {
        let text = self.choices.pick(from);
        let power = if text.starts_with('-') {
            power::SIGN
        } else {
            power::ATOM
        };
        self.made(text.to_string(), power)
    }

    /// A variant, bare where that says enough.
    pub(super) fn variant(&mut self, number: usize, context: Context) -> Text {
        let of = &self.model.enums[number];
        let variant = of.variants[self.choices.below(of.variants.len())].clone();
        let of = &self.model.enums[number];
        let others = self.model.enums.iter().enumerate();
        let is_shared = others
            .filter(|(other, _)| *other != number)
            .any(|(_, other)| other.variants.contains(&variant));
        let needs_name = is_shared && context == Context::Unknown;
        match &of.name {
            Some(name) if needs_name || self.choices.below(3) == 2 => {
                Text::atom(format!("{name}.{variant}"))
            }
            _ => Text::atom(variant),
        }
    }

    /// `(a, b)`
    pub(super) fn tuple(&mut self, parts: &[Type], context: Context, depth: u32) -> Text {
        let parts: Vec<String> = (parts.iter())
            .map(|part| self.expression(part, context.part(), depth).text)
            .collect();
        Text::atom(format!("({})", parts.join(", ")))
    }

    /// A record, by position or by names.
    pub(super) fn record(&mut self, number: usize, depth: u32) -> Text {
        let fields = self.model.records[number].fields.clone();
        let name = self.model.records[number].name.clone();
        let is_named = self.choices.below(2) == 1;
        let mut values = Vec::new();
        for field in fields {
            let value = self.expression(&field.ty, Context::Fit, depth).text;
            values.push(match is_named {
                true => format!("{} = {value}", field.name),
                false => value,
            });
        }
        Text::atom(format!("{name}({})", values.join(", ")))
    }
}
