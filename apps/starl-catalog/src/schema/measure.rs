//! Additional information about a field for forms.

use super::Object;
use serde_json::json;
use starl_sim::read::schema::{Dimension, Kind, LEAST_PERIOD, Range};

/// Adds the information for forms.
pub(super) fn annotate(schema: &mut Object, kind: &Kind) {
    schema.put("x-kind", json!(word(kind)));
    match kind {
        Kind::Probability => measure(schema, "probability".to_string(), Dimension::Ratio),
        Kind::Quantity(dimension, range) => {
            measure(schema, quantity_name(*dimension), *dimension);
            match range {
                Range::Any => {}
                Range::NotNegative => schema.put("x-minimum", json!(0)),
                Range::Positive => schema.put("x-exclusive-minimum", json!(0)),
                Range::Period => schema.put("x-minimum", json!(LEAST_PERIOD)),
            }
        }
        _ => {}
    }
}

pub(super) fn measure(schema: &mut Object, quantity: String, dimension: Dimension) {
    schema.put("x-quantity", json!(quantity));
    schema.put("x-units", json!(dimension.unit_names().collect::<Vec<_>>()));
}

/// The name of a quantity: `rate_of_turn`.
pub(super) fn quantity_name(dimension: Dimension) -> String {
    let name = dimension.name();
    let name = name.split_once(' ').map_or(name, |(_, name)| name);
    name.replace(' ', "_")
}

fn word(kind: &Kind) -> &'static str {
    match kind {
        Kind::Text => "text",
        Kind::Texts => "texts",
        Kind::Flag => "flag",
        Kind::Choice(_) => "choice",
        Kind::Model => "model",
        Kind::Count(..) => "count",
        Kind::Probability => "probability",
        Kind::Quantity(..) => "quantity",
        Kind::Point => "point",
        Kind::PlanarPoint => "planar_point",
        Kind::Outline => "outline",
        Kind::Velocity => "velocity",
        Kind::Heights => "heights",
        Kind::Robots => "robots",
        Kind::RobotGroups => "robot_groups",
        Kind::Parameters => "parameters",
        Kind::ModelParameters => "model_parameters",
        Kind::Table(_) => "table",
        Kind::Tables(_) => "tables",
        Kind::Switch(_) => "switch",
    }
}
