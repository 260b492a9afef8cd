//! Quantities as people write them: `100ms`, `330 mm`, `90deg`, `20%`.
//!
//! Inside, everything is SI: seconds, metres, radians, metres per second, bits per second.

use starl_core::math;

/// The quantity that a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Seconds.
    Time,
    /// Metres.
    Length,
    /// Radians.
    Angle,
    /// Metres per second.
    Speed,
    /// Radians per second.
    TurnRate,
    /// Metres per second squared.
    Acceleration,
    /// Kilograms.
    Mass,
    /// Kilograms per second: force over speed.
    Drag,
    /// Bits per second.
    BitRate,
    /// Events per second.
    Rate,
    /// A number without a unit, or with `%` or `ppm`.
    Ratio,
}

impl Dimension {
    /// Its name, with the article.
    pub fn name(self) -> &'static str {
        match self {
            Dimension::Time => "a duration",
            Dimension::Length => "a length",
            Dimension::Angle => "an angle",
            Dimension::Speed => "a speed",
            Dimension::TurnRate => "a rate of turn",
            Dimension::Acceleration => "an acceleration",
            Dimension::Mass => "a mass",
            Dimension::Drag => "a linear drag",
            Dimension::BitRate => "a bit rate",
            Dimension::Rate => "a rate",
            Dimension::Ratio => "a ratio",
        }
    }

    /// How one is written.
    pub fn example(self) -> &'static str {
        match self {
            Dimension::Time => "\"100ms\" or \"2s\"",
            Dimension::Length => "\"0.5m\" or \"330mm\"",
            Dimension::Angle => "\"90deg\" or \"1.57rad\"",
            Dimension::Speed => "\"0.2m/s\" or \"250mm/s\"",
            Dimension::TurnRate => "\"50deg/s\" or \"0.9rad/s\"",
            Dimension::Acceleration => "\"2m/s2\"",
            Dimension::Mass => "\"0.5kg\" or \"500g\"",
            Dimension::Drag => "\"0.3kg/s\"",
            Dimension::BitRate => "\"1Mbit/s\" or \"250kbit/s\"",
            Dimension::Rate => "\"0.1/s\" or \"2/min\"",
            Dimension::Ratio => "0.05 or \"5%\"",
        }
    }

    /// The names of its units, the smallest first.
    pub fn unit_names(self) -> impl Iterator<Item = &'static str> {
        let own = UNITS.iter().filter(move |unit| unit.dimension == self);
        own.map(|unit| unit.name)
    }

    /// The name of its unit in SI; empty for a ratio.
    pub(crate) fn si(self) -> &'static str {
        let is_si = |unit: &&Unit| unit.dimension == self && unit.times == unit.over;
        UNITS.iter().find(is_si).map_or("", |unit| unit.name)
    }

    /// All spellings of its units, such as `us` and `\u{b5}s`.
    pub fn spellings(self) -> impl Iterator<Item = &'static str> {
        self.unit_names().flat_map(|name| {
            let others = ALIASES.iter().filter(move |(_, plain)| *plain == name);
            [name].into_iter().chain(others.map(|(alias, _)| *alias))
        })
    }

    /// The quantity of a model's parameter whose unit has this name in the model, and the unit's name in
    /// scenarios.
    pub fn of_model_unit(unit: &'static str) -> (Dimension, &'static str) {
        match unit {
            "m" => (Dimension::Length, unit),
            "m/s" => (Dimension::Speed, unit),
            "m/s2" => (Dimension::Acceleration, unit),
            "kg" => (Dimension::Mass, unit),
            "kg/s" => (Dimension::Drag, unit),
            "s" => (Dimension::Time, unit),
            "rad" => (Dimension::Angle, unit),
            "rad/s" => (Dimension::TurnRate, unit),
            "degrees" => (Dimension::Angle, "deg"),
            "degrees/s" => (Dimension::TurnRate, "deg/s"),
            _ => (Dimension::Ratio, ""),
        }
    }

    /// Its units, e.g. `ns, us, ms, s, min or h`.
    pub(crate) fn units(self) -> String {
        let names: Vec<&str> = self.unit_names().collect();
        match names.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            Some((last, _)) => last.to_string(),
            None => String::new(),
        }
    }
}

/// A unit: a number of it, times `times`, divided by `over`, is in SI. Two exact whole numbers instead of one
/// factor, so that `75mm` is the number nearest to 0.075.
struct Unit {
    name: &'static str,
    dimension: Dimension,
    times: f64,
    over: f64,
}

