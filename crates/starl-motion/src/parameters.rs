//! Parameters of robot models: named numbers with a unit, a default and a range, from which a model
//! is built, and which a scenario may set by name.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use thiserror::Error;

/// One parameter of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Its name, as a scenario spells it.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its value unless set.
    pub default: f64,
    /// Its smallest value.
    pub low: f64,
    /// Its greatest value.
    pub high: f64,
}

/// Why a model cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParameterError {
    /// There is no model of this name.
    #[error("there is no robot model `{name}`; the models are {}", quoted(known.iter().copied()))]
    UnknownModel {
        /// The name.
        name: String,
        /// Those that there are.
        known: Vec<&'static str>,
    },
    /// The model has no such parameter.
    #[error("model `{model}` has no parameter `{field}`; it has {}", quoted(allowed.iter().map(|field| field.name)))]
    UnknownField {
        /// The model's name.
        model: &'static str,
        /// The name that is not among its parameters.
        field: String,
        /// Those it has.
        allowed: &'static [Field],
    },
    /// A parameter is out of its range or not a number.
    #[error("`{}` is {value}, but must be {} to {} {}", field.name, field.low, field.high, field.unit)]
    OutOfRange {
        /// The parameter.
        field: Field,
        /// The value it was to have.
        value: f64,
    },
    /// Two parameters contradict each other.
    #[error("`{lesser}` must not exceed `{greater}`")]
    Inconsistent {
        /// The parameter that should be the smaller one.
        lesser: &'static str,
        /// The parameter that should be the greater one.
        greater: &'static str,
    },
}

fn quoted(names: impl Iterator<Item = &'static str>) -> String {
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// A set of parameters that can be set by name; [`parameters!`] writes the implementations.
pub(crate) trait ParameterSet: Default {
    /// The parameters in the order of their declaration.
    const FIELDS: &'static [Field];

    /// The parameter called `name`.
    fn field(&mut self, name: &str) -> Option<&mut f64>;

    /// Whether every parameter is in its range.
    fn check_ranges(&self) -> Result<(), ParameterError>;

    /// The parameters that are not at their defaults, with their values.
    fn changed(&self) -> Vec<(Field, f64)>;
}

/// Fails unless `lesser` is at most `greater`; each is a name and a value.
pub(crate) fn ordered(
    lesser: (&'static str, f64),
    greater: (&'static str, f64),
) -> Result<(), ParameterError> {
    if lesser.1 <= greater.1 {
        return Ok(());
    }
    Err(ParameterError::Inconsistent {
        lesser: lesser.0,
        greater: greater.0,
    })
}

/// Declares a struct of parameters; each line reads `name: "unit" = default, low to high;`.
macro_rules! parameters {
    (
        $(#[$outer:meta])*
        pub struct $name:ident {
            $( $(#[$inner:meta])* $field:ident: $unit:literal = $default:expr, $low:literal => $high:literal; )*
        }
    ) => {
        $(#[$outer])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $( $(#[$inner])* #[doc = concat!("\n\nUnit: ", $unit, ".")] pub $field: f64, )*
        }

        impl Default for $name {
            fn default() -> $name {
                $name { $( $field: $default, )* }
            }
        }

        impl $crate::parameters::ParameterSet for $name {
            const FIELDS: &'static [$crate::parameters::Field] = &[
                $( $crate::parameters::Field {
                    name: stringify!($field),
                    unit: $unit,
                    default: $default,
                    low: $low,
                    high: $high,
                }, )*
            ];

            fn field(&mut self, name: &str) -> Option<&mut f64> {
                match name {
                    $( stringify!($field) => Some(&mut self.$field), )*
                    _ => None,
                }
            }

            fn check_ranges(&self) -> Result<(), $crate::ParameterError> {
                let values = [$( self.$field ),*];
                for (field, value) in Self::FIELDS.iter().zip(values) {
                    if !(field.low..=field.high).contains(&value) {
                        return Err($crate::ParameterError::OutOfRange { field: *field, value });
                    }
                }
                Ok(())
            }

            fn changed(&self) -> alloc::vec::Vec<($crate::parameters::Field, f64)> {
                let values = [$( self.$field ),*];
                let all = Self::FIELDS.iter().copied().zip(values);
                all.filter(|(field, value)| field.default != *value).collect()
            }
        }
    };
}
pub(crate) use parameters;
