//! The robot models, one file each, and how to find them by name.
//!
//! To add a model: write its file here, its tracker in [`crate::tracking`] if no tracker there fits,
//! and one line in [`KINDS`]. The conformance suite finds it there.

mod ardrone;
mod car;
mod create;
mod differential;
mod holonomic;
mod unicycle;

pub use ardrone::{Ardrone, ArdroneParameters, mode as drone_mode};
pub use car::{Car, CarParameters};
pub use create::{Create, CreateParameters};
pub use differential::{Differential, DifferentialParameters};
pub use holonomic::{Holonomic, HolonomicParameters};

use crate::Model;
use crate::parameters::{Field, ParameterError, ParameterSet};
use alloc::string::{String, ToString};
use alloc::sync::Arc;

/// A model that is built from parameters.
pub(crate) trait Parameterised: Model + Sized + 'static {
    type Parameters: ParameterSet;

    /// The model with these parameters.
    fn build(parameters: Self::Parameters) -> Result<Self, ParameterError>;
}

/// Builds a model, whose name goes into errors, with these parameters set.
type Make = fn(&'static str, &[(String, f64)]) -> Result<Arc<dyn Model>, ParameterError>;

/// An entry of the registry.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The model's name, as scenarios spell it.
    pub name: &'static str,
    /// A description, in one line.
    pub summary: &'static str,
    /// Its parameters.
    pub fields: &'static [Field],
    make: Make,
}

impl Kind {
    const fn of<M: Parameterised>(name: &'static str, summary: &'static str) -> Kind {
        Kind {
            name,
            summary,
            fields: M::Parameters::FIELDS,
            make: make::<M>,
        }
    }
}

/// Every model.
pub const KINDS: [Kind; 5] = [
    Kind::of::<Create>(
        create::NAME,
        "iRobot Create, a round ground robot that turns on the spot",
    ),
    Kind::of::<Ardrone>(ardrone::NAME, "Parrot AR.Drone 2, a quadcopter"),
    Kind::of::<Car>(
        car::NAME,
        "a tenth-scale car with a smallest turning radius",
    ),
    Kind::of::<Holonomic>(holonomic::NAME, "an ideal robot that moves any way at once"),
    Kind::of::<Differential>(
        differential::NAME,
        "a small two-wheeled swarm robot (foot-bot)",
    ),
];

/// The name of every model, with what it is in one line.
pub const NAMES: [(&str, &str); KINDS.len()] = {
    let mut names = [("", ""); KINDS.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = (KINDS[i].name, KINDS[i].summary);
        i += 1;
    }
    names
};

/// The model of this name with its default parameters.
pub fn by_name(name: &str) -> Option<Arc<dyn Model>> {
    with_parameters(name, &[]).ok()
}

/// The model of this name with some of its parameters set, by name.
///
/// # Errors
/// If there is no such model or parameter, or a value does not do.
pub fn with_parameters(
    name: &str,
    parameters: &[(String, f64)],
) -> Result<Arc<dyn Model>, ParameterError> {
    let kind = KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| {
        ParameterError::UnknownModel {
            name: name.to_string(),
            known: NAMES.iter().map(|(name, _)| *name).collect(),
        }
    })?;
    (kind.make)(kind.name, parameters)
}

fn make<M: Parameterised>(
    model: &'static str,
    settings: &[(String, f64)],
) -> Result<Arc<dyn Model>, ParameterError> {
    let mut parameters = M::Parameters::default();
    for (name, value) in settings {
        let field = parameters
            .field(name)
            .ok_or_else(|| ParameterError::UnknownField {
                model,
                field: name.clone(),
                allowed: M::Parameters::FIELDS,
            })?;
        *field = *value;
    }
    Ok(Arc::new(M::build(parameters)?))
}
