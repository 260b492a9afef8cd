//! Tables of plain data, declared in one place.

use super::schema::{Default as Preset, Dimension, Field, Kind};
use super::section::Section;
use super::tree::{Node, Value, parse_value};
use super::value::{self, Complaint};
use super::written::{Table, flag, number, quantity, spatial, text, time};
use starl_core::{Duration, Point};

/// A table of a scenario. [`field_table`] implements it.
pub(crate) trait FieldTable: Default + Clone + PartialEq {
    /// Its fields.
    const FIELDS: &'static [Field];

    /// Reads the table; fields that are left out are as in `base`.
    fn read_over(section: Section<'_>, base: &Self) -> Self;

    /// The table as the schema's defaults say, for tests.
    #[cfg(test)]
    fn presets() -> Self;

    /// Writes the fields that are not as in `base`, or all.
    fn write_over(&self, table: &mut Table, base: Option<&Self>);

    /// Reads the table; fields that are left out are at their defaults.
    fn read(section: Section<'_>) -> Self {
        Self::read_over(section, &Self::default())
    }

    /// The table of this name with the fields that are not at their defaults.
    fn write(&self, name: &str) -> String {
        let mut table = Table::named(name);
        self.write_over(&mut table, Some(&Self::default()));
        table.finish()
    }

    /// The same within a line; none if all fields are at their defaults.
    fn write_inline(&self) -> Option<String> {
        let mut table = Table::root();
        self.write_over(&mut table, Some(&Self::default()));
        table.inline()
    }
}

/// The value of a field of plain data.
pub(crate) trait FieldValue: Clone + PartialEq {
    /// The value that a word such as `never` stands for.
    fn absent() -> Option<Self> {
        None
    }

    /// Turns a node into the value, or says why it is not one.
    fn parse(node: &Node, kind: &Kind) -> Result<Self, Complaint>;

    /// Reads a field that is written.
    fn read(section: Section<'_>, name: &str) -> Option<Self> {
        let kind = &section.field(name).kind;
        section.read(name, |node| Self::parse(node, kind))
    }

    /// As it is written in a file.
    fn show(&self, field: &Field) -> String;

    /// Whether it has to be written where `base` would be read otherwise.
    fn differs(&self, base: &Self) -> bool {
        self != base
    }

    /// The value of a field that is left out, by the schema.
    fn preset(field: &Field) -> Self {
        let value = match field.default {
            Preset::Value(text) => {
                Self::parse(&parse_value(text, Default::default()), &field.kind).ok()
            }
            _ => Self::absent(),
        };
        value.unwrap_or_else(|| unreachable!("the default of {} is valid", field.name))
    }
}

/// A field's value in a table; none if it is left out.
pub(crate) fn read_written<T: FieldValue>(section: Section<'_>, name: &str) -> Option<T> {
    match (section.is_written(name), section.has(name)) {
        (true, true) => T::read(section, name),
        (true, false) => T::absent(),
        (false, _) => None,
    }
}

/// Adds a field that is not as in `base`.
pub(crate) fn write_over<T: FieldValue>(
    table: &mut Table,
    field: &Field,
    value: &T,
    base: Option<&T>,
) {
    if base.is_none_or(|base| value.differs(base)) {
        table.set(field.name, value.show(field));
    }
}

impl FieldValue for bool {
    fn parse(node: &Node, _: &Kind) -> Result<bool, Complaint> {
        value::flag(node)
    }

    fn show(&self, _: &Field) -> String {
        flag(*self)
    }
}

impl FieldValue for u32 {
    fn parse(node: &Node, kind: &Kind) -> Result<u32, Complaint> {
        let (least, most) = match kind {
            Kind::Count(least, most) => (*least, *most),
            _ => (0, u64::from(u32::MAX)),
        };
        value::count(node, least, most).map(|count| count as u32)
    }

    fn show(&self, _: &Field) -> String {
        self.to_string()
    }
}

impl FieldValue for f64 {
    fn parse(node: &Node, kind: &Kind) -> Result<f64, Complaint> {
        match kind {
            Kind::Quantity(dimension, range) => value::quantity(node, *dimension, *range),
            _ => value::probability(node),
        }
    }

    fn show(&self, field: &Field) -> String {
        match &field.kind {
            Kind::Quantity(dimension, _) if *dimension != Dimension::Ratio => {
                quantity(*self, dimension.si())
            }
            _ => number(*self),
        }
    }
}

impl FieldValue for Option<f64> {
    fn absent() -> Option<Option<f64>> {
        Some(None)
    }

    fn parse(node: &Node, kind: &Kind) -> Result<Option<f64>, Complaint> {
        f64::parse(node, kind).map(Some)
    }

