//! The variables and parameters that clients find in an emulated Crazyflie.

use super::flight::Flight;
use starl_crazyflie::log::kind;

/// A variable: its name, its type, and its value now.
pub(super) type Variable = (&'static str, u8, fn(&Flight) -> f64);

/// The variables, by number. A real Crazyflie has some hundreds; these are named as there.
pub(super) const VARIABLES: [Variable; 13] = [
    ("pm.vbat", kind::F32, |flight| 3.2 + flight.battery()),
    ("pm.batteryLevel", kind::U8, |flight| {
        100.0 * flight.battery()
    }),
    ("stabilizer.yaw", kind::F32, |flight| {
        flight.yaw().to_degrees()
    }),
    ("stateEstimate.x", kind::F32, |flight| flight.position().x),
    ("stateEstimate.y", kind::F32, |flight| flight.position().y),
    ("stateEstimate.z", kind::F32, |flight| flight.position().z),
    ("stateEstimate.yaw", kind::F32, |flight| {
        flight.yaw().to_degrees()
    }),
    ("stateEstimateZ.z", kind::I16, |flight| {
        1000.0 * flight.position().z
    }),
    ("stateEstimateZ.vx", kind::I16, |flight| {
        1000.0 * flight.velocity().x
    }),
    ("stateEstimateZ.vy", kind::I16, |flight| {
        1000.0 * flight.velocity().y
    }),
    ("stateEstimateZ.vz", kind::I16, |flight| {
        1000.0 * flight.velocity().z
    }),
    ("supervisor.info", kind::U16, |flight| flight.info().into()),
    ("sys.canfly", kind::U8, |flight| {
        f64::from(u8::from(flight.can_fly()))
    }),
];

/// The parameters, by number: bytes, with their first values.
pub(super) const PARAMETERS: [(&str, u8); 3] = [
    ("commander.enHighLevel", 1),
    ("kalman.resetEstimation", 0),
    ("stabilizer.estimator", 2),
];

/// The encoding of a value in this type; none if the type is not supported.
pub(super) fn encode(value: f64, kind: u8) -> Option<Vec<u8>> {
    Some(match kind {
        kind::U8 => vec![value as u8],
        kind::U16 => (value as u16).to_le_bytes().to_vec(),
        kind::I16 => (value as i16).to_le_bytes().to_vec(),
        kind::F32 => (value as f32).to_le_bytes().to_vec(),
        _ => return None,
    })
}