const fn unit(name: &'static str, dimension: Dimension, times: f64, over: f64) -> Unit {
    Unit {
        name,
        dimension,
        times,
        over,
    }
}

const UNITS: &[Unit] = &[
    unit("ns", Dimension::Time, 1.0, 1e9),
    unit("us", Dimension::Time, 1.0, 1e6),
    unit("ms", Dimension::Time, 1.0, 1e3),
    unit("s", Dimension::Time, 1.0, 1.0),
    unit("min", Dimension::Time, 60.0, 1.0),
    unit("h", Dimension::Time, 3600.0, 1.0),
    unit("mm", Dimension::Length, 1.0, 1e3),
    unit("cm", Dimension::Length, 1.0, 1e2),
    unit("m", Dimension::Length, 1.0, 1.0),
    unit("km", Dimension::Length, 1e3, 1.0),
    unit("deg", Dimension::Angle, math::PI, 180.0),
    unit("rad", Dimension::Angle, 1.0, 1.0),
    unit("mm/s", Dimension::Speed, 1.0, 1e3),
    unit("cm/s", Dimension::Speed, 1.0, 1e2),
    unit("m/s", Dimension::Speed, 1.0, 1.0),
    unit("km/h", Dimension::Speed, 1.0, 3.6),
    unit("deg/s", Dimension::TurnRate, math::PI, 180.0),
    unit("rad/s", Dimension::TurnRate, 1.0, 1.0),
    unit("m/s2", Dimension::Acceleration, 1.0, 1.0),
    unit("g", Dimension::Mass, 1.0, 1e3),
    unit("kg", Dimension::Mass, 1.0, 1.0),
    unit("kg/s", Dimension::Drag, 1.0, 1.0),
    unit("bit/s", Dimension::BitRate, 1.0, 1.0),
    unit("kbit/s", Dimension::BitRate, 1e3, 1.0),
    unit("Mbit/s", Dimension::BitRate, 1e6, 1.0),
    unit("Gbit/s", Dimension::BitRate, 1e9, 1.0),
    unit("/s", Dimension::Rate, 1.0, 1.0),
    unit("/min", Dimension::Rate, 1.0, 60.0),
    unit("/h", Dimension::Rate, 1.0, 3600.0),
    unit("%", Dimension::Ratio, 1.0, 1e2),
    unit("ppm", Dimension::Ratio, 1.0, 1e6),
];

/// Other spellings of units: the micro sign, the degree sign and the superscript two.
const ALIASES: &[(&str, &str)] = &[
    ("\u{b5}s", "us"),
    ("\u{3bc}s", "us"),
    ("\u{b0}", "deg"),
    ("\u{b0}/s", "deg/s"),
    ("m/s\u{b2}", "m/s2"),
    ("m/s^2", "m/s2"),
];

/// A number and its unit, read from a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity<'a> {
    /// The number as written.
    pub number: f64,
    /// The unit as written; may be empty.
    pub unit: &'a str,
}

impl<'a> Quantity<'a> {
    /// Splits a text into number and unit; none if it does not begin with a number.
    pub fn split(text: &'a str) -> Option<Quantity<'a>> {
        let text = text.trim();
        let bytes = text.as_bytes();
        let digits = |from: usize| {
            from + bytes[from..]
                .iter()
                .take_while(|b| b.is_ascii_digit() || **b == b'_')
                .count()
        };
        let sign = |from: usize| from + usize::from(matches!(bytes.get(from), Some(b'+' | b'-')));
        let mut end = digits(sign(0));
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let exponent = sign(end + 1);
            if bytes.get(exponent).is_some_and(u8::is_ascii_digit) {
                end = digits(exponent);
            }
        }
        let number = text[..end].replace('_', "").parse().ok()?;
        Some(Quantity {
            number,
            unit: text[end..].trim(),
        })
    }

    /// The dimension of the unit and the quantity in SI; none if the unit is not known.
    pub fn in_si(self) -> Option<(Dimension, f64)> {
        let alias = ALIASES.iter().find(|(alias, _)| *alias == self.unit);
        let name = alias.map_or(self.unit, |(_, name)| name);
        let unit = UNITS.iter().find(|unit| unit.name == name)?;
        Some((unit.dimension, self.number * unit.times / unit.over))
    }
}
