//! Definitions of typed events: an enum, and with it the names in traces of its variants and fields.

/// Defines the events of one primitive. Each variant has the name that traces give it; its fields are called in
/// traces as here, in this order. After `+` stands a variant whose events are another definition's.
macro_rules! events {
    (
        $(#[$about:meta])*
        $name:ident $(+ $(#[$about_inner:meta])* $inner:ident($inner_events:ident))? {
            $(
                $(#[$about_variant:meta])*
                $variant:ident = $word:literal
                $({ $($(#[$about_field:meta])* $field:ident: $type:ty),* $(,)? })?
            ),* $(,)?
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $name {
            $(
                $(#[$about_variant])*
                $variant $({ $($(#[$about_field])* $field: $type),* })?,
            )*
            $($(#[$about_inner])* $inner($inner_events),)?
        }

        impl $name {
            /// Its name in traces.
            pub fn name(&self) -> &'static str {
                match self {
                    $($name::$variant { .. } => $word,)*
                    $($name::$inner(event) => event.name(),)?
                }
            }

            pub(in crate::event) fn show<'a>(&'a self, shown: &mut $crate::event::ValueRefs<'a>) {
                match self {
                    $($name::$variant { $($($field),*)? } => {
                        $($($crate::event::fields::Field::show($field, stringify!($field), shown);)*)?
                    })*
                    $($name::$inner(event) => event.show(shown),)?
                }
            }

            /// The event that traces call so, if these are its fields.
            pub(in crate::event) fn read(
                name: &str,
                fields: &[($crate::event::Name, $crate::event::Value)],
            ) -> Option<$name> {
                let mut reader = $crate::event::fields::Reader(fields);
                let event = match name {
                    $($word => $name::$variant {
                        $($($field: read!(reader, $field)),*)?
                    },)*
                    _ => return otherwise!(name, fields $(, $inner_events, $name::$inner)?),
                };
                reader.end(event)
            }
        }

        $(impl From<$inner_events> for $name {
            fn from(event: $inner_events) -> $name {
                $name::$inner(event)
            }
        })?
    };
}

macro_rules! read {
    ($reader:ident, $field:ident) => {
        $crate::event::fields::Field::read(stringify!($field), &mut $reader)?
    };
}

macro_rules! otherwise {
    ($name:ident, $fields:ident) => {
        None
    };
    ($name:ident, $fields:ident, $inner:ident, $wrap:path) => {
        $inner::read($name, $fields).map($wrap)
    };
}

/// Defines fields that stand together in several events, and in traces among the others.
macro_rules! group {
    (
        $(#[$about:meta])*
        $name:ident { $($(#[$about_field:meta])* $field:ident: $type:ty),* $(,)? }
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub struct $name {
            $($(#[$about_field])* pub $field: $type,)*
        }

        impl $crate::event::fields::Field for $name {
            fn show<'a>(&'a self, _: &'static str, shown: &mut $crate::event::ValueRefs<'a>) {
                $($crate::event::fields::Field::show(&self.$field, stringify!($field), shown);)*
            }

            fn read(_: &str, reader: &mut $crate::event::fields::Reader<'_>) -> Option<$name> {
                Some($name {
                    $($field: $crate::event::fields::Field::read(stringify!($field), reader)?,)*
                })
            }
        }
    };
}

/// Defines fields that are one of some words.
macro_rules! words {
    (
        $(#[$about:meta])*
        $name:ident { $($(#[$about_variant:meta])* $variant:ident = $word:literal),* $(,)? }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$about_variant])* $variant,)*
        }

        impl $name {
            /// Its name in traces.
            pub fn name(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }

            fn named(name: &str) -> Option<$name> {
                match name {
                    $($word => Some($name::$variant),)*
                    _ => None,
                }
            }
        }

        impl $crate::event::fields::Field for $name {
            fn show<'a>(&'a self, name: &'static str, shown: &mut $crate::event::ValueRefs<'a>) {
                shown.push((name, $crate::event::ValueRef::Text(self.name())));
            }

            fn read(name: &str, reader: &mut $crate::event::fields::Reader<'_>) -> Option<$name> {
                reader.text(name).and_then($name::named)
            }
        }
    };
}