    fn show(&self, field: &Field) -> String {
        match (self, field.default) {
            (Some(number), _) => number.show(field),
            (None, Preset::Word(word)) => text(word),
            (None, _) => unreachable!("a field that may have no value has a word for that"),
        }
    }
}

impl FieldValue for Duration {
    fn absent() -> Option<Duration> {
        Some(Duration::ZERO)
    }

    fn parse(node: &Node, kind: &Kind) -> Result<Duration, Complaint> {
        value::duration(f64::parse(node, kind)?)
    }

    fn show(&self, _: &Field) -> String {
        time(*self)
    }
}

impl FieldValue for Point {
    fn parse(node: &Node, _: &Kind) -> Result<Point, Complaint> {
        value::point(node, Dimension::Speed, true).map(|(velocity, _)| velocity)
    }

    fn show(&self, _: &Field) -> String {
        spatial(*self)
    }
}

/// A table that can be switched off.
impl<T: FieldTable> FieldValue for Option<T> {
    fn parse(node: &Node, _: &Kind) -> Result<Option<T>, Complaint> {
        match node.value {
            Value::Flag(is_on) => Ok(is_on.then(T::default)),
            _ => Err((String::new(), None)),
        }
    }

    fn read(section: Section<'_>, name: &str) -> Option<Option<T>> {
        Some(section.switch(name, T::read))
    }

    fn show(&self, _: &Field) -> String {
        let on = |table: &T| table.write_inline().unwrap_or_else(|| flag(true));
        self.as_ref().map_or_else(|| flag(false), on)
    }

    fn differs(&self, base: &Option<T>) -> bool {
        let fields = |table: &Option<T>| table.as_ref().map(T::write_inline);
        fields(self) != fields(base)
    }
}

/// Declares a table of a scenario: for each field its name, the type of its value, its kind in the file, and its
/// default as it is written there. The comment is the meaning in the reference.
///
/// With `pub struct` the structure and its defaults are made too; with `impl` the structure stands elsewhere. `besides`
/// names the fields that are read in another way, or do not come from the file.
macro_rules! field_table {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $($(#[doc = $about:literal])+ $field:ident: $type:ty = $kind:expr, $how:ident($default:literal);)+
        }
        $(besides { $($(#[$other_meta:meta])* pub $other:ident: $other_type:ty,)+ })?
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $(
                $(#[doc = $about])+
                #[doc = concat!(" Default ", $default, ".")]
                pub $field: $type,
            )+
            $($($(#[$other_meta])* pub $other: $other_type,)+)?
        }

        impl Default for $name {
            fn default() -> $name {
                let [$($field),+] = <$name as $crate::fields::FieldTable>::FIELDS else {
                    unreachable!("it has these fields");
                };
                $name {
                    $($field: $crate::fields::FieldValue::preset($field),)+
                    $($($other: Default::default(),)+)?
                }
            }
        }

        $crate::fields::field_table! {
            impl $name $(besides $($other),+)? {
                $($(#[doc = $about])+ $field: $type = $kind, $how($default);)+
            }
        }
    };
    (
        impl $name:ident $(besides $($besides:ident),+)? {
            $($(#[doc = $about:literal])+ $field:ident: $type:ty = $kind:expr, $how:ident($default:literal);)+
        }
    ) => {
        impl $crate::fields::FieldTable for $name {
            const FIELDS: &'static [$crate::fields::schema::Field] = $crate::fields::schema::fields! {
                $($(#[doc = $about])+ $field = $kind, $how($default);)+
            };

            fn read_over(section: $crate::fields::section::Section<'_>, base: &$name) -> $name {
                // A field that is not declared does not compile.
                let $name { $($field: _,)+ $($($besides: _,)+)? } = base;
                let mut read = base.clone();
                $(read.$field = $crate::fields::read_written(section, stringify!($field))
                    .unwrap_or_else(|| base.$field.clone());)+
                read
            }

            #[cfg(test)]
            fn presets() -> $name {
                let [$($field),+] = Self::FIELDS else {
                    unreachable!("it has these fields");
                };
                let mut presets = $name::default();
                $(presets.$field = $crate::fields::FieldValue::preset($field);)+
                presets
            }

            fn write_over(&self, table: &mut $crate::fields::written::Table, base: Option<&$name>) {
                let [$($field),+] = Self::FIELDS else {
                    unreachable!("it has these fields");
                };
                $($crate::fields::write_over::<$type>(table, $field, &self.$field, base.map(|base| &base.$field));)+
            }
        }
    };
}

pub(crate) use field_table;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Detector, Properties, Proximity, SensorSuite};
    use starl_motion::avoidance;

    #[test]
    fn structures_of_other_crates_have_the_defaults_of_the_reference() {
        fn check<T: FieldTable>() {
            assert_eq!(T::presets().write_inline(), None);
        }
        check::<Properties>();
        check::<avoidance::Options>();
        check::<SensorSuite>();
        check::<Proximity>();
        check::<Detector>();
    }
}
